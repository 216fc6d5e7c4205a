//! Makes HTML of views: a page of one file, or parts of another page.

use crate::{Animation, AnimationGroup, Meshes};
use serde::Serialize;
use serde_json::Serializer;
use serde_json::ser::{CharEscape, CompactFormatter, Formatter};
use std::io;

/// The HTML element in which the scripts show the views.
pub const VIEW_HTML: &str = include_str!("page/view.html");
/// The style sheet for the element in [`VIEW_HTML`].
pub const VIEW_CSS: &str = include_str!("page/view.css");

/// Returns a page with a title, in plain text, and views, of which its reader chooses one at a time.
///
/// # Errors
/// The views cannot be serialised as JSON.
pub fn page_html(
    title: &str,
    meshes: &Meshes,
    views: Vec<Animation>,
) -> Result<String, serde_json::Error> {
    let name = String::new();
    let parts = [
        ("title", escape(title)),
        (
            "style",
            format!("{}{VIEW_CSS}", include_str!("page/page.css")),
        ),
        ("view", VIEW_HTML.to_owned()),
        (
            "views",
            views_json(meshes, &[AnimationGroup { name, views }])?,
        ),
        ("scripts", view_scripts()),
    ];
    Ok(fill_template(include_str!("page/page.html"), &parts))
}

/// Returns the scripts that fill [`VIEW_HTML`] with the views of [`views_json`], which an earlier element with the id `views`
/// holds.
pub fn view_scripts() -> String {
    let views = [
        include_str!("page/coarse.js"),
        include_str!("page/gap.js"),
        include_str!("page/marks.js"),
        include_str!("page/view.js"),
    ];
    drawing_scripts() + &script_elements(&views)
}

/// Returns the scripts for a page that draws its own scene: three.js, `Motion`, `Stage` and `Player`.
pub fn drawing_scripts() -> String {
    script_elements(&[
        include_str!("../vendor/three/three.min.js"),
        include_str!("page/motion.js"),
        include_str!("page/stage.js"),
        include_str!("page/player.js"),
    ])
}

/// Returns elements of HTML that run scripts, in their order.
pub fn script_elements(scripts: &[&str]) -> String {
    let element = |script: &&str| format!("<script>\n{script}</script>\n");
    scripts.iter().map(element).collect()
}

/// Returns meshes and groups of views as JSON for an element `<script type="application/json" id="views">`.
///
/// # Errors
/// The value cannot be serialised.
pub fn views_json(meshes: &Meshes, groups: &[AnimationGroup]) -> Result<String, serde_json::Error> {
    #[derive(Serialize)]
    struct ViewsData<'a> {
        meshes: &'a Meshes,
        groups: &'a [AnimationGroup],
    }
    json(&ViewsData { meshes, groups })
}

/// Returns a value as JSON that cannot end the element `script` that it stands in, without control characters except
/// line ends and tabs.
///
/// # Errors
/// The value cannot be serialised.
pub fn json(value: &impl Serialize) -> Result<String, serde_json::Error> {
    let mut text = Vec::new();
    value.serialize(&mut Serializer::with_formatter(
        &mut text,
        ControlCharReplacingFormatter,
    ))?;
    Ok(String::from_utf8_lossy(&text).replace('<', "\\u003c"))
}

/// A JSON formatter that replaces control characters by U+FFFD.
struct ControlCharReplacingFormatter;

impl Formatter for ControlCharReplacingFormatter {
    fn write_char_escape<W: ?Sized + io::Write>(
        &mut self,
        writer: &mut W,
        escape: CharEscape,
    ) -> io::Result<()> {
        match escape {
            CharEscape::AsciiControl(_) | CharEscape::Backspace | CharEscape::FormFeed => {
                writer.write_all(b"\\ufffd")
            }
            other => CompactFormatter.write_char_escape(writer, other),
        }
    }
}

/// Escapes a text for an element or an attribute in double quotes, and replaces control characters by U+FFFD.
pub fn escape(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for character in text.chars() {
        match character {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            '\n' | '\t' => escaped.push(character),
            control if control.is_control() => escaped.push(char::REPLACEMENT_CHARACTER),
            other => escaped.push(other),
        }
    }
    escaped
}

/// Returns the template with every `{{name}}` replaced by the part of that name. Inserted text is not searched again.
pub fn fill_template(template: &str, parts: &[(&str, String)]) -> String {
    let mut pieces = template.split("{{");
    let mut text = pieces.next().unwrap_or_default().to_owned();
    for piece in pieces {
        let (name, rest) = piece.split_once("}}").unwrap_or(("", piece));
        if let Some((_, part)) = parts.iter().find(|(part_name, _)| *part_name == name) {
            text.push_str(part);
        }
        text.push_str(rest);
    }
    text
}

#[cfg(test)]
mod tests;
