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

mod axis;
mod grid;
mod heat_map;
mod legend;
mod panel;
mod pareto;
mod sheet;
mod style;
#[cfg(test)]
mod tests;
mod triangles;

pub use heat_map::{HeatCell, HeatKind, HeatMap, HeatRow};

use crate::run::measured::Cell;
use std::io;
use std::path::{Path, PathBuf};
use style::{Fill, MethodStyle};

/// The paper's tolerance `[FAST06 §6.2]`, used by charts of one tolerance.
pub const PAPER_TOLERANCE: f64 = 1e-3;

/// The remark on medians over different rows.
const SAME_ROWS: &str = "A method that was asked fewer rows than ours is drawn at our median, times the median ratio on \
                         the rows that both were asked.";

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
    /// The label in the legend.
    pub label: &'a str,
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
    /// The description, a sentence.
    pub title: String,
    /// The content of its file.
    pub svg: String,
}

/// Charts cannot be made.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ChartError {
    /// The table has no row with a known scene and a known method.
    #[error("nothing to draw: no row of the table is of a known scene and a known method")]
    NothingToDraw,
    /// The drawing library failed.
    #[error("chart {name}: {reason}")]
    Drawing {
        /// The chart.
        name: String,
        /// The library's message.
        reason: String,
    },
    /// A file cannot be written.
    #[error("cannot write {}: {source}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// The cause.
        source: io::Error,
    },
}

impl Charts<'_> {
    /// Writes `NAME.svg` of every chart that has data. Returns their paths.
    ///
    /// # Errors
    /// [`ChartError::NothingToDraw`] for empty tables, [`ChartError::Write`] if a file cannot be
    /// written.
    pub fn write(&self, directory: &Path) -> Result<Vec<PathBuf>, ChartError> {
        self.drawings()?
            .iter()
            .map(|drawing| {
                let path = directory.join(format!("{}.svg", drawing.name));
                match ccd_file::write(&path, |out| out.write_all(drawing.svg.as_bytes())) {
                    Ok(()) => Ok(path),
                    Err(source) => Err(ChartError::Write { path, source }),
                }
            })
            .collect()
    }

    /// Returns every chart that has data.
    ///
    /// # Errors
    /// [`ChartError::NothingToDraw`] for empty tables.
    pub fn drawings(&self) -> Result<Vec<Drawing>, ChartError> {
        if self.measured_scenes().is_empty() {
            return Err(ChartError::NothingToDraw);
        }
        let mut drawings = Vec::new();
        drawings.extend(pareto::chart(self)?);
        drawings.extend(triangles::chart(self)?);
        Ok(drawings)
    }

    /// Returns true if the method was late or missed a contact in any cell.
    pub fn is_unsafe(&self, method: &str) -> bool {
        self.cells
            .iter()
            .any(|cell| cell.method == method && cell.is_unsafe())
    }

    /// Returns the scenes that have cells.
    fn measured_scenes(&self) -> Vec<&SceneFacts<'_>> {
        let of_known = |scene: &str| {
            let known = |cell: &&Cell| self.methods.iter().any(|m| m.name == cell.method);
            self.cells
                .iter()
                .filter(known)
                .any(|cell| cell.scene == scene)
        };
        self.scenes.iter().filter(|s| of_known(s.name)).collect()
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
    fn shown(&self, families: &[Family]) -> Vec<(&MethodFacts<'_>, MethodStyle)> {
        let measured = |name: &str| {
            let known = |cell: &&Cell| self.scenes.iter().any(|s| s.name == cell.scene);
            self.cells
                .iter()
                .filter(known)
                .any(|cell| cell.method == name)
        };
        let fill = |name: &str| {
            if self.is_unsafe(name) {
                Fill::Hollow
            } else {
                Fill::Solid
            }
        };
        self.methods
            .iter()
            .zip(style::styles(self.methods, fill))
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

/// Returns a constructor of the error for a chart that the library failed to draw.
fn failed(name: &str) -> impl Fn(sheet::DrawError) -> ChartError {
    move |error| ChartError::Drawing {
        name: name.to_owned(),
        reason: error.to_string(),
    }
}
