//! Operators that act on each field of a struct by itself.

/// Implements an operator, such as `Add::add`, that acts on each field by itself. The type may have one parameter, the
/// level of vector instructions.
macro_rules! impl_componentwise {
    ($operator:ident::$function:ident for $name:ident $(<$level:ident>)? { $($field:tt),+ }) => {
        impl $(<$level: fearless_simd::Simd>)? std::ops::$operator for $name $(<$level>)? {
            type Output = Self;
            #[inline(always)]
            fn $function(self, other: Self) -> Self {
                $name { $($field: std::ops::$operator::$function(self.$field, other.$field)),+ }
            }
        }
    };
}

pub(crate) use impl_componentwise;
