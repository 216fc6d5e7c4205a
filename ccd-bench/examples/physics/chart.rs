//! Draws a chart of the bodies' penetration depth over the steps.

use crate::{METHODS, Method};
use anyhow::Result;
use ccd_core::order::greater;
use plotters::prelude::*;
use std::ops::Range;
use std::path::Path;

/// The penetration depths of a world after each step, for each of [`METHODS`].
pub(crate) struct Depths {
    pub(crate) world: &'static str,
    pub(crate) methods: Vec<Vec<f64>>,
}

/// The least depth on the chart's axis, in metres; smaller depths are drawn there.
const LEAST_DEPTH: f64 = 1e-6;

/// The maximum number of values of a line, each of which is the deepest of several steps.
const MOST_VALUES: usize = 300;

/// Draws one panel for each world.
pub(crate) fn draw(worlds: &[Depths], path: &Path) -> Result<()> {
    let size = (900, 260 * worlds.len() as u32);
    let sheet = SVGBackend::new(path, size).into_drawing_area();
    sheet.fill(&WHITE)?;
    for (panel, depths) in sheet.split_evenly((worlds.len(), 1)).iter().zip(worlds) {
        let steps = depths.methods.first().map_or(0, Vec::len);
        let range: Range<f64> = LEAST_DEPTH..1.0;
        let mut chart = ChartBuilder::on(panel)
            .caption(depths.world, ("sans-serif", 18))
            .margin(10)
            .margin_right(30)
            .x_label_area_size(36)
            .y_label_area_size(70)
            .build_cartesian_2d(0..steps, range.log_scale())?;
        let mut mesh = chart.configure_mesh();
        mesh.x_desc("step")
            .y_desc("deepest penetration, m; none: lower edge")
            .y_labels(7)
            .light_line_style(TRANSPARENT);
        mesh.y_label_formatter(&|depth| format!("{depth:.0e}"))
            .draw()?;
        for (method, values) in METHODS.iter().zip(&depths.methods) {
            let style = style(*method);
            let line = deepest(values)
                .into_iter()
                .map(|(step, depth)| (step, greater(LEAST_DEPTH, depth)));
            let drawn = chart.draw_series(LineSeries::new(line, style))?;
            drawn
                .label(method.name())
                .legend(move |(x, y)| PathElement::new([(x, y), (x + 20, y)], style));
        }
        let mut legend = chart.configure_series_labels();
        legend
            .position(SeriesLabelPosition::UpperRight)
            .background_style(WHITE.mix(0.8))
            .draw()?;
    }
    sheet.present()?;
    Ok(())
}

fn style(method: Method) -> ShapeStyle {
    match method {
        Method::Plain => RGBColor(200, 80, 60).stroke_width(1),
        Method::Rapier => RGBColor(220, 160, 40).stroke_width(1),
        Method::Certified => RGBColor(30, 90, 180).stroke_width(3),
    }
}

/// Returns the greatest depth in each group of consecutive steps, with the number of the step.
fn deepest(values: &[f64]) -> Vec<(usize, f64)> {
    let few = values.len().div_ceil(MOST_VALUES).max(1);
    let chunks = values.chunks(few).enumerate();
    chunks
        .map(|(k, chunk)| (k * few, chunk.iter().copied().fold(0.0, greater)))
        .collect()
}
