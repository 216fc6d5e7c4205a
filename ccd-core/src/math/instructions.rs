//! Chooses at run time the vector instructions for which kernels are compiled.

use crate::settings::Instructions;
use fearless_simd::Level;

impl Instructions {
    /// Converts the choice to the form that [`vectorize!`](crate::vectorize) takes.
    #[doc(hidden)]
    pub fn level(self) -> Level {
        match self {
            Instructions::Best => Level::new(),
            Instructions::Baseline => Level::baseline(),
        }
    }
}

/// Evaluates an expression with the best useful vector instructions: AVX2 or SSE2 on x86, the only ones elsewhere. All
/// functions called by the expression, closures included, have to be `#[inline(always)]`: others are compiled for the
/// oldest machine.
///
/// AVX-512 is left out: eight lanes of f32 gain nothing by it, and rustc 1.95 miscompiles it. Every further level is
/// another copy of the code.
///
/// This is for the distance backends of this project, and no stable interface.
#[doc(hidden)]
#[macro_export]
macro_rules! vectorize {
    (@with $token:expr, $name:ident => $value:expr) => {{
        use $crate::fearless_simd::Simd as _;
        let $name = $token;
        $name.vectorize(
            #[inline(always)]
            || $value,
        )
    }};
    ($level:expr, $token:ident => $value:expr) => {{
        #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
        {
            match $level.as_avx2() {
                Some(avx2) => $crate::vectorize!(@with avx2, $token => $value),
                None => {
                    let sse2 = $level.as_sse2().expect("an x86 target with SSE2");
                    $crate::vectorize!(@with sse2, $token => $value)
                }
            }
        }
        #[cfg(target_arch = "aarch64")]
        {
            let neon = $level.as_neon().expect("64-bit ARM with NEON");
            $crate::vectorize!(@with neon, $token => $value)
        }
        #[cfg(not(any(target_arch = "x86", target_arch = "x86_64", target_arch = "aarch64")))]
        {
            $crate::fearless_simd::dispatch!($level, $token => $value)
        }
    }};
}

#[cfg(all(
    any(target_arch = "x86", target_arch = "x86_64"),
    not(target_feature = "sse2")
))]
compile_error!(
    "ccd-core needs SSE2 on x86; build for a target that has it, such as i686 instead of i586"
);
