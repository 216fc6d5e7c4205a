//! Builds binary trees over the triangles of a mesh.

use super::triangles_apart::Triangle;

/// What a traversal of two trees examines in place of a pair of nodes.
pub(super) enum OpenedPair {
    /// The children of A's node, each with B's node.
    ChildrenOfA([u32; 2]),
    /// The children of B's node, each with A's node.
    ChildrenOfB([u32; 2]),
    /// The triangles of two leaves.
    Triangles([u32; 2]),
}

/// Opens the larger of two nodes, given by their contents and sizes, or the only one that is no leaf.
#[inline]
pub(super) fn open_pair([a, b]: [NodeContent; 2], [size_a, size_b]: [f64; 2]) -> OpenedPair {
    match (a, b) {
        (NodeContent::Triangle(a), NodeContent::Triangle(b)) => OpenedPair::Triangles([a, b]),
        (NodeContent::Children(below), NodeContent::Children(_)) if size_a > size_b => {
            OpenedPair::ChildrenOfA(below)
        }
        (_, NodeContent::Children(below)) => OpenedPair::ChildrenOfB(below),
        (NodeContent::Children(below), NodeContent::Triangle(_)) => OpenedPair::ChildrenOfA(below),
    }
}

/// The children of a node, or the triangle of a leaf.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum NodeContent {
    /// The node has two children, given by their indices.
    Children([u32; 2]),
    /// The node is a leaf, and contains the triangle with this index.
    Triangle(u32),
}

/// Builds a tree from the root down, with one leaf per triangle, and sorts the triangles into the order of the leaves.
///
/// `fit` makes the node of some triangles below a parent, and `split` partitions those of a node: it returns the number
/// of triangles in the first part. The root comes first. Without triangles there are no nodes.
pub(super) fn build_binary_tree<N>(
    triangles: &mut [Triangle],
    fit: impl Fn(&[Triangle], Option<&N>) -> N,
    split: impl Fn(&mut [Triangle], &N) -> usize,
) -> Vec<(N, NodeContent)> {
    let mut nodes = Vec::with_capacity(2 * triangles.len());
    if triangles.is_empty() {
        return nodes;
    }
    let leaf = |node: N| (node, NodeContent::Triangle(0));
    nodes.push(leaf(fit(triangles, None)));
    let mut open = vec![(0, 0..triangles.len())];
    while let Some((index, range)) = open.pop() {
        if range.len() == 1 {
            nodes[index].1 = NodeContent::Triangle(range.start as u32);
            continue;
        }
        let parent = &nodes[index].0;
        let middle = range.start + split(&mut triangles[range.clone()], parent);
        let parts = [range.start..middle, middle..range.end];
        let children = parts
            .clone()
            .map(|part| fit(&triangles[part], Some(parent)));
        let left = nodes.len();
        nodes[index].1 = NodeContent::Children([left as u32, left as u32 + 1]);
        nodes.extend(children.map(leaf));
        open.extend((left..).zip(parts));
    }
    nodes
}
