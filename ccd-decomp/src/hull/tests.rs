use super::*;
use crate::exact::predicates::{Projection, is_degenerate, side_of_plane};
use proptest::prelude::*;
use rstest::rstest;
use std::cmp::Ordering;
use std::collections::BTreeSet;

/// The hull of a few points, found by testing for every triple of points whether it spans a facet. A triple of points
/// spans a facet if no point is in front of its plane.
struct BruteForceHull {
    corners: Vec<DVec3>,
    /// For each facet, the indices of all points on it, also of those that are not corners.
    facet_points: BTreeSet<Vec<u32>>,
}

impl BruteForceHull {
    fn from_points(points: &[DVec3]) -> Self {
        let n = points.len();
        let first_at = |k: usize| (0..n).find(|&l| points[l] == points[k]) == Some(k);
        let distinct: Vec<usize> = (0..n).filter(|&k| first_at(k)).collect();
        let mut planes = BTreeSet::new();
        for &a in &distinct {
            for &b in &distinct {
                for &c in &distinct {
                    let plane = [points[a], points[b], points[c]];
                    let sides = || distinct.iter().map(|&k| side_of_plane(plane, points[k]));
                    if is_degenerate(plane) || sides().any(|s| s == Ordering::Greater) {
                        continue;
                    }
                    let on = distinct.iter().zip(sides());
                    let on = on.filter(|(_, s)| *s == Ordering::Equal);
                    planes.insert(on.map(|(&k, _)| k as u32).collect::<Vec<u32>>());
                }
            }
        }
        let on: BTreeSet<u32> = planes.iter().flatten().copied().collect();
        // A corner is on three planes; in a plane, it is in no triangle or segment of others.
        let is_corner = |k: &u32| match planes.len() {
            1 => !is_in_coplanar_hull(points, &distinct, *k as usize),
            _ => planes.iter().filter(|plane| plane.contains(k)).count() >= 3,
        };
        let corners = on.into_iter().filter(is_corner);
        BruteForceHull {
            corners: corners.map(|k| points[k as usize]).collect(),
            facet_points: planes,
        }
    }
}

/// Returns whether a point is in the convex hull of coplanar points.
fn is_in_coplanar_hull(points: &[DVec3], distinct: &[usize], k: usize) -> bool {
    let others = || distinct.iter().filter(|&&l| l != k).map(|&l| points[l]);
    let point = points[k];
    let in_segment =
        |a: DVec3, b: DVec3| is_degenerate([a, b, point]) && (a - point).dot(b - point) < 0.0;
    let in_triangle = |a: DVec3, b: DVec3, c: DVec3| {
        Projection::new([a, b, c]).is_some_and(|plane| {
            let edges = [(a, b), (b, c), (c, a)];
            edges
                .iter()
                .all(|&(v, w)| plane.turn(v, w, point) != Ordering::Less)
        })
    };
    let amid = |a, b| in_segment(a, b) || others().any(|c| in_triangle(a, b, c));
    others().any(|a| others().any(|b| amid(a, b)))
}

/// Checks, in exact arithmetic, that a hull is a closed convex polytope that contains all points, without superfluous
/// corners.
fn assert_valid_hull(points: &[DVec3], hull: &Hull) {
    let at = |v: u32| hull.points[v as usize];
    let mut edges = BTreeSet::new();
    for corners in hull.facets.iter() {
        assert!(corners.len() >= 3);
        let plane = [at(corners[0]), at(corners[1]), at(corners[2])];
        for &p in points {
            assert_ne!(side_of_plane(plane, p), Ordering::Greater, "{p} is outside");
        }
        for k in 0..corners.len() {
            let [v, w, x] = [0, 1, 2].map(|l| corners[(k + l) % corners.len()]);
            assert_eq!(side_of_plane(plane, at(v)), Ordering::Equal);
            assert!(!is_degenerate([at(v), at(w), at(x)]), "collinear corners");
            assert!(edges.insert((v, w)), "edge {v}-{w} is there twice");
        }
    }
    for &(v, w) in &edges {
        assert!(edges.contains(&(w, v)), "edge {v}-{w} is open");
    }
    let corners: BTreeSet<u32> = hull.facets.corners().iter().copied().collect();
    let (v, e, f) = (hull.points.len(), edges.len() / 2, hull.facets.len());
    assert!(corners.into_iter().eq(0..v as u32));
    assert_eq!(v + f, e + 2, "Euler's formula");
}

/// Checks the hull of some points against the brute-force hull; it may have no facets only if all points are on a line.
fn assert_hull_agrees_with_brute_force(points: &[DVec3]) {
    let (hull, twin) = (
        hull(points).expect("in range"),
        BruteForceHull::from_points(points),
    );
    if hull.facets.is_empty() {
        assert!(twin.facet_points.is_empty() && (1..=2).contains(&hull.points.len()));
    } else {
        assert_valid_hull(points, &hull);
        assert_eq!(hull.points, twin.corners);
    }
}

fn checked_hull(points: &[DVec3]) -> Hull {
    let hull = hull(points).expect("a hull");
    assert_valid_hull(points, &hull);
    assert_eq!(super::hull(points).as_ref(), Ok(&hull), "not deterministic");
    hull
}

/// Returns a linear congruential generator of pseudorandom numbers in −1..1.
fn noise_generator(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed.wrapping_mul(2).wrapping_add(1);
    move || {
        state = state
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

fn cloud(count: usize, seed: u64) -> Vec<DVec3> {
    let mut next = noise_generator(seed);
    (0..count)
        .map(|_| DVec3::new(next(), next(), next()))
        .collect()
}

fn sphere_points(count: usize, seed: u64) -> Vec<DVec3> {
    let inside = |p: &DVec3| (1e-2..1.0).contains(&p.length());
    let points = cloud(4 * count, seed);
    points
        .into_iter()
        .filter(inside)
        .map(|p| p.normalize())
        .take(count)
        .collect()
}

fn grid_points(n: i32) -> Vec<DVec3> {
    let points = (0..n * n * n).map(|k| [k % n, k / n % n, k / n / n].map(f64::from));
    points.map(DVec3::from_array).collect()
}

fn perturbed_points(points: Vec<DVec3>, amplitude: f64, seed: u64) -> Vec<DVec3> {
    let mut next = noise_generator(seed);
    let mut shake = |p: DVec3| p + amplitude * DVec3::new(next(), next(), next());
    points.into_iter().map(&mut shake).collect()
}

fn cylinder(around: usize, along: usize) -> Vec<DVec3> {
    let angle = |k: usize| std::f64::consts::TAU * k as f64 / around as f64;
    let point = |k: usize| {
        let (sin, cos) = angle(k % around).sin_cos();
        DVec3::new(cos, sin, (k / around) as f64)
    };
    (0..around * along).map(point).collect()
}

#[rstest]
#[case::cloud(cloud(14, 1))]
#[case::ball(sphere_points(16, 2))]
#[case::grid(grid_points(3))]
#[case::cylinder(cylinder(8, 3))]
#[case::shaken_grid(perturbed_points(grid_points(3), 1e-16, 3))]
#[case::flat_grid(grid_points(4)[..16].to_vec())]
#[case::flat_cloud(cloud(12, 8).into_iter().map(|p| p.with_z(p.x)).collect())]
#[case::needle(cloud(14, 4).into_iter().map(|p| p * DVec3::new(1e6, 1.0, 1e-6)).collect())]
#[case::far_off(cloud(14, 5).into_iter().map(|p| p + DVec3::splat(1e7)).collect())]
#[case::duplicates([cloud(9, 6), cloud(9, 6), cloud(9, 6)].concat())]
#[case::nearly_flat(cloud(14, 7).into_iter().map(|p| p * DVec3::new(1.0, 1.0, 1e-15)).collect())]
#[case::tetrahedron(vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z])]
fn hull_agrees_with_brute_force(#[case] points: Vec<DVec3>) {
    let hull = checked_hull(&points);
    let twin = BruteForceHull::from_points(&points);
    assert_eq!(hull.points, twin.corners);
    // A flat hull has two facets in one plane.
    let planes = twin.facet_points.len();
    let facets = if planes == 1 { 2 } else { planes };
    assert_eq!(hull.facets.len(), facets);
}

#[rstest]
#[case::cloud(cloud(20_000, 1), 100)]
#[case::some(cloud(60, 1), 20)]
#[case::hardly_planar(perturbed_points(grid_points(4), 1e-15, 0), 8)]
#[case::ball(sphere_points(3000, 2), 3000)]
#[case::grid(grid_points(12), 8)]
#[case::cylinder(cylinder(100, 30), 200)]
#[case::turned_grid(rotated_points(grid_points(8)), 8)]
fn hull_has_at_least_the_expected_corners(#[case] points: Vec<DVec3>, #[case] least: usize) {
    let hull = checked_hull(&points);
    assert!(hull.points.len() >= least, "{}", hull.points.len());
}

fn rotated_points(points: Vec<DVec3>) -> Vec<DVec3> {
    let turn = ccd_core::glam::DQuat::from_scaled_axis(DVec3::new(0.3, -0.5, 0.7));
    points.into_iter().map(|p| turn * p).collect()
}

#[test]
fn a_box_of_many_points_has_six_facets() {
    let hull = checked_hull(&grid_points(5));
    assert_eq!(hull.facets.len(), 6);
    assert!(hull.facets.iter().all(|f| f.len() == 4));
    assert_eq!(hull.points.len(), 8);
}

#[test]
fn a_plane_is_seen_from_both_sides() {
    let points: Vec<DVec3> = grid_points(5)[..25].to_vec();
    let hull = checked_hull(&points);
    assert_eq!(hull.points, [0, 4, 20, 24].map(|v| points[v]));
    assert_eq!(hull.facets.len(), 2);
    let facet = |k| hull.facets.get(k).expect("two facets");
    let back: Vec<u32> = facet(1).iter().rev().copied().collect();
    assert_eq!(facet(0), back);
}

#[rstest]
#[case(vec![], vec![])]
#[case(vec![DVec3::X; 4], vec![DVec3::X])]
#[case(vec![DVec3::X, DVec3::ZERO, 2.0 * DVec3::X, DVec3::X], vec![DVec3::ZERO, 2.0 * DVec3::X])]
fn a_hull_of_points_on_a_line_has_no_facets(#[case] points: Vec<DVec3>, #[case] ends: Vec<DVec3>) {
    let facets = PolygonList::default();
    let points = hull(&points);
    assert_eq!(
        points,
        Ok(Hull {
            points: ends,
            facets
        })
    );
}

#[rstest]
#[case(DVec3::NAN)]
#[case(DVec3::splat(1e13))]
#[case(DVec3::splat(1e-100))]
fn a_coordinate_out_of_range_is_an_error(#[case] bad: DVec3) {
    let points = [DVec3::ZERO, DVec3::X, bad, DVec3::Y, bad];
    assert_eq!(hull(&points), Err(HullError { point_index: 2 }));
}

proptest! {
    /// Tests the hulls of points with small integer coordinates, many of which are coplanar, collinear or equal.
    #[test]
    fn coarse_points(points in prop::collection::vec(prop::array::uniform3(-2_i8..=2), 1..18)) {
        let points: Vec<DVec3> = points.iter().map(|p| DVec3::from_array(p.map(f64::from))).collect();
        assert_hull_agrees_with_brute_force(&points);
    }

    /// Tests the hulls of points within a few units in the last place of a plane, a line or each other.
    #[test]
    fn hardly_apart(
        points in prop::collection::vec(prop::array::uniform3(-1_i8..=1), 4..14),
        scale in prop::sample::select(vec![1e-18, 1e-16, 3e-16, 1e-15, 1e-12]),
        seed in 0_u64..1000,
    ) {
        let points = points.iter().map(|p| DVec3::from_array(p.map(f64::from))).collect();
        assert_hull_agrees_with_brute_force(&perturbed_points(points, scale, seed));
    }
}
