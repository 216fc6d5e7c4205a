//! Tests that parts of cubes that are face to face are claimed to touch, but not to overlap.

use super::scene::{Body, Scene};
use super::shape;
use super::twin::{self, ReferencePolytope};
use crate::{Cache, Vmarch};
use ccd_core::glam::{DMat3, DQuat, DVec3};
use ccd_core::{DistanceOracle, Frame};
use std::f64::consts::FRAC_PI_2;

/// Returns the twelve triangles of a cube, each as a body, and the cube itself.
fn parts() -> Vec<Body> {
    let cube = shape::cuboid(DVec3::ONE);
    let triangles = cube.clone().triangulated();
    let triangle = |corners: &Vec<u32>| {
        let points = corners.iter().map(|&v| triangles.points[v as usize]);
        Body::new(shape::shape_of_points(&points.collect::<Vec<_>>()))
    };
    let mut parts: Vec<Body> = triangles.loops.iter().map(triangle).collect();
    parts.push(Body::new(cube));
    parts
}

/// Returns frames that put a second cube next to, above or in front of the first cube. The second cube is shifted along
/// the common face, and turned by right angles, which are inexact in floating point.
fn frames() -> Vec<Frame> {
    let mut frames = Vec::new();
    for (side, shift) in [
        (DVec3::X, DVec3::Y),
        (DVec3::Y, DVec3::Z),
        (DVec3::Z, DVec3::X),
    ] {
        for translation in [2.0 * side, -2.0 * side] {
            for shifted in [0.0, -0.5, 2.0] {
                for axis in [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z] {
                    frames.push(Frame {
                        translation: translation + shifted * shift,
                        rotation: DMat3::from_quat(DQuat::from_scaled_axis(FRAC_PI_2 * axis)),
                    });
                }
            }
        }
    }
    frames
}

/// Tests that the claimed axis separates any part of one cube from any part of the other, up to rounding.
#[test]
fn parts_of_flush_cubes_are_kept_apart() {
    let parts = parts();
    let mut touching = 0;
    for b_to_a in frames() {
        for (a, b) in parts.iter().flat_map(|a| parts.iter().map(move |b| (a, b))) {
            let scene = Scene {
                a,
                b,
                b_to_a,
                gap: 1.0,
            };
            let claim = Vmarch::default().separation(&scene.pair(), &mut Cache::default());
            let claim = claim.unwrap_or_else(|why| panic!("{why:?}"));
            let on_a = claim.a.position(&a.shape.points).expect("a point of A");
            let on_b =
                b_to_a.transform_point(claim.b.position(&b.shape.points).expect("a point of B"));
            let distance = on_a.distance(on_b);
            let bare_a = ReferencePolytope::new(&a.shape, &Frame::IDENTITY);
            let bare_b = ReferencePolytope::new(&b.shape, &b_to_a);
            let kept = twin::gap(&bare_a, &bare_b, claim.axis.normalize_or_zero());
            assert!(
                claim.axis != DVec3::ZERO && kept >= distance - 4e-15,
                "{distance:e} {kept:e} {claim:?} {b_to_a:?}\n{:?}\n{:?}",
                a.shape.points,
                b.shape.points
            );
            touching += usize::from(distance <= 1e-15);
        }
    }
    assert!(touching > 2_000, "{touching}");
}
