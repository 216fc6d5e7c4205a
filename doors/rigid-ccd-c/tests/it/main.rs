//! Tests of the interface. They are written in Rust, and call the functions as C does.

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
