//! One page with the maps of stability. Each cell opens: the steps, the scene at the wrong time, and the
//! command that repeats it. It works offline.

use crate::show::chart::{HeatCell, HeatMap, HeatRow};
use crate::show::page::{self, PageError, escape, json};
use crate::show::view::{self, View};
use plotters::style::RGBColor;
use serde::Serialize;
use std::path::Path;

/// The content of the page.
#[derive(Clone, Copy, Debug)]
pub struct Atlas<'a> {
    /// The title.
    pub title: &'a str,
    /// The introduction.
    pub preface: &'a str,
    /// Maps of the same families and methods.
    pub maps: &'a [HeatMap],
    /// What opens, by families and methods; `None` for methods that were not asked.
    pub details: &'a [Vec<Option<Detail>>],
    /// The scenes to view.
    pub views: &'a [View<'a>],
}

/// What opens at a cell.
#[derive(Clone, Debug, Serialize)]
pub struct Detail {
    /// The command that repeats the answers.
    pub command: String,
    /// The steps of the family, the easiest first.
    pub steps: Vec<StepLine>,
    /// The scene to show, and its motion; `None` if there is none to show.
    pub view: Option<[usize; 2]>,
}

/// One step of a family.
#[derive(Clone, Debug, Serialize)]
pub struct StepLine {
    /// The value of the parameter.
    pub value: String,
    /// The worst verdict.
    pub verdict: String,
    /// The exact answer, in words.
    pub exact: String,
    /// The answer that was given, in words.
    pub given: String,
    /// The cost of a query, in words.
    pub cost: String,
}

impl Atlas<'_> {
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
        let maps = (0..).zip(self.maps).map(|(k, map)| map_html(k, map));
        let parts = [
            ("title", escape(self.title)),
            ("style", page::STYLE.to_owned()),
            ("atlas_style", include_str!("atlas/atlas.css").to_owned()),
            ("preface", escape(self.preface)),
            ("links", self.links()),
            ("maps", maps.collect()),
            ("view_place", ccd_view::HTML.to_owned()),
            ("view_style", ccd_view::STYLE.to_owned()),
            ("details", json(&self.details)?),
            ("views", view::data(self.views)?),
            ("view_scripts", ccd_view::scripts()),
            ("atlas_script", include_str!("atlas/atlas.js").to_owned()),
        ];
        Ok(page::filled(include_str!("atlas/atlas.html"), &parts))
    }
}

impl Atlas<'_> {
    /// Returns links to the maps.
    fn links(&self) -> String {
        let maps = (0..).zip(self.maps).map(|(k, map)| {
            let name = map.kind.words().link;
            format!("<a href=\"#map-{k}\">{name}</a> ")
        });
        maps.collect()
    }
}

/// Returns a map as a table of buttons.
fn map_html(number: usize, map: &HeatMap) -> String {
    let words = map.kind.words();
    let legend = words.legend.iter().map(|(kind, colour)| {
        format!(
            "<li><span style=\"background:{}\"></span>{kind}</li>",
            css(*colour)
        )
    });
    let header = map
        .methods
        .iter()
        .map(|method| format!("<th scope=\"col\"><span>{}</span></th>", escape(method)));
    let rows = (0..)
        .zip(&map.rows)
        .map(|(k, row)| row_html(k, row, &map.methods));
    format!(
        "<section id=\"map-{number}\">\n<h2>{}</h2>\n<p>{}</p>\n<ul class=\"legend\">{}</ul>\n\
         <div class=\"map\"><table>\n<thead><tr><th></th>{}</tr></thead>\n<tbody>\n{}</tbody>\n</table></div>\n\
         </section>\n",
        escape(words.title),
        escape(words.remark),
        legend.collect::<String>(),
        header.collect::<String>(),
        rows.collect::<String>(),
    )
}

fn row_html(number: usize, row: &HeatRow, methods: &[String]) -> String {
    let cells = (0..)
        .zip(row.cells.iter().zip(methods))
        .map(|(k, (cell, method))| {
            cell.as_ref().map_or_else(
                || "<td></td>".to_owned(),
                |cell| cell_html([number, k], &format!("{}: {method}", row.name), cell),
            )
        });
    format!(
        "<tr><th scope=\"row\">{}<small>{}</small></th>{}</tr>\n",
        escape(&row.name),
        escape(&row.parameter),
        cells.collect::<String>()
    )
}

fn cell_html([family, method]: [usize; 2], name: &str, cell: &HeatCell) -> String {
    let look = cell.look();
    let text = look.lines.join(" ");
    let text = text.trim();
    format!(
        "<td><button type=\"button\" data-cell=\"{family},{method}\" aria-label=\"{}\" \
         style=\"background:{};color:{};--bar:{:.0}%\">{}</button></td>",
        escape(&format!("{name} {text}")),
        css(look.fill),
        css(look.ink),
        100.0 * look.bar,
        escape(text),
    )
}

fn css(RGBColor(red, green, blue): RGBColor) -> String {
    format!("#{red:02x}{green:02x}{blue:02x}")
}

#[cfg(test)]
mod tests;
