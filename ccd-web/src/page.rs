//! Writes the page: WebAssembly module, scripts and style in one file.

use crate::answers::random_throw_results;
use anyhow::{Context, Result, ensure};
use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use flate2::Compression;
use flate2::write::GzEncoder;
use std::env;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::Command;
use wasm_bindgen_cli_support::Bindgen;

const WASM_TARGET: &str = "wasm32-unknown-unknown";

/// Builds the WebAssembly module, and writes the page.
pub(crate) fn write(out: &Path, check: bool) -> Result<()> {
    let mut bindgen = Bindgen::new();
    bindgen.input_path(build_wasm_module()?).no_modules(true)?;
    bindgen
        .typescript(false)
        .remove_name_section(true)
        .remove_producers_section(true);
    let mut module = bindgen.generate_output()?;
    let code = BASE64_STANDARD.encode(gzip(&module.wasm_mut().emit_wasm())?);
    let checks = if check {
        format!(
            "<script type=\"application/json\" id=\"answers\">{}</script>\n<script>\n{}</script>",
            ccd_view::json(&random_throw_results()?)?,
            include_str!("page/check.js")
        )
    } else {
        String::new()
    };
    let scripts = [
        module.js(),
        include_str!("page/throw.js"),
        include_str!("page/side.js"),
        include_str!("page/page.js"),
    ];
    let parts = [
        ("style", include_str!("page/page.css").to_owned()),
        ("code", code),
        ("stage", ccd_view::drawing_scripts()),
        ("scripts", ccd_view::script_elements(&scripts)),
        ("checks", checks),
    ];
    let text = ccd_view::fill_template(include_str!("page/page.html"), &parts);
    ccd_file::write(out, |file| file.write_all(text.as_bytes()))
        .with_context(|| format!("cannot write {}", out.display()))
}

/// Compresses the WebAssembly module, which halves the size of the page.
fn gzip(bytes: &[u8]) -> Result<Vec<u8>> {
    let mut encoder = GzEncoder::new(Vec::new(), Compression::best());
    encoder.write_all(bytes)?;
    Ok(encoder.finish()?)
}

/// Builds this crate as a WebAssembly module, and returns the module's path.
fn build_wasm_module() -> Result<PathBuf> {
    // This command is at TARGET_DIR/PROFILE/ccd-web.
    let command = env::current_exe()?;
    let folder = command
        .ancestors()
        .nth(2)
        .context("this command has no target folder")?;
    let cargo = env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let built = Command::new(cargo)
        .args([
            "build",
            "--locked",
            "--release",
            "--lib",
            "--package",
            "ccd-web",
            "--target",
            WASM_TARGET,
            "--target-dir",
        ])
        .arg(folder)
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        // All browsers with WebAssembly have supported 128-bit vectors since 2023.
        .env("CARGO_ENCODED_RUSTFLAGS", "-Ctarget-feature=+simd128")
        .status()
        .context("cannot start cargo")?;
    ensure!(
        built.success(),
        "cargo cannot build for {WASM_TARGET}; run `rustup target add {WASM_TARGET}`"
    );
    Ok(folder.join(WASM_TARGET).join("release/ccd_web.wasm"))
}
