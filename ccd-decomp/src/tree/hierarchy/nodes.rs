//! A binary tree under construction: nodes in pairs of siblings, and their boxes.

use ccd_core::glam::{DVec3, Vec3A};

/// A box along the coordinate axes, in single precision.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Cuboid {
    pub(super) lo: Vec3A,
    pub(super) hi: Vec3A,
}

impl Cuboid {
    pub(super) const EMPTY: Cuboid = Cuboid {
        lo: Vec3A::MAX,
        hi: Vec3A::MIN,
    };

    pub(super) fn of_point(point: Vec3A) -> Self {
        Cuboid {
            lo: point,
            hi: point,
        }
    }

    /// The smallest box that holds two boxes.
    pub(super) fn union(self, other: Self) -> Self {
        Cuboid {
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

    pub(super) fn longest_axis(self) -> usize {
        let size = self.extent();
        match (size.x < size.y, size.x < size.z, size.y < size.z) {
            (true, _, false) => 1,
            (true, _, true) | (false, true, _) => 2,
            (false, false, _) => 0,
        }
    }

    /// Half of the surface area, the price of a node: the chance that a search among many meets it.
    pub(super) fn half_area(self) -> f32 {
        let size = self.extent();
        (size.x + size.y) * size.z + size.x * size.y
    }

    /// The place of a box's centre within this one, from 0 to 1 along every axis.
    pub(super) fn place(self, inner: Self) -> DVec3 {
        let scale = self.extent().as_dvec3().recip();
        inner.centre().as_dvec3() * scale - self.lo.as_dvec3() * scale
    }
}

/// A node of the tree. The children of an inner node stand side by side: the first at an odd index.
#[derive(Clone, Copy, Debug)]
pub(super) struct Node {
    pub(super) cuboid: Cuboid,
    pub(super) below: Below,
}

/// What stands below a node.
#[derive(Clone, Copy, Debug)]
pub(super) enum Below {
    Piece(u32),
    /// Two nodes, the first at this index.
    Children(u32),
}

impl Below {
    /// The index of the piece, or of the first child.
    pub(super) fn index(self) -> u32 {
        match self {
            Below::Piece(index) | Below::Children(index) => index,
        }
    }
}

impl Node {
    pub(super) fn leaf(piece: u32, cuboid: Cuboid) -> Self {
        Node {
            cuboid,
            below: Below::Piece(piece),
        }
    }
}

/// The other child of a node's parent. The root, node 0, has none.
pub(super) fn sibling(node: u32) -> u32 {
    ((node - 1) ^ 1) + 1
}
