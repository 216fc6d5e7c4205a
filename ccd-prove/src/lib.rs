#![doc = include_str!("../README.md")]

mod body;
mod cover;
mod error;
mod stretch;
mod write;

pub use body::Body;
pub use error::NotProven;
pub use write::{Claim, Proof, prove};
