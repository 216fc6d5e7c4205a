//! Names of the numbers that JavaScript reads and writes in the memory of the engine.

/// Returns the name of each field of a struct of numbers, with the index of its first number.
macro_rules! field_indices {
    ($numbers:ty: $($field:ident),+) => {
        [$((stringify!($field), std::mem::offset_of!($numbers, $field) / size_of::<f64>())),+]
    };
}
pub(super) use field_indices;
