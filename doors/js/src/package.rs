//! Builds the WebAssembly, and writes the package.

use anyhow::{Context, Result, anyhow, ensure};
use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use flate2::Compression;
use flate2::write::GzEncoder;
use std::env;
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::thread;
use wasm_bindgen_cli_support::Bindgen;

const WASM_TARGET: &str = "wasm32-unknown-unknown";

/// The parts of the module. Each comes after the parts that it imports.
const PARTS: [&str; 14] = [
    include_str!("../module/words.js"),
    include_str!("../module/numbers.js"),
    include_str!("../module/places.js"),
    include_str!("../module/inflate.js"),
    include_str!("../module/wasm.js"),
    include_str!("../module/owned.js"),
    include_str!("../module/layout.js"),
    include_str!("../module/answer.js"),
    include_str!("../module/body.js"),
    include_str!("../module/movement.js"),
    include_str!("../module/solver.js"),
    include_str!("../module/robot.js"),
    include_str!("../module/cell.js"),
    include_str!("../module/index.js"),
];

/// The name of the module without vector instructions. The main module loads it if necessary.
const FALLBACK: &str = "fallback.js";

/// The names and contents of the package's files, except for both modules.
const FILES: [(&str, &str); 5] = [
    ("package.json", include_str!("../package.json")),
    ("rigid-ccd.d.ts", include_str!("../types/rigid-ccd.d.ts")),
    ("README.md", include_str!("../README.md")),
    ("LICENSE-APACHE", include_str!("../../../LICENSE-APACHE")),
    ("LICENSE-MIT", include_str!("../../../LICENSE-MIT")),
];

/// The modules of a package.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Modules {
    /// Both modules, as published.
    All,
    /// Only the module with vector instructions. For tests: it halves the time of a build.
    WithVectors,
}

/// Writes the package to a folder, for `npm pack`.
///
/// # Errors
/// A build that fails, or a file that cannot be written.
pub fn write(folder: &Path, modules: Modules) -> Result<()> {
    // Runs both builds in parallel: most of a build is the optimisation of one unit, on one core.
    let (module, fallback) = thread::scope(|scope| {
        let fallback = (modules == Modules::All).then(|| scope.spawn(fallback));
        (module(), fallback.map(thread::ScopedJoinHandle::join))
    });
    let fallback = fallback
        .transpose()
        .map_err(|_| anyhow!("the build of the fallback has panicked"))?
        .transpose()?;
    let module = module?;
    let main = ("rigid-ccd.js", module.as_str());
    let fallback = fallback.as_deref().map(|text| (FALLBACK, text));
    fs::create_dir_all(folder).with_context(|| format!("cannot make {}", folder.display()))?;
    if fallback.is_none() && folder.join(FALLBACK).exists() {
        fs::remove_file(folder.join(FALLBACK)).context("cannot remove the fallback")?;
    }
    for (name, text) in [main].into_iter().chain(fallback).chain(FILES) {
        let path = folder.join(name);
        ccd_file::write(&path, |file| file.write_all(text.as_bytes()))
            .with_context(|| format!("cannot write {}", path.display()))?;
    }
    Ok(())
}

/// Returns the text of the module. It needs no other file in engines with vector instructions.
///
/// # Errors
/// A build that fails.
pub fn module() -> Result<String> {
    let parts = PARTS.map(without_links);
    // All browsers with WebAssembly have supported 128-bit vectors since 2023.
    let engine = engine(Path::new(""), "-Ctarget-feature=+simd128")?;
    Ok([engine, parts.concat()].concat())
}

/// Returns the text of the module that the main module loads in engines without vector instructions.
fn fallback() -> Result<String> {
    let exports = "export { CODE as code, wasm_bindgen as bindgen };\n".to_owned();
    // Builds in a folder of its own, because two builds in one folder wait for each other.
    Ok([engine(Path::new("without-vectors"), "")?, exports].concat())
}

/// Returns JavaScript code that defines two constants. `wasm_bindgen` is a function that makes a loader of the
/// WebAssembly. `CODE` is the compressed WebAssembly.
///
/// `wasm_bindgen` takes a replacement of the global `WebAssembly`, and the object that `wasm/host.rs` calls. Each call
/// makes classes of its own, because the classes of an ended engine free objects in its memory.
fn engine(subfolder: &Path, flags: &str) -> Result<String> {
    let mut bindgen = Bindgen::new();
    bindgen
        .input_path(build_wasm(subfolder, flags)?)
        .no_modules(true)?
        .typescript(false)
        .remove_name_section(true)
        .remove_producers_section(true);
    let mut module = bindgen.generate_output()?;
    let mut encoder = GzEncoder::new(Vec::new(), Compression::best());
    encoder.write_all(&module.wasm_mut().emit_wasm())?;
    let code = BASE64_STANDARD.encode(encoder.finish()?);
    let (once, each) = (
        "let wasm_bindgen = (function(exports) {",
        "const wasm_bindgen = (WebAssembly, host) => (function(exports) {",
    );
    let loader = module.js();
    ensure!(
        loader.matches(once).count() == 1,
        "this version of wasm-bindgen begins otherwise than with {once:?}"
    );
    let loader = loader.replace(once, each);
    Ok(format!("{loader}const CODE = \"{code}\";\n"))
}

/// Returns a part as it is joined with the other parts in one file: without imports, and without exports except for the
/// list of the last part.
fn without_links(part: &str) -> String {
    let lines = part.lines().filter(|line| !line.starts_with("import "));
    let local = |line: &str| line.strip_prefix("export ").map(str::to_owned);
    let is_list = |line: &str| line.starts_with("export {");
    let lines = lines.map(|line| {
        local(line)
            .filter(|_| !is_list(line))
            .unwrap_or(line.into())
    });
    lines.map(|line| line + "\n").collect()
}

/// Compiles this crate to WebAssembly, in a subfolder of the target folder and with compiler flags. Returns the path of
/// the file.
fn build_wasm(subfolder: &Path, flags: &str) -> Result<PathBuf> {
    // The running command is at TARGET_DIR/PROFILE/NAME.
    let command = env::current_exe()?;
    let folder = command
        .ancestors()
        .nth(2)
        .context("this command has no target folder")?
        .join(subfolder);
    let cargo = env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let built = Command::new(cargo)
        .args("build --locked --profile wasm --lib --package rigid-ccd-js --target".split(' '))
        .args([WASM_TARGET, "--target-dir"])
        .arg(&folder)
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .env("CARGO_ENCODED_RUSTFLAGS", flags)
        .status()
        .context("cannot start cargo")?;
    ensure!(
        built.success(),
        "cargo cannot build for {WASM_TARGET}; run `rustup target add {WASM_TARGET}`"
    );
    Ok(folder.join(WASM_TARGET).join("wasm/rigid_ccd_js.wasm"))
}
