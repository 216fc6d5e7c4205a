//! Proofs of the engine's answers hold, and forged ones do not.

use ccd_check::Stop;
use ccd_core::glam::DVec3;
use ccd_core::{Motion, Pose};
use ccd_prove::{
    AxisKind, Body, Carried, Joint, Link, NotProven, Pair, Proof, Scene, Statement, Witness, prove,
    steps_text,
};
use rigid_ccd::mesh::{Detail, TriangleMesh, body_from_mesh};
use rigid_ccd::{Outcome, Settings, Solver};
use std::f64::consts::TAU;

/// Where the number of witnesses stands in the file of a query of two free bodies.
const WITNESSES_AT: usize = 28 + 2 * 152 + 2 * 36 + 16 + 8;

/// The bytes of a witness, and of a leaf with a plane.
const WITNESS: usize = 70;
const PLANE: usize = 29;

/// A torus of triangles about z, a mesh that is not convex.
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

/// A mesh with balls around its vertices.
fn rounded((vertices, faces): &(Vec<[f64; 3]>, Vec<[u32; 3]>), radius: f64) -> Body {
    let vertices: Vec<[f64; 4]> = vertices
        .iter()
        .map(|&[x, y, z]| [x, y, z, radius])
        .collect();
    Body::rounded(&vertices, faces)
}

/// A generator of numbers from -1 to 1.
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
        let place = DVec3::from_array(self.vector(2.0));
        let turn = [self.number(), self.number(), self.number(), self.number()];
        let start = Pose::new(place, turn).unwrap();
        Motion::about(start, self.vector(3.0), self.vector(4.0), self.vector(0.3)).unwrap()
    }
}

/// Two meshes, as the engine and as proofs take them; these have the second one with rounded triangles, too.
struct Meshes {
    engine: [rigid_ccd::Body; 2],
    proofs: [Body; 3],
}

impl Meshes {
    fn new() -> Self {
        let meshes = [torus(12, 0.3), torus(9, 0.25)];
        let engine = |(vertices, faces): &(Vec<[f64; 3]>, Vec<[u32; 3]>)| {
            let mesh = TriangleMesh::new(vertices.clone(), faces).unwrap();
            body_from_mesh(&mesh, Detail::Surface).unwrap().body
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

    /// Asks the engine when the bodies first touch, and proves the answer; `None` if they do at the start.
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

/// Proofs about random motions that do not touch at the start: so many of each claim.
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

fn reason(verdict: Result<(), Stop>) -> &'static str {
    match verdict {
        Err(Stop::Broken(reason, _)) => reason,
        other => panic!("{other:?}"),
    }
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
fn a_body_that_rests_inside_the_range_of_another_is_proven_free() {
    let meshes = Meshes::new();
    // Both turn about z, as a wheel on its axle: no axis of the world stays between them.
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

/// Two arms on one turning column, each with a joint that turns and one that slides.
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
        joint(0, AxisKind::Turns, 0.0, DVec3::Z, [0.3, 9.0]),
        joint(1, AxisKind::Turns, 2.0, DVec3::Y, [0.2, 0.7]),
        joint(2, AxisKind::Slides, 0.5, DVec3::X, [0.0, 0.4]),
        joint(1, AxisKind::Turns, -2.0, DVec3::Y, [0.1, -0.9]),
        joint(4, AxisKind::Slides, -0.5, DVec3::X, [-0.1, -0.3]),
    ];
    let carried = |k: usize, link| Carried {
        body: &meshes.proofs[k],
        link,
    };
    let bodies = vec![carried(0, 3), carried(2, 5), carried(2, 0)];
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

/// The column turns by nine radians, which moves both arms alike. No stretch may be longer than two radians, but each takes as few
/// leaves as if the column stood still.
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
    let still = prove(&scene, 1.0, None).unwrap();
    assert_eq!(meshes.check(&still), Ok(()));
    assert!(
        turning.leaves <= 16 * still.leaves,
        "{} {}",
        turning.leaves,
        still.leaves
    );
}

#[test]
fn arms_and_a_body_at_rest_are_proven_apart_unless_its_radius_reaches_them() {
    let meshes = Meshes::new();
    let mut scene = arms(&meshes);
    let whole = prove(&scene, 1.0, None).unwrap();
    assert_eq!(meshes.check(&whole), Ok(()));
    let thick = rounded(&torus(9, 0.25), 3.0);
    scene.bodies[2].body = &thick;
    let touching = prove(&scene, 1.0, None);
    assert!(
        matches!(touching, Err(NotProven::Touching { .. })),
        "{touching:?}"
    );
}

/// Returns the last step of a proof as text.
fn last_step(bytes: &[u8]) -> String {
    let steps = steps_text(bytes, &Statement::read(bytes).unwrap());
    steps.lines().last().unwrap_or_default().to_owned()
}

#[test]
fn each_kind_of_forgery_is_seen() {
    let meshes = Meshes::new();
    let [free, contacts] = proofs(&meshes, 10);
    // One whose last leaf has a plane, and one whose last leaf has a ball.
    let [proof, with_ball] = ["plane", "ball"].map(|name| {
        let mut proofs = free.iter().map(|(_, proof)| proof);
        let is_last = |proof: &&Proof| last_step(&proof.bytes).starts_with(name);
        proofs.find(is_last).unwrap()
    });
    let bodies = meshes.bodies(&proof.bytes);
    let reason_of = |bytes: &[u8]| reason(ccd_check::check(&bodies, bytes));
    assert_eq!(ccd_check::check(&bodies, &proof.bytes), Ok(()));
    // The last leaf is dropped, and one too many is there.
    let end = proof.bytes.len();
    assert_eq!(
        reason_of(&proof.bytes[..end - PLANE]),
        "the file ends too early"
    );
    let longer = [&proof.bytes[..], &proof.bytes[end - PLANE..]].concat();
    assert_eq!(reason_of(&longer), "the file goes on after its end");
    // A leaf has a normal of no length, or one that is too long, or its plane is on the other side of A or of B.
    let bent = |normal: [i64; 3], offset: Option<i64>| {
        let mut bytes = proof.bytes.clone();
        let mut numbers: Vec<i64> = normal.into();
        numbers.extend(offset);
        for (k, number) in numbers.into_iter().enumerate() {
            let at = end - PLANE + 1 + 7 * k;
            bytes[at..at + 7].copy_from_slice(&number.to_le_bytes()[..7]);
        }
        bytes
    };
    let not_apart = "a leaf does not prove that its parts are apart";
    assert_eq!(reason_of(&bent([0; 3], None)), not_apart);
    assert_eq!(reason_of(&bent([1 << 50, 1, 0], None)), not_apart);
    let normal = [1, 8, 15].map(|k| {
        let bytes = &proof.bytes[end - PLANE + k..end - PLANE + k + 7];
        let high = if bytes[6] < 128 { 0 } else { 255 };
        i64::from_le_bytes([&[high], bytes].concat().try_into().unwrap()) >> 8
    });
    for offset in [-(1 << 55), (1 << 55) - 1] {
        assert_eq!(reason_of(&bent(normal, Some(offset))), not_apart);
    }
    // One leaf stands for everything.
    for leaf in [&[6][..], &[7], &proof.bytes[end - PLANE..]] {
        let contact = &contacts[0].1;
        let nothing = [&contact.bytes[..WITNESSES_AT], &[0; 4], leaf].concat();
        let verdict = ccd_check::check(&meshes.bodies(&contact.bytes), &nothing);
        assert_eq!(reason(verdict), not_apart);
    }
    // The ball is around the other body, or there is no such step.
    let mut around = with_ball.bytes.clone();
    *around.last_mut().unwrap() = 8;
    let bodies_of_ball = meshes.bodies(&with_ball.bytes);
    assert_eq!(
        reason(ccd_check::check(&bodies_of_ball, &around)),
        "there is no such step"
    );
    // A mesh is not given.
    assert_eq!(
        reason(ccd_check::check(&bodies[..1], &proof.bytes)),
        "a mesh is none of those that are given, in this unit"
    );
}

/// Weights are read as they are stated, also that of a point that is a corner, which has all.
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
    let stated = Statement::read(&proof.bytes).unwrap().witness.unwrap();
    for (_, weights) in stated.points {
        assert_eq!(weights.iter().sum::<u64>(), 1 << 55);
        assert_eq!(weights.iter().max(), Some(&(1 << 55)));
    }
}

#[test]
fn contacts_that_are_said_to_be_later_are_seen() {
    let meshes = Meshes::new();
    let [_, contacts] = proofs(&meshes, 10);
    // The bodies are said to be free for longer than they are, and to touch later.
    for (_, proof) in &contacts {
        let bodies = meshes.bodies(&proof.bytes);
        let mut bytes = proof.bytes.clone();
        let until = WITNESSES_AT - 8..WITNESSES_AT;
        let time = f64::from_le_bytes(bytes[until.clone()].try_into().unwrap());
        bytes[until].copy_from_slice(&(time + 0.01).to_le_bytes());
        assert!(ccd_check::check(&bodies, &bytes).is_err());
        let mut free = bytes[..WITNESSES_AT].to_vec();
        free.extend([0; 4]);
        free.extend(&bytes[WITNESSES_AT + 4 + WITNESS..]);
        assert!(ccd_check::check(&bodies, &free).is_err());
    }
}

#[test]
fn witnesses_that_are_not_near_or_not_on_their_triangles_are_seen() {
    let meshes = Meshes::new();
    let [_, contacts] = proofs(&meshes, 10);
    let triangle = WITNESSES_AT + 4 + 4 + 16;
    for (_, proof) in &contacts {
        let bodies = meshes.bodies(&proof.bytes);
        // Another triangle, one that is none, and weights that are more than 1, or less.
        let verdict_with = |at: usize, with: &[u8]| {
            let mut bytes = proof.bytes.clone();
            bytes[at..at + with.len()].copy_from_slice(with);
            reason(ccd_check::check(&bodies, &bytes))
        };
        let number = u32::from_le_bytes(proof.bytes[triangle..][..4].try_into().unwrap());
        let other = (number + 100) % (2 * 12 * 12);
        let far = "the witnesses are too far from each other";
        assert_eq!(verdict_with(triangle, &other.to_le_bytes()), far);
        let none = "there is nothing of this number";
        assert_eq!(verdict_with(triangle, &[0xff; 4]), none);
        let not_one = "the weights of a witness do not add up to 1";
        assert_eq!(verdict_with(triangle + 4, &[0xff; 21]), not_one);
        assert_eq!(verdict_with(triangle + 4, &[0; 21]), not_one);
    }
}

#[test]
fn an_order_that_omits_a_triangle_or_belongs_to_another_mesh_is_seen() {
    let meshes = Meshes::new();
    let body = &meshes.proofs[0];
    let proof = proofs(&meshes, 1)[0][0].1.bytes.clone();
    let read = |mesh: &[u8], certificate: &[u8]| {
        reason(ccd_check::Body::new(mesh, certificate, &proof).map(|_| ()))
    };
    // The last part of a tree is a triangle, and so is one before.
    let mut twice = body.certificate().to_vec();
    let end = twice.len();
    let places = (40..end - 4).step_by(4).rev();
    let number = |at: usize| u32::from_le_bytes(twice[at..at + 4].try_into().unwrap());
    let another = places.map(number).find(|&other| other > 144).unwrap();
    twice[end - 4..].copy_from_slice(&another.to_le_bytes());
    assert_eq!(read(body.mesh(), &twice), "a tree has a triangle twice");
    // A vertex is moved by the least that its numbers can tell.
    let mut moved = body.mesh().to_vec();
    moved[8] ^= 1;
    let other = "this is the certificate of another mesh";
    assert_eq!(read(&moved, body.certificate()), other);
    let short = &body.certificate()[..body.certificate().len() - 1];
    assert_eq!(read(body.mesh(), short), "the file ends too early");
}

/// Changes bits of proofs at random. What still holds must be true, by the motions that it states.
#[test]
fn no_random_forgery_is_accepted_that_is_false() {
    let meshes = Meshes::new();
    let mut random = Random(7);
    let [mut all, contacts] = proofs(&meshes, 8);
    all.extend(contacts);
    let (mut accepted, mut refused) = (0, 0);
    for (_, proof) in &all {
        let bodies = meshes.bodies(&proof.bytes);
        for _ in 0..500 {
            let mut bytes = proof.bytes.clone();
            // Half of the changes are to the statement.
            let limit = if random.bits().is_multiple_of(2) {
                WITNESSES_AT
            } else {
                bytes.len()
            };
            let at = random.bits() as usize % limit;
            bytes[at] ^= 1 << (random.bits() % 8);
            if ccd_check::check(&bodies, &bytes) == Ok(()) {
                accepted += 1;
                assert!(is_true(&meshes, &bytes), "byte {at}");
            } else {
                refused += 1;
            }
        }
    }
    assert!(accepted > 100 && refused > 3000, "{accepted} {refused}");
}

/// Returns whether no sampled pair of triangles crosses until the time that a certificate states.
fn is_true(meshes: &Meshes, bytes: &[u8]) -> bool {
    let number = |at: usize| f64::from_le_bytes(bytes[at..at + 8].try_into().unwrap());
    let vector = |at: usize| [number(at), number(at + 8), number(at + 16)];
    let motions = [32, 32 + 152].map(|at| {
        let turn = [0, 1, 2, 3].map(|k| number(at + 24 + 8 * k));
        let start = Pose::new(vector(at), turn).unwrap();
        // What a forger has made of the axes and of the start is no motion of a free body.
        let is_free = bytes[at + 80..at + 84] == [0; 4] && number(at + 132) == 0.0;
        let [velocity, spin] = [84, 108].map(|k| vector(at + k).map(|x| x * number(at + 140)));
        is_free.then(|| Motion::about(start, velocity, spin, vector(at + 56)).unwrap())
    });
    let [Some(a), Some(b)] = motions else {
        return true;
    };
    let motions = [a, b];
    let until = number(WITNESSES_AT - 8);
    let mut solver = Solver::new();
    (0..20).all(|k| {
        let time = until * f64::from(k) / 20.0;
        let [a, b] = [0, 1].map(|k| (&meshes.engine[k], motions[k].pose(time)));
        solver.distance(a, b).unwrap().outcome.upper() > 0.0
    })
}
