//! Tests that every hull of a hull tree is the hull of the points below it, and that features not marked `Free` lie on
//! a piece.

use super::*;
use crate::exact::predicates::side_of_plane;
use ccd_core::order::greater;
use ccd_core::{ConvexCombination, FacetClass, HierarchyNode, HullFault, Polytope};
use proptest::prelude::*;
use std::cmp::Ordering;

fn any_coordinate() -> impl Strategy<Value = f64> {
    // On a grid, so that many points share planes and lines, and anywhere.
    prop_oneof![(-4i32..=4).prop_map(|x| 0.25 * f64::from(x)), -1.0..1.0f64]
}

fn point() -> impl Strategy<Value = DVec3> {
    (any_coordinate(), any_coordinate(), any_coordinate()).prop_map(|(x, y, z)| DVec3::new(x, y, z))
}

/// Generates a piece: the hull of random points on a line, in a plane or in space.
fn piece() -> impl Strategy<Value = Polytope> {
    let span = prop_oneof![
        Just(DVec3::ONE),
        Just(DVec3::new(1.0, 1.0, 0.0)),
        Just(DVec3::new(0.0, 1.0, 0.0)),
    ];
    let points = prop::collection::vec(point(), 1..10);
    (points, span, point()).prop_map(|(points, span, at)| {
        polytope(
            &points
                .iter()
                .map(|&p| 0.25 * p * span + at)
                .collect::<Vec<_>>(),
        )
    })
}

/// Returns the hull of points as a polytope of virtual facets.
fn polytope(points: &[DVec3]) -> Polytope {
    let hull = hull(points).unwrap();
    let facet = |corners: &[u32]| ccd_core::Facet {
        origin: ccd_core::FacetOrigin::Virtual,
        corners: corners.to_vec(),
    };
    Polytope {
        facets: hull.facets.iter().map(facet).collect(),
        points: hull.points,
        ..Polytope::default()
    }
}

/// Returns the numbers of the leaf nodes below the node `at`.
fn leaf_indices_below(tree: &HullTree, at: usize) -> Vec<usize> {
    match tree.hierarchy().nodes()[at] {
        HierarchyNode::Leaf(_) => vec![at],
        HierarchyNode::Inner(left, right) => [left, right]
            .iter()
            .flat_map(|&child| leaf_indices_below(tree, child as usize))
            .collect(),
    }
}

/// Returns whether a hull contains a point up to the distance `slack`, by a test of every facet.
fn contains_within_slack(hull: &ccd_core::Piece<'_>, point: DVec3, slack: f64) -> bool {
    let beyond = hull.facets.iter().map(|corners| {
        let at = |k: usize| hull.points[corners[k] as usize];
        let normals = (1..corners.len() - 1).map(|k| (at(k) - at(0)).cross(at(k + 1) - at(0)));
        let normal = normals.sum::<DVec3>().normalize();
        let outward = (0..corners.len()).map(|k| {
            let edge = at((k + 1) % corners.len()) - at(k);
            edge.cross(normal).normalize().dot(point - at(k))
        });
        let height = normal.dot(point - at(0));
        match hull.facets.len() {
            // A plate is bounded by its edges, too.
            2 => outward.fold(height, greater),
            _ => height,
        }
    });
    match *hull.points {
        [a] => a.distance(point) <= slack,
        [a, b] => {
            let share = (point - a).dot(b - a) / (b - a).length_squared();
            (a + share.clamp(0.0, 1.0) * (b - a)).distance(point) <= slack
        }
        _ => beyond.fold(f64::NEG_INFINITY, greater) <= slack,
    }
}

fn is_exactly_inside(hull: &ccd_core::Piece<'_>, point: DVec3) -> bool {
    hull.facets.iter().all(|corners| {
        let corners: Vec<DVec3> = corners.iter().map(|&v| hull.points[v as usize]).collect();
        let fan = (1..corners.len() - 1).map(|k| [corners[0], corners[k], corners[k + 1]]);
        fan.into_iter()
            .all(|t| side_of_plane(t, point) != Ordering::Greater)
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn every_hull_is_exactly_that_of_the_points_below(pieces in prop::collection::vec(piece(), 1..24)) {
        let count = pieces.len();
        let tree = build_hull_tree(&Pieces::from_polytopes(&pieces).unwrap()).unwrap();
        prop_assert_eq!(tree.hierarchy().nodes().len(), 2 * count - 1);
        for at in 0..tree.hulls().len() {
            let hull = tree.hulls().get(at);
            for leaf in leaf_indices_below(&tree, at) {
                for &point in tree.hulls().get(leaf).points {
                    prop_assert!(is_exactly_inside(&hull, point));
                    // A facet of a hull with volume may be so thin that rounding turns its normal; a
                    // plate's edges bound it as well, which planes alone do not show.
                    let has_volume = hull.facets.len() > 2;
                    prop_assert!(has_volume || contains_within_slack(&hull, point, 1e-9));
                }
            }
        }
    }

    #[test]
    fn features_that_are_not_free_are_on_a_piece(
        pieces in prop::collection::vec(piece(), 2..16),
        weights in [0.01..1.0f64, 0.01..1.0, 0.01..1.0],
    ) {
        let tree = build_hull_tree(&Pieces::from_polytopes(&pieces).unwrap()).unwrap();
        for at in 0..tree.hulls().len() {
            let hull = tree.hulls().get(at);
            let below = leaf_indices_below(&tree, at);
            let real = |combination: &ConvexCombination| {
                let point = combination.position(hull.points).unwrap();
                let near = |&leaf: &usize| contains_within_slack(&tree.hulls().get(leaf), point, 1e-9);
                tree.facet_class_at(at as u32, combination) == FacetClass::Bridge
                    || below.iter().any(near)
                    || is_near_two_pieces(&tree, &below, point)
            };
            for corners in hull.facets.iter() {
                for k in 0..corners.len() {
                    let next = corners[(k + 1) % corners.len()];
                    prop_assert!(real(&ConvexCombination::from_single_point(corners[k])));
                    prop_assert!(real(&ConvexCombination::of_two_points([corners[k], next], weights[0])));
                    let mut inside = ConvexCombination::of_two_points([corners[k], next], weights[1]);
                    inside.add_weighted_point(corners[(k + 2) % corners.len()], weights[2]);
                    prop_assert!(real(&inside));
                }
            }
        }
    }
}

/// Returns whether a point is within 1e-6 of two pieces, so that rounding may decide which piece contains it.
fn is_near_two_pieces(tree: &HullTree, below: &[usize], point: DVec3) -> bool {
    let near = |&&leaf: &&usize| contains_within_slack(&tree.hulls().get(leaf), point, 1e-6);
    below.iter().filter(near).count() > 1
}

/// Returns eight blocks on a grid of 4 by 2, `gap` apart along x. The sides of a block differ in length.
fn block_grid(gap: f64) -> Vec<Polytope> {
    let size = DVec3::new(1.0, 0.75, 0.5);
    let corner = |k: u32| size * DVec3::new((k & 1).into(), (k >> 1 & 1).into(), (k >> 2).into());
    let block = |k: u32| {
        let step = DVec3::new(1.0 + gap, 0.75, 0.0);
        let at = step * DVec3::new((k % 4).into(), (k / 4).into(), 0.0);
        polytope(&(0..8).map(|k| at + corner(k)).collect::<Vec<_>>())
    };
    (0..8).map(block).collect()
}

#[test]
fn blocks_side_by_side_leave_no_bridge_and_blocks_apart_do() {
    let classes = |gap| {
        let tree = build_hull_tree(&Pieces::from_polytopes(&block_grid(gap)).unwrap()).unwrap();
        assert_eq!(tree.hulls().get(0).facets.len(), 6);
        let all = (0..15).flat_map(|node| tree.facet_classes(node).to_vec());
        all.collect::<Vec<_>>()
    };
    assert_eq!(classes(0.0), [FacetClass::InsideSolid; 90]);
    let apart = classes(0.25);
    let free = apart.iter().filter(|&&class| class == FacetClass::Bridge);
    // Four facets of every node along the wall: the root, its halves, and no others.
    assert_eq!(free.count(), 12);
}

#[test]
fn a_row_splits_in_the_middle_along_itself() {
    let bead = |x: f64| Polytope {
        points: vec![DVec3::new(x, 0.1 * x, 0.0)],
        ..Polytope::default()
    };
    let row: Vec<Polytope> = (0..16).map(|k| bead(f64::from(k))).collect();
    let tree = build_hull_tree(&Pieces::from_polytopes(&row).unwrap()).unwrap();
    let HierarchyNode::Inner(left, _) = tree.hierarchy().nodes()[0] else {
        panic!("16 pieces in one leaf");
    };
    let mut below: Vec<u32> = leaf_indices_below(&tree, left as usize)
        .into_iter()
        .map(|leaf| match tree.hierarchy().nodes()[leaf] {
            HierarchyNode::Leaf(piece) => piece,
            HierarchyNode::Inner(..) => unreachable!("a leaf"),
        })
        .collect();
    below.sort_unstable();
    assert!(below == (0..8).collect::<Vec<_>>() || below == (8..16).collect::<Vec<_>>());
}

fn depth(tree: &HullTree, at: u32) -> usize {
    match tree.hierarchy().nodes()[at as usize] {
        HierarchyNode::Leaf(_) => 0,
        HierarchyNode::Inner(left, right) => 1 + depth(tree, left).max(depth(tree, right)),
    }
}

#[test]
fn the_depth_is_bounded_wherever_pieces_are() {
    // Each half as far as the last: at half the length, one piece would be split off at a time.
    let far = |k: i32| DVec3::new(0.5f64.powi(k), 0.0, 0.0);
    let same = |_: i32| DVec3::ONE;
    let bead = |point: DVec3| Polytope {
        points: vec![point],
        ..Polytope::default()
    };
    for place in [far as fn(i32) -> DVec3, same] {
        let beads: Vec<Polytope> = (0..200).map(|k| bead(place(k))).collect();
        let tree = build_hull_tree(&Pieces::from_polytopes(&beads).unwrap()).unwrap();
        let most = (200f64.ln() / (8f64 / 7.0).ln()).ceil() as usize;
        assert!(depth(&tree, 0) <= most, "{} > {most}", depth(&tree, 0));
    }
}

#[test]
fn coordinates_too_fine_are_an_error() {
    let bead = |x: f64| Polytope {
        points: vec![DVec3::new(x, 0.0, 0.0)],
        ..Polytope::default()
    };
    let pieces = Pieces::from_polytopes(&[bead(1.0), bead(1e-300)]).unwrap();
    let error = build_hull_tree(&pieces).unwrap_err();
    assert_eq!(
        error,
        HullTreeBuildError::CoordinateOutOfRange(DVec3::new(1e-300, 0.0, 0.0))
    );
    let alone = Pieces::from_polytopes(&[bead(1e-300)]).unwrap();
    let error = build_hull_tree(&alone).unwrap_err();
    let fault = HullFault::CoordinateTooSmall { point: 0 };
    assert_eq!(error, HullTreeError::Node { node: 0, fault }.into());
}

#[test]
fn the_same_pieces_give_the_same_tree() {
    let corner = |k: u32| DVec3::new(f64::from(k % 5), f64::from(k / 5 % 5), f64::from(k / 25));
    let cube = |k: u32| {
        let lumps = (0..8).map(|j| {
            corner(k) + 0.5 * DVec3::new((j & 1) as f64, (j >> 1 & 1) as f64, (j >> 2) as f64)
        });
        polytope(&lumps.collect::<Vec<_>>())
    };
    let cubes: Vec<Polytope> = (0..125).map(cube).collect();
    let pieces = Pieces::from_polytopes(&cubes).unwrap();
    let tree = build_hull_tree(&pieces).unwrap();
    assert_eq!(
        tree.to_nodes(),
        build_hull_tree(&pieces).unwrap().to_nodes()
    );
    // All centers at equal steps: halves at every level.
    assert!(depth(&tree, 0) <= 10, "{}", depth(&tree, 0));
}
