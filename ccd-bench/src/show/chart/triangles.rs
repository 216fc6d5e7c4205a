//! Draws the chart of time against the size of the mesh, at the tolerance of the paper's benchmarks.

use super::pareto::is_lower_bound;
use super::plane::{
    HEAD_HEIGHT, Plane, Point, decades, draw_footer, draw_header, footer_height, series,
};
use super::sheet::{MARGIN, WIDTH, svg, units};
use super::{Charts, Drawing, Family, MethodFacts, SAME_ROWS, is_papers};
use anyhow::Result;
use std::collections::BTreeMap;

/// The names of the scenes by their shape and size; those of one shape and size give one point.
type Sizes<'a> = BTreeMap<(String, usize), Vec<&'a str>>;

/// The height of the plane, in pixels.
const HEIGHT: f64 = 440.0;

/// Draws one plane for all shapes: a line over the sizes of one shape, or a marker for a shape of one size.
pub(super) fn chart(charts: &Charts<'_>) -> Result<Option<Drawing>> {
    let shown = charts.methods_with_styles(&Family::COMPARED);
    let mut sizes = Sizes::new();
    for scene in charts.measured_scenes() {
        let size = sizes.entry((scene.shape(), scene.triangles)).or_default();
        size.push(scene.name);
    }
    let costs = shown.iter().flat_map(|(method, _)| {
        let scenes = sizes.values();
        scenes.filter_map(|scenes| mean_cost(charts, method, scenes))
    });
    let triangles = sizes.keys().map(|(_, triangles)| *triangles as f64);
    let (Some(x), Some(y)) = (decades(triangles), decades(costs)) else {
        return Ok(None);
    };
    let plane = Plane {
        x: (x, "triangles of the body that moves"),
        y: (y, "time of a query, median, µs"),
    };
    let bodies: Vec<String> = sizes
        .keys()
        .map(|(shape, triangles)| format!("{shape} {triangles}"))
        .collect();
    let bodies = format!("Bodies: {}.", bodies.join(", "));
    let remarks = [
        "Lines join sizes of one shape. Scenes of one body (turning or not) make one marker: the geometric mean of their medians.",
        &bodies,
        SAME_ROWS,
    ];
    let title = "Time against triangles: lower and flatter is better";
    let bottom = HEAD_HEIGHT + HEIGHT;
    let height = bottom + footer_height(&shown, &remarks);
    let svg = svg(title, (WIDTH, height), |sheet| {
        draw_header(
            sheet,
            title,
            "At the tolerance 1e-3; hollow markers: late or missed contacts somewhere",
        )?;
        let (panel, _) = sheet.split_vertically(units(bottom));
        let (_, panel) = panel.split_vertically(units(HEAD_HEIGHT - MARGIN));
        let mut drawn = plane.draw(&panel)?;
        for (method, style) in &shown {
            let mut lines: BTreeMap<&str, Vec<Point>> = BTreeMap::new();
            for ((shape, triangles), scenes) in &sizes {
                lines
                    .entry(shape)
                    .or_default()
                    .extend(mean_cost(charts, method, scenes).map(|y| Point {
                        x: *triangles as f64,
                        y,
                        is_lower_bound: false,
                    }));
            }
            for points in lines.values() {
                series(&mut drawn, &plane, points, style)?;
            }
        }
        draw_footer(sheet, &shown, &remarks, bottom)
    })?;
    let name = "triangles".to_owned();
    Ok(Some(Drawing { name, svg }))
}

/// Returns the geometric mean of the medians of some scenes. Returns `None` if one of them was not measured, or if half
/// of its queries were given up or cut off.
fn mean_cost(charts: &Charts<'_>, method: &MethodFacts<'_>, scenes: &[&str]) -> Option<f64> {
    let mut sum = 0.0;
    for scene in scenes {
        let cells = charts.cells_of(scene, method.name);
        let cell = cells.iter().find(|cell| is_papers(cell.tolerance))?;
        if is_lower_bound(cell) {
            return None;
        }
        sum += cell.median_us.ln();
    }
    let mean = (sum / scenes.len() as f64).exp();
    mean.is_finite().then_some(mean)
}
