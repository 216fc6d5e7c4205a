//! Sets `faulty_avx512` for compilers whose LLVM miscompiles AVX-512, and `inline_kernels` unless the target is
//! WebAssembly without vector instructions.

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
    println!("cargo::rustc-check-cfg=cfg(inline_kernels)");
    if !target_has("FAMILY", "wasm") || target_has("FEATURE", "simd128") {
        println!("cargo::rustc-cfg=inline_kernels");
    }
}

/// Returns whether a list that cargo gives of the target, its families or features, has an entry.
fn target_has(list: &str, entry: &str) -> bool {
    let entries = std::env::var(format!("CARGO_CFG_TARGET_{list}")).unwrap_or_default();
    entries.split(',').any(|each| each == entry)
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
