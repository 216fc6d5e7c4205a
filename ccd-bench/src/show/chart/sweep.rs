//! The cost of a tighter tolerance: one panel for each scene.

use super::axis::Axis;
use super::grid::Grid;
use super::legend::Legend;
use super::panel::{Kind, Point};
use super::pareto::kind;
use super::{ChartError, Charts, Drawing, Family, SAME_ROWS, failed};
use crate::run::measured::Cell;

/// Draws time against tolerance.
pub(super) fn tolerance(charts: &Charts<'_>) -> Result<Option<Drawing>, ChartError> {
    Sweep {
        name: "tolerance",
        title: "Time against tolerance: lower and flatter is better",
        label: "time of a query, median, µs",
        value: |cell| cell.median_us,
        kind,
        remark: Some(SAME_ROWS),
    }
    .draw(charts)
}

/// Draws steps against tolerance.
pub(super) fn steps(charts: &Charts<'_>) -> Result<Option<Drawing>, ChartError> {
    Sweep {
        name: "steps",
        title: "Steps in time against tolerance: lower and flatter is better",
        label: "steps in time of a query, mean",
        value: |cell| cell.mean_steps,
        kind: |_| Kind::Measured,
        remark: None,
    }
    .draw(charts)
}

struct Sweep {
    name: &'static str,
    title: &'static str,
    label: &'static str,
    value: fn(&Cell) -> f64,
    kind: fn(&Cell) -> Kind,
    remark: Option<&'static str>,
}

impl Sweep {
    fn draw(&self, charts: &Charts<'_>) -> Result<Option<Drawing>, ChartError> {
        let scenes = charts.measured_scenes();
        let shown = charts.shown(&Family::COMPARED);
        let cells = || {
            scenes.iter().flat_map(|scene| {
                shown
                    .iter()
                    .flat_map(|(method, _)| charts.cells_of(scene.name, method.name))
            })
        };
        let axes = (
            Axis::logarithmic("tolerance, as a length", cells().map(|c| c.tolerance)),
            Axis::logarithmic(self.label, cells().map(self.value)),
        );
        let (Some(x), Some(y)) = axes else {
            return Ok(None);
        };
        let grid = Grid {
            title: self.title,
            subtitle: "One line per method; hollow markers: late or missed contacts somewhere",
            remarks: self.remarks(cells()),
            legend: Legend::of(&shown),
            x,
            y,
            columns: 3,
            height: 190.0,
            right_margin: 0.0,
        };
        let titles: Vec<_> = scenes.iter().map(|scene| scene.name).collect();
        let svg = grid.draw(&titles, |sheet, number, panel| {
            for (method, look) in &shown {
                let cells = charts.cells_of(scenes[number].name, method.name);
                let points: Vec<_> = cells
                    .iter()
                    .map(|cell| Point {
                        x: cell.tolerance,
                        y: (self.value)(cell),
                        kind: (self.kind)(cell),
                    })
                    .collect();
                panel.series(sheet, &points, look)?;
            }
            Ok(())
        });
        Ok(Some(Drawing {
            name: self.name.to_owned(),
            title: format!("{}. One panel for each scene.", self.title),
            svg: svg.map_err(failed(self.name))?,
        }))
    }

    fn remarks<'c>(&self, mut cells: impl Iterator<Item = &'c Cell>) -> Vec<String> {
        let mut remarks: Vec<String> = self.remark.map(str::to_owned).into_iter().collect();
        if cells.any(|cell| (self.kind)(cell) == Kind::AtLeast) {
            remarks.push(
                "Arrow up: half of the queries or more were cut off; the time is at least that."
                    .to_owned(),
            );
        }
        remarks
    }
}
