//! Proofs of a point and an edge that come very near each other. The cases are from the tests of other libraries.

use ccd_core::{Motion, Pose};
use ccd_prove::{Body, NotProven, Scene, prove};
use std::f64::consts::TAU;

/// Proves and checks that a point and an edge stay apart until a time.
fn prove_point_and_edge(a: ([f64; 3], Motion), b: ([[f64; 3]; 2], Motion), until: f64) {
    let point = Body::new(&[a.0], &[[0; 3]]);
    let edge = Body::new(&b.0, &[[0, 1, 1]]);
    let scene = Scene::of_two((&point, a.1), (&edge, b.1), 0.0);
    let proof = prove(&scene, until, None).unwrap();
    let read = |body: &Body| ccd_check::Body::new(body.mesh(), body.certificate(), &proof.bytes);
    let bodies = [read(&point).unwrap(), read(&edge).unwrap()];
    assert_eq!(ccd_check::check(&bodies, &proof.bytes), Ok(()));
}

fn flight(position: [f64; 3], velocity: [f64; 3], angular_velocity: [f64; 3]) -> Motion {
    Motion::new(Pose::at(position).unwrap(), velocity, angular_velocity).unwrap()
}

/// Tests a tiny gap beside a long edge. The error of the normal has to be smaller than the gap divided by the length.
/// Source: `ipc-toolkit`'s test "Point-edge ToI random rigid 0".
#[test]
fn a_point_is_proven_to_fly_until_a_billionth_from_an_edge() {
    let from = [-3.523_344_703_336_752_6, -6.983_016_521_509_961_5, 0.0];
    let to = [3.018_689_460_797_075, -8.551_274_266_649_145, 0.0];
    let position = [-9.250_086_831_160_303, -1.327_086_326_752_282_6, 0.0];
    let velocity = [156.693_014_898_532_9, -113.924_839_249_120_31, 0.0];
    let edge_velocity = [0.717_640_086_133_783_9, -2.686_221_661_748_289_2, 0.0];
    prove_point_and_edge(
        ([0.0; 3], flight(position, velocity, [0.0; 3])),
        ([from, to], flight([0.0; 3], edge_velocity, [0.0; 3])),
        0.057_998_924_760_781_87,
    );
}

/// Tests a tiny gap to a static edge. Only the turning body has a rounding error of its rotation.
/// Source: `rigid-ipc`'s test "edge-vertex Rotation theta -2 pi order 0".
#[test]
fn a_point_is_proven_to_turn_until_a_hundred_billionth_from_an_edge() {
    prove_point_and_edge(
        (
            [-1.0, 0.0, 0.0],
            flight([0.0, 0.5, 0.0], [0.0; 3], [0.0, 0.0, -TAU]),
        ),
        ([[-2.0, 0.0, 0.0], [2.0, 0.0, 0.0]], Motion::STILL),
        0.583_333_333_332_394_2,
    );
}

/// Tests bodies that move at the same velocity. Only a plane that moves with them separates them for long.
/// Source: `ipc-toolkit`'s test "Point-Triangle CCD General".
#[test]
fn bodies_that_fly_side_by_side_are_proven_apart() {
    let common_velocity = [3.0, 1.0, -2.0];
    prove_point_and_edge(
        (
            [0.0; 3],
            flight([0.0, 0.0, 1e-6], common_velocity, [0.0; 3]),
        ),
        (
            [[-2.0, 0.0, 0.0], [2.0, 0.0, 0.0]],
            flight([0.0; 3], common_velocity, [0.0; 3]),
        ),
        1.0,
    );
}

/// Tests a velocity so small that scaling it by a power of two loses bits.
#[test]
fn a_velocity_that_loses_bits_is_refused() {
    let point = Body::new(&[[0.0; 3]], &[[0; 3]]);
    let velocity = [3.0 * 5e-324, 0.0, 0.0];
    let verdict = |angular_velocity: f64| {
        let motion = flight([0.0, 0.0, 1.0], velocity, [0.0, 0.0, angular_velocity]);
        let scene = Scene::of_two((&point, motion), (&point, Motion::STILL), 0.0);
        prove(&scene, 1.0, None).map(|_| ())
    };
    assert_eq!(verdict(3.0), Err(NotProven::TooSmall { link: 1 }));
    assert_eq!(verdict(0.0), Ok(()));
}
