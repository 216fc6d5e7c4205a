//! Intersecting is told from touching.

use super::intersects;
use crate::body::Body;
use crate::oracle::{Claim, Combination, DistanceOracle, PiecePair};
use crate::piece::Piece;
use crate::pose::{Frame, Pose};
use crate::separation;
use crate::tests::nearest::{Triangle, nearest};
use crate::tests::oracle::Exhaustive;
use crate::tests::scene::{couple, rng, rotation, within};
use glam::DVec3;

const ROUNDING: f64 = 1e-13;

fn at(translation: DVec3) -> Frame {
    Frame {
        translation,
        ..Frame::IDENTITY
    }
}

fn triangles(a: &Triangle, b: &Triangle) -> bool {
    let pair = PiecePair {
        a: Piece::from_points(a),
        b: Piece::from_points(b),
        b_to_a: Frame::IDENTITY,
    };
    let claim = Exhaustive.separation(&pair, &mut ()).unwrap();
    intersects(&pair, &separation::check(&pair, &claim, ROUNDING), ROUNDING)
}

#[test]
fn triangles_that_cross_intersect_and_those_that_touch_do_not() {
    let flat = [DVec3::ZERO, 2.0 * DVec3::X, 2.0 * DVec3::Y];
    let spike = |tip: f64| {
        [
            DVec3::new(0.5, 0.5, tip),
            DVec3::new(0.4, 0.5, 1.0),
            DVec3::new(0.6, 0.6, 1.0),
        ]
    };
    assert!(triangles(&flat, &spike(-0.1)));
    assert!(triangles(&flat, &spike(-1e-6)));
    assert!(!triangles(&flat, &spike(0.0)), "a corner on a face");
    assert!(!triangles(&flat, &spike(0.1)));
    // A shared edge, a shared corner, the same triangle.
    assert!(!triangles(&flat, &[DVec3::ZERO, 2.0 * DVec3::X, DVec3::Z]));
    assert!(!triangles(
        &flat,
        &[DVec3::ZERO, -DVec3::X, DVec3::new(-1.0, -1.0, 1.0)]
    ));
    assert!(!triangles(&flat, &flat));
    // Edges that meet within, at a right angle.
    let above = [
        DVec3::new(1.0, -1.0, 0.0),
        DVec3::new(1.0, 1.0, 0.0),
        DVec3::new(1.0, 0.0, 2.0),
    ];
    assert!(!triangles(&flat, &above), "an edge in the plane");
    let through = above.map(|p| p - 0.5 * DVec3::Z);
    assert!(triangles(&flat, &through));
    // Coplanar triangles have no inside in common.
    let beside = flat.map(|p| p + DVec3::new(0.3, 0.2, 0.0));
    assert!(!triangles(&flat, &beside));
}

#[test]
fn what_is_apart_never_intersects_and_what_crosses_deeply_does() {
    let mut rng = rng(1);
    let (mut crossing, mut apart) = (0, 0);
    for _ in 0..20_000 {
        let pair = couple(&mut rng);
        let found = nearest(&pair[0], &pair[1]).distance;
        let overlap = triangles(&pair[0], &pair[1]);
        if found > 1e-12 {
            assert!(!overlap, "{found:e} {pair:?}");
            apart += 1;
        } else if overlap {
            crossing += 1;
        }
    }
    assert!(crossing > 200 && apart > 10_000, "{crossing} {apart}");
}

/// A claim of the witnesses' being at one point, whatever the axis.
fn boxes(b_to_a: Frame) -> bool {
    let body = Body::cuboid(DVec3::ONE).unwrap();
    let piece = body.pieces().get(0);
    let pair = PiecePair {
        a: piece,
        b: piece,
        b_to_a,
    };
    // The middle of what both boxes have in common, as a point of either.
    let middle = 0.5 * b_to_a.translation;
    let named = |p: DVec3| -> Combination {
        // Four corners about the point: trilinear weights along the box's diagonal directions.
        let mut out = Combination::EMPTY;
        for (corner, weight) in tetrahedron(p) {
            out.push(corner, weight);
        }
        out
    };
    let claim = Claim {
        axis: b_to_a.translation,
        a: named(middle),
        b: named(b_to_a.inverse_point(middle)),
    };
    intersects(&pair, &separation::check(&pair, &claim, ROUNDING), ROUNDING)
}

/// Weights of corners 0, 1, 3, 7 of a unit box, which name any point with x ≥ y ≥ z.
fn tetrahedron(p: DVec3) -> [(u32, f64); 4] {
    let mut order = [0, 1, 2];
    order.sort_by(|&i, &j| p[j].total_cmp(&p[i]));
    let [x, y, z] = order.map(|k| 0.5 * (p[k] + 1.0));
    let first = 1 << order[0];
    let second = first | 1 << order[1];
    [(0, 1.0 - x), (first, x - y), (second, y - z), (7, z)]
}

#[test]
fn boxes_overlap_by_more_than_rounding_or_not() {
    let mut rng = rng(2);
    for gap in [-1.0, -1e-3, -1e-9] {
        for way in [DVec3::X, DVec3::Y, -DVec3::Z] {
            assert!(boxes(at((2.0 + gap) * way)), "{gap} {way}");
        }
    }
    for gap in [0.0, 1e-14, 1e-9, 1.0] {
        for way in [DVec3::X, DVec3::Y, -DVec3::Z] {
            assert!(!boxes(at((2.0 + gap) * way)), "{gap} {way}");
        }
    }
    // Edge to edge: no face normal tells the two apart.
    let turned = |axis: DVec3| glam::DQuat::from_axis_angle(axis, std::f64::consts::FRAC_PI_4);
    let crossed = |gap: f64| {
        let pose = Pose::new(
            (2.0 * 2f64.sqrt() + gap) * DVec3::Z,
            turned(DVec3::X).inverse() * turned(DVec3::Y),
        );
        // Seen from A, which is turned about x itself.
        let a = Frame::from(Pose::new(DVec3::ZERO, turned(DVec3::X)).unwrap());
        let b = Frame::from(Pose::new(pose.unwrap().translation(), turned(DVec3::Y)).unwrap());
        boxes(a.from_frame(&b))
    };
    assert!(!crossed(1e-9));
    assert!(crossed(-1e-3));
    for _ in 0..100 {
        let pose = Pose::new(within(&mut rng, 0.5), rotation(&mut rng)).unwrap();
        assert!(boxes(Frame::from(pose)), "deep inside: {pose:?}");
    }
}

#[test]
fn rounded_pieces_intersect_when_their_cores_are_near() {
    let capsule = Body::capsule(0.5, 1.0).unwrap();
    let piece = capsule.pieces().get(0);
    let cross = |x: f64| {
        let turn = Pose::new(x * DVec3::X, glam::DQuat::from_rotation_x(1.0)).unwrap();
        let pair = PiecePair {
            a: piece,
            b: piece,
            b_to_a: turn.into(),
        };
        let claim = Exhaustive.separation(&pair, &mut ()).unwrap();
        intersects(&pair, &separation::check(&pair, &claim, ROUNDING), ROUNDING)
    };
    assert!(cross(0.0) && cross(0.5) && cross(1.0 - 1e-9));
    assert!(!cross(1.0) && !cross(1.0 + 1e-9) && !cross(2.0));
}
