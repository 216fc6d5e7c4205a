//! Draws the chart of time against error: one plane for each scene, with a strip for unsafe methods.

use super::plane::{
    HEAD_HEIGHT, PlotAxes, PlotPoint, decade_range, draw_footer, draw_header, draw_marker,
    draw_series, footer_height,
};
use super::sheet::{
    CHART_WIDTH, DEFAULT_FONT_SIZE, Sheet, TEXT_COLOUR, draw_svg, font, to_drawing_units,
};
use super::style::WARNING_COLOUR;
use super::{ChartData, StyledMethod};
use crate::run::measured::MeasurementCell;
use anyhow::Result;
use ccd_core::order::greater;
use plotters::prelude::*;

/// The least error on the axis; smaller ones are due to rounding, and are drawn at the edge.
const MIN_DRAWN_ERROR: f64 = 1e-12;
/// The number of planes side by side, and their height in pixels.
const PLOTS_PER_ROW_AND_HEIGHT: (usize, f64) = (3, 260.0);
/// The width of a method's lane in the strip of unsafe methods, and the least width of the strip, in pixels.
const LANE_AND_STRIP_WIDTHS: (f64, f64) = (10.0, 50.0);

/// Returns the SVG text of the chart, with a plane for each measured scene; `None` if there are no times.
pub(super) fn draw_chart(charts: &ChartData<'_>) -> Result<Option<String>> {
    let scenes = charts.measured_scenes();
    let shown = charts.methods_with_styles();
    let cells = |is_shown: fn(&StyledMethod<'_>) -> bool| {
        let methods = shown.iter().filter(move |method| is_shown(method));
        let of = |(method, _): &StyledMethod<'_>| {
            let of_scene = |scene: &&str| charts.cells_of(scene, method.name);
            scenes.iter().flat_map(of_scene).collect::<Vec<_>>()
        };
        methods.flat_map(of).collect::<Vec<_>>()
    };
    let all = cells(|_| true);
    let errors = cells(|(_, style)| !style.is_unsafe);
    let errors = errors.iter().filter_map(|cell| cell.mean_error);
    // A plane without points is still drawn: the strip shows the methods.
    let errors = decade_range(errors.filter(|error| *error > MIN_DRAWN_ERROR));
    let Some(times) = decade_range(all.iter().map(|cell| cell.median_us)) else {
        return Ok(None);
    };
    let plane = PlotAxes {
        x: (
            errors.unwrap_or(MIN_DRAWN_ERROR..1.0),
            "mean error, fraction of duration",
        ),
        y: (times, "time of a query, median, µs"),
    };
    let mut remarks = vec![
        "Errors are those of the time of contact; below 1e-12 they are rounding, and drawn at the left edge. A method that \
         found nothing has no marker.",
        "A method that was asked fewer rows than ours is drawn at our median, times the median ratio on the rows that both \
         were asked.",
    ];
    if all.iter().any(|cell| is_median_lower_bound(cell)) {
        remarks.push(
            "Arrow up: half of the queries or more were given up or cut off; the time is at least that.",
        );
    }
    let title = "Time against error: lower left is better";
    let rows = scenes.len().div_ceil(PLOTS_PER_ROW_AND_HEIGHT.0);
    let bottom = HEAD_HEIGHT + PLOTS_PER_ROW_AND_HEIGHT.1 * rows as f64;
    let height = bottom + footer_height(&shown, &remarks);
    let svg = draw_svg(title, (CHART_WIDTH, height), |sheet| {
        draw_header(
            sheet,
            title,
            "One line per method, a marker for each tolerance; hollow in the strip beside: late or missed contacts \
             somewhere, so no accuracy to show",
        )?;
        let (panels, _) = sheet.split_vertically(to_drawing_units(bottom));
        let (_, panels) = panels.split_vertically(to_drawing_units(HEAD_HEIGHT));
        let panels = panels.split_evenly((rows, PLOTS_PER_ROW_AND_HEIGHT.0));
        for (scene, panel) in scenes.iter().zip(&panels) {
            draw_scene(charts, panel, scene, &plane, &shown)?;
        }
        draw_footer(sheet, &shown, &remarks, bottom)
    })?;
    Ok(Some(svg))
}

fn draw_scene(
    charts: &ChartData<'_>,
    panel: &Sheet<'_>,
    scene: &str,
    plane: &PlotAxes,
    shown: &[StyledMethod<'_>],
) -> Result<()> {
    let (hollow, solid): (Vec<_>, Vec<_>) = shown.iter().partition(|(_, style)| style.is_unsafe);
    let strip = match hollow.len() {
        0 => 0.0,
        lanes => greater(
            LANE_AND_STRIP_WIDTHS.1,
            LANE_AND_STRIP_WIDTHS.0 * (lanes as f64 + 1.0),
        ),
    };
    let width = panel.dim_in_pixel().0 as i32;
    let (panel, strip) = panel.split_horizontally(width - to_drawing_units(strip));
    let bold = font(DEFAULT_FONT_SIZE, FontStyle::Bold);
    let panel = panel.titled(scene, bold.color(&TEXT_COLOUR))?;
    let mut drawn = plane.draw(&panel)?;
    for (method, style) in &solid {
        let cells = charts.cells_of(scene, method.name);
        let points = cells.iter().map(|cell| PlotPoint {
            x: cell.mean_error.unwrap_or(f64::NAN),
            y: cell.median_us,
            is_lower_bound: is_median_lower_bound(cell),
        });
        draw_series(&mut drawn, plane, &points.collect::<Vec<_>>(), style)?;
    }
    if hollow.is_empty() {
        return Ok(());
    }
    // Unsafe methods have a time alone, and a lane each: at 10, 100 and so on of a logarithmic axis.
    let lane = |number: usize| 10f64.powi(number as i32 + 1);
    let strip = strip.titled("unsafe", bold.color(&WARNING_COLOUR))?;
    let mut beside = plane.empty_plot_beside(&strip, 1.0..lane(hollow.len()))?;
    beside.plotting_area().fill(&WARNING_COLOUR.mix(0.08))?;
    for (number, (method, style)) in hollow.iter().enumerate() {
        for cell in charts.cells_of(scene, method.name) {
            if !cell.median_us.is_nan() {
                let at = (lane(number), cell.median_us);
                draw_marker(&mut beside, at, is_median_lower_bound(cell), style)?;
            }
        }
    }
    Ok(())
}

/// Returns true if half of a cell's queries or more are unresolved, so that its median is only a lower bound of the
/// time.
fn is_median_lower_bound(cell: &MeasurementCell) -> bool {
    cell.rows > 0 && 2 * cell.unresolved >= cell.rows
}
