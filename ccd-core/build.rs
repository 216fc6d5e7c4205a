//! Detects compilers whose LLVM miscompiles AVX-512, and sets the cfg `faulty_avx512` for them.

use std::process::Command;

/// The first major version of LLVM that compiles AVX-512 correctly.
const FIRST_CORRECT_LLVM_VERSION: u32 = 23;

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rustc-check-cfg=cfg(faulty_avx512)");
    // An unknown version counts as faulty.
    if llvm_major_version().is_none_or(|major| major < FIRST_CORRECT_LLVM_VERSION) {
        println!("cargo::rustc-cfg=faulty_avx512");
    }
}

/// Returns the major version of the LLVM in rustc; `None` if it is unknown.
fn llvm_major_version() -> Option<u32> {
    let rustc = std::env::var_os("RUSTC")?;
    let output = Command::new(rustc).arg("-vV").output().ok()?;
    let output = String::from_utf8(output.stdout).ok()?;
    let version = output
        .lines()
        .find_map(|line| line.strip_prefix("LLVM version: "))?;
    version.split('.').next()?.trim().parse().ok()
}
