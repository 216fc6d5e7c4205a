//! One page that shows what was measured: charts, tables, scenes in three dimensions; works offline.

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

/// What the page shows.
#[derive(Clone, Copy, Debug)]
pub struct Page<'a> {
    /// What it is called.
    pub title: &'a str,
    /// What is said first: paragraphs, an empty line between two.
    pub preface: &'a str,
    /// The charts, which the plane of time and error is drawn from as well.
    pub charts: Charts<'a>,
    /// The scenes to be looked at.
    pub views: &'a [View<'a>],
    /// The tables.
    pub tables: &'a [TextTable],
}

/// A scene to be looked at.
#[derive(Clone, Debug)]
pub struct View<'a> {
    /// The scene's name.
    pub scene: &'a str,
    /// The mesh of body A.
    pub a: &'a TriangleMesh,
    /// The mesh of body B; equal meshes are stored once, for all views.
    pub b: &'a TriangleMesh,
    /// Motions of both.
    pub shots: Vec<Shot>,
}

/// A motion of a view, and what happens in it.
#[derive(Clone, Debug)]
pub struct Shot {
    /// The motions.
    pub query: Query,
    /// The answer.
    pub answer: Answer,
}

/// Why there is no page.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PageError {
    /// A chart cannot be drawn.
    #[error(transparent)]
    Chart(#[from] ChartError),
    /// What the page's scripts read cannot be written down.
    #[error("the page's data: {0}")]
    Data(#[from] serde_json::Error),
    /// The file cannot be written.
    #[error("cannot write {}: {source}", path.display())]
    Write {
        /// Which.
        path: PathBuf,
        /// Why.
        source: io::Error,
    },
}

impl Page<'_> {
    /// Writes the page as one file that needs nothing else.
    ///
    /// # Errors
    /// [`PageError`].
    pub fn write(&self, path: &Path) -> Result<(), PageError> {
        fs::write(path, self.html()?).map_err(|source| PageError::Write {
            path: path.to_owned(),
            source,
        })
    }

    /// The text of the page.
    ///
    /// # Errors
    /// [`PageError`], but for [`PageError::Write`].
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
        // The small one is for where there is no room for all scenes.
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

/// The template with every `{{name}}` replaced; what is put in is not looked at again.
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

/// The first of the scripts that the library brings: the other one sets formulas, of which there are
/// none.
fn plotly_script() -> String {
    const END: &str = "</script>";
    let scripts = Plot::offline_js_sources();
    match scripts.split_once(END) {
        Some((first, _)) => format!("{first}{END}"),
        None => scripts,
    }
}

/// A text as it may stand in HTML.
fn escape(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('"', "&quot;")
}
