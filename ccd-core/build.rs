//! Finds out whether the compiler's LLVM is of those that miscompile AVX-512.

use std::process::Command;

/// The first LLVM that is free of it.
const MENDED: u32 = 23;

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rustc-check-cfg=cfg(faulty_avx512)");
    // An unknown version counts as faulty.
    if llvm().is_none_or(|major| major < MENDED) {
        println!("cargo::rustc-cfg=faulty_avx512");
    }
}

/// The major version of the LLVM behind rustc.
fn llvm() -> Option<u32> {
    let rustc = std::env::var_os("RUSTC")?;
    let told = Command::new(rustc).arg("-vV").output().ok()?;
    let told = String::from_utf8(told.stdout).ok()?;
    let version = told
        .lines()
        .find_map(|line| line.strip_prefix("LLVM version: "))?;
    version.split('.').next()?.trim().parse().ok()
}
