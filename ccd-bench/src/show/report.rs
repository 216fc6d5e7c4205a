//! One page that shows measurements: charts, tables, scenes in three dimensions. It works offline.

mod data;
#[cfg(test)]
mod tests;

use crate::show::chart::{ChartError, Charts};
use crate::show::tables::TextTable;
use ccd_core::Answer;
use ccd_decomp::TriangleMesh;
use plotly::Plot;
use rigid_ccd::table::motions::Query;
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::{fs, io};

/// The content of the page.
#[derive(Clone, Copy, Debug)]
pub struct Page<'a> {
    /// The title.
    pub title: &'a str,
    /// The introduction: paragraphs, separated by empty lines.
    pub preface: &'a str,
    /// The charts; the interactive plane of time and error is drawn from them too.
    pub charts: Charts<'a>,
    /// The scenes to view.
    pub views: &'a [View<'a>],
    /// The tables.
    pub tables: &'a [TextTable],
}

/// A scene to view.
#[derive(Clone, Debug)]
pub struct View<'a> {
    /// The scene's name.
    pub scene: &'a str,
    /// The mesh of body A.
    pub a: &'a TriangleMesh,
    /// The mesh of body B; equal meshes are stored once, for all views.
    pub b: &'a TriangleMesh,
    /// The motions of both bodies.
    pub shots: Vec<Shot>,
}

/// A motion of a view, and its answer.
#[derive(Clone, Debug)]
pub struct Shot {
    /// The motions.
    pub query: Query,
    /// The answer.
    pub answer: Answer,
}

/// The page cannot be made.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PageError {
    /// A chart cannot be drawn.
    #[error(transparent)]
    Chart(#[from] ChartError),
    /// The data for the page's scripts cannot be serialised.
    #[error("the page's data: {0}")]
    Data(#[from] serde_json::Error),
    /// The file cannot be written.
    #[error("cannot write {}: {source}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// The cause.
        source: io::Error,
    },
}

impl Page<'_> {
    /// Writes the page as one self-contained file.
    ///
    /// # Errors
    /// [`PageError`].
    pub fn write(&self, path: &Path) -> Result<(), PageError> {
        fs::write(path, self.html()?).map_err(|source| PageError::Write {
            path: path.to_owned(),
            source,
        })
    }

    /// Returns the text of the page.
    ///
    /// # Errors
    /// [`PageError`], except [`PageError::Write`].
    pub fn html(&self) -> Result<String, PageError> {
        let parts = [
            ("title", escape(self.title)),
            ("style", include_str!("report/style.css").to_owned()),
            ("preface", self.preface_html()),
            ("charts", self.charts_html()?),
            ("tables", self.tables_html()),
            ("measured", data::measured(&self.charts)?),
            ("views", data::views(self.views)?),
            ("plotly", plotly_script()),
            ("charts_script", include_str!("report/charts.js").to_owned()),
            ("view_script", include_str!("report/view.js").to_owned()),
            ("tables_script", include_str!("report/tables.js").to_owned()),
        ];
        Ok(filled(include_str!("report/page.html"), &parts))
    }

    fn preface_html(&self) -> String {
        let paragraphs = self.preface.split("\n\n").map(str::trim);
        paragraphs
            .filter(|paragraph| !paragraph.is_empty())
            .map(|paragraph| format!("<p>{}</p>\n", escape(paragraph)))
            .collect()
    }

    fn charts_html(&self) -> Result<String, PageError> {
        let drawings = self.charts.drawings()?;
        let mut html = String::new();
        // The small chart is for places without room for all scenes.
        for drawing in drawings.iter().filter(|d| d.name != "pareto-small") {
            // Writing to a string does not fail.
            let _ = writeln!(html, "<figure>{}</figure>", drawing.svg);
        }
        Ok(html)
    }

    fn tables_html(&self) -> String {
        self.tables.iter().map(table_html).collect()
    }
}

fn table_html(table: &TextTable) -> String {
    let cell = |text: &String| {
        let class = match text.starts_with(char::is_alphabetic) {
            true => "",
            false => " class=\"number\"",
        };
        format!("<td{class}>{}</td>", escape(text))
    };
    let header = table.header.iter().map(|name| {
        format!(
            "<th scope=\"col\"><button type=\"button\">{}</button></th>",
            escape(name)
        )
    });
    let rows = table.rows.iter().map(|row| {
        let cells: String = row.iter().map(cell).collect();
        format!("<tr>{cells}</tr>\n")
    });
    format!(
        "<h3>{}</h3>\n<div class=\"table\"><table>\n<thead><tr>{}</tr></thead>\n<tbody>\n{}</tbody>\n\
         </table></div>\n",
        escape(&table.title),
        header.collect::<String>(),
        rows.collect::<String>(),
    )
}

/// Returns the template with every `{{name}}` replaced. Inserted text is not searched again.
fn filled(template: &str, parts: &[(&str, String)]) -> String {
    let mut pieces = template.split("{{");
    let mut text = pieces.next().unwrap_or_default().to_owned();
    for piece in pieces {
        let (name, rest) = piece.split_once("}}").unwrap_or(("", piece));
        if let Some((_, part)) = parts.iter().find(|(known, _)| *known == name) {
            text.push_str(part);
        }
        text.push_str(rest);
    }
    text
}

/// Returns the first of the library's scripts. The other one renders formulas, and the page has none.
fn plotly_script() -> String {
    const END: &str = "</script>";
    let scripts = Plot::offline_js_sources();
    match scripts.split_once(END) {
        Some((first, _)) => format!("{first}{END}"),
        None => scripts,
    }
}

/// Escapes a text for HTML.
fn escape(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('"', "&quot;")
}
