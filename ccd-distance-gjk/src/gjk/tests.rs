//! Tests the nearest points of each kind of simplex, and the recovery from a stalled search.

use super::fan::CandidateAxisVertices;
use super::foot::NearestPoint;
use super::minkowski::MinkowskiDifference;
use super::oracle::{is_certified, solve, solve_with_cache};
use super::refine::weights_of_point_pairs;
use super::search::{SearchResult, search};
use super::simplex::{Simplex, Vertex};
use super::start::Cache;
use super::termination::StopReason;
use super::{segment, tetrahedron, triangle};
use crate::tests::scene::{self, NearestFeatures, Pcg64, SeedableRng};
use ccd_core::glam::{DMat3, DQuat, DVec3};
use ccd_core::order::greater;
use ccd_core::{Body, Frame, PiecePair};
use rand::RngExt;
use rstest::rstest;

/// Draws corners of every kind: at random, on one line, in one plane, needles, coinciding, near the origin.
fn corners(rng: &mut Pcg64) -> [DVec3; 4] {
    let [a, b, c, d]: [DVec3; 4] = std::array::from_fn(|_| scene::random_vector(rng));
    let (s, t) = (rng.random_range(-0.5..1.5), rng.random_range(-0.5..1.5));
    let thin = scene::random_magnitude(rng, -15.0, 0.0) * d;
    let mut out = match rng.random_range(0..6) {
        0 => [a, b, c, d],
        1 => [a, b, c, a + s * (b - a) + t * (c - a) + thin],
        2 => [a, b, a + s * (b - a) + thin, d],
        3 => [a, b, a + s * (b - a), a + t * (b - a)],
        4 => [a, a + thin, c, d],
        _ => [a, a, b, b],
    };
    if rng.random_bool(0.5) {
        // A point inside, up to rounding, becomes the origin.
        let inside = 0.3 * out[0] + 0.3 * out[1] + 0.2 * out[2] + 0.2 * out[3];
        let off = scene::random_magnitude(rng, -17.0, 0.0) * scene::random_vector(rng);
        out = out.map(|corner| corner - inside + off);
    }
    out
}

/// Checks that a foot is a convex combination of the corners, and that no segment from the foot to a corner comes
/// nearer to the origin.
fn assert_nearest_point(corners: &[DVec3], foot: &NearestPoint) {
    let size = corners
        .iter()
        .map(|c| c.length_squared())
        .fold(0.0, greater)
        .sqrt();
    let slack = 64.0 * f64::EPSILON;
    let sum = foot.weights.iter().fold(0.0, |sum, &w| sum + w);
    assert!(foot.weights.iter().all(|&w| w >= 0.0), "a negative weight");
    assert!((sum - 1.0).abs() <= slack, "weights do not add up");
    let combined = corners
        .iter()
        .zip(foot.weights)
        .fold(DVec3::ZERO, |sum, (&c, w)| sum + c * w);
    assert!(
        (combined - foot.point).length_squared().sqrt() <= slack * size,
        "not the combination"
    );
    let distance = foot.point.length_squared().sqrt();
    for corner in corners {
        // The nearest point of the segment to this corner is not nearer by more than rounding.
        let other = segment::nearest_point(foot.point, *corner)
            .point
            .length_squared()
            .sqrt();
        assert!(
            distance - other <= slack * size,
            "{distance:?}, not {other:?}: {foot:?} of {corners:?}"
        );
    }
}

#[test]
fn feet_are_nearest() {
    let mut enclosed = 0;
    for seed in 0..20_000 {
        let corners = corners(&mut Pcg64::seed_from_u64(seed));
        let [a, b, c, d] = corners;
        assert_nearest_point(&corners[..2], &segment::nearest_point(a, b));
        assert_nearest_point(&corners[..3], &triangle::nearest_point(a, b, c));
        let foot = tetrahedron::foot([a, b, c, d]);
        enclosed += u32::from(foot.direction.is_none());
        assert_nearest_point(&corners, &foot);
    }
    assert!(
        (500..10_000).contains(&enclosed),
        "{enclosed} enclose the origin"
    );
}

#[test]
fn a_flat_tetrahedron_encloses_nothing() {
    let flat = [DVec3::X, DVec3::Y, -DVec3::X, -DVec3::Y];
    let foot = tetrahedron::foot(flat);
    assert!(foot.direction.is_some() && foot.point.length() < 1e-15);
}

#[test]
fn an_enclosing_tetrahedron_weighs_its_corners() {
    let regular = [
        DVec3::new(1.0, 1.0, 1.0),
        DVec3::new(1.0, -1.0, -1.0),
        DVec3::new(-1.0, 1.0, -1.0),
        DVec3::new(-1.0, -1.0, 1.0),
    ];
    let foot = tetrahedron::foot(regular);
    assert!(foot.direction.is_none());
    assert_eq!(foot.weights, [0.25; 4]);
}

#[rstest]
#[case([0.25, 0.75, 0.0], [0.0, 0.5, 0.5], 3)]
#[case([1.0, 0.0, 0.0], [0.2, 0.3, 0.5], 3)]
#[case([0.5, 0.0, 0.5], [0.5, 0.5, 0.0], 2)]
#[case([0.0, 0.0, 1.0], [0.0, 1.0, 0.0], 1)]
fn paired_weights_sum_to_both_weights(
    #[case] a: [f64; 3],
    #[case] b: [f64; 3],
    #[case] pairs: usize,
) {
    let couples: Vec<_> = weights_of_point_pairs(a, b).collect();
    assert_eq!(couples.len(), pairs);
    let (mut left, mut right) = ([0.0; 3], [0.0; 3]);
    for (i, j, weight) in couples {
        left[i] += weight;
        right[j] += weight;
    }
    assert_eq!((left, right), (a, b));
}

#[test]
fn a_simplex_takes_no_pair_twice_and_no_fifth() {
    let vertex = |a, b| Vertex {
        point: DVec3::X,
        a,
        b,
    };
    let mut simplex = Simplex::EMPTY;
    assert!(simplex.push(vertex(0, 0)) && simplex.push(vertex(0, 1)));
    assert!(!simplex.push(vertex(0, 1)));
    assert!(simplex.push(vertex(1, 0)) && simplex.push(vertex(1, 1)));
    assert!(!simplex.push(vertex(2, 2)));
}

/// Tests that an axis is found along which no base corner of a flat pyramid is below its apex.
#[test]
fn a_fan_finds_the_axis_between_its_edges() {
    let mut found = SearchResult::empty();
    let vertex = |x: f64, y: f64, z: f64, a| Vertex {
        point: DVec3::new(x, y, z),
        a,
        b: 0,
    };
    found.simplex.push(vertex(0.0, 0.0, 0.0, 0));
    found.weights[0] = 1.0;
    let mut fan = CandidateAxisVertices::new(&found).expect("it has a vertex");
    for (k, (x, y)) in [(1.0, 1.0), (-1.0, 1.0), (1.0, -1.0), (-1.0, -1.0)]
        .into_iter()
        .enumerate()
    {
        assert!(fan.push(vertex(x, y, 1e-3, k as u32 + 1)));
    }
    // Every vertex is above: along the axis z they would be at 0, as along all axes at which they
    // touch.
    let (axis, low) = fan.best_axis(DVec3::X);
    assert!(low >= -1e-15 && axis.z > 0.99, "{axis} stands at {low}");
}

/// Tests that `solve` certifies the distance of nearly parallel edges, on which a single search often stalls.
#[test]
fn stalled_searches_are_taken_up_again() {
    let (mut stalled, mut short) = (0, 0);
    for seed in 0..1000 {
        let scene = scene::near_contact(
            &mut Pcg64::seed_from_u64(seed),
            NearestFeatures::CrossedEdges,
            1e-9,
        );
        let pair = scene.pair();
        let difference = MinkowskiDifference::new(&pair).expect("pieces with points");
        let start = || Cache::default().simplex(&difference);
        let mut alone = SearchResult::empty();
        let stop = search(&difference, start(), &mut alone);
        stalled += u32::from(stop == StopReason::Stalled);
        short += u32::from(alone.gap < 0.5 * alone.squared_distance.sqrt());
        let found = solve(&difference, start());
        assert!(
            found.gap >= 0.99 * found.squared_distance.sqrt(),
            "{found:?} of {scene:?}"
        );
    }
    assert!(
        stalled > 20 && short > 5,
        "{stalled} stalled, {short} fell short"
    );
}

/// Tests that a search that fails from the cached simplex succeeds without it, on boxes whose faces were parallel at
/// the last call.
#[test]
fn a_search_that_stalls_from_the_last_simplex_begins_anew() {
    let a = Body::cuboid([0.5, 0.5, 1.0]).unwrap();
    let b = Body::cuboid([0.5, 1.0, 1.5]).unwrap();
    let (mut rng, mut stalled) = (Pcg64::seed_from_u64(3), 0);
    for _ in 0..2_000 {
        let (height, mut cache) = (rng.random_range(2.51..8.0), Cache::default());
        let spin = DVec3::new(1e-7, 1e-3, rng.random_range(-1e-7..1e-7));
        for t in [0.0, 10f64.powf(rng.random_range(-9.0..0.0))] {
            let a_to_world = Frame {
                rotation: DMat3::from_quat(DQuat::from_scaled_axis(spin * t)),
                translation: DVec3::new(0.0, 0.0, height),
            };
            let pair = PiecePair {
                a: a.pieces().get(0),
                b: b.pieces().get(0),
                b_to_a: a_to_world.transform_from(&Frame::IDENTITY),
            };
            let difference = MinkowskiDifference::new(&pair).unwrap();
            let warm = solve(&difference, cache.simplex(&difference));
            stalled += u32::from(!is_certified(&warm));
            let found = solve_with_cache(&difference, &cache);
            assert!(is_certified(&found), "{height} {t}: {found:?}");
            cache = Cache::from_search_result(&found);
        }
    }
    assert!(stalled > 20, "{stalled}");
}
