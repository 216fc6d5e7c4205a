//! Proofs of the engine's answers hold, and forged ones do not.

use ccd_check::{Fault, Stop};
use ccd_core::glam::DVec3;
use ccd_core::{Motion, Pose};
use ccd_prove::{Body, Claim, Proof, prove};
use rigid_ccd::mesh::{Detail, TriangleMesh, body_from_mesh};
use rigid_ccd::{Outcome, Solver};
use std::f64::consts::TAU;

/// The claim of a free query, and where the steps begin in its file.
const CLAIM_AT: usize = 8 + 8 + 64 + 2 * 128 + 16;
const FREE_STEPS_AT: usize = CLAIM_AT + 1;

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

/// Two meshes, as the engine and as proofs take them.
struct Meshes {
    engine: [rigid_ccd::Body; 2],
    proofs: [Body; 2],
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
            proofs: meshes.map(|(vertices, faces)| Body::new(&vertices, &faces)),
        }
    }

    /// Asks the engine when the bodies first touch, as a claim; `None` if they do at the start.
    fn claim(&self, motions: [Motion; 2]) -> Option<Claim> {
        let mut solver = Solver::new();
        let tolerance = rigid_ccd::Settings::DEFAULT.tolerance;
        let (a, b) = ((&self.engine[0], motions[0]), (&self.engine[1], motions[1]));
        match solver.first_contact(a, b, 1.0).unwrap().outcome {
            Outcome::Free { .. } => Some(Claim::Free),
            Outcome::Contact { time, contact } => Some(Claim::Contact {
                time,
                tolerance,
                witnesses: [contact.separation.witness_a, contact.separation.witness_b],
            }),
            _ => None,
        }
    }

    fn prove(&self, motions: [Motion; 2], claim: Claim) -> Proof {
        let [a, b] = &self.proofs;
        prove((a, motions[0]), (b, motions[1]), (1.0, 0.0), claim).unwrap()
    }

    fn bodies(&self, unit: i32) -> [ccd_check::Body; 2] {
        let [a, b] = &self.proofs;
        let read =
            |body: &Body| ccd_check::Body::new(body.mesh(), body.certificate(), unit).unwrap();
        [read(a), read(b)]
    }

    fn check(&self, proof: &Proof) -> Result<(), Stop> {
        let [a, b] = self.bodies(proof.unit);
        ccd_check::check(&a, &b, &proof.bytes)
    }
}

/// Proofs about random motions that do not touch at the start: so many of each claim.
fn proofs(meshes: &Meshes, count: usize) -> [Vec<([Motion; 2], Proof)>; 2] {
    let mut random = Random(1);
    let mut found = [Vec::new(), Vec::new()];
    while found.iter().any(|proofs| proofs.len() < count) {
        let motions = [random.motion(), random.motion()];
        let Some(claim) = meshes.claim(motions) else {
            continue;
        };
        let kind = usize::from(claim != Claim::Free);
        if found[kind].len() < count {
            found[kind].push((motions, meshes.prove(motions, claim)));
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
fn a_body_that_rests_inside_the_range_of_another_is_proven_free() {
    let meshes = Meshes::new();
    // Both turn about z, as a wheel on its axle: no axis of the world stays between them.
    let spin = Motion::new(Pose::IDENTITY, [0.0; 3], [0.0, 0.0, 5.0]).unwrap();
    let aside = Motion::new(
        Pose::at([0.0, 0.0, 0.7]).unwrap(),
        [0.0; 3],
        [0.0, 0.0, -5.0],
    )
    .unwrap();
    let proof = meshes.prove([spin, aside], Claim::Free);
    assert_eq!(meshes.check(&proof), Ok(()));
}

#[test]
fn each_kind_of_forgery_is_seen() {
    let meshes = Meshes::new();
    let [free, contacts] = proofs(&meshes, 10);
    let (_, proof) = &free[0];
    let [a, b] = meshes.bodies(proof.unit);
    let verdict_on = |bytes: &[u8]| ccd_check::check(&a, &b, bytes);
    let fault_of = |bytes: &[u8]| match verdict_on(bytes) {
        Err(Stop::Broken(fault, _)) => fault,
        other => panic!("{other:?}"),
    };
    assert_eq!(verdict_on(&proof.bytes), Ok(()));
    // The last leaf is dropped, and one too many is there.
    let end = proof.bytes.len();
    assert_eq!(fault_of(&proof.bytes[..end - 7]), Fault::Format);
    let longer = [&proof.bytes[..], &proof.bytes[end - 7..]].concat();
    assert_eq!(fault_of(&longer), Fault::Format);
    // A leaf has an axis of no length, or one that is too long.
    let bent = |axis: [i16; 3]| {
        let mut bytes = proof.bytes.clone();
        let axis = axis.map(i16::to_le_bytes).concat();
        bytes[end - 6..].copy_from_slice(&axis);
        bytes
    };
    assert_eq!(fault_of(&bent([0; 3])), Fault::NotApart);
    assert_eq!(fault_of(&bent([16_000, 16_000, 0])), Fault::Axis);
    // The meshes are swapped.
    assert!(matches!(
        ccd_check::check(&b, &a, &proof.bytes),
        Err(Stop::Broken(Fault::OtherMesh, _))
    ));
    // One proof stands for everything.
    let mut nothing = proof.bytes[..FREE_STEPS_AT].to_vec();
    nothing.extend([3, 0, 0, 0, 0, 0, 64]);
    assert_eq!(fault_of(&nothing), Fault::NotApart);
    // The bodies are said to be free for longer than they are, and to touch later.
    for (_, proof) in &contacts {
        let [a, b] = meshes.bodies(proof.unit);
        let mut bytes = proof.bytes.clone();
        let until = CLAIM_AT - 16..CLAIM_AT - 8;
        let time = f64::from_le_bytes(bytes[until.clone()].try_into().unwrap());
        bytes[until].copy_from_slice(&(time + 0.01).to_le_bytes());
        assert!(matches!(
            ccd_check::check(&a, &b, &bytes),
            Err(Stop::Broken(..))
        ));
        let mut free = bytes[..CLAIM_AT].to_vec();
        free.push(0);
        free.extend(&bytes[CLAIM_AT + 33..]);
        assert!(matches!(
            ccd_check::check(&a, &b, &free),
            Err(Stop::Broken(..))
        ));
    }
}

#[test]
fn witnesses_that_are_not_near_or_not_on_their_triangles_are_seen() {
    let meshes = Meshes::new();
    let [_, contacts] = proofs(&meshes, 10);
    for (_, proof) in &contacts {
        let [a, b] = meshes.bodies(proof.unit);
        for at in [CLAIM_AT + 9, CLAIM_AT + 16] {
            // Another triangle, or a weight below 0.
            let mut bytes = proof.bytes.clone();
            bytes[at] ^= 0xc0;
            let verdict = ccd_check::check(&a, &b, &bytes);
            assert!(
                matches!(verdict, Err(Stop::Broken(Fault::Witnesses, _))),
                "{verdict:?}"
            );
        }
    }
}

#[test]
fn a_tree_that_omits_a_triangle_or_belongs_to_another_mesh_is_seen() {
    let meshes = Meshes::new();
    let body = &meshes.proofs[0];
    let read = |mesh: &[u8], certificate: &[u8]| {
        ccd_check::Body::new(mesh, certificate, -48)
            .map(|_| ())
            .unwrap_err()
    };
    let order = 40;
    let mut twice = body.certificate().to_vec();
    twice.copy_within(order..order + 4, order + 4);
    assert!(matches!(
        read(body.mesh(), &twice),
        Stop::Broken(Fault::Triangles, _)
    ));
    // A vertex is moved by the least that its numbers can tell.
    let mut moved = body.mesh().to_vec();
    moved[8] ^= 1;
    assert!(matches!(
        read(&moved, body.certificate()),
        Stop::Broken(Fault::OtherMesh, _)
    ));
    let short = &body.certificate()[..body.certificate().len() - 1];
    assert!(matches!(
        read(body.mesh(), short),
        Stop::Broken(Fault::Format, _)
    ));
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
        let [a, b] = meshes.bodies(proof.unit);
        for _ in 0..500 {
            let mut bytes = proof.bytes.clone();
            // Half of the changes are to the statement.
            let limit = if random.bits().is_multiple_of(2) {
                CLAIM_AT
            } else {
                bytes.len()
            };
            let at = random.bits() as usize % limit;
            bytes[at] ^= 1 << (random.bits() % 8);
            if ccd_check::check(&a, &b, &bytes) == Ok(()) {
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
    let motions = [80, 208].map(|at| {
        let turn = [0, 1, 2, 3].map(|k| number(at + 24 + 8 * k));
        let start = Pose::new(vector(at), turn).unwrap();
        Motion::about(start, vector(at + 56), vector(at + 80), vector(at + 104)).unwrap()
    });
    let until = number(CLAIM_AT - 16);
    let mut solver = Solver::new();
    (0..20).all(|k| {
        let time = until * f64::from(k) / 20.0;
        let [a, b] = [0, 1].map(|k| (&meshes.engine[k], motions[k].pose(time)));
        solver.distance(a, b).unwrap().outcome.upper() > 0.0
    })
}
