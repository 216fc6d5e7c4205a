//! Tests that forged proofs do not hold.

use super::{Meshes, Random, WITNESSES_AT, proofs};
use ccd_check::Stop;
use ccd_core::{Motion, Pose};
use ccd_prove::{Proof, Statement, StatementLink, steps_text};
use rigid_ccd::Solver;

/// The number of bytes of a witness.
const WITNESS: usize = 70;

/// The number of bytes of a leaf with a plane.
const PLANE: usize = 29;

/// Returns the last step of a proof as text.
fn last_step(bytes: &[u8]) -> String {
    let steps = steps_text(bytes, &Statement::read(bytes).unwrap());
    steps.lines().last().unwrap_or_default().to_owned()
}

#[test]
fn each_kind_of_forgery_is_rejected() {
    let meshes = Meshes::new();
    let [free, contacts] = proofs(&meshes, 10);
    // Finds a proof whose last leaf has a plane, and one whose last leaf has a ball.
    let [proof, with_ball] = ["plane", "ball"].map(|name| {
        let mut proofs = free.iter().map(|(_, proof)| proof);
        let is_last = |proof: &&Proof| last_step(&proof.bytes).starts_with(name);
        proofs.find(is_last).unwrap()
    });
    let bodies = meshes.bodies(&proof.bytes);
    let reason_of = |bytes: &[u8]| reason(ccd_check::check(&bodies, bytes));
    assert_eq!(ccd_check::check(&bodies, &proof.bytes), Ok(()));
    // The last leaf is missing, or it is repeated.
    let end = proof.bytes.len();
    assert_eq!(
        reason_of(&proof.bytes[..end - PLANE]),
        "the file ends too early"
    );
    let lengthened = [&proof.bytes[..], &proof.bytes[end - PLANE..]].concat();
    assert_eq!(reason_of(&lengthened), "the file has bytes after its end");
    // A normal is zero or too long, or the plane is on the far side of A or of B.
    let with_plane = |normal: [i64; 3], offset: Option<i64>| {
        let mut bytes = proof.bytes.clone();
        let mut numbers: Vec<i64> = normal.into();
        numbers.extend(offset);
        for (k, number) in numbers.into_iter().enumerate() {
            let at = end - PLANE + 1 + 7 * k;
            bytes[at..at + 7].copy_from_slice(&number.to_le_bytes()[..7]);
        }
        bytes
    };
    let not_apart = "a leaf does not prove its nodes apart";
    assert_eq!(reason_of(&with_plane([0; 3], None)), not_apart);
    assert_eq!(reason_of(&with_plane([1 << 50, 1, 0], None)), not_apart);
    let normal = [1, 8, 15].map(|k| {
        let bytes = &proof.bytes[end - PLANE + k..end - PLANE + k + 7];
        let sign_byte = if bytes[6] < 128 { 0 } else { 255 };
        i64::from_le_bytes([&[sign_byte], bytes].concat().try_into().unwrap()) >> 8
    });
    for offset in [-(1 << 55), (1 << 55) - 1] {
        assert_eq!(reason_of(&with_plane(normal, Some(offset))), not_apart);
    }
    // The only step is a single leaf.
    for leaf in [&[6][..], &[7], &proof.bytes[end - PLANE..]] {
        let contact = &contacts[0].1;
        let single_leaf = [&contact.bytes[..WITNESSES_AT], &[0; 4], leaf].concat();
        let verdict = ccd_check::check(&meshes.bodies(&contact.bytes), &single_leaf);
        assert_eq!(reason(verdict), not_apart);
    }
    // The opcode of the last leaf is out of range.
    let mut with_bad_opcode = with_ball.bytes.clone();
    *with_bad_opcode.last_mut().unwrap() = 8;
    let bodies_of_ball = meshes.bodies(&with_ball.bytes);
    assert_eq!(
        reason(ccd_check::check(&bodies_of_ball, &with_bad_opcode)),
        "there is no such step"
    );
    // One of the meshes is missing.
    assert_eq!(
        reason(ccd_check::check(&bodies[..1], &proof.bytes)),
        "a mesh of the statement is missing, or was read in another unit"
    );
}

#[test]
fn contacts_with_a_later_time_are_rejected() {
    let meshes = Meshes::new();
    let [_, contacts] = proofs(&meshes, 10);
    // The statement claims that the bodies stay apart for longer. It has the witness of the contact, or no witness.
    for (_, proof) in &contacts {
        let bodies = meshes.bodies(&proof.bytes);
        let mut bytes = proof.bytes.clone();
        let until = WITNESSES_AT - 8..WITNESSES_AT;
        let time = f64::from_le_bytes(bytes[until.clone()].try_into().unwrap());
        bytes[until].copy_from_slice(&(time + 0.01).to_le_bytes());
        assert!(ccd_check::check(&bodies, &bytes).is_err());
        let mut without_witness = bytes[..WITNESSES_AT].to_vec();
        without_witness.extend([0; 4]);
        without_witness.extend(&bytes[WITNESSES_AT + 4 + WITNESS..]);
        assert!(ccd_check::check(&bodies, &without_witness).is_err());
    }
}

#[test]
fn witnesses_with_far_points_or_wrong_weights_are_rejected() {
    let meshes = Meshes::new();
    let [_, contacts] = proofs(&meshes, 10);
    let triangle = WITNESSES_AT + 4 + 4 + 16;
    for (_, proof) in &contacts {
        let bodies = meshes.bodies(&proof.bytes);
        // The witness has another triangle, a triangle that does not exist, or weights whose sum is not 1.
        let verdict_with = |at: usize, with: &[u8]| {
            let mut bytes = proof.bytes.clone();
            bytes[at..at + with.len()].copy_from_slice(with);
            reason(ccd_check::check(&bodies, &bytes))
        };
        let number = u32::from_le_bytes(proof.bytes[triangle..][..4].try_into().unwrap());
        let other = (number + 100) % (2 * 12 * 12);
        let far = "the points of the witness are too far apart";
        assert_eq!(verdict_with(triangle, &other.to_le_bytes()), far);
        let none = "an index is out of range";
        assert_eq!(verdict_with(triangle, &[0xff; 4]), none);
        let not_one = "the weights of a witness do not add up to 1";
        assert_eq!(verdict_with(triangle + 4, &[0xff; 21]), not_one);
        assert_eq!(verdict_with(triangle + 4, &[0; 21]), not_one);
    }
}

#[test]
fn a_tree_that_omits_a_triangle_or_belongs_to_another_mesh_is_rejected() {
    let meshes = Meshes::new();
    let body = &meshes.proofs[0];
    let proof = proofs(&meshes, 1)[0][0].1.bytes.clone();
    let read = |mesh: &[u8], certificate: &[u8]| {
        reason(ccd_check::Body::new(mesh, certificate, &proof).map(|_| ()))
    };
    // The last triangle of the tree is replaced by an earlier one.
    let mut with_duplicate = body.certificate().to_vec();
    let end = with_duplicate.len();
    let positions = (40..end - 4).step_by(4).rev();
    let number = |at: usize| u32::from_le_bytes(with_duplicate[at..at + 4].try_into().unwrap());
    let other_triangle = positions.map(number).find(|&other| other > 144).unwrap();
    with_duplicate[end - 4..].copy_from_slice(&other_triangle.to_le_bytes());
    assert_eq!(
        read(body.mesh(), &with_duplicate),
        "a tree contains a triangle twice"
    );
    // A coordinate of a vertex changes by one unit in the last place.
    let mut changed_mesh = body.mesh().to_vec();
    changed_mesh[8] ^= 1;
    let other = "the certificate belongs to another mesh";
    assert_eq!(read(&changed_mesh, body.certificate()), other);
    let shortened = &body.certificate()[..body.certificate().len() - 1];
    assert_eq!(read(body.mesh(), shortened), "the file ends too early");
}

/// Changes random bits of proofs. If the checker still accepts a proof, its changed statement has to be true.
#[test]
fn no_false_random_forgery_is_accepted() {
    let meshes = Meshes::new();
    let mut random = Random(7);
    let [mut all, contacts] = proofs(&meshes, 8);
    all.extend(contacts);
    let (mut accepted, mut refused) = (0, 0);
    for (_, proof) in &all {
        let bodies = meshes.bodies(&proof.bytes);
        for _ in 0..500 {
            let mut bytes = proof.bytes.clone();
            // Half of the changes are in the statement.
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

/// Returns whether the engine finds no contact at sampled times until the end time of the statement.
fn is_true(meshes: &Meshes, bytes: &[u8]) -> bool {
    let statement = Statement::read(bytes).unwrap();
    let motion = |link: &StatementLink| {
        let [velocity, angular_velocity] =
            [link.velocity, link.axis].map(|v| v.map(|x| x * link.rate));
        let start = Pose::new(link.position, link.quaternion).unwrap();
        // Otherwise the link is not a freely moving body.
        let is_free = link.axes == 0 && link.start == 0.0;
        is_free.then(|| Motion::about(start, velocity, angular_velocity, link.center).unwrap())
    };
    let [Some(a), Some(b)] = [&statement.links[0], &statement.links[1]].map(motion) else {
        return true;
    };
    let motions = [a, b];
    let mut solver = Solver::new();
    (0..20).all(|k| {
        let time = statement.until * f64::from(k) / 20.0;
        let [a, b] = [0, 1].map(|k| (&meshes.engine[k], motions[k].pose(time)));
        solver.distance(a, b).unwrap().outcome.upper() > 0.0
    })
}

fn reason(verdict: Result<(), Stop>) -> &'static str {
    match verdict {
        Err(Stop::Broken(reason, _)) => reason,
        other => panic!("{other:?}"),
    }
}
