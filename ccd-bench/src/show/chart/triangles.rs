//! Time against the size of the mesh, at the paper's tolerance.

use super::axis::Axis;
use super::grid::Grid;
use super::legend::Legend;
use super::panel::{Kind, Panel, Point, remark};
use super::sheet::{DrawError, Sheet, TextFormat};
use super::{
    ChartError, Charts, Drawing, Family, MethodFacts, SAME_ROWS, SceneFacts, failed, is_papers,
};
use plotters::style::text_anchor::{HPos, VPos};

const NAME: &str = "triangles";

/// The position on the axis from which names are placed to the left of their point.
const CROWDED: f64 = 0.75;

/// Scenes of one shape and size, which form one point of a line.
struct Size<'a> {
    shape: &'a str,
    triangles: usize,
    scenes: Vec<&'a str>,
}

/// Draws one panel for all shapes: a line over the sizes of one shape, or a marker for a shape of one size.
pub(super) fn chart(charts: &Charts<'_>) -> Result<Option<Drawing>, ChartError> {
    let shown = charts.shown(&Family::COMPARED);
    let sizes = sizes(&charts.measured_scenes());
    let values = || {
        shown.iter().flat_map(|(method, _)| {
            sizes
                .iter()
                .filter_map(|size| mean_cost(charts, method, size))
        })
    };
    let triangles = sizes.iter().map(|size| size.triangles as f64);
    let axes = (
        Axis::fitted("triangles of the body that moves", triangles),
        Axis::logarithmic("time of a query, median, µs", values()),
    );
    let (Some(x), Some(y)) = axes else {
        return Ok(None);
    };
    let title = "Time against triangles: lower and flatter is better";
    let grid = Grid {
        title,
        subtitle: "At the tolerance 10⁻³; hollow markers: late or missed contacts somewhere",
        remarks: vec![
            "Lines join sizes of one shape. Scenes of one body (turning or not) make one marker: \
             the geometric mean of their medians."
                .to_owned(),
            SAME_ROWS.to_owned(),
        ],
        legend: Legend::of_methods(&shown),
        x,
        y,
        columns: 1,
        height: 400.0,
        right_margin: 0.0,
    };
    let svg = grid.draw(&[""], |sheet, _, panel| {
        name_sizes(sheet, panel, &sizes)?;
        for (method, style) in &shown {
            for shape in shapes(&sizes) {
                let points = points(charts, method, &sizes, shape);
                panel.series(sheet, &points, style)?;
            }
        }
        Ok(())
    });
    Ok(Some(Drawing {
        name: NAME.to_owned(),
        title: title.to_owned(),
        svg: svg.map_err(failed(NAME))?,
    }))
}

/// Returns the time of a method for each size of a shape.
fn points(
    charts: &Charts<'_>,
    method: &MethodFacts<'_>,
    sizes: &[Size<'_>],
    shape: &str,
) -> Vec<Point> {
    let of_shape = sizes.iter().filter(|size| size.shape == shape);
    let point = |size: &Size<'_>| {
        Some(Point {
            x: size.triangles as f64,
            y: mean_cost(charts, method, size)?,
            kind: Kind::Measured,
        })
    };
    of_shape.filter_map(point).collect()
}

fn sizes<'a>(scenes: &[&'a SceneFacts<'a>]) -> Vec<Size<'a>> {
    let mut sizes: Vec<Size<'a>> = Vec::new();
    for scene in scenes {
        let same =
            |size: &&mut Size<'_>| size.shape == scene.shape && size.triangles == scene.triangles;
        match sizes.iter_mut().find(same) {
            Some(size) => size.scenes.push(scene.name),
            None => sizes.push(Size {
                shape: scene.shape,
                triangles: scene.triangles,
                scenes: vec![scene.name],
            }),
        }
    }
    sizes.sort_by_key(|size| size.triangles);
    sizes
}

fn shapes<'a>(sizes: &[Size<'a>]) -> Vec<&'a str> {
    let mut shapes: Vec<_> = sizes.iter().map(|size| size.shape).collect();
    shapes.sort_unstable();
    shapes.dedup();
    shapes
}

/// Returns the geometric mean of the medians of a size's scenes. Returns `None` if one of them was
/// not measured, or if half of its queries were given up or cut off.
fn mean_cost(charts: &Charts<'_>, method: &MethodFacts<'_>, size: &Size<'_>) -> Option<f64> {
    let mut sum = 0.0;
    for scene in &size.scenes {
        let cells = charts.cells_of(scene, method.name);
        let cell = cells.iter().find(|cell| is_papers(cell.tolerance))?;
        if 2 * cell.unresolved >= cell.rows {
            return None;
        }
        sum += cell.median_us.ln();
    }
    let mean = (sum / size.scenes.len() as f64).exp();
    mean.is_finite().then_some(mean)
}

/// Writes the names of bodies along the upper edge.
fn name_sizes(sheet: &Sheet<'_>, panel: &Panel<'_>, sizes: &[Size<'_>]) -> Result<(), DrawError> {
    for (number, size) in sizes.iter().enumerate() {
        let Some(share) = panel.x.share(size.triangles as f64) else {
            continue;
        };
        let format = TextFormat {
            // Large meshes are close together on a logarithmic axis, so their names end at their points.
            across: if share > CROWDED {
                HPos::Right
            } else {
                HPos::Center
            },
            down: VPos::Center,
            ..remark()
        };
        let x = panel.rect.left + share * panel.rect.width;
        // Neighbours may be close, so they alternate between two lines.
        let y = panel.rect.top - 21.0 + 13.0 * (number % 2) as f64;
        sheet.text(size.shape, (x, y), format)?;
    }
    Ok(())
}
