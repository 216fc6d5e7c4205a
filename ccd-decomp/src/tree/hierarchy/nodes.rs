//! The nodes of a binary tree under construction, in pairs of siblings.

use ccd_core::glam::{DVec3, Vec3A};

/// The axis-aligned box of a node while the hierarchy is built, in f32.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct AabbF32 {
    pub(super) lo: Vec3A,
    pub(super) hi: Vec3A,
}

impl AabbF32 {
    pub(super) const EMPTY: AabbF32 = AabbF32 {
        lo: Vec3A::MAX,
        hi: Vec3A::MIN,
    };

    pub(super) fn from_point(point: Vec3A) -> Self {
        AabbF32 {
            lo: point,
            hi: point,
        }
    }

    /// Returns the bounding box of two boxes.
    pub(super) fn union(self, other: Self) -> Self {
        AabbF32 {
            lo: self.lo.min(other.lo),
            hi: self.hi.max(other.hi),
        }
    }

    pub(super) fn centre(self) -> Vec3A {
        (self.hi + self.lo) * 0.5
    }

    pub(super) fn extent(self) -> Vec3A {
        self.hi - self.lo
    }

    /// Returns half of the surface area, the cost of a node: it is proportional to the probability of a visit.
    pub(super) fn half_area(self) -> f32 {
        let size = self.extent();
        (size.x + size.y) * size.z + size.x * size.y
    }

    /// Returns the position of the centre of the box `inner` in this box, from 0 to 1 along every axis.
    pub(super) fn relative_centre(self, inner: Self) -> DVec3 {
        let scale = self.extent().as_dvec3().recip();
        inner.centre().as_dvec3() * scale - self.lo.as_dvec3() * scale
    }
}

/// A node of the binary tree. The children of an inner node are adjacent, the first at an odd index.
#[derive(Clone, Copy, Debug)]
pub(super) struct Node {
    pub(super) cuboid: AabbF32,
    pub(super) content: NodeContent,
}

/// The content of a node: a piece or two children.
#[derive(Clone, Copy, Debug)]
pub(super) enum NodeContent {
    Piece(u32),
    /// An inner node, by the index of its first child. The second child follows it.
    Children(u32),
}

impl Node {
    pub(super) fn leaf(piece: u32, cuboid: AabbF32) -> Self {
        Node {
            cuboid,
            content: NodeContent::Piece(piece),
        }
    }
}

/// Returns the index of a node's sibling. The root, node 0, has none.
pub(super) fn sibling(node: u32) -> u32 {
    ((node - 1) ^ 1) + 1
}
