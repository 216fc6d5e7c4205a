//! Why a certificate is not written.

/// The reason why no certificate is written.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum NotProven {
    /// Two triangles are too near each other to be proven apart.
    #[error("two triangles cannot be proven apart, at time {at} or soon after")]
    Touching {
        /// The start of the stretch of time that is not proven.
        at: f64,
    },
    /// The certificate would be too long.
    #[error("the certificate has {bytes} bytes, and is not complete from time {at} on")]
    TooLong {
        /// The start of the stretch of time that is not proven.
        at: f64,
        /// The number of its bytes.
        bytes: usize,
    },
}
