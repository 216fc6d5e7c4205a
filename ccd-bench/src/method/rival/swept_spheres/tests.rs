use super::{NodeContent, PairChildren, RssNodePair, RssTree, RssTreePair};
use crate::method::rival::Placement;
use crate::scene::model::Model;
use ccd_core::glam::{DMat3, DQuat, DVec3};
use ccd_core::order::{greater, lesser};
use ccd_decomp::TriangleMesh;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

fn knot() -> TriangleMesh {
    Model::Knot216.generate().unwrap()
}

fn random_placement(rng: &mut Pcg64) -> Placement {
    let mut vec = |size: f64| size * DVec3::from_array([0; 3].map(|_| rng.random_range(-1.0..1.0)));
    Placement {
        rotation: DMat3::from_quat(DQuat::from_scaled_axis(vec(3.0))),
        translation: vec(3.0),
    }
}

/// Returns the indices of all triangles in the leaves below a node.
fn triangle_indices_below(tree: &RssTree, node: u32) -> Vec<u32> {
    match tree.nodes[node as usize].content {
        NodeContent::Triangle(k) => vec![k],
        NodeContent::Children(below) => below
            .map(|node| triangle_indices_below(tree, node))
            .concat(),
    }
}

#[test]
fn nodes_hold_their_triangles_and_are_tight() {
    for mesh in [
        knot(),
        Model::Board.generate().unwrap(),
        Model::Bunny26k.generate().unwrap(),
    ] {
        let tree = RssTree::new(&mesh);
        let mut all = triangle_indices_below(&tree, 0);
        all.sort_unstable();
        assert_eq!(all, (0..mesh.faces().len() as u32).collect::<Vec<_>>());
        for (k, node) in tree.nodes.iter().enumerate().take(500) {
            let below = triangle_indices_below(&tree, k as u32);
            let inside = tree.node_frames[k];
            let mut farthest = 0.0_f64;
            for point in below.iter().flat_map(|&t| tree.triangles[t as usize]) {
                let local = inside.rotation.transpose() * (point - inside.translation);
                let nearest = local.clamp(DVec3::ZERO, node.side_lengths.extend(0.0));
                farthest = greater(farthest, local.distance(nearest));
            }
            assert!(
                farthest <= node.radius,
                "node {k}: {farthest} {}",
                node.radius
            );
            assert!(
                node.radius <= farthest + 1e-12,
                "node {k}: {farthest} {}",
                node.radius
            );
        }
    }
}

#[test]
fn no_split_is_lopsided() {
    // A strip of small triangles and one far away: the mean is beyond all except this one.
    let at = |k: u32| if k == 0 { 1e6 } else { 1e-3 * f64::from(k) };
    let corners = |k| [DVec3::ZERO, DVec3::X, DVec3::Y].map(|p| 1e-3 * p + at(k) * DVec3::X);
    let faces: Vec<_> = (0..400).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]).collect();
    let mesh = TriangleMesh::new((0..400).flat_map(corners).collect(), &faces).unwrap();
    let tree = RssTree::new(&mesh);
    for (k, node) in tree.nodes.iter().enumerate() {
        let NodeContent::Children([left, right]) = node.content else {
            continue;
        };
        let all = triangle_indices_below(&tree, k as u32).len();
        let few = triangle_indices_below(&tree, left).len();
        let few = few.min(triangle_indices_below(&tree, right).len());
        assert!(16 * few + 15 >= all, "{few} of {all}");
    }
}

#[test]
fn no_node_is_farther_than_its_triangles_or_nearer_than_its_size() {
    let trees = RssTreePair {
        a: RssTree::new(&knot()),
        b: RssTree::new(&knot()),
    };
    let mut rng = Pcg64::seed_from_u64(4);
    let (mut checked, mut apart) = (0, 0);
    for _ in 0..60 {
        let placement = random_placement(&mut rng);
        let mut pair: RssNodePair = trees.root_pair(&placement).unwrap();
        while let PairChildren::Pairs(pairs) = trees.children(&pair) {
            pair = pairs[rng.random_range(0..2)];
            let (a, b) = (
                triangle_indices_below(&trees.a, pair.a),
                triangle_indices_below(&trees.b, pair.b),
            );
            if a.len() * b.len() > 3_000 {
                continue;
            }
            let mut true_distance = f64::INFINITY;
            for &i in &a {
                for &j in &b {
                    let nearest = trees.nearest_triangle_points([i, j], &placement);
                    true_distance = lesser(true_distance, nearest.vector_from_a_to_b().length());
                }
            }
            let gap = trees.gap_bound(&pair);
            assert_eq!(gap.distance_bound, trees.distance_bound(&pair));
            assert!(gap.distance_bound <= true_distance + 1e-12);
            assert!(
                true_distance <= gap.distance_bound + trees.distance_excess_bound(&pair) + 1e-12
            );
            if gap.distance_bound > 0.0 {
                let along = |points: &[DVec3; 3]| points.map(|p| gap.gap_direction.dot(p));
                let high = a
                    .iter()
                    .flat_map(|&i| along(&trees.a.triangles[i as usize]));
                let low = b.iter().flat_map(|&j| {
                    along(&trees.b.triangles[j as usize].map(|corner| placement.apply(corner)))
                });
                let parted =
                    low.fold(f64::INFINITY, lesser) - high.fold(f64::NEG_INFINITY, greater);
                assert!(
                    parted >= gap.distance_bound - 1e-12,
                    "{parted} {}",
                    gap.distance_bound
                );
                apart += 1;
            }
            checked += 1;
        }
    }
    assert!(
        checked > 300 && apart > 200,
        "{checked} checked, {apart} apart"
    );
}

#[test]
fn levers_reach_all_points() {
    let tree = RssTree::new(&knot());
    let (center, axis) = (
        DVec3::new(0.3, -0.2, 0.5),
        DVec3::new(1.0, 2.0, 3.0).normalize(),
    );
    for node in 0..tree.node_count() as u32 {
        let farthest = triangle_indices_below(&tree, node)
            .iter()
            .flat_map(|&t| tree.triangles[t as usize])
            .map(|p| (p - center).cross(axis).length())
            .fold(0.0, greater);
        let lever = tree.axis_distance_bound(node, center, axis);
        let size = tree.nodes[node as usize].diameter_bound();
        assert!(
            farthest <= lever && lever <= farthest + size,
            "{farthest} {lever}"
        );
    }
}
