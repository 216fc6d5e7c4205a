//! Draws a plane of two logarithmic axes with a line for each method, and the legend of all planes of a chart.

use super::ChartedMethod;
use super::sheet::{
    CHART_MARGIN, DEFAULT_FONT_SIZE, Sheet, TEXT_COLOUR, draw_text, font, text_style,
    to_drawing_position, to_drawing_units,
};
use super::style::{MARKER_RADIUS, MethodStyle};
use anyhow::Result;
use ccd_core::order::{greater, lesser};
use plotters::coord::combinators::LogCoord;
use plotters::element::{ComposedElement, DashedPathElement};
use plotters::prelude::*;
use std::ops::Range;

/// The height of a line of text, in pixels.
pub(super) const LINE_HEIGHT: f64 = 18.0;
/// The height of the chart's title and subtitle, in pixels.
pub(super) const HEAD_HEIGHT: f64 = 50.0;
/// The number of columns of the legend, and the width of each in pixels.
const LEGEND_COLUMN_LAYOUT: (usize, f64) = (2, 400.0);
/// The colour of grid lines behind the data.
const GRID_COLOUR: RGBColor = RGBColor(0xe4, 0xe4, 0xe4);

/// The two axes of a plane, with their labels and ranges.
#[derive(Clone)]
pub(super) struct PlotAxes {
    pub(super) x: (Range<f64>, &'static str),
    pub(super) y: (Range<f64>, &'static str),
}

/// The drawing library's handle for a plane on a sheet, which converts values on the axes to positions.
type PlaneContext<'a, 's> =
    ChartContext<'a, SVGBackend<'s>, Cartesian2d<LogCoord<f64>, LogCoord<f64>>>;

/// A point of a line on a plane, in the units of the axes. The quantity of `y` is at least this if the measurement was
/// cut off.
#[derive(Clone, Copy, Debug)]
pub(super) struct PlotPoint {
    pub(super) x: f64,
    pub(super) y: f64,
    pub(super) is_lower_bound: bool,
}

/// A method on a chart, with its style.
pub(super) type StyledMethod<'a> = (&'a ChartedMethod<'a>, MethodStyle);

/// Returns the range of whole decades that has all positive values, at least one decade; `None` without positive
/// values.
pub(super) fn decade_range(values: impl Iterator<Item = f64>) -> Option<Range<f64>> {
    let exponents = values.map(f64::log10).filter(|value| value.is_finite());
    let exponents: Vec<f64> = exponents.collect();
    let low = exponents.iter().copied().reduce(lesser)?.floor();
    let high = exponents.iter().copied().reduce(greater)?.ceil();
    Some(10f64.powf(low)..10f64.powf(greater(high, low + 1.0)))
}

impl PlotAxes {
    /// Draws the axes of the plane on a sheet.
    pub(super) fn draw<'a, 's>(&self, sheet: &'a Sheet<'s>) -> Result<PlaneContext<'a, 's>> {
        let mut drawn = self.empty_plot_beside(sheet, self.x.0.clone())?;
        drawn
            .configure_mesh()
            .max_light_lines(1)
            .bold_line_style(GRID_COLOUR.stroke_width(10))
            .axis_style(TEXT_COLOUR.stroke_width(10))
            .set_all_tick_mark_size(to_drawing_units(4.0))
            .x_labels(4)
            .y_labels(6)
            .x_desc(self.x.1)
            .y_desc(self.y.1)
            .x_label_formatter(&|value| format!("{value:.0e}"))
            .y_label_formatter(&|value| format!("{value:.0e}"))
            .label_style(font(DEFAULT_FONT_SIZE, FontStyle::Normal))
            .draw()?;
        Ok(drawn)
    }

    /// Prepares a plane with the same vertical axis, but without numbers and grid lines, such as a strip beside this
    /// plane.
    pub(super) fn empty_plot_beside<'a, 's>(
        &self,
        sheet: &'a Sheet<'s>,
        x: Range<f64>,
    ) -> Result<PlaneContext<'a, 's>> {
        let narrow = x != self.x.0;
        Ok(ChartBuilder::on(sheet)
            .margin_top(to_drawing_units(CHART_MARGIN))
            .margin_bottom(to_drawing_units(CHART_MARGIN))
            .margin_right(to_drawing_units(CHART_MARGIN))
            .x_label_area_size(to_drawing_units(38.0))
            .y_label_area_size(if narrow { 0 } else { to_drawing_units(66.0) })
            .build_cartesian_2d(x.log_scale(), self.y.0.clone().log_scale())?)
    }
}

/// Draws a line through points, with a marker on each. Values beyond the axes are at the edge.
pub(super) fn draw_series(
    drawn: &mut PlaneContext<'_, '_>,
    plane: &PlotAxes,
    points: &[PlotPoint],
    style: &MethodStyle,
) -> Result<()> {
    let within = |value: f64, range: &Range<f64>| value.clamp(range.start, range.end);
    let known = points.iter().filter(|point| !(point.x * point.y).is_nan());
    let at = |point: &PlotPoint| (within(point.x, &plane.x.0), within(point.y, &plane.y.0));
    let spots: Vec<(f64, f64)> = known.clone().map(at).collect();
    match style.dash_and_gap {
        None => drawn.draw_series(LineSeries::new(spots, style.line_style(14)))?,
        Some((dash, gap)) => drawn.draw_series(DashedLineSeries::new(
            spots,
            dash,
            gap,
            style.line_style(14),
        ))?,
    };
    for point in known {
        draw_marker(drawn, at(point), point.is_lower_bound, style)?;
    }
    Ok(())
}

/// Draws a method's marker, with an arrow upwards if the value is a lower bound.
pub(super) fn draw_marker(
    drawn: &mut PlaneContext<'_, '_>,
    at: (f64, f64),
    is_lower_bound: bool,
    style: &MethodStyle,
) -> Result<()> {
    drawn.draw_series([marker_glyph(at, style)])?;
    if is_lower_bound {
        let arrow = [
            (0.0, MARKER_RADIUS),
            (0.0, 12.0),
            (-3.0, 8.0),
            (3.0, 8.0),
            (0.0, 12.0),
        ];
        let arrow = arrow.map(|(x, up)| (to_drawing_units(x), -to_drawing_units(up)));
        drawn
            .draw_series([EmptyElement::at(at) + PathElement::new(arrow, style.line_style(13))])?;
    }
    Ok(())
}

/// Returns the drawing of a method's marker at a position.
fn marker_glyph<'s, C>(at: C, style: &MethodStyle) -> Glyph<'s, C> {
    let corners = style.corners();
    let closed: Vec<_> = corners.iter().chain(corners.first()).copied().collect();
    let inside = if style.is_unsafe { WHITE } else { style.colour };
    EmptyElement::at(at)
        + Polygon::new(corners, inside.filled())
        + PathElement::new(closed, style.line_style(13))
}

/// The polygon of a marker, with its corners relative to its position.
type Glyph<'s, C> =
    ComposedElement<C, SVGBackend<'s>, Polygon<(i32, i32)>, PathElement<(i32, i32)>>;

/// Draws the title and the subtitle of a chart.
pub(super) fn draw_header(sheet: &Sheet<'_>, title: &str, subtitle: &str) -> Result<()> {
    let mut large = text_style(16.0);
    large.font = font(16.0, FontStyle::Bold);
    draw_text(sheet, title, (CHART_MARGIN, 16.0), &large)?;
    let plain = text_style(DEFAULT_FONT_SIZE);
    draw_text(sheet, subtitle, (CHART_MARGIN, 36.0), &plain)
}

/// Returns the height of the legend and the remarks, in pixels.
pub(super) fn footer_height(shown: &[StyledMethod<'_>], remarks: &[&str]) -> f64 {
    LINE_HEIGHT * (shown.len().div_ceil(LEGEND_COLUMN_LAYOUT.0) + remarks.len()) as f64
        + CHART_MARGIN
}

/// Draws the legend, and the remarks below it.
pub(super) fn draw_footer(
    sheet: &Sheet<'_>,
    shown: &[StyledMethod<'_>],
    remarks: &[&str],
    top: f64,
) -> Result<()> {
    let (columns, width) = LEGEND_COLUMN_LAYOUT;
    for (index, (method, style)) in shown.iter().enumerate() {
        let left = CHART_MARGIN + width * (index % columns) as f64;
        let middle = top + LINE_HEIGHT * ((index / columns) as f64 + 0.5);
        let [from, at, to] =
            [0.0, 15.0, 30.0].map(|right| to_drawing_position((left + right, middle)));
        let (dash, gap) = style.dash_and_gap.unwrap_or((300, 0));
        let line = DashedPathElement::new([from, to], dash, gap, style.line_style(15));
        sheet.draw(&line)?;
        sheet.draw(&marker_glyph(at, style))?;
        let mark = if style.is_unsafe { " (unsafe)" } else { "" };
        let label = format!(
            "{}: {}{mark}",
            method.method_family.legend_heading(),
            method.name
        );
        draw_text(
            sheet,
            &label,
            (left + 36.0, middle),
            &text_style(DEFAULT_FONT_SIZE),
        )?;
    }
    let top = top + LINE_HEIGHT * (shown.len().div_ceil(columns) as f64 + 0.5);
    let small = text_style(DEFAULT_FONT_SIZE - 1.0);
    for (line, remark) in remarks.iter().enumerate() {
        let at = (CHART_MARGIN, top + LINE_HEIGHT * line as f64);
        draw_text(sheet, remark, at, &small)?;
    }
    Ok(())
}
