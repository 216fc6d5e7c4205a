#![doc = include_str!("../README.md")]

mod body;
mod cover;
mod stretch;
mod write;

pub use body::Body;
pub use write::{Claim, NotProven, Proof, prove};
