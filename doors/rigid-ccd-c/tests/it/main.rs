//! Tests of the interface, from Rust, as C calls it.

#![allow(unsafe_code, reason = "the interface is called as C calls it")]

mod abi;
mod arguments;
mod calls;
mod cells;
mod equal_bits;
mod header;
mod memory;
mod paths;
mod programs;
mod support;
mod support_cells;
mod threads;
