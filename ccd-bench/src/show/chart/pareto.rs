//! Time against error: one panel for each scene, with a strip for unsafe methods.

use super::axis::Axis;
use super::grid::Grid;
use super::legend::Legend;
use super::panel::{Kind, Panel, Point, mark, remark};
use super::sheet::{DrawError, FRAME, Rect, Sheet, TextFormat};
use super::style::{Fill, MethodStyle, WARNING};
use super::{ChartError, Charts, Drawing, Family, MethodFacts, SAME_ROWS, SceneFacts, failed};
use crate::run::measured::Cell;
use ccd_core::order::greater;
use plotters::style::Color;
use plotters::style::text_anchor::HPos;

const NAME: &str = "pareto";
/// The least error that is drawn; smaller ones are rounding, and are drawn at the edge.
const LEAST_ERROR: f64 = 1e-12;
/// The width of a method's lane in the strip.
const LANE: f64 = 10.0;
/// The gap between a panel and its strip.
const STRIP_GAP: f64 = 4.0;
/// The least width of the strip, for its title.
const LEAST_STRIP: f64 = 46.0;

type Shown<'a> = (&'a MethodFacts<'a>, MethodStyle);

/// Draws all scenes that were measured.
pub(super) fn chart(charts: &Charts<'_>) -> Result<Option<Drawing>, ChartError> {
    let scenes = charts.measured_scenes();
    let shown: Vec<_> = charts
        .shown(&Family::COMPARED)
        .into_iter()
        .filter(|(method, _)| {
            scenes
                .iter()
                .any(|scene| !charts.cells_of(scene.name, method.name).is_empty())
        })
        .collect();
    let cells: Vec<_> = scenes
        .iter()
        .flat_map(|scene| {
            shown.iter().flat_map(|(method, style)| {
                let cells = charts.cells_of(scene.name, method.name);
                cells.into_iter().map(|cell| (cell, style.fill))
            })
        })
        .collect();
    let Some((x, y)) = axes(&cells) else {
        return Ok(None);
    };
    let strip = strip_width(&shown);
    let title = "Time against error: lower left is better";
    let grid = Grid {
        title,
        subtitle: "One line per method, a marker for each tolerance; hollow in the strip beside: \
                   late or missed contacts somewhere, so no accuracy to show",
        remarks: remarks(&cells),
        legend: Legend::of_methods(&shown),
        x,
        y,
        columns: 3,
        height: 190.0,
        right_margin: strip,
    };
    let titles: Vec<_> = scenes.iter().map(|scene| scene.name).collect();
    let svg = grid.draw(&titles, |sheet, number, panel| {
        draw_scene(charts, sheet, (scenes[number], panel), &shown)?;
        if strip > 0.0 {
            draw_strip(charts, sheet, (scenes[number], panel), &shown, strip)
        } else {
            Ok(())
        }
    });
    Ok(Some(Drawing {
        name: NAME.to_owned(),
        title: format!("{title}. One panel for each scene."),
        svg: svg.map_err(failed(NAME))?,
    }))
}

fn axes(cells: &[(&Cell, Fill)]) -> Option<(Axis, Axis)> {
    let times = cells.iter().map(|(cell, _)| cell.median_us);
    let safe = cells.iter().filter(|(_, fill)| *fill == Fill::Solid);
    let errors = safe
        .map(|(cell, _)| cell.mean_error)
        .filter(|error| *error > LEAST_ERROR);
    let label = "mean error, share of duration";
    // A plane without points is still drawn: the strip shows the methods.
    let errors = Axis::logarithmic(label, errors)
        .or_else(|| Axis::logarithmic(label, [LEAST_ERROR].into_iter()));
    Some((
        errors?,
        Axis::logarithmic("time of a query, median, µs", times)?,
    ))
}

/// Returns the width of the strip, or zero if nothing is unsafe.
fn strip_width(shown: &[Shown<'_>]) -> f64 {
    let lanes = shown.iter().filter(|(_, style)| style.fill == Fill::Hollow);
    match lanes.count() {
        0 => 0.0,
        lanes => STRIP_GAP + greater(LEAST_STRIP, LANE * (lanes as f64 + 1.0)),
    }
}

fn remarks(cells: &[(&Cell, Fill)]) -> Vec<String> {
    let mut remarks = vec![
        "Errors are those of the time of contact; below 10⁻¹² they are rounding, and drawn at the left edge. \
         A method that found nothing has no error and no marker."
            .to_owned(),
        SAME_ROWS.to_owned(),
    ];
    if cells.iter().any(|(cell, _)| kind(cell) == Kind::AtLeast) {
        remarks.push(
            "Arrow up: half of the queries or more were given up or cut off; the time is at least that."
                .to_owned(),
        );
    }
    remarks
}

fn draw_scene(
    charts: &Charts<'_>,
    sheet: &Sheet<'_>,
    (scene, panel): (&SceneFacts<'_>, &Panel<'_>),
    shown: &[Shown<'_>],
) -> Result<(), DrawError> {
    for (method, style) in shown.iter().filter(|(_, style)| style.fill == Fill::Solid) {
        let cells = charts.cells_of(scene.name, method.name);
        let points: Vec<_> = cells
            .iter()
            .filter(|cell| !cell.mean_error.is_nan())
            .map(|cell| Point {
                x: greater(LEAST_ERROR, cell.mean_error),
                y: cell.median_us,
                kind: kind(cell),
            })
            .collect();
        panel.series(sheet, &points, style)?;
    }
    Ok(())
}

/// Draws unsafe methods by their time alone, one lane for each.
fn draw_strip(
    charts: &Charts<'_>,
    sheet: &Sheet<'_>,
    (scene, panel): (&SceneFacts<'_>, &Panel<'_>),
    shown: &[Shown<'_>],
    width: f64,
) -> Result<(), DrawError> {
    let strip = Rect {
        left: panel.rect.right() + STRIP_GAP,
        width: width - STRIP_GAP,
        ..panel.rect
    };
    sheet.rect(strip, WARNING.mix(0.08).filled())?;
    sheet.frame(strip, FRAME)?;
    let format = TextFormat {
        colour: WARNING,
        across: HPos::Center,
        ..remark()
    };
    let middle = strip.left + 0.5 * strip.width;
    sheet.text("unsafe", (middle, strip.top - 9.0), format)?;
    let unsafe_ones: Vec<_> = shown
        .iter()
        .filter(|(_, style)| style.fill == Fill::Hollow)
        .collect();
    let lane = strip.width / (unsafe_ones.len() as f64 + 1.0);
    for (number, (method, style)) in unsafe_ones.iter().enumerate() {
        let x = strip.left + lane * (number as f64 + 1.0);
        for cell in charts.cells_of(scene.name, method.name) {
            if let Some((_, y)) = panel.spot(LEAST_ERROR, cell.median_us) {
                mark(sheet, (x, y), kind(cell), style)?;
            }
        }
    }
    Ok(())
}

/// Returns `AtLeast` if the median of a cell is the time of queries without a complete answer.
pub(super) fn kind(cell: &Cell) -> Kind {
    if cell.rows > 0 && 2 * cell.unresolved >= cell.rows {
        Kind::AtLeast
    } else {
        Kind::Measured
    }
}
