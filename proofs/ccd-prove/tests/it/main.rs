//! Tests that proofs of the engine's answers hold, and that forged proofs do not.

mod forged;

use ccd_check::Stop;
use ccd_core::glam::DVec3;
use ccd_core::{Motion, Pose};
use ccd_prove::{
    AxisKind, Body, Joint, Link, NotProven, Pair, Proof, Scene, SceneBody, Statement, Witness,
    prove,
};
use rigid_ccd::mesh::{PieceChoice, TriangleMesh, body_from_mesh};
use rigid_ccd::{Outcome, Settings, Solver};
use std::f64::consts::TAU;

/// The position of the number of witnesses in a certificate of two free bodies.
const WITNESSES_AT: usize = 28 + 2 * 152 + 2 * 36 + 16 + 8;

/// Returns the mesh of a torus about z, with `count` vertices in both directions.
fn torus(count: usize, radius: f64) -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
    let (mut vertices, mut faces) = (Vec::new(), Vec::new());
    let number = |i: usize, j: usize| ((i % count) * count + j % count) as u32;
    for i in 0..count {
        for j in 0..count {
            let [a, b] = [i, j].map(|k| k as f64 / count as f64 * TAU);
            let out = 1.0 + radius * b.cos();
            vertices.push([out * a.cos(), out * a.sin(), radius * b.sin()]);
            faces.push([number(i, j), number(i + 1, j), number(i + 1, j + 1)]);
            faces.push([number(i, j), number(i + 1, j + 1), number(i, j + 1)]);
        }
    }
    (vertices, faces)
}

/// Returns a body with balls around its vertices.
fn rounded((vertices, faces): &(Vec<[f64; 3]>, Vec<[u32; 3]>), radius: f64) -> Body {
    let vertices: Vec<[f64; 4]> = vertices
        .iter()
        .map(|&[x, y, z]| [x, y, z, radius])
        .collect();
    Body::rounded(&vertices, faces)
}

/// A generator of random numbers from -1 to 1.
struct Random(u64);

impl Random {
    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005);
        self.0 = self.0.wrapping_add(1_442_695_040_888_963_407);
        self.0 >> 33
    }

    fn number(&mut self) -> f64 {
        self.bits() as f64 / (1u64 << 30) as f64 - 1.0
    }

    fn vector(&mut self, size: f64) -> [f64; 3] {
        [
            self.number() * size,
            self.number() * size,
            self.number() * size,
        ]
    }

    fn motion(&mut self) -> Motion {
        let position = DVec3::from_array(self.vector(2.0));
        let quaternion = [self.number(), self.number(), self.number(), self.number()];
        let start = Pose::new(position, quaternion).unwrap();
        Motion::about(start, self.vector(3.0), self.vector(4.0), self.vector(0.3)).unwrap()
    }
}

/// Two meshes as bodies of the engine and of proofs. A third body for proofs is the second mesh with rounded triangles.
struct Meshes {
    engine: [rigid_ccd::Body; 2],
    proofs: [Body; 3],
}

impl Meshes {
    fn new() -> Self {
        let meshes = [torus(12, 0.3), torus(9, 0.25)];
        let engine = |(vertices, faces): &(Vec<[f64; 3]>, Vec<[u32; 3]>)| {
            let mesh = TriangleMesh::new(vertices.clone(), faces).unwrap();
            body_from_mesh(&mesh, PieceChoice::Surface).unwrap().body
        };
        Meshes {
            engine: [engine(&meshes[0]), engine(&meshes[1])],
            proofs: [
                Body::new(&meshes[0].0, &meshes[0].1),
                Body::new(&meshes[1].0, &meshes[1].1),
                rounded(&meshes[1], 0.02),
            ],
        }
    }

    /// Computes the first contact with the engine, and proves the answer. Returns `None` for a contact at the start.
    fn prove(&self, motions: [Motion; 2]) -> Option<Proof> {
        self.prove_within(Settings::DEFAULT.tolerance, motions)
    }

    fn prove_within(&self, tolerance: f64, motions: [Motion; 2]) -> Option<Proof> {
        let mut solver = Solver::new().with_settings(Settings {
            tolerance,
            ..Settings::DEFAULT
        });
        let (a, b) = ((&self.engine[0], motions[0]), (&self.engine[1], motions[1]));
        let (until, witness) = match solver.first_contact(a, b, 1.0).unwrap().outcome {
            Outcome::Free { .. } => (1.0, None),
            Outcome::Contact { time, contact } => {
                (time, Some(Witness::of_two(time, tolerance, &contact)))
            }
            _ => return None,
        };
        let [a, b, _] = &self.proofs;
        let scene = Scene::of_two((a, motions[0]), (b, motions[1]), 0.0);
        Some(prove(&scene, until, witness).unwrap())
    }

    fn bodies(&self, proof: &[u8]) -> [ccd_check::Body; 3] {
        let read =
            |body: &Body| ccd_check::Body::new(body.mesh(), body.certificate(), proof).unwrap();
        self.proofs.each_ref().map(read)
    }

    fn check(&self, proof: &Proof) -> Result<(), Stop> {
        ccd_check::check(&self.bodies(&proof.bytes), &proof.bytes)
    }
}

/// Returns `count` proofs without a contact and `count` proofs with one, for random motions.
fn proofs(meshes: &Meshes, count: usize) -> [Vec<([Motion; 2], Proof)>; 2] {
    let mut random = Random(1);
    let mut found = [Vec::new(), Vec::new()];
    while found.iter().any(|proofs| proofs.len() < count) {
        let motions = [random.motion(), random.motion()];
        let Some(proof) = meshes.prove(motions) else {
            continue;
        };
        let kind = usize::from(proof.bytes[WITNESSES_AT]);
        if found[kind].len() < count {
            found[kind].push((motions, proof));
        }
    }
    found
}

#[test]
fn answers_of_the_engine_are_proven() {
    let meshes = Meshes::new();
    for kind in proofs(&meshes, 40) {
        for (motions, proof) in kind {
            assert_eq!(meshes.check(&proof), Ok(()), "{motions:?}");
            assert!(proof.leaves > 0);
        }
    }
}

#[test]
fn contacts_within_a_billionth_are_proven() {
    let meshes = Meshes::new();
    for (motions, _) in &proofs(&meshes, 8)[1] {
        let proof = meshes.prove_within(1e-9, *motions).unwrap();
        assert_eq!(proof.bytes[WITNESSES_AT], 1);
        assert_eq!(meshes.check(&proof), Ok(()));
    }
}

#[test]
fn a_wheel_that_turns_around_another_one_is_proven_free() {
    let meshes = Meshes::new();
    // Both rotate about z, and their surfaces are near each other. So a plane that is static in the world separates two nodes only
    // for a short time.
    let turning = |height: f64, rate: f64| {
        let start = Pose::at([0.0, 0.0, height]).unwrap();
        Motion::new(start, [0.0; 3], [0.0, 0.0, rate]).unwrap()
    };
    let proof = meshes
        .prove([turning(0.0, 5.0), turning(0.7, -5.0)])
        .unwrap();
    assert_eq!(proof.bytes[WITNESSES_AT], 0);
    assert_eq!(meshes.check(&proof), Ok(()));
}

/// Returns two robot arms on one rotating column, each with a revolute joint and a prismatic joint.
fn arms(meshes: &Meshes) -> Scene<'_> {
    let joint = |parent, kind, x, axis: DVec3, [start, rate]: [f64; 2]| Link {
        parent,
        joint: Joint::Axis {
            kind,
            pose: Pose::new([x, 0.0, 0.5], [0.1, 0.2, 0.0, 1.0]).unwrap(),
            axis,
            start,
            rate,
        },
    };
    let links = vec![
        joint(0, AxisKind::Revolute, 0.0, DVec3::Z, [0.3, 9.0]),
        joint(1, AxisKind::Revolute, 2.0, DVec3::Y, [0.2, 0.7]),
        joint(2, AxisKind::Prismatic, 0.5, DVec3::X, [0.0, 0.4]),
        joint(1, AxisKind::Revolute, -2.0, DVec3::Y, [0.1, -0.9]),
        joint(4, AxisKind::Prismatic, -0.5, DVec3::X, [-0.1, -0.3]),
    ];
    let on_link = |k: usize, link| SceneBody {
        body: &meshes.proofs[k],
        link,
    };
    let bodies = vec![on_link(0, 3), on_link(2, 5), on_link(2, 0)];
    Scene {
        links,
        bodies,
        pairs: [[0, 1], [2, 0]]
            .map(|bodies| Pair {
                bodies,
                margin: 0.01,
            })
            .into(),
    }
}

/// Tests a column that rotates by nine radians and carries both arms. The rotation of the column does not change their distance, so
/// the proof has only a few times as many leaves as with a static column.
#[test]
fn arms_on_a_turning_column_are_proven_apart_from_each_other() {
    let meshes = Meshes::new();
    let mut scene = arms(&meshes);
    scene.pairs.truncate(1);
    let turning = prove(&scene, 1.0, None).unwrap();
    assert_eq!(meshes.check(&turning), Ok(()));
    let Joint::Axis { rate, .. } = &mut scene.links[0].joint else {
        unreachable!()
    };
    *rate = 0.0;
    let static_column = prove(&scene, 1.0, None).unwrap();
    assert_eq!(meshes.check(&static_column), Ok(()));
    assert!(
        turning.leaves <= 16 * static_column.leaves,
        "{} {}",
        turning.leaves,
        static_column.leaves
    );
}

#[test]
fn arms_and_a_body_at_rest_are_proven_apart_unless_its_radius_reaches_them() {
    let meshes = Meshes::new();
    let mut scene = arms(&meshes);
    let proof = prove(&scene, 1.0, None).unwrap();
    assert_eq!(meshes.check(&proof), Ok(()));
    let large_body = rounded(&torus(9, 0.25), 3.0);
    scene.bodies[2].body = &large_body;
    let touching = prove(&scene, 1.0, None);
    assert!(
        matches!(touching, Err(NotProven::Touching { .. })),
        "{touching:?}"
    );
}

/// Tests a witness at a vertex, for which one weight is 1.
#[test]
fn weights_of_witnesses_add_up_to_one() {
    let point = Body::new(&[[0.0; 3]], &[[0; 3]]);
    let falls = Motion::new(
        Pose::at([0.0, 0.0, 1.0]).unwrap(),
        [0.0, 0.0, -1.0],
        [0.0; 3],
    );
    let scene = Scene::of_two((&point, falls.unwrap()), (&point, Motion::STILL), 0.0);
    let witness = Witness {
        pair: 0,
        time: 0.9995,
        tolerance: 1e-3,
        points: [DVec3::new(0.0, 0.0, 0.0005), DVec3::ZERO],
    };
    let proof = prove(&scene, 0.9995, Some(witness)).unwrap();
    let witness = Statement::read(&proof.bytes).unwrap().witness.unwrap();
    for (_, weights) in witness.points {
        assert_eq!(weights.iter().sum::<u64>(), 1 << 55);
        assert_eq!(weights.iter().max(), Some(&(1 << 55)));
    }
}
