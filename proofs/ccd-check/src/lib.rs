#![doc = include_str!("../README.md")]
#![no_std]
#![forbid(unsafe_code, clippy::float_arithmetic)]

extern crate alloc;

mod body;
mod check;
mod leaf;
mod motion;
mod number;
mod reader;
mod sha256;

pub use body::Body;
pub use check::check;
pub use sha256::sha256;

/// The reason why a check stops without a proof.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stop {
    /// The file is broken, or does not prove its statement. Contains the reason, and the number of bytes read so far.
    Broken(&'static str, usize),
    /// A number or the work exceeds a limit of the checker. The statement may be true or false.
    Unverifiable(&'static str),
}

impl core::fmt::Display for Stop {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Stop::Broken(reason, position) => write!(f, "broken: {reason} (before byte {position})"),
            Stop::Unverifiable(reason) => write!(f, "unverifiable: {reason}"),
        }
    }
}

impl core::error::Error for Stop {}

/// A result with the reason why the check stops.
type Checked<T> = Result<T, Stop>;

/// Stops the check as unverifiable if the condition is false.
fn verifiable(condition: bool, reason: &'static str) -> Checked<()> {
    condition.then_some(()).ok_or(Stop::Unverifiable(reason))
}
