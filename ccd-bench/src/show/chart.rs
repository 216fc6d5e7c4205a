//! Draws charts of measurements as SVG files from the tables alone.
//!
//! | chart | shows |
//! |---|---|
//! | `pareto` | time against error, a line for each method over its tolerances |
//! | `stability`, `growth` | how far each method follows each family of scenes, and how its cost grows |
//!
//! A method that was late or missed a contact anywhere has hollow markers everywhere, and no point
//! on a plane of time and error: its accuracy when it is right is no merit.

mod heat_map;
mod pareto;
mod plane;
mod sheet;
mod style;
#[cfg(test)]
mod tests;

pub use heat_map::{
    COST_GROWTH_TEXTS, HeatCell, HeatMap, HeatMapTexts, HeatRow, SOLVED_RANGE_TEXTS,
};

use crate::method::Method;
use crate::run::measured::MeasurementCell;
use anyhow::{Result, ensure};
use plane::StyledMethod;

/// The measurements that all charts show.
#[derive(Clone, Copy, Debug)]
pub struct ChartData<'a> {
    /// The measurements of every method on every scene at every tolerance, with medians that [can be
    /// compared](super::comparable).
    pub cells: &'a [MeasurementCell],
    /// The scenes in display order; cells of other scenes are left out.
    pub scenes: &'a [&'a str],
    /// The methods in display order; cells of other methods are left out.
    pub methods: &'a [ChartedMethod<'a>],
}

/// The name of a method, and the family to which it belongs on charts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ChartedMethod<'a> {
    /// The name of the method in the tables.
    pub name: &'a str,
    /// Whether the method is this project's, a published one or a library.
    pub method_family: MethodFamily,
}

/// Where a method comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MethodFamily {
    /// The method is this project's.
    ThisProject,
    /// The method is published, and built here for comparison.
    Rival,
    /// The method is a call of a peer library.
    Peer,
}

impl ChartData<'_> {
    /// Draws the chart of time against error. Returns an SVG file as text, or `None` if no time was measured.
    ///
    /// # Errors
    /// If no row of the table is of a known scene and a known method, or the drawing library fails.
    pub fn draw_pareto_chart(&self) -> Result<Option<String>> {
        ensure!(
            !self.measured_scenes().is_empty(),
            "nothing to draw: no row of the table is of a known scene and a known method"
        );
        pareto::draw_chart(self)
    }

    /// Returns true if the method was late or missed a contact in any cell of the data.
    pub fn is_unsafe(&self, method: &str) -> bool {
        self.cells
            .iter()
            .any(|cell| cell.method == method && cell.has_unsafe_answers())
    }

    /// Returns the scenes for which there are measurements, in display order.
    fn measured_scenes(&self) -> Vec<&str> {
        let has_cells = |scene: &&str| {
            let of = |method: &ChartedMethod<'_>| !self.cells_of(scene, method.name).is_empty();
            self.methods.iter().any(of)
        };
        self.scenes.iter().copied().filter(has_cells).collect()
    }

    /// Returns the measurements of a method on a scene, the coarsest tolerance first.
    fn cells_of(&self, scene: &str, method: &str) -> Vec<&MeasurementCell> {
        let mut cells: Vec<_> = self
            .cells
            .iter()
            .filter(|cell| cell.scene == scene && cell.method == method)
            .collect();
        cells.sort_by(|a, b| b.tolerance.total_cmp(&a.tolerance));
        cells
    }

    /// Returns the measured methods of some families, each with its style.
    fn methods_with_styles(&self) -> Vec<StyledMethod<'_>> {
        let measured = |name: &str| {
            let of = |scene: &&str| !self.cells_of(scene, name).is_empty();
            self.scenes.iter().any(of)
        };
        self.methods
            .iter()
            .zip(style::method_styles(self.methods, |name| {
                self.is_unsafe(name)
            }))
            .filter(|(method, _)| measured(method.name))
            .collect()
    }
}

impl<'a> ChartedMethod<'a> {
    /// Returns the facts about the method with this name; `None` for this project's default on other kinds of pieces,
    /// which only tables show. An unknown name counts as a peer library.
    pub fn from_name(name: &'a str) -> Option<Self> {
        let family = match Method::from_name(name) {
            Some(method) if method.has_non_default_pieces() => return None,
            Some(Method::ThisProject(..)) => MethodFamily::ThisProject,
            Some(Method::Rival(_)) => MethodFamily::Rival,
            Some(Method::Peer(_) | Method::Script(_)) | None => MethodFamily::Peer,
        };
        Some(ChartedMethod {
            name,
            method_family: family,
        })
    }
}

impl MethodFamily {
    /// Returns the heading of the family in the legend.
    pub(in crate::show) fn legend_heading(self) -> &'static str {
        match self {
            MethodFamily::ThisProject => "this project",
            MethodFamily::Rival => "published rivals",
            MethodFamily::Peer => "peer libraries",
        }
    }
}
