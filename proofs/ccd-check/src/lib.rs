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

/// Why a certificate proves nothing. A check that returns none of these has proven the statement in the certificate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stop {
    /// A file is broken: what is wrong, and how many bytes were read before.
    Broken(&'static str, usize),
    /// Numbers are beyond the range in which the checker computes; nothing is said.
    Unverifiable(&'static str),
}

impl core::fmt::Display for Stop {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Stop::Broken(reason, at) => write!(f, "broken: {reason} (before byte {at})"),
            Stop::Unverifiable(reason) => write!(f, "unverifiable: {reason}"),
        }
    }
}

impl core::error::Error for Stop {}

/// What is read, or why the check stops.
type Checked<T> = Result<T, Stop>;

/// Requires that numbers are in the range of the checker.
fn verifiable(condition: bool, reason: &'static str) -> Checked<()> {
    condition.then_some(()).ok_or(Stop::Unverifiable(reason))
}
