//! Names of the numbers that JavaScript reads and writes in the memory of the engine.

/// Defines a struct of numbers, and `FIELDS`: the name of each field, with the index of its first number.
macro_rules! named_numbers {
    (
        $(#[$about:meta])*
        $visible:vis struct $name:ident { $($(#[$about_field:meta])* $field:ident: $kind:ty),+ $(,)? }
    ) => {
        $(#[$about])*
        #[derive(Clone, Copy, Debug, Default)]
        #[repr(C)]
        $visible struct $name { $($(#[$about_field])* $field: $kind),+ }

        impl $name {
            pub(super) const FIELDS: &[(&str, usize)] =
                &[$((stringify!($field), std::mem::offset_of!($name, $field) / size_of::<f64>())),+];
        }
    };
}
pub(super) use named_numbers;
