use super::build_hierarchy;
use ccd_core::glam::{DVec3, dvec3};
use ccd_core::{Hierarchy, HierarchyNode, Pieces, Polytope};
use proptest::prelude::*;

fn triangle_pieces(count: u32, corners: impl Fn(f64) -> [DVec3; 3]) -> Pieces {
    let points: Vec<DVec3> = (0..count).flat_map(|k| corners(f64::from(k))).collect();
    let faces: Vec<[u32; 3]> = (0..count).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]).collect();
    let ids: Vec<u32> = (0..count).collect();
    Pieces::from_triangles(&points, &faces, &ids).unwrap()
}

fn corner(size: f64) -> [DVec3; 3] {
    [DVec3::ZERO, size * DVec3::X, size * DVec3::Y]
}

/// Returns the pieces of the leaves, sorted, and the depth of the deepest leaf.
fn leaf_pieces_and_depth(hierarchy: &Hierarchy) -> (Vec<u32>, usize) {
    let (mut leaves, mut deepest) = (Vec::new(), 0);
    let mut stack = vec![(0, 0)];
    while let Some((node, depth)) = stack.pop() {
        deepest = deepest.max(depth);
        match hierarchy.nodes()[node as usize] {
            HierarchyNode::Leaf(piece) => leaves.push(piece),
            HierarchyNode::Inner(left, right) => {
                stack.extend([(left, depth + 1), (right, depth + 1)]);
            }
        }
    }
    leaves.sort_unstable();
    (leaves, deepest)
}

fn check_hierarchy_and_measure_depth(pieces: &Pieces) -> usize {
    let hierarchy = build_hierarchy(pieces).unwrap();
    let (leaves, deepest) = leaf_pieces_and_depth(&hierarchy);
    assert!(leaves.into_iter().eq(0..pieces.len() as u32));
    assert_eq!(hierarchy.nodes().len(), 2 * pieces.len() - 1);
    deepest
}

#[test]
fn every_piece_appears_once_for_any_count() {
    for count in (1..40).chain([255, 256, 257, 512, 513, 1500]) {
        check_hierarchy_and_measure_depth(&triangle_pieces(count, |k| corner(k.sin())));
    }
}

#[test]
fn degenerate_pieces_make_no_long_chains() {
    const PIECE_COUNT: u32 = 5000;
    let far = DVec3::splat(9.9e11);
    let shapes: [&dyn Fn(f64) -> [DVec3; 3]; 8] = [
        &|_| corner(1.0),
        &|_| [far; 3],
        &|k| [-k, k, 2.0 * k].map(DVec3::splat),
        &|k| corner(k).map(|p| p + far),
        &|k| corner(1e-310 * k),
        &|k| corner(1.0).map(|p| p + k * k * DVec3::Z),
        &|k| corner(1.0).map(|p| (0.0079 * k).exp2() * p),
        &|k| [DVec3::ZERO, DVec3::splat(1e12), dvec3(k, 0.0, -1e12)],
    ];
    for (k, shape) in shapes.iter().enumerate() {
        let deepest = check_hierarchy_and_measure_depth(&triangle_pieces(PIECE_COUNT, shape));
        assert!(deepest < 400, "shape {k} is {deepest} deep");
    }
}

#[test]
fn rounded_pieces_count_with_their_radius() {
    let balls: Vec<Polytope> = (0..600)
        .map(|k| Polytope {
            points: vec![DVec3::ZERO],
            radius: if k % 7 == 0 { 1e12 } else { f64::from(k) },
            ..Polytope::default()
        })
        .collect();
    check_hierarchy_and_measure_depth(&Pieces::from_polytopes(&balls).unwrap());
}

#[test]
fn any_number_of_threads_gives_the_same_hierarchy() {
    // More pieces than one task takes, at pseudorandom places.
    let place = |k: f64| {
        dvec3(
            (1.3 * k).sin(),
            (1.7 * k).cos(),
            (0.3 * k).sin() * (1.1 * k).cos(),
        )
    };
    let pieces = triangle_pieces(20_000, |k| corner(0.01).map(|p| p + place(k)));
    let built = [1, 2, 7].map(|threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        pool.unwrap().install(|| build_hierarchy(&pieces).unwrap())
    });
    assert_eq!(built[0].nodes(), built[1].nodes());
    assert_eq!(built[0].nodes(), built[2].nodes());
}

#[test]
fn neighbours_are_siblings() {
    // Pairs of triangles at one place each, listed in two rounds: a leaf's sibling is its twin.
    let pieces = triangle_pieces(400, |k| corner(0.1).map(|p| p + (k % 200.0) * DVec3::X));
    let hierarchy = build_hierarchy(&pieces).unwrap();
    let twins = hierarchy.nodes().iter().filter(|node| {
        let HierarchyNode::Inner(left, right) = **node else {
            return false;
        };
        match [left, right].map(|child| hierarchy.nodes()[child as usize]) {
            [HierarchyNode::Leaf(a), HierarchyNode::Leaf(b)] => a % 200 == b % 200,
            _ => false,
        }
    });
    assert!(twins.count() >= 198);
}

proptest! {
    #[test]
    fn random_pieces_give_the_same_hierarchy_twice(
        corners in prop::collection::vec(prop::array::uniform3(prop::array::uniform3(-1e12..1e12)), 1..700),
    ) {
        let pieces = triangle_pieces(corners.len() as u32, |k| corners[k as usize].map(DVec3::from));
        check_hierarchy_and_measure_depth(&pieces);
        let twice = [(); 2].map(|()| build_hierarchy(&pieces).unwrap());
        prop_assert_eq!(twice[0].nodes(), twice[1].nodes());
    }
}
