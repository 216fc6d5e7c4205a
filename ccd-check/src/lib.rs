#![doc = include_str!("../README.md")]
#![no_std]
#![forbid(unsafe_code, clippy::float_arithmetic)]

extern crate alloc;

mod body;
mod cover;
mod leaf;
mod motion;
mod number;
mod reader;
mod sha256;
mod statement;
mod way;

pub use body::Body;
pub use cover::check;
pub use sha256::sha256;

/// Why a certificate proves nothing. A check that returns none of these has proven the statement in the certificate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stop {
    /// A file is broken.
    Broken {
        /// What is wrong.
        reason: &'static str,
        /// The number of bytes that were read before.
        at: usize,
    },
    /// Numbers are beyond the range in which the checker computes; nothing is said.
    Unverifiable(&'static str),
}

impl core::fmt::Display for Stop {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Stop::Broken { reason, at } => write!(f, "broken: {reason} (before byte {at})"),
            Stop::Unverifiable(reason) => write!(f, "unverifiable: {reason}"),
        }
    }
}

impl core::error::Error for Stop {}

/// Requires that numbers are in the range of the checker.
fn verifiable(condition: bool, reason: &'static str) -> Result<(), Stop> {
    condition.then_some(()).ok_or(Stop::Unverifiable(reason))
}
