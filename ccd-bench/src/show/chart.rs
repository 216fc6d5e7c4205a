//! Charts of measurements: SVG files drawn from the tables alone.
//!
//! | chart | shows |
//! |---|---|
//! | `pareto` | time against error, a line for each method over its tolerances |
//! | `triangles` | time against the size of the mesh |
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
mod triangles;

pub use heat_map::{GROWTH, HeatCell, HeatKind, HeatMap, HeatRow, REACH};

use crate::run::measured::Cell;
use anyhow::{Result, ensure};
use plane::Shown;

/// The paper's tolerance `[FAST06 §6.2]`, used by charts of one tolerance.
pub const PAPER_TOLERANCE: f64 = 1e-3;

/// The remark on medians over different rows.
const SAME_ROWS: &str = "A method that was asked fewer rows than ours is drawn at our median, times the median ratio on the \
                         rows that both were asked.";

/// The data of all charts.
#[derive(Clone, Copy, Debug)]
pub struct Charts<'a> {
    /// Every method on every scene at every tolerance, with medians that [can be compared](super::comparable).
    pub cells: &'a [Cell],
    /// The scenes in display order; cells of other scenes are left out.
    pub scenes: &'a [SceneFacts<'a>],
    /// The methods in display order; cells of other methods are left out.
    pub methods: &'a [MethodFacts<'a>],
}

/// The facts about a scene that charts need.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SceneFacts<'a> {
    /// The name in the tables.
    pub name: &'a str,
    /// The moving shape; a line over the sizes joins scenes of the same shape.
    pub shape: &'a str,
    /// The number of triangles of the moving mesh.
    pub triangles: usize,
}

/// The facts about a method that charts need.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MethodFacts<'a> {
    /// The name in the tables.
    pub name: &'a str,
    /// The family.
    pub family: Family,
}

/// The origin of a method.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Family {
    /// This project.
    Ours,
    /// A published method, built here for comparison.
    Rival,
    /// A library in use.
    Peer,
    /// This project's method on another model of the same mesh, shown in tables only.
    Model,
}

/// A chart.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Drawing {
    /// The name of its file, without the extension.
    pub name: String,
    /// The content of its file.
    pub svg: String,
}

impl Charts<'_> {
    /// Returns every chart that has data.
    ///
    /// # Errors
    /// If no row of the table is of a known scene and a known method, or the drawing library fails.
    pub fn drawings(&self) -> Result<Vec<Drawing>> {
        ensure!(
            !self.measured_scenes().is_empty(),
            "nothing to draw: no row of the table is of a known scene and a known method"
        );
        let charts = [pareto::chart(self)?, triangles::chart(self)?];
        Ok(charts.into_iter().flatten().collect())
    }

    /// Returns true if the method was late or missed a contact in any cell.
    pub fn is_unsafe(&self, method: &str) -> bool {
        self.cells
            .iter()
            .any(|cell| cell.method == method && cell.is_unsafe())
    }

    /// Returns the scenes that have cells.
    fn measured_scenes(&self) -> Vec<&SceneFacts<'_>> {
        let has_cells = |scene: &&SceneFacts<'_>| {
            let of = |method: &MethodFacts<'_>| !self.cells_of(scene.name, method.name).is_empty();
            self.methods.iter().any(of)
        };
        self.scenes.iter().filter(has_cells).collect()
    }

    /// Returns the cells of a method on a scene, the coarsest tolerance first.
    fn cells_of(&self, scene: &str, method: &str) -> Vec<&Cell> {
        let mut cells: Vec<_> = self
            .cells
            .iter()
            .filter(|cell| cell.scene == scene && cell.method == method)
            .collect();
        cells.sort_by(|a, b| b.tolerance.total_cmp(&a.tolerance));
        cells
    }

    /// Returns the methods of some families that have cells, each with its style.
    fn shown(&self, families: &[Family]) -> Vec<Shown<'_>> {
        let measured = |name: &str| {
            let of = |scene: &SceneFacts<'_>| !self.cells_of(scene.name, name).is_empty();
            self.scenes.iter().any(of)
        };
        self.methods
            .iter()
            .zip(style::styles(self.methods, |name| self.is_unsafe(name)))
            .filter(|(method, _)| families.contains(&method.family) && measured(method.name))
            .collect()
    }
}

impl Family {
    /// The families that charts compare.
    const COMPARED: [Family; 3] = [Family::Ours, Family::Rival, Family::Peer];

    /// Returns the heading in the legend.
    pub(in crate::show) fn title(self) -> &'static str {
        match self {
            Family::Ours => "this project",
            Family::Rival => "published rivals",
            Family::Peer => "peer libraries",
            Family::Model => "models",
        }
    }
}

/// Returns true if a tolerance is the paper's, up to its rounding in a table.
fn is_papers(tolerance: f64) -> bool {
    (tolerance / PAPER_TOLERANCE - 1.0).abs() < 1e-9
}
