//! What is accepted at most.

/// The most compounds within one another.
pub const DEEPEST: usize = 16;

/// The farthest voxel from the origin, in voxels: parry rounds their places.
pub const FARTHEST_VOXEL: i64 = 1 << 20;

/// The most memory that the bodies of the functions with parry's signatures take in a thread, in bytes.
pub const KEPT_BYTES: usize = 256 << 20;

/// The most bodies that the functions with parry's signatures keep in a thread.
pub const KEPT_BODIES: usize = 64;

/// The default limit of a cast's work: about a second.
pub const DEFAULT_BUDGET: u64 = 1 << 20;
