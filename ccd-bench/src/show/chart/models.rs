//! The costs and errors of several models of the same mesh.

use super::axis::Axis;
use super::grid::{HEAD, foot, foot_height, head};
use super::legend::Legend;
use super::look::Look;
use super::panel::{BOTTOM_MARGIN, Label, Labelled, Panel, TOP_MARGIN};
use super::pareto::kind;
use super::sheet::{DrawError, MARGIN, Pen, RULE, Rect, Sheet, TextFormat, WIDTH, text_width};
use super::{ChartError, Charts, Drawing, Family, MethodFacts, SceneFacts, failed, is_papers};
use crate::run::measured::Cell;
use ccd_core::order::greater;
use indicatif::HumanCount;
use plotters::style::text_anchor::HPos;

const NAME: &str = "models";
/// The height of a scene's row.
const ROW: f64 = 26.0;
/// The gap between the two panels.
const GUTTER: f64 = 44.0;

type Shown<'a> = (&'a MethodFacts<'a>, Look);
/// The value of a cell that a panel shows.
type Value = fn(&Cell) -> f64;

/// Draws two panels side by side, with a row for each scene and a marker for each model.
pub(super) fn chart(charts: &Charts<'_>) -> Result<Option<Drawing>, ChartError> {
    let shown = charts.shown(&[Family::Model]);
    let mut scenes = charts.measured_scenes();
    scenes.retain(|scene| {
        shown
            .iter()
            .any(|(method, _)| cell_of(charts, scene, method).is_some())
    });
    let cells = || {
        scenes.iter().flat_map(|scene| {
            shown
                .iter()
                .filter_map(|(method, _)| cell_of(charts, scene, method))
        })
    };
    let cost = Axis::logarithmic("time of a query, median, µs", cells().map(|c| c.median_us));
    let error = Axis::logarithmic(
        "mean error of the time of contact, share of duration",
        cells().map(|c| c.mean_error),
    );
    let Some(cost) = cost else {
        return Ok(None);
    };
    let panels: Vec<(Axis, Value)> = [
        Some((cost, (|cell| cell.median_us) as Value)),
        error.map(|axis| (axis, (|cell: &Cell| cell.mean_error) as Value)),
    ]
    .into_iter()
    .flatten()
    .collect();
    let title = "Models of the same mesh, cost and error: left is better";
    let legend = Legend::of(&shown);
    let remarks = ["In brackets: triangles of the body that moves.".to_owned()];
    let height = ROW * scenes.len() as f64;
    let legend_top = HEAD + TOP_MARGIN + height + BOTTOM_MARGIN;
    let remarks_top = legend_top + legend.height() + 0.5 * GUTTER;
    let size = (WIDTH, remarks_top + foot_height(&remarks));
    let svg = Sheet::draw(title, size, |sheet| {
        let subtitle = "At the tolerance 10⁻³; hollow markers: late or missed contacts somewhere, \
                        against the mesh itself";
        head(sheet, title, subtitle)?;
        let rows = Rows {
            charts,
            scenes: &scenes,
            shown: &shown,
        };
        rows.draw(sheet, &panels)?;
        legend.draw(sheet, (MARGIN, legend_top))?;
        foot(sheet, &remarks, remarks_top)
    });
    Ok(Some(Drawing {
        name: NAME.to_owned(),
        title: title.to_owned(),
        svg: svg.map_err(failed(NAME))?,
    }))
}

fn cell_of<'a>(
    charts: &'a Charts<'_>,
    scene: &SceneFacts<'_>,
    method: &MethodFacts<'_>,
) -> Option<&'a Cell> {
    charts
        .cells_of(scene.name, method.name)
        .into_iter()
        .find(|cell| is_papers(cell.tolerance))
}

struct Rows<'a> {
    charts: &'a Charts<'a>,
    scenes: &'a [&'a SceneFacts<'a>],
    shown: &'a [Shown<'a>],
}

impl Rows<'_> {
    fn draw(&self, sheet: &Sheet<'_>, panels: &[(Axis, Value)]) -> Result<(), DrawError> {
        let names: Vec<_> = self
            .scenes
            .iter()
            .map(|scene| format!("{} ({})", scene.name, HumanCount(scene.triangles as u64)))
            .collect();
        let widest = names
            .iter()
            .map(|name| text_width(name, super::sheet::TEXT));
        let left = MARGIN + widest.fold(0.0, greater) + MARGIN;
        let width = (WIDTH - 2.0 * MARGIN - left + GUTTER) / panels.len() as f64 - GUTTER;
        let rows = Axis::counting("", 0, 1);
        for (number, (x, value)) in panels.iter().enumerate() {
            let panel = Panel {
                rect: Rect {
                    left: left + (width + GUTTER) * number as f64,
                    top: HEAD + TOP_MARGIN,
                    width,
                    height: ROW * self.scenes.len() as f64,
                },
                title: "",
                x,
                y: &rows,
                labelled: Labelled {
                    x: Label::Written,
                    y: Label::Left,
                },
            };
            panel.draw(sheet)?;
            for (row, scene) in self.scenes.iter().enumerate() {
                let y = panel.rect.top + ROW * (row as f64 + 0.5);
                self.draw_row(sheet, &panel, (scene, y), *value)?;
            }
        }
        for (row, name) in names.iter().enumerate() {
            let y = HEAD + TOP_MARGIN + ROW * (row as f64 + 0.5);
            let format = TextFormat {
                across: HPos::Right,
                ..TextFormat::default()
            };
            sheet.text(name, (left - 0.8 * MARGIN, y), format)?;
        }
        Ok(())
    }

    fn draw_row(
        &self,
        sheet: &Sheet<'_>,
        panel: &Panel<'_>,
        (scene, y): (&SceneFacts<'_>, f64),
        value: Value,
    ) -> Result<(), DrawError> {
        let ends = [(panel.rect.left, y), (panel.rect.right(), y)];
        sheet.line(&ends, Pen::solid(RULE, 1.0))?;
        for (method, look) in self.shown {
            let Some(cell) = cell_of(self.charts, scene, method) else {
                continue;
            };
            if let Some(share) = panel.x.share(value(cell)) {
                let spot = (panel.rect.left + share * panel.rect.width, y);
                super::panel::mark(sheet, spot, kind(cell), look)?;
            }
        }
        Ok(())
    }
}
