//! The WebAssembly part of the npm package `rigid-ccd`, and the program that builds the package.
//!
//! Built for WebAssembly, this crate is `wasm`: classes that the modules in `doors/js/module` wrap. Built for any other
//! target, it is `package`, which compiles this crate to WebAssembly and writes the package.

#[cfg(not(target_family = "wasm"))]
pub mod package;
#[cfg(target_family = "wasm")]
pub mod wasm;
