//! Every numeric tolerance of the engine: its unit, why it is what it is, what breaks without it.

/// The tolerance of a query that names none, in the scene's unit of length `[FAST06 §6.2]`.
pub const DEFAULT_TOLERANCE: f64 = 1e-3;

/// How many pairs of nodes a query may visit that names no budget: about a second's work.
pub const DEFAULT_BUDGET: u64 = 1 << 23;

/// The largest coordinate a body may have, in the scene's unit of length: squares of distances stay
/// far from the overflow of `f32` (3.4e38).
pub const MAX_COORDINATE: f64 = 1e15;
