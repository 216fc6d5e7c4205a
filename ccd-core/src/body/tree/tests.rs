//! Tests that trees have every piece once, and that all boxes and balls contain the pieces below them.

use super::*;
use crate::body::pieces::Pieces;
use crate::body::polytope::Polytope;
use crate::body::{Body, Solidity};
use crate::math::order::greater;
use crate::math::vector::length;
use crate::settings::VectorInstructions;
use crate::tests::nearest::Triangle;
use crate::tests::scene::{
    Pcg64, RngExt, SoupKind, body, random_direction, random_point_in_ball, random_power_of_ten,
    random_triangle_soup, rng,
};
use crate::vectorize;
use glam::{DVec3, Vec3};

/// The relative tolerance of the checks, which covers the rounding of their own f64 arithmetic.
const CHECK_TOLERANCE: f64 = 1e-14;

/// Asserts that a body's tree has each piece once, within all bounds above it; returns the number of groups.
fn assert_tree_bounds_pieces(body: &Body) -> usize {
    let (tree, pieces) = (body.tree(), body.pieces());
    let mut seen = vec![0; pieces.len()];
    let below_root = assert_subtree_bounds_pieces(tree, pieces, 0, &mut seen);
    assert!(seen.iter().all(|&n| n == 1), "each piece once: {seen:?}");
    assert_eq!(below_root.len(), pieces.len());
    assert!(
        tree.max_distance_from_origin >= max_distance_from_origin(pieces) * (1.0 - CHECK_TOLERANCE)
    );
    assert!(tree.memory_usage() >= size_of::<Node>() * tree.nodes.len());
    tree.box_groups.len() + tree.triangle_groups.len()
}

fn max_distance_from_origin(pieces: &Pieces) -> f64 {
    let reach =
        |p: crate::Piece<'_>| p.points.iter().map(|&x| length(x)).fold(0.0, greater) + p.radius;
    pieces.iter().map(reach).fold(0.0, greater)
}

/// Asserts that a node and all nodes below it bound their pieces, and returns the pieces below.
fn assert_subtree_bounds_pieces(
    tree: &Tree,
    pieces: &Pieces,
    id: NodeId,
    seen: &mut [u32],
) -> Vec<u32> {
    let NodeOrTriangle::Node(node) = tree.get(id) else {
        let piece = tree.piece(id).expect("a triangle");
        seen[piece as usize] += 1;
        return vec![piece];
    };
    let mut below = Vec::new();
    match node.children {
        NodeChildren::Piece(piece) => {
            assert_eq!(tree.piece(id), Some(piece));
            seen[piece as usize] += 1;
            below.push(piece);
        }
        NodeChildren::Boxes(group) => {
            let group = tree.box_group(group);
            for child in child_ids(&group.header) {
                let lane = (child - group.header.first_child) as usize;
                let inside = assert_subtree_bounds_pieces(tree, pieces, child, seen);
                assert_lane_bounds_pieces(group, lane, pieces, &inside);
                let leaf = tree.piece(child).is_some();
                assert_eq!(group.leaf_mask >> lane & 1 == 1, leaf);
                below.extend(inside);
            }
        }
        NodeChildren::Triangles(group) => {
            let level = VectorInstructions::Best.simd_level();
            let group = &vectorize!(level, level => tree.triangle_group(level, group, pieces));
            for child in child_ids(&group.header) {
                let lane = (child - group.header.first_child) as usize;
                let inside = assert_subtree_bounds_pieces(tree, pieces, child, seen);
                let [piece] = inside[..] else {
                    panic!("one triangle");
                };
                assert_lane_holds_triangle(group, lane, pieces.triangle(piece as usize));
                below.push(piece);
            }
        }
    }
    assert_node_bounds_pieces(node, pieces, &below);
    below
}

fn child_ids(members: &GroupHeader) -> std::ops::Range<NodeId> {
    assert!((1..=LANES as u32).contains(&members.count));
    members.first_child..members.first_child + members.count
}

/// Asserts that a node's box and ball contain all points of its pieces, rounding radii included.
fn assert_node_bounds_pieces(node: &Node, pieces: &Pieces, below: &[u32]) {
    assert!(node.half_extents.iter().all(|h| h.is_finite()) && node.radius.is_finite());
    for axis in node.axes {
        assert!((axis.as_dvec3().length() - 1.0).abs() < 4.0 * f64::from(f32::EPSILON));
    }
    let [x, y, z] = node.axes.map(|axis| axis.as_dvec3());
    for askew in [x.dot(y), y.dot(z), z.dot(x)] {
        assert!(askew.abs() < 4.0 * f64::from(f32::EPSILON), "{node:?}");
    }
    for &piece in below {
        let piece = pieces.get(piece as usize);
        for &point in piece.points {
            let way = point - node.center;
            let slack = CHECK_TOLERANCE * (point.length() + node.center.length());
            assert!(way.length() + piece.radius <= f64::from(node.radius) + slack);
            let half = node
                .half_extents
                .map(|h| f64::from(h) + f64::from(node.rounding_radius));
            for (axis, half) in node.axes.iter().zip(half) {
                let reach = way.dot(axis.as_dvec3()).abs() + piece.radius;
                assert!(reach <= half + slack, "{reach:e} > {half:e}");
            }
        }
    }
}

/// Asserts that the box and the ball in one lane of a group contain the child's points, about the rounded center.
fn assert_lane_bounds_pieces(group: &BoxGroup, lane: usize, pieces: &Pieces, below: &[u32]) {
    let at =
        |rows: &[[f32; LANES]; 3]| DVec3::from_array([0, 1, 2].map(|k| f64::from(rows[k][lane])));
    let center = group.header.origin + at(&group.center);
    for &piece in below {
        let piece = pieces.get(piece as usize);
        for &point in piece.points {
            let way = point - center;
            let slack = CHECK_TOLERANCE * (point.length() + center.length());
            assert!(way.length() + piece.radius <= f64::from(group.radius[lane]) + slack);
            for k in 0..3 {
                let reach = way.dot(at(&group.axes[k])).abs() + piece.radius;
                let half =
                    f64::from(group.half_extents[k][lane]) + f64::from(group.rounding_radius[lane]);
                assert!(reach <= half + slack);
            }
            let from_origin = (point - group.header.origin).length() + piece.radius;
            assert!(from_origin <= f64::from(group.header.max_distance_from_origin) + slack);
        }
    }
}

/// Asserts that a group has a triangle's corners correctly rounded, and that its ball contains the exact corners.
fn assert_lane_holds_triangle(group: &TriangleGroup, lane: usize, triangle: Triangle) {
    let mean = (triangle[0] + triangle[1] + triangle[2]) / 3.0;
    for (k, &corner) in triangle.iter().enumerate() {
        let exact = corner - group.header.origin;
        let slack = CHECK_TOLERANCE * (corner.length() + group.header.origin.length());
        for axis in 0..3 {
            let rounded = f64::from(group.corners[k][axis][lane]);
            let allowed = exact[axis].abs() * f64::from(f32::EPSILON) / 2.0;
            assert!((rounded - exact[axis]).abs() <= allowed + f64::from(f32::MIN_POSITIVE));
        }
        assert!((corner - mean).length() <= f64::from(group.radius[lane]) + slack);
        assert!(exact.length() <= f64::from(group.header.max_distance_from_origin) + slack);
    }
}

fn random_soup(rng: &mut Pcg64, count: usize) -> Vec<Triangle> {
    let look = SoupKind::ALL[rng.random_range(0..5)];
    let size = random_power_of_ten(rng, -6.0, 6.0);
    let offset = size * random_power_of_ten(rng, -3.0, 6.0);
    let middle = random_direction(rng) * offset;
    let triangles = random_triangle_soup(rng, look, count, size);
    triangles.iter().map(|t| t.map(|p| p + middle)).collect()
}

#[test]
fn soups_of_every_kind_and_count() {
    let mut rng = rng(1);
    for count in (1..=80).chain([200, 511, 512, 513, 3_000]) {
        for _ in 0..3 {
            let groups = assert_tree_bounds_pieces(&body(&random_soup(&mut rng, count)));
            // Eight lanes are used: there are not many more groups than clusters of eight.
            assert!(groups <= 1 + count / 2, "{groups} for {count}");
        }
    }
}

#[test]
fn single_equal_and_degenerate_pieces() {
    let corner = [DVec3::ZERO, DVec3::X, DVec3::Y];
    for count in [1, 2, 8, 9, 65, 300] {
        assert_tree_bounds_pieces(&body(&vec![corner; count]));
        assert_tree_bounds_pieces(&body(&vec![[DVec3::ONE; 3]; count]));
        let line = |k: usize| [0.0, 0.3, 1.0].map(|t| (k as f64 + t) * DVec3::new(1.0, 2.0, 3.0));
        assert_tree_bounds_pieces(&body(&(0..count).map(line).collect::<Vec<_>>()));
        let flat = |k: usize| corner.map(|p| p + DVec3::new((k % 7) as f64, (k / 7) as f64, 0.0));
        assert_tree_bounds_pieces(&body(&(0..count).map(flat).collect::<Vec<_>>()));
    }
}

#[test]
fn coordinates_up_to_the_largest_and_down_to_the_least() {
    let mut rng = rng(2);
    for scale in [1e-300, 1e-30, 1e-12, 1e6, 9e11] {
        for count in [1, 7, 100] {
            let triangles: Vec<Triangle> =
                random_triangle_soup(&mut rng, SoupKind::MixedSizes, count, 0.5)
                    .iter()
                    .map(|t| t.map(|p| p * scale))
                    .collect();
            assert_tree_bounds_pieces(&body(&triangles));
        }
    }
}

/// Tests that trees are valid at coordinates so small that their squares lose digits (below 1e-154) or are 0 (below
/// 1e-162).
#[test]
fn components_whose_squares_are_no_numbers() {
    let mut rng = rng(4);
    for _ in 0..3_000 {
        let count = rng.random_range(1..30);
        let tiny = random_power_of_ten(&mut rng, -170.0, -150.0);
        let triangles: Vec<Triangle> =
            random_triangle_soup(&mut rng, SoupKind::WellShaped, count, 1.0)
                .iter()
                .map(|t| {
                    let mut kept = |_| [1.0, tiny, 0.0][rng.random_range(0..3)];
                    let scale = [0, 1, 2].map(|_| DVec3::from_array([0, 1, 2].map(&mut kept)));
                    [0, 1, 2].map(|k| t[k] * scale[k])
                })
                .collect();
        assert_tree_bounds_pieces(&body(&triangles));
    }
    // Frames computed from such normals had lengths off by up to a third.
    for k in 0..2_000 {
        let tiny = 1e-163 * 1.002f64.powi(k);
        let across = DVec3::new(-tiny, tiny, 0.3 * tiny);
        assert_tree_bounds_pieces(&body(&[[DVec3::ZERO, DVec3::new(1.0, 1.0, -2.0), across]]));
    }
}

#[test]
fn polytopes_balls_and_capsules_are_held_with_their_radii() {
    let mut rng = rng(3);
    for count in [1, 2, 8, 9, 70, 300] {
        let polytopes: Vec<Polytope> = (0..count)
            .map(|_| {
                let at = random_point_in_ball(&mut rng, 10.0);
                let points = rng.random_range(1..12);
                Polytope {
                    points: (0..points)
                        .map(|_| at + random_point_in_ball(&mut rng, 1.0))
                        .collect(),
                    radius: [0.0, 0.5, 3.0][rng.random_range(0..3)],
                    ..Polytope::default()
                }
            })
            .collect();
        let pieces = Pieces::from_polytopes(&polytopes).unwrap();
        assert_tree_bounds_pieces(&Body::new(&pieces, Solidity::Surface).unwrap());
    }
}

#[test]
fn unit_normals_and_upper_numbers_are_those_of_f64_rounded() {
    let mut rng = rng(9);
    for size in [1e-160, 1e-9, 1.0, 1e9] {
        for _ in 0..100 {
            let corners = [(); 3].map(|()| size * random_point_in_ball(&mut rng, 1.0));
            let exact = crate::math::vector::normal(corners).unwrap();
            let found = unit_normal(corners).as_dvec3();
            assert!(found.distance(exact) < 2e-7, "{found} for {exact}");
        }
    }
    assert_eq!(unit_normal([DVec3::ONE; 3]), Vec3::ZERO);
    for (x, above) in [(0.5, 0.5), (0.1, 0.1_f32), (0.7, 0.7_f32.next_up())] {
        assert_eq!(round_up_to_f32(x), above, "{x}");
    }
}
