//! Detects compilers whose LLVM miscompiles AVX-512, and sets the cfg `faulty_avx512` for them.

use std::process::Command;

/// The first major version of LLVM that compiles AVX-512 correctly.
const MENDED: u32 = 23;

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rustc-check-cfg=cfg(faulty_avx512)");
    // An unknown version counts as faulty.
    if llvm().is_none_or(|major| major < MENDED) {
        println!("cargo::rustc-cfg=faulty_avx512");
    }
}

/// Returns the major version of the LLVM in rustc; `None` if it is unknown.
fn llvm() -> Option<u32> {
    let rustc = std::env::var_os("RUSTC")?;
    let told = Command::new(rustc).arg("-vV").output().ok()?;
    let told = String::from_utf8(told.stdout).ok()?;
    let version = told
        .lines()
        .find_map(|line| line.strip_prefix("LLVM version: "))?;
    version.split('.').next()?.trim().parse().ok()
}
