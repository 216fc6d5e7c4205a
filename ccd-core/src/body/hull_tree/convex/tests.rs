//! Tests that convex surfaces are recognised, and that nearly convex ones are rejected, at integer coordinates.

use super::is_convex;
use crate::body::pieces::Pieces;
use crate::body::polytope::{Facet, FacetOrigin, Polytope};
use glam::DVec3;

fn is_convex_polytope(points: &[[f64; 3]], facets: &[&[u32]]) -> bool {
    let facet = |corners: &&[u32]| Facet {
        origin: FacetOrigin::Virtual,
        corners: corners.to_vec(),
    };
    let polytope = Polytope {
        points: points.iter().map(|&p| DVec3::from_array(p)).collect(),
        facets: facets.iter().map(facet).collect(),
        ..Polytope::default()
    };
    is_convex(&Pieces::from_polytopes(&[polytope]).unwrap().get(0))
}

const PYRAMID_POINTS: [[f64; 3]; 5] = [
    [0.0, 0.0, 0.0],
    [2.0, 0.0, 0.0],
    [2.0, 2.0, 0.0],
    [0.0, 2.0, 0.0],
    [1.0, 1.0, 3.0],
];
const PYRAMID_FACETS: [&[u32]; 5] = [
    &[3, 2, 1, 0],
    &[0, 1, 4],
    &[1, 2, 4],
    &[2, 3, 4],
    &[3, 0, 4],
];

#[test]
fn polytopes_are() {
    assert!(is_convex_polytope(&PYRAMID_POINTS, &PYRAMID_FACETS));
    // One facet is divided into two parts of one plane.
    let parts: [&[u32]; 6] = [
        &[3, 2, 1],
        &[3, 1, 0],
        PYRAMID_FACETS[1],
        PYRAMID_FACETS[2],
        PYRAMID_FACETS[3],
        PYRAMID_FACETS[4],
    ];
    assert!(is_convex_polytope(&PYRAMID_POINTS, &parts));
}

#[test]
fn dented_turned_or_open_surfaces_are_not_convex() {
    let mut dented = PYRAMID_POINTS;
    dented[2] = [0.75, 0.75, 0.0];
    assert!(!is_convex_polytope(&dented, &PYRAMID_FACETS));
    let parts: [&[u32]; 6] = [
        &[3, 2, 1],
        &[3, 1, 0],
        PYRAMID_FACETS[1],
        PYRAMID_FACETS[2],
        PYRAMID_FACETS[3],
        PYRAMID_FACETS[4],
    ];
    let mut folded = PYRAMID_POINTS;
    // The new edge across the square bends inward in one direction and outward in the other.
    folded[2] = [2.0, 2.0, -1e-60];
    assert!(!is_convex_polytope(&folded, &parts));
    folded[2] = [2.0, 2.0, 1e-60];
    assert!(is_convex_polytope(&folded, &parts) && !is_convex_polytope(&folded, &PYRAMID_FACETS));
    let inside_out: Vec<Vec<u32>> = PYRAMID_FACETS
        .map(|f| f.iter().rev().copied().collect())
        .to_vec();
    let inside_out: Vec<&[u32]> = inside_out.iter().map(Vec::as_slice).collect();
    assert!(!is_convex_polytope(&PYRAMID_POINTS, &inside_out));
    assert!(!is_convex_polytope(&PYRAMID_POINTS, &PYRAMID_FACETS[..4]));
    let mut spare = PYRAMID_POINTS.to_vec();
    spare.push([1.0, 1.0, 9.0]);
    assert!(!is_convex_polytope(&spare, &PYRAMID_FACETS));
}

/// Tests that a double pyramid over a five-pointed star is rejected: it is locally convex, but winds about its middle
/// twice.
#[test]
fn a_star_that_winds_twice_is_not() {
    let rim = [
        [0.0, 10.0],
        [9.0, 3.0],
        [6.0, -8.0],
        [-6.0, -8.0],
        [-9.0, 3.0],
    ];
    let mut points: Vec<[f64; 3]> = rim.iter().map(|&[x, y]| [x, y, 0.0]).collect();
    points.extend([[0.0, 0.0, 20.0], [0.0, 0.0, -20.0]]);
    let sides = |step: u32| -> Vec<Vec<u32>> {
        (0..5)
            .flat_map(|k| {
                // The numbers are clockwise, so the edges are reversed.
                let (from, to) = ((k + step) % 5, k);
                [vec![from, to, 5], vec![to, from, 6]]
            })
            .collect()
    };
    let check = |step| {
        let facets = sides(step);
        let facets: Vec<&[u32]> = facets.iter().map(Vec::as_slice).collect();
        is_convex_polytope(&points, &facets)
    };
    assert!(check(1));
    assert!(!check(2));
}

/// Tests that a box is rejected if its lid is cut into an L-shaped facet and a square, as the L is no convex polygon.
/// The lid is flat, but climbing along the L's outline ends in its reflex corner.
#[test]
fn facets_that_are_not_convex_are_not() {
    let [o, z] = [0.0, 1.0];
    let mut points = vec![[o, o, o], [2.0, o, o], [2.0, 2.0, o], [o, 2.0, o]];
    let lid = [
        [o, o],
        [2.0, o],
        [2.0, 1.0],
        [1.0, 1.0],
        [1.0, 2.0],
        [o, 2.0],
        [2.0, 2.0],
    ];
    points.extend(lid.map(|[x, y]| [x, y, z]));
    let sides: [&[u32]; 5] = [
        &[3, 2, 1, 0],
        &[0, 1, 5, 4],
        &[1, 2, 10, 6, 5],
        &[2, 3, 9, 8, 10],
        &[3, 0, 4, 9],
    ];
    let with = |lid: &[&[u32]]| is_convex_polytope(&points, &[&sides, lid].concat());
    assert!(!with(&[&[4, 5, 6, 7, 8, 9], &[7, 6, 10, 8]]));
    assert!(with(&[&[4, 5, 6, 7], &[4, 7, 8, 9], &[7, 6, 10, 8]]));
}

/// Tests that a double pyramid is rejected if a second, lower pyramid shares the rim between its halves.
#[test]
fn surfaces_that_share_a_rim_are_not() {
    let points = [
        [1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [-1.0, 0.0, 0.0],
        [0.0, -1.0, 0.0],
        [0.0, 0.0, 10.0],
        [0.0, 0.0, -10.0],
        [0.0, 0.0, 0.5],
    ];
    let roof = |apex: u32| (0..4).map(move |k| vec![k, (k + 1) % 4, apex]);
    let floor = (0..4).map(|k| vec![(k + 1) % 4, k, 5]);
    let spindle: Vec<Vec<u32>> = roof(4).chain(floor).collect();
    let all: Vec<Vec<u32>> = spindle.iter().cloned().chain(roof(6)).collect();
    let check = |points: &[[f64; 3]], facets: &[Vec<u32>]| {
        let facets: Vec<&[u32]> = facets.iter().map(Vec::as_slice).collect();
        is_convex_polytope(points, &facets)
    };
    assert!(check(&points[..6], &spindle));
    assert!(!check(&points, &all));
}
