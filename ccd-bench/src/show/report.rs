//! One page that shows measurements: charts, tables, scenes in three dimensions. It works offline.

use crate::show::chart::Charts;
use crate::show::page::{self, PageError, escape};
use crate::show::tables::TextTable;
use crate::show::view::{self, View};
use std::fmt::Write;
use std::path::Path;

/// The content of the page.
#[derive(Clone, Copy, Debug)]
pub struct Page<'a> {
    /// The title.
    pub title: &'a str,
    /// The introduction: paragraphs, separated by empty lines.
    pub preface: &'a str,
    /// The charts.
    pub charts: Charts<'a>,
    /// The scenes to view.
    pub views: &'a [View<'a>],
    /// The tables.
    pub tables: &'a [TextTable],
}

impl Page<'_> {
    /// Writes the page as one self-contained file.
    ///
    /// # Errors
    /// [`PageError`].
    pub fn write(&self, path: &Path) -> Result<(), PageError> {
        page::write(path, &self.html()?)
    }

    /// Returns the text of the page.
    ///
    /// # Errors
    /// [`PageError`], except [`PageError::Write`].
    pub fn html(&self) -> Result<String, PageError> {
        let parts = [
            ("title", escape(self.title)),
            ("style", page::STYLE.to_owned()),
            ("preface", self.preface_html()),
            ("charts", self.charts_html()?),
            ("tables", self.tables_html()),
            ("view_place", ccd_view::HTML.to_owned()),
            ("view_style", ccd_view::STYLE.to_owned()),
            ("views", view::data(self.views)?),
            ("view_scripts", ccd_view::scripts()),
            ("tables_script", include_str!("report/tables.js").to_owned()),
        ];
        Ok(page::filled(include_str!("report/page.html"), &parts))
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
        for drawing in &drawings {
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
        let class = if text.starts_with(char::is_alphabetic) {
            ""
        } else {
            " class=\"number\""
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

#[cfg(test)]
mod tests;
