//! Writes the page: WebAssembly module, scripts and style in one file.

use crate::answers::random_throw_results;
use anyhow::{Context, Result, ensure};
use ccd_web::Part;
use serde_json::Value;
use std::path::Path;

/// Builds the WebAssembly, and writes the page.
pub(crate) fn write(out: &Path, check: bool) -> Result<()> {
    let engine = rigid_ccd_js::package::module()?;
    ensure!(
        !engine.contains("</script"),
        "the module cannot be an element of the page"
    );
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
        include_str!("page/parts.js"),
        include_str!("page/throw.js"),
        include_str!("page/side.js"),
        include_str!("page/page.js"),
    ];
    let parts = [
        ("style", include_str!("page/page.css").to_owned()),
        ("parts", ccd_view::json(&all_parts()?)?),
        ("engine", engine),
        ("stage", ccd_view::drawing_scripts()),
        ("scripts", ccd_view::script_elements(&scripts)),
        ("checks", checks),
    ];
    let text = ccd_view::fill_template(include_str!("page/page.html"), &parts);
    ccd_file::write(out, |file| file.write_all(text.as_bytes()))
        .with_context(|| format!("cannot write {}", out.display()))
}

/// Returns the built-in parts by their names, as JSON.
fn all_parts() -> Result<Value> {
    let entry = |name: &str| Ok((name.to_owned(), Part::from_name(name)?.to_json()));
    let entries: Result<serde_json::Map<_, _>> = Part::NAMES.into_iter().map(entry).collect();
    Ok(Value::Object(entries?))
}
