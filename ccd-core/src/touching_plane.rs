//! The plane between two bodies that are in contact at the start, for queries that ignore this contact.

use glam::DVec3;

/// The plane between two bodies that are in contact at the start.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TouchingPlane {
    /// The unit normal from A to B, in A's frame and in B's frame: the plane may move with either body.
    pub(crate) normals: [DVec3; 2],
    /// The least gap along the normal that pieces have to keep for their contact to be ignored: the distance at the
    /// start, minus rounding.
    pub(crate) required_gap: f64,
}
