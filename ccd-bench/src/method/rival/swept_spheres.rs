//! A tree of spheres swept over rectangles, above the triangles of a mesh.

use super::principal_axes::mean_and_principal_axes;
use super::tree::{NodeContent, OpenedPair, open_pair};
use super::triangles_apart::{NearestPoints, Triangle, nearest_points};
use super::{Placement, rectangles};
use ccd_core::glam::{DVec2, DVec3};
use ccd_core::order::greater;
use ccd_decomp::TriangleMesh;

mod fit;
#[cfg(test)]
mod tests;

/// A tree of rectangles swept by spheres over the triangles of a mesh, one triangle per leaf \[PQP99 §3\].
///
/// A node splits at the mean of its triangles' centers along its longest axis. The authors leave
/// the case of a lopsided split open. Here it becomes a split into halves, so that no tree is deep.
#[derive(Clone, Debug)]
pub(super) struct RssTree {
    /// The nodes of the tree: the root first, two children side by side.
    nodes: Vec<Node>,
    /// The frames of the nodes' rectangles, relative to the body's frame.
    node_frames: Vec<Placement>,
    triangles: Vec<Triangle>,
}

/// A rectangle swept by a sphere: all points within a radius of the rectangle.
#[derive(Clone, Copy, Debug)]
struct Node {
    /// The rectangle's frame, relative to that of its parent.
    frame_in_parent: Placement,
    /// The side lengths of the rectangle along its x and y axes.
    side_lengths: DVec2,
    radius: f64,
    content: NodeContent,
}

/// The trees of two bodies, which are descended together.
#[derive(Clone, Debug)]
pub(super) struct RssTreePair {
    pub(super) a: RssTree,
    pub(super) b: RssTree,
}

/// A node of A's tree and a node of B's tree.
#[derive(Clone, Copy, Debug)]
pub(super) struct RssNodePair {
    pub(super) a: u32,
    pub(super) b: u32,
    /// The frame of B's rectangle in the frame of A's rectangle.
    placement: Placement,
}

/// The pairs below a pair of nodes.
pub(super) enum PairChildren {
    /// The children of one node, each paired with the other node.
    Pairs([RssNodePair; 2]),
    /// The triangles of two leaves, which have no children.
    Triangles(TriangleIndexPair),
}

/// The indices of a triangle of each tree.
pub(super) type TriangleIndexPair = [u32; 2];

/// A lower bound of the distance of two nodes, with the direction from A to B.
#[derive(Clone, Copy, Debug)]
pub(super) struct GapBound {
    /// The lower bound of the distance; zero if the nodes overlap.
    pub(super) distance_bound: f64,
    /// The unit vector from A towards B in the frame of body A; zero if their rectangles meet.
    pub(super) gap_direction: DVec3,
}

impl RssTree {
    pub(super) fn new(mesh: &TriangleMesh) -> Self {
        let corner = |&v: &u32| mesh.vertices()[v as usize];
        let triangle = |[a, b, c]: &[u32; 3]| [corner(a), corner(b), corner(c)];
        fit::build_tree(mesh.faces().iter().map(triangle).collect())
    }

    /// Returns an upper bound of the distance of a node's points from an axis that is fixed in the body.
    ///
    /// It is attained at the farthest corner of the rectangle, plus the radius \[C2A09 §4\].
    pub(super) fn axis_distance_bound(&self, node: u32, center: DVec3, axis: DVec3) -> f64 {
        let (node, frame) = (&self.nodes[node as usize], &self.node_frames[node as usize]);
        let corner = (frame.translation - center).cross(axis);
        let x = node.side_lengths.x * frame.rotation.x_axis.cross(axis);
        let y = node.side_lengths.y * frame.rotation.y_axis.cross(axis);
        let farthest = [corner, corner + x, corner + y, corner + x + y]
            .map(DVec3::length_squared)
            .into_iter()
            .fold(0.0, greater);
        farthest.sqrt() + node.radius
    }

    /// Returns the number of nodes in the tree, including leaves.
    pub(super) fn node_count(&self) -> usize {
        self.nodes.len()
    }

    /// Returns the corners of all triangles in the mesh.
    pub(super) fn all_triangle_corners(&self) -> impl Iterator<Item = DVec3> + '_ {
        self.triangles.iter().flatten().copied()
    }
}

impl Node {
    /// Returns an upper bound of the node's diameter.
    fn diameter_bound(&self) -> f64 {
        self.side_lengths.length() + 2.0 * self.radius
    }
}

impl RssTreePair {
    pub(super) fn new(a: &TriangleMesh, b: &TriangleMesh) -> Self {
        RssTreePair {
            a: RssTree::new(a),
            b: RssTree::new(b),
        }
    }

    /// Returns both roots, with body B placed in A's frame, or `None` if a mesh has no triangles.
    pub(super) fn root_pair(&self, placement: &Placement) -> Option<RssNodePair> {
        let (a, b) = (self.a.node_frames.first()?, self.b.node_frames.first()?);
        Some(RssNodePair {
            a: 0,
            b: 0,
            placement: compose(placement, b).relative_to(a),
        })
    }

    fn nodes(&self, pair: &RssNodePair) -> (&Node, &Node) {
        let (a, b) = (pair.a as usize, pair.b as usize);
        (&self.a.nodes[a], &self.b.nodes[b])
    }

    /// Returns a lower bound of the distance of two nodes.
    #[inline]
    pub(super) fn distance_bound(&self, pair: &RssNodePair) -> f64 {
        self.gap_bound(pair).distance_bound
    }

    /// Returns a lower bound of the distance of two nodes, and its direction.
    #[inline]
    pub(super) fn gap_bound(&self, pair: &RssNodePair) -> GapBound {
        let (a, b) = self.nodes(pair);
        let between = rectangles::shortest_vector(a.side_lengths, b.side_lengths, &pair.placement);
        let length = between.length();
        // NaN becomes zero.
        let distance = greater(0.0, length - (a.radius + b.radius));
        if !(distance > 0.0) {
            return GapBound {
                distance_bound: 0.0,
                gap_direction: DVec3::ZERO,
            };
        }
        GapBound {
            distance_bound: distance,
            gap_direction: self.a.node_frames[pair.a as usize].rotation * (between / length),
        }
    }

    /// Returns an upper bound of how much farther apart the triangles in two nodes can be than the nodes are.
    pub(super) fn distance_excess_bound(&self, pair: &RssNodePair) -> f64 {
        let (a, b) = self.nodes(pair);
        a.diameter_bound() + b.diameter_bound()
    }

    /// Returns the nearest points of two triangles in the frame of body A; `placement` is that of body B in this frame.
    #[inline]
    pub(super) fn nearest_triangle_points(
        &self,
        leaves: TriangleIndexPair,
        placement: &Placement,
    ) -> NearestPoints {
        let moved = self.b.triangles[leaves[1] as usize].map(|corner| placement.apply(corner));
        nearest_points(&self.a.triangles[leaves[0] as usize], &moved)
    }

    /// Returns the pairs that replace a pair of nodes: the larger node is opened \[PQP99 §5\], and two leaves give
    /// their triangles.
    #[inline]
    pub(super) fn children(&self, pair: &RssNodePair) -> PairChildren {
        let (a, b) = self.nodes(pair);
        let sizes = [a.diameter_bound(), b.diameter_bound()];
        match open_pair([a.content, b.content], sizes) {
            OpenedPair::Triangles(leaves) => PairChildren::Triangles(leaves),
            OpenedPair::ChildrenOfA(below) => PairChildren::Pairs(below.map(|a| {
                let child = &self.a.nodes[a as usize].frame_in_parent;
                let placement = pair.placement.relative_to(child);
                RssNodePair {
                    a,
                    placement,
                    ..*pair
                }
            })),
            OpenedPair::ChildrenOfB(below) => PairChildren::Pairs(below.map(|b| {
                let child = &self.b.nodes[b as usize].frame_in_parent;
                let placement = compose(&pair.placement, child);
                RssNodePair {
                    b,
                    placement,
                    ..*pair
                }
            })),
        }
    }
}

/// Returns the composition `outer ∘ inner` of two placements.
#[inline]
fn compose(outer: &Placement, inner: &Placement) -> Placement {
    Placement {
        rotation: outer.rotation * inner.rotation,
        translation: outer.apply(inner.translation),
    }
}
