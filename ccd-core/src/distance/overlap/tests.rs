//! Tests that intersecting pieces are distinguished from touching ones.

use super::{ExpandingPolytope, Intersection, decide_intersection};
use crate::body::Body;
use crate::body::piece::ConvexCombination;
use crate::body::piece::Piece;
use crate::distance::oracle::{Claim, DistanceOracle, PiecePair};
use crate::distance::separation;
use crate::math::order::greater;
use crate::motion::pose::{Frame, Pose};
use crate::tests::double::{DoubleDouble, DoubleDouble3};
use crate::tests::nearest::Triangle;
use crate::tests::oracle::ExhaustiveOracle;
use crate::tests::scene::{
    RngExt, random_point_in_ball, random_rotation, rng, two_random_triangles,
};
use glam::DVec3;

const ROUNDING: f64 = 1e-13;

/// Returns whether the pieces intersect, and asserts that this is decided.
fn intersects_decidedly(pair: &PiecePair<'_>, claim: &Claim) -> bool {
    let checked = separation::check_claim(pair, claim, ROUNDING);
    match decide_intersection(pair, &checked, ROUNDING, &mut ExpandingPolytope::default()) {
        Intersection::Certain => true,
        Intersection::None => false,
        Intersection::Undecided => panic!("{pair:?}"),
    }
}

fn frame_at(translation: DVec3) -> Frame {
    Frame {
        translation,
        ..Frame::IDENTITY
    }
}

fn triangles_intersect(a: &Triangle, b: &Triangle) -> bool {
    let pair = PiecePair {
        a: Piece::from_points(a),
        b: Piece::from_points(b),
        b_to_a: Frame::IDENTITY,
    };
    let claim = ExhaustiveOracle.separation(&pair, &mut ()).unwrap();
    intersects_decidedly(&pair, &claim)
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
    assert!(triangles_intersect(&flat, &spike(-0.1)));
    assert!(triangles_intersect(&flat, &spike(-1e-6)));
    assert!(
        !triangles_intersect(&flat, &spike(0.0)),
        "a corner on a face"
    );
    assert!(!triangles_intersect(&flat, &spike(0.1)));
    // The triangles share an edge, a corner, or are the same.
    assert!(!triangles_intersect(
        &flat,
        &[DVec3::ZERO, 2.0 * DVec3::X, DVec3::Z]
    ));
    assert!(!triangles_intersect(
        &flat,
        &[DVec3::ZERO, -DVec3::X, DVec3::new(-1.0, -1.0, 1.0)]
    ));
    assert!(!triangles_intersect(&flat, &flat));
    // The edges meet within, at a right angle.
    let above = [
        DVec3::new(1.0, -1.0, 0.0),
        DVec3::new(1.0, 1.0, 0.0),
        DVec3::new(1.0, 0.0, 2.0),
    ];
    assert!(!triangles_intersect(&flat, &above), "an edge in the plane");
    let through = above.map(|p| p - 0.5 * DVec3::Z);
    assert!(triangles_intersect(&flat, &through));
    // Coplanar triangles have no inside in common.
    let beside = flat.map(|p| p + DVec3::new(0.3, 0.2, 0.0));
    assert!(!triangles_intersect(&flat, &beside));
}

/// Tests that the decision for random triangles and needles agrees with the separating axis theorem.
#[test]
fn the_same_as_all_axes_of_the_separating_axis_theorem() {
    let mut rng = rng(1);
    let mut counts = [0; 2];
    for _ in 0..20_000 {
        let pair = two_random_triangles(&mut rng);
        let exact = overlaps_by_separating_axes(&PiecePair {
            a: Piece::from_points(&pair[0]),
            b: Piece::from_points(&pair[1]),
            b_to_a: Frame::IDENTITY,
        });
        assert_eq!(triangles_intersect(&pair[0], &pair[1]), exact, "{pair:?}");
        counts[usize::from(exact)] += 1;
    }
    assert!(counts[0] > 10_000 && counts[1] > 200, "{counts:?}");
}

/// Decides whether two boxes intersect, from a claim with equal nearest points and an arbitrary axis.
fn boxes_intersect(b_to_a: Frame) -> bool {
    let body = Body::cuboid(DVec3::ONE).unwrap();
    let piece = body.pieces().get(0);
    let pair = PiecePair {
        a: piece,
        b: piece,
        b_to_a,
    };
    // The middle of the boxes' intersection is a point of each box.
    let middle = 0.5 * b_to_a.translation;
    let named = |p: DVec3| -> ConvexCombination {
        // The point is a combination of four corners, with trilinear weights along the box's diagonal directions.
        let mut out = ConvexCombination::EMPTY;
        for (corner, weight) in corner_weights(p) {
            out.add_weighted_point(corner, weight);
        }
        out
    };
    let claim = Claim {
        axis: b_to_a.translation,
        a: named(middle),
        b: named(b_to_a.inverse_transform_point(middle)),
    };
    intersects_decidedly(&pair, &claim)
}

/// Returns four corners of the cube of half extent 1, and weights with which they represent a point.
fn corner_weights(p: DVec3) -> [(u32, f64); 4] {
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
            assert!(boxes_intersect(frame_at((2.0 + gap) * way)), "{gap} {way}");
        }
    }
    for gap in [0.0, 1e-14, 1e-9, 1.0] {
        for way in [DVec3::X, DVec3::Y, -DVec3::Z] {
            assert!(!boxes_intersect(frame_at((2.0 + gap) * way)), "{gap} {way}");
        }
    }
    // The boxes meet edge to edge: no face normal separates the two.
    let turned = |axis: DVec3| glam::DQuat::from_axis_angle(axis, std::f64::consts::FRAC_PI_4);
    let crossed = |gap: f64| {
        let pose = Pose::new(
            (2.0 * 2f64.sqrt() + gap) * DVec3::Z,
            turned(DVec3::X).inverse() * turned(DVec3::Y),
        );
        // The pair is seen from A, which is turned about x itself.
        let a = Frame::from(Pose::new(DVec3::ZERO, turned(DVec3::X)).unwrap());
        let b = Frame::from(Pose::new(pose.unwrap().translation(), turned(DVec3::Y)).unwrap());
        boxes_intersect(a.transform_from(&b))
    };
    assert!(!crossed(1e-9));
    assert!(crossed(-1e-3));
    for _ in 0..100 {
        let pose = Pose::new(
            random_point_in_ball(&mut rng, 0.5),
            random_rotation(&mut rng),
        )
        .unwrap();
        assert!(boxes_intersect(Frame::from(pose)), "deep inside: {pose:?}");
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
        let claim = ExhaustiveOracle.separation(&pair, &mut ()).unwrap();
        intersects_decidedly(&pair, &claim)
    };
    assert!(cross(0.0) && cross(0.5) && cross(1.0 - 1e-9));
    assert!(!cross(1.0) && !cross(1.0 + 1e-9) && !cross(2.0));
}

/// Tests that a claim with a random axis and random corners does not change the decision about two boxes.
#[test]
fn false_claims_do_not_change_the_decision() {
    let mut rng = rng(3);
    let body = Body::cuboid(DVec3::ONE).unwrap();
    let piece = body.pieces().get(0);
    let (mut overlaps, mut others) = (0, 0);
    for _ in 0..2_000 {
        let pose = Pose::new(
            random_point_in_ball(&mut rng, 3.0),
            random_rotation(&mut rng),
        )
        .unwrap();
        let pair = PiecePair {
            a: piece,
            b: piece,
            b_to_a: pose.into(),
        };
        let lie = Claim {
            axis: random_point_in_ball(&mut rng, 1.0),
            a: ConvexCombination::from_single_point(rng.random_range(0..8)),
            b: ConvexCombination::from_single_point(rng.random_range(0..8)),
        };
        let exact = overlaps_by_separating_axes(&pair);
        assert_eq!(intersects_decidedly(&pair, &lie), exact, "{pose:?}");
        overlaps += usize::from(exact);
        others += usize::from(!exact);
    }
    assert!(overlaps > 200 && others > 200, "{overlaps} {others}");
}

/// Tests that each corner of the first tetrahedron is about as far from the corners before it as possible, for long or
/// flat point sets.
#[test]
fn the_first_tetrahedron_is_as_large_as_the_differences_allow() {
    let mut rng = rng(4);
    for _ in 0..2_000 {
        let stretch = [0; 3].map(|_| 10f64.powf(rng.random_range(-4.0..0.0)));
        let turn = random_rotation(&mut rng);
        let mut cloud =
            || [0; 8].map(|_| turn * (random_point_in_ball(&mut rng, 1.0) * DVec3::from(stretch)));
        let (ours, theirs) = (cloud(), cloud());
        let aside = random_point_in_ball(&mut rng, 2.0);
        let pair = PiecePair {
            a: Piece::from_points(&ours),
            b: Piece::from_points(&theirs),
            b_to_a: frame_at(aside),
        };
        let differences = || {
            ours.iter()
                .flat_map(|&p| theirs.iter().map(move |&q| p - q - aside))
        };
        let most = |measure: &dyn Fn(DVec3) -> f64| differences().map(measure).fold(0.0, greater);
        let [a, mut b, mut c, d] = super::find_start_tetrahedron(&pair, ROUNDING).unwrap();
        let behind = (b - a).cross(c - a).dot(d - a);
        assert!(behind < 0.0, "faces look outward: {behind}");
        if a.distance(b) < a.distance(c) {
            (b, c) = (c, b);
        }
        // The point is among the extremes along the axes.
        let far = |p: DVec3| p.distance(a);
        assert!(far(b) >= 0.28 * most(&far), "{pair:?}");
        // The point is among the extremes along two directions across the line.
        let line = (b - a).normalize();
        let off_line = |p: DVec3| (p - a).cross(line).length();
        assert!(off_line(c) >= 0.7 * most(&off_line), "{pair:?}");
        let normal = (b - a).cross(c - a).normalize();
        let height = |p: DVec3| normal.dot(p - a).abs();
        assert!(height(d) >= 0.99 * most(&height), "{pair:?}");
    }
}

#[test]
fn flat_differences_have_no_tetrahedron() {
    let mut rng = rng(5);
    for _ in 0..200 {
        let turn = random_rotation(&mut rng);
        let mut flat =
            || [0; 3].map(|_| turn * random_point_in_ball(&mut rng, 1.0).reject_from(DVec3::Z));
        let (ours, theirs) = (flat(), flat());
        let pair = PiecePair {
            a: Piece::from_points(&ours),
            b: Piece::from_points(&theirs),
            b_to_a: frame_at(turn * DVec3::Z),
        };
        assert_eq!(super::find_start_tetrahedron(&pair, ROUNDING), None);
        assert!(!ExpandingPolytope::default().start_with_tetrahedron(&pair, ROUNDING));
    }
}

#[test]
fn a_claim_that_shows_no_depth_needs_no_polytope() {
    let flat = [DVec3::ZERO, DVec3::X, DVec3::Y];
    let tip = flat.map(|p| DVec3::new(p.x, p.z, p.y));
    let pair = PiecePair {
        a: Piece::from_points(&flat),
        b: Piece::from_points(&tip),
        b_to_a: Frame::IDENTITY,
    };
    let claim = Claim {
        axis: DVec3::Z,
        a: ConvexCombination::from_single_point(0),
        b: ConvexCombination::from_single_point(0),
    };
    let (checked, mut inner) = (
        separation::check_claim(&pair, &claim, ROUNDING),
        ExpandingPolytope::default(),
    );
    let decision = decide_intersection(&pair, &checked, ROUNDING, &mut inner);
    assert_eq!(decision, Intersection::None);
    assert!(inner.corners.is_empty());
}

/// Tests that two balls do not intersect if the distance of their centers is exactly the sum of their radii.
#[test]
fn balls_that_touch_exactly_do_not_intersect() {
    let ball = Body::sphere(0.5).unwrap();
    let pair = PiecePair {
        a: ball.pieces().get(0),
        b: ball.pieces().get(0),
        b_to_a: frame_at(DVec3::X),
    };
    let claim = ExhaustiveOracle.separation(&pair, &mut ()).unwrap();
    let checked = separation::check_claim(&pair, &claim, 0.0);
    let decision = decide_intersection(&pair, &checked, 0.0, &mut ExpandingPolytope::default());
    assert_eq!(decision, Intersection::None);
}

/// Returns whether no axis of the separating axis theorem separates the pieces, in slow double-double arithmetic. The
/// axes are the normals of both pieces and the cross products of their edges; for flat pieces also the normals of their
/// edges within either plane.
fn overlaps_by_separating_axes(pair: &PiecePair<'_>) -> bool {
    let a = PieceFeatures::from_piece(&pair.a, |p| p);
    let b = PieceFeatures::from_piece(&pair.b, |p| pair.b_to_a.transform_point(p));
    let across = |p: &[DoubleDouble3], q: &[DoubleDouble3]| -> Vec<DoubleDouble3> {
        let crossed = p.iter().flat_map(|e| q.iter().map(|f| e.cross(*f)));
        crossed.collect()
    };
    let depth = |axis: &DoubleDouble3| {
        let heights = |points: &[DoubleDouble3]| -> Vec<DoubleDouble> {
            points.iter().map(|p| axis.dot(*p)).collect()
        };
        let (p, q) = (heights(&a.points), heights(&b.points));
        let farthest = |h: &[DoubleDouble]| h.iter().copied().reduce(DoubleDouble::max).unwrap();
        let nearest = |h: &[DoubleDouble]| h.iter().copied().reduce(DoubleDouble::min).unwrap();
        let (one, other) = (farthest(&p) - nearest(&q), farthest(&q) - nearest(&p));
        (one.min(other) / axis.length()).get()
    };
    [
        a.normals.clone(),
        b.normals.clone(),
        across(&a.edges, &b.edges),
        across(&a.normals, &a.edges),
        across(&b.normals, &b.edges),
        across(&a.normals, &b.edges),
        across(&b.normals, &a.edges),
    ]
    .concat()
    .iter()
    .filter(|axis| axis.length().get() > 1e-25)
    .all(|axis| depth(axis) > ROUNDING)
}

/// The points, the distinct edges and the facet normals of a piece.
struct PieceFeatures {
    points: Vec<DoubleDouble3>,
    edges: Vec<DoubleDouble3>,
    normals: Vec<DoubleDouble3>,
}

impl PieceFeatures {
    fn from_piece(piece: &Piece<'_>, place: impl Fn(DVec3) -> DVec3) -> Self {
        let points: Vec<DoubleDouble3> = piece.points.iter().map(|&p| place(p).into()).collect();
        let all: Vec<u32> = (0..points.len() as u32).collect();
        let loops: Vec<&[u32]> = if piece.facets.is_empty() {
            vec![&all]
        } else {
            piece.facets.iter().collect()
        };
        let (mut edges, mut normals) = (Vec::new(), Vec::new());
        for corners in loops {
            let at = |k: usize| points[corners[k % corners.len()] as usize];
            for k in 0..corners.len() {
                // Two facets share an edge, in opposite directions.
                let once = piece.facets.is_empty() || corners[k] < corners[(k + 1) % corners.len()];
                edges.extend(once.then(|| at(k + 1) - at(k)));
            }
            normals.push((at(1) - at(0)).cross(at(2) - at(0)));
        }
        PieceFeatures {
            points,
            edges,
            normals,
        }
    }
}
