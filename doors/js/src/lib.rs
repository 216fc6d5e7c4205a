//! What the npm package `rigid-ccd` has in WebAssembly, and what builds the package.
//!
//! Built for WebAssembly, this crate is `wasm`: the classes that the modules in `doors/js/module` wrap. Built for any other target, it is
//! `package`: it builds itself for WebAssembly, and writes the package.

#[cfg(not(target_family = "wasm"))]
pub mod package;
#[cfg(target_family = "wasm")]
pub mod wasm;
