//! The limits on input and memory.

/// The maximum nesting depth of compounds.
pub const MAX_NESTING_DEPTH: usize = 16;

/// The maximum grid coordinate of a voxel, in voxels, because parry rounds the positions of voxels.
pub const MAX_VOXEL_COORDINATE: i64 = 1 << 20;

/// The maximum memory of cached bodies per thread, in bytes, for the functions with parry's signatures.
pub const MAX_CACHED_BYTES: usize = 256 << 20;

/// The maximum number of cached bodies per thread, for the functions with parry's signatures.
pub const MAX_CACHED_BODIES: usize = 64;

/// The default limit of a cast's work. It takes about a second, or some seconds if both bodies make many turns.
pub const DEFAULT_BUDGET: u64 = 1 << 20;
