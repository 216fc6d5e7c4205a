//! Makes one page that shows measurements: a chart, tables, scenes in three dimensions. It works offline.

use super::tables::TextTable;
use super::views::SceneAnimations;
use ccd_view::{escape, fill_template};

#[cfg(test)]
mod tests;

/// Returns the HTML text of a page with a chart, views of motions, and tables.
///
/// # Errors
/// If the views cannot be serialised.
pub fn page_html(
    chart: &str,
    views: &SceneAnimations,
    tables: &[TextTable],
) -> Result<String, serde_json::Error> {
    let parts = [
        ("style", include_str!("page/style.css").to_owned()),
        ("charts", format!("<figure>{chart}</figure>\n")),
        ("tables", tables.iter().map(table_html).collect()),
        ("view_place", ccd_view::VIEW_HTML.to_owned()),
        ("view_style", ccd_view::VIEW_CSS.to_owned()),
        ("views", ccd_view::views_json(&views.meshes, &views.groups)?),
        ("view_scripts", ccd_view::view_scripts()),
    ];
    Ok(fill_template(include_str!("page/page.html"), &parts))
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
    let header = table.header.iter();
    let header = header.map(|name| format!("<th scope=\"col\">{}</th>", escape(name)));
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
