//! A mesh's surface, under a tree of boxes along the axes of the body's frame.

use super::rounding::{ROUNDED_UP, larger};
use ccd_core::glam::DVec3;
use ccd_decomp::TriangleMesh;

/// The triangles of a mesh, prepared to be judged.
#[derive(Clone, Debug)]
pub struct Surface {
    /// The root is the first; children follow their parents.
    nodes: Vec<Node>,
    triangles: Vec<Triangle>,
}

/// Three corners, in the body's frame.
pub(super) type Triangle = [DVec3; 3];

/// A box about some triangles.
#[derive(Clone, Copy, Debug)]
pub(super) struct Node {
    pub(super) centre: DVec3,
    /// Half its extents: all triangles lie within, whatever was rounded.
    pub(super) half: DVec3,
    /// Half its diagonal.
    pub(super) size: f64,
    pub(super) content: Content,
}

/// What a box is about.
#[derive(Clone, Copy, Debug)]
pub(super) enum Content {
    /// Two nodes.
    Children([u32; 2]),
    /// One triangle.
    Triangle(u32),
}

impl Surface {
    /// Prepares the surface of a mesh.
    ///
    /// # Complexity
    /// O(n log n) for n triangles.
    pub fn new(mesh: &TriangleMesh) -> Self {
        let corner = |&index: &u32| mesh.vertices().get(index as usize).copied();
        let triangles = mesh.faces().iter().map(|face| {
            // A mesh's faces name vertices that there are.
            face.each_ref().map(|i| corner(i).unwrap_or_default())
        });
        let mut surface = Surface {
            nodes: Vec::with_capacity(2 * mesh.faces().len()),
            triangles: triangles.collect(),
        };
        let mut order: Vec<u32> = (0..).take(surface.triangles.len()).collect();
        if !order.is_empty() {
            surface.grow(&mut order);
        }
        surface
    }

    /// The root's index, unless there are no triangles at all.
    pub(super) fn root(&self) -> Option<u32> {
        (!self.nodes.is_empty()).then_some(0)
    }

    pub(super) fn node(&self, index: u32) -> &Node {
        &self.nodes[index as usize]
    }

    pub(super) fn triangle(&self, index: u32) -> &Triangle {
        &self.triangles[index as usize]
    }

    /// The corners of the box about the whole body; none of a body without triangles.
    pub(super) fn corners(&self) -> impl Iterator<Item = DVec3> {
        let root = self.nodes.first().map(|node| (node.centre, node.half));
        root.into_iter().flat_map(|(centre, half)| {
            (0..8).map(move |corner| {
                let side = |bit| if corner & bit == 0 { -1.0 } else { 1.0 };
                centre + half * DVec3::new(side(1), side(2), side(4))
            })
        })
    }

    /// How far the body reaches from its origin, at most.
    pub(super) fn farthest(&self) -> f64 {
        let far = self.corners().map(DVec3::length).fold(0.0, larger);
        far * ROUNDED_UP
    }

    /// Adds the node of some triangles, halved at the median along their longest extent, as deep as the
    /// logarithm of their number.
    fn grow(&mut self, order: &mut [u32]) -> u32 {
        let index = self.nodes.len();
        let node = self.about(order);
        self.nodes.push(node);
        if let [triangle] = order {
            self.nodes[index].content = Content::Triangle(*triangle);
        } else {
            let middle = order.len() / 2;
            let axis = node.half.max_position();
            let key = |&i: &u32| self.triangle(i).iter().map(|p| p[axis]).sum::<f64>();
            order.select_nth_unstable_by(middle, |i, j| key(i).total_cmp(&key(j)));
            let (left, right) = order.split_at_mut(middle);
            let children = [self.grow(left), self.grow(right)];
            self.nodes[index].content = Content::Children(children);
        }
        index as u32
    }

    fn about(&self, order: &[u32]) -> Node {
        let corners = order.iter().flat_map(|&i| self.triangle(i));
        let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        for &corner in corners {
            low = low.min(corner);
            high = high.max(corner);
        }
        let centre = low.midpoint(high);
        let half = (high - centre).max(centre - low) * ROUNDED_UP;
        Node {
            centre,
            half,
            size: half.length(),
            content: Content::Triangle(0),
        }
    }
}
