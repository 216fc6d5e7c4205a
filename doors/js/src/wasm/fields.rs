//! Names of numbers that JavaScript reads and writes in the memory of the engine.

/// Returns the names of the fields of a struct of numbers, each with its index among all numbers.
macro_rules! field_indices {
    ($numbers:ty: $($field:ident),+) => {
        [$((stringify!($field), std::mem::offset_of!($numbers, $field) / size_of::<f64>())),+]
    };
}
pub(super) use field_indices;
