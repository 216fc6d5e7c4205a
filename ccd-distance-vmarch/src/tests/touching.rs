//! Triangles that touch without an inside in common.

use super::scene::{Body, Scene};
use super::shape;
use super::twin::{self, Bare};
use crate::{Cache, Vmarch};
use ccd_core::glam::DVec3;
use ccd_core::{DistanceOracle, Frame};

/// Triangles of two cubes that stand face to face: whatever two of them touch in, the axis keeps them
/// apart.
#[test]
fn triangles_of_flush_cubes_are_kept_apart() {
    let shape = shape::cuboid(DVec3::ONE).triangulated();
    let triangle = |corners: &Vec<u32>| {
        let points: Vec<DVec3> = corners.iter().map(|&v| shape.points[v as usize]).collect();
        Body::new(shape::few(&points))
    };
    let triangles: Vec<Body> = shape.loops.iter().map(triangle).collect();
    let mut touching = 0;
    for side in [DVec3::X, DVec3::Y, DVec3::Z].map(|side| 2.0 * side) {
        for translation in [side, -side] {
            let b_to_a = Frame {
                translation,
                ..Frame::IDENTITY
            };
            for (a, b) in triangles
                .iter()
                .flat_map(|a| triangles.iter().map(move |b| (a, b)))
            {
                let scene = Scene {
                    a,
                    b,
                    b_to_a,
                    gap: 1.0,
                };
                let claim = Vmarch::default().separation(&scene.pair(), &mut Cache::default());
                let claim = claim.unwrap_or_else(|why| panic!("{why:?}"));
                let on_a = claim.a.of(&a.shape.points).expect("a point of A");
                let on_b = b_to_a.point(claim.b.of(&b.shape.points).expect("a point of B"));
                let (bare_a, bare_b) = (
                    Bare::new(&a.shape, &Frame::IDENTITY),
                    Bare::new(&b.shape, &b_to_a),
                );
                let distance = on_a.distance(on_b);
                let kept = twin::gap(&bare_a, &bare_b, claim.axis.normalize_or_zero());
                assert!(
                    claim.axis != DVec3::ZERO && kept >= distance - 2e-15,
                    "{distance:e} {kept:e} {claim:?}\n{:?}\n{:?}",
                    a.shape.points,
                    b.shape.points
                );
                touching += usize::from(distance == 0.0);
            }
        }
    }
    assert!(touching > 100, "{touching}");
}
