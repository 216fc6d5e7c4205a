//! Tests that a stored hull tree is read back unchanged, and that invalid stored trees are refused.

use super::*;
use crate::body::hierarchy::Hierarchy;
use glam::DVec3;
use serde::{Serialize, de::DeserializeOwned};

fn read<T: DeserializeOwned>(bytes: &[u8]) -> Option<T> {
    postcard::from_bytes(bytes).ok()
}

fn to_bytes<T: Serialize>(value: &T) -> Vec<u8> {
    postcard::to_allocvec(value).unwrap()
}

fn pieces_with_hull_tree() -> (Pieces, HullTree) {
    let pieces = [box_between(0.0, 1.0, 0), box_between(1.0, 3.0, 6)];
    let tree = tree(&pieces, box_hull(0.0, 3.0)).unwrap();
    (Pieces::from_polytopes(&pieces).unwrap(), tree)
}

#[test]
fn stored_trees_are_read_again() {
    let (pieces, tree) = pieces_with_hull_tree();
    let again: Pieces = read(&to_bytes(&pieces)).unwrap();
    assert!((0..2).all(|k| again.polytope(k) == pieces.polytope(k)));
    let again: HullTree = read(&to_bytes(&tree)).unwrap();
    assert_eq!(again.to_nodes(), tree.to_nodes());
    assert_eq!(again.facet_classes(0), tree.facet_classes(0));
    let again: Hierarchy = read(&to_bytes(tree.hierarchy())).unwrap();
    assert_eq!(again.nodes(), tree.hierarchy().nodes());
    assert_eq!(read(&to_bytes(&Solidity::Solid)), Some(Solidity::Solid));
    let triangles = [DVec3::X, DVec3::Y, DVec3::Z, DVec3::ONE];
    let soup = Pieces::from_triangles(&triangles, &[[0, 1, 2], [3, 2, 1]], &[7, 4]).unwrap();
    let again: Pieces = read(&to_bytes(&soup)).unwrap();
    assert!(again.are_all_triangles());
    assert!((0..2).all(|k| again.polytope(k) == soup.polytope(k)));
}

#[test]
fn trees_are_checked_when_read() {
    let point = |x: f64| Polytope {
        points: vec![DVec3::splat(x)],
        ..Polytope::default()
    };
    let variant = 1u32;
    let pieces = |x: f64| read::<Pieces>(&to_bytes(&(variant, vec![point(x)])));
    assert!(pieces(1.0).is_some());
    assert!(pieces(f64::NAN).is_none());
    assert!(read::<Pieces>(&to_bytes(&(variant, Vec::<Polytope>::new()))).is_none());
    // Triangles need as many numbers as corners and faces.
    let soup = |corners: usize, vertices: usize, faces: usize| {
        let raw = (
            0u32,
            vec![DVec3::X; corners],
            vec![0u32; vertices],
            vec![0u32; faces],
        );
        read::<Pieces>(&to_bytes(&raw))
    };
    assert!(soup(6, 6, 2).is_some());
    assert!(soup(6, 5, 2).is_none() && soup(5, 5, 2).is_none() && soup(6, 6, 3).is_none());
    assert!(soup(0, 0, 0).is_none());
    let nodes = vec![HierarchyNode::Inner(1, 1), HierarchyNode::Leaf(0)];
    assert!(read::<Hierarchy>(&to_bytes(&nodes)).is_none());
    let (_, tree) = pieces_with_hull_tree();
    let mut nodes = tree.to_nodes();
    let polytopes = vec![box_between(0.0, 1.0, 0), box_between(1.0, 3.0, 6)];
    assert!(read::<HullTree>(&to_bytes(&(&polytopes, &nodes))).is_some());
    nodes[0] = HullNode::Inner([1, 2], box_hull(0.0, 1.0));
    assert!(read::<HullTree>(&to_bytes(&(&polytopes, &nodes))).is_none());
}

/// Tests that reading a stored tree with a damaged or missing byte never panics: it fails or gives a valid tree.
#[test]
fn no_bytes_make_it_panic() {
    let (_, tree) = pieces_with_hull_tree();
    let good = to_bytes(&tree);
    for at in 0..good.len() {
        for flip in [0x01, 0x40, 0xff] {
            let mut bad = good.clone();
            bad[at] ^= flip;
            if let Some(tree) = read::<HullTree>(&bad) {
                assert_eq!(tree.hierarchy().nodes().len(), tree.hulls().len());
            }
        }
        assert!(read::<HullTree>(&good[..at]).is_none());
    }
}
