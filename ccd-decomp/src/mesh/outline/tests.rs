use super::*;
use crate::exact::predicates::Projection;
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::TestRunner;
use robust::{Coord, orient2d};
use std::cmp::Ordering;

fn turn(p: DVec3, q: DVec3, r: DVec3) -> f64 {
    let [a, b, c] = [p, q, r].map(|p| Coord { x: p.x, y: p.y });
    orient2d(a, b, c)
}

/// Returns whether an outline intersects itself: two non-adjacent edges meet, or two adjacent edges overlap. Tests all
/// pairs exactly.
fn is_self_intersecting(points: &[DVec3]) -> bool {
    let n = points.len();
    let at = |k: usize| points[k % n];
    let between = |p: DVec3, q: DVec3, x: DVec3| {
        turn(p, q, x) == 0.0 && x.cmpge(p.min(q)).all() && x.cmple(p.max(q)).all()
    };
    let meet = |k: usize, l: usize| {
        let [p, q, r, s] = [at(k), at(k + 1), at(l), at(l + 1)];
        let crosses = turn(p, q, r) * turn(p, q, s) < 0.0 && turn(r, s, p) * turn(r, s, q) < 0.0;
        let ends = [(p, q, r), (p, q, s), (r, s, p), (r, s, q)];
        crosses || ends.iter().any(|&(p, q, x)| between(p, q, x))
    };
    let folded = |k: usize| {
        let [p, q, r] = [at(k), at(k + 1), at(k + 2)];
        turn(p, q, r) == 0.0 && (q - p).dot(r - q) <= 0.0
    };
    (0..n).any(folded) || (0..n).any(|k| (k + 2..n).any(|l| (l + 1) % n != k && meet(k, l)))
}

/// Tests that random outlines are triangulated if and only if they do not intersect themselves. The areas of the
/// triangles add up to the outline's area.
#[test]
fn outlines_are_filled_unless_they_meet_themselves() {
    let radii = prop::collection::vec((0.5..4.0_f64, -4..=4_i32, -4..=4_i32), 4..12);
    let given = (radii, 0..3_u8);
    let mut runner = TestRunner::deterministic();
    let (mut whole, mut crossed) = (0, 0);
    for _ in 0..400 {
        let (radii, kind) = given.new_tree(&mut runner).unwrap().current();
        let n = radii.len() as f64;
        let corner = |(k, &(radius, x, y)): (usize, &(f64, i32, i32))| {
            let angle = std::f64::consts::TAU * k as f64 / n;
            let round = radius * DVec3::new(angle.cos(), angle.sin(), 0.0);
            match kind {
                0 => round,
                1 => round.round(),
                _ => DVec3::new(x.into(), y.into(), 0.0),
            }
        };
        let points: Vec<DVec3> = radii.iter().enumerate().map(corner).collect();
        let filled = triangulate_outline(&points);
        if is_self_intersecting(&points) {
            assert_eq!(filled, None, "{points:?}");
            crossed += 1;
            continue;
        }
        whole += 1;
        let filled = filled.unwrap();
        assert_eq!(filled.len(), points.len() - 2);
        let area = |[a, b, c]: [usize; 3]| turn(points[a], points[b], points[c]);
        let first = points.iter().zip(points.iter().cycle().skip(1));
        let all: f64 = first.map(|(p, q)| turn(DVec3::ZERO, *p, *q)).sum();
        assert!(filled.iter().all(|&t| area(t) * all > 0.0));
        let sum: f64 = filled.iter().map(|&t| area(t)).sum();
        assert!((sum - all).abs() < 1e-9 * all.abs());
    }
    assert!(whole > 50 && crossed > 50, "{whole}, {crossed}");
}

#[test]
fn outlines_are_filled_from_whichever_side() {
    let notch = [(0.0, 0.0), (4.0, 0.0), (1.0, 1.0), (0.0, 4.0)];
    for axes in [
        [0, 1, 2],
        [1, 2, 0],
        [2, 0, 1],
        [1, 0, 2],
        [0, 2, 1],
        [2, 1, 0],
    ] {
        let placed = |&(x, y): &(f64, f64)| {
            let mut p = [0.0; 3];
            (p[axes[0]], p[axes[1]], p[axes[2]]) = (x, y, 0.25 * x);
            DVec3::from_array(p)
        };
        let points: Vec<DVec3> = notch.iter().map(placed).collect();
        assert_eq!(
            triangulate_outline(&points),
            Some(vec![[0, 1, 2], [0, 2, 3]])
        );
        let turned: Vec<DVec3> = points.iter().rev().copied().collect();
        let filled = triangulate_outline(&turned).unwrap();
        let plane = Projection::new([points[0], points[2], points[1]]).unwrap();
        let [a, b, c] = filled[0].map(|k| turned[k]);
        assert_eq!(plane.turn(a, b, c), Ordering::Greater);
    }
}

#[test]
fn outlines_without_an_inside_are_not_filled() {
    let line: Vec<DVec3> = (0..5).map(|k| DVec3::X * f64::from(k)).collect();
    assert_eq!(triangulate_outline(&line), None);
    assert_eq!(triangulate_outline(&[DVec3::ONE; 6]), None);
    let twice = [DVec3::ZERO, DVec3::X, DVec3::ONE, DVec3::X, DVec3::Y];
    assert_eq!(triangulate_outline(&twice), None);
    let fine = [
        DVec3::ZERO,
        1e-300 * DVec3::X,
        DVec3::ONE,
        1e-300 * DVec3::Y,
    ];
    assert_eq!(triangulate_outline(&fine), None);
}

/// Tests that outlines of 60,000 corners on or near a line, or in convex position, are triangulated. A sweep takes
/// minutes for them.
#[test]
fn outlines_of_many_corners_take_no_longer_than_others() {
    let count = 60_000;
    let at = |k: usize| k as f64;
    let chain = |height: fn(f64) -> f64| {
        let mut points: Vec<DVec3> = (0..count)
            .map(|k| DVec3::new(at(k), height(at(k)), 0.0))
            .collect();
        points.push(DVec3::new(at(count / 2), -1e5, 0.0));
        points
    };
    let comb = (0..count / 2).flat_map(|k| {
        let height = if k % 2 == 0 { 0.0 } else { 1e4 };
        [at(2 * k), at(2 * k + 1)].map(|x| DVec3::new(x, height, 0.0))
    });
    let comb: Vec<DVec3> = comb
        .chain([DVec3::new(at(count), -1.0, 0.0), DVec3::new(0.0, -1.0, 0.0)])
        .collect();
    for mut points in [
        chain(|_| 0.0),
        chain(|x| 1e-7 * x * x),
        chain(|x| 1e-9 * (x % 13.0)),
        comb,
    ] {
        let filled = triangulate_outline(&points).expect("the outline does not meet itself");
        assert_eq!(filled.len(), points.len() - 2);
        let area = |[a, b, c]: [usize; 3]| (points[b] - points[a]).cross(points[c] - points[a]).z;
        let pairs = points.iter().zip(points.iter().cycle().skip(1));
        let whole: f64 = pairs.map(|(p, q)| p.cross(*q).z).sum();
        let sum: f64 = filled.iter().map(|&triangle| area(triangle)).sum();
        assert!((sum - whole).abs() < 1e-6 * whole.abs(), "{sum}, {whole}");
        // Outlines with a repeated corner, or an edge through another corner.
        points.push(points[count / 3]);
        assert_eq!(triangulate_outline(&points), None);
    }
    let again: Vec<DVec3> = (0..count)
        .map(|k| [DVec3::ZERO, DVec3::X, DVec3::Y][k % 3])
        .collect();
    assert_eq!(triangulate_outline(&again), None);
}

/// Tests that outlines with random repeats and spikes cover what they cover without those, wherever the outline begins.
#[test]
fn flat_corners_change_no_area() {
    let plain = [
        (0, 0),
        (6, 0),
        (6, 6),
        (4, 6),
        (4, 2),
        (2, 2),
        (2, 6),
        (0, 6),
    ];
    let plain = plain.map(|(x, y)| DVec3::new(f64::from(x), f64::from(y), f64::from(x + 2 * y)));
    let area = |points: &[DVec3], triangles: &[[usize; 3]]| -> f64 {
        let corners = triangles.iter().map(|t| t.map(|k| points[k]));
        corners.map(|[a, b, c]| (b - a).cross(c - a).length()).sum()
    };
    let whole = area(&plain, &fill_outline(&plain).unwrap());
    let given = (
        prop::collection::vec((0..32_usize, 0..3_u8), 1..8),
        0..32_usize,
    );
    let mut runner = TestRunner::deterministic();
    for _ in 0..400 {
        let (changes, turned) = given.new_tree(&mut runner).unwrap().current();
        let mut points = plain.to_vec();
        for (at, kind) in changes {
            let (count, at) = (points.len(), at % points.len());
            let (here, before) = (points[at], points[(at + count - 1) % count]);
            let beyond = match kind {
                0 => vec![here],
                // Back to the corner before, and half of the way.
                1 => vec![before, here],
                _ => vec![(here + before) / 2.0, here],
            };
            points.splice(at + 1..at + 1, beyond);
        }
        let count = points.len();
        points.rotate_left(turned % count);
        let filled = fill_outline(&points).unwrap_or_else(|| panic!("{points:?}"));
        assert_eq!(filled.len(), count - 2);
        let found = area(&points, &filled);
        assert!(
            (found - whole).abs() < 1e-9,
            "{found} instead of {whole}: {points:?}"
        );
        assert!((0..count).all(|k| {
            filled
                .iter()
                .any(|t| t.map(|t| points[t]).contains(&points[k]))
        }));
    }
}
