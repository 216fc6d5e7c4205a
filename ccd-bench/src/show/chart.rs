//! Charts of what was measured: SVG files drawn from the tables alone.
//!
//! | chart | shows |
//! |---|---|
//! | `pareto`, `pareto-small` | time against error, a line for each method over its tolerances |
//! | `tolerance`, `steps` | time and steps against tolerance |
//! | `triangles` | time against the size of the mesh |
//! | `models` | models of the same mesh: time and error |
//! | `figure-N` | the paper's figures, trial by trial |
//!
//! A method that was late or missed a contact anywhere has hollow markers everywhere, and no point on
//! a plane of time and error: how accurate it is when it is right is no merit.

mod axis;
mod figures;
mod grid;
mod legend;
mod look;
mod models;
mod panel;
mod pareto;
mod sheet;
mod sweep;
#[cfg(test)]
mod tests;
mod triangles;

use crate::run::measured::{Cell, Trial};
use look::{Fill, Look};
use plotters::style::Color;
use std::path::{Path, PathBuf};
use std::{fs, io};

/// The paper's tolerance `[FAST06 §6.2]`, that charts of one tolerance are drawn at.
pub const PAPER_TOLERANCE: f64 = 1e-3;

/// What charts are drawn from.
#[derive(Clone, Copy, Debug)]
pub struct Charts<'a> {
    /// Every method on every scene at every tolerance.
    pub cells: &'a [Cell],
    /// Single queries, in the order of their scene.
    pub trials: &'a [Trial],
    /// The scenes, in the order in which they are shown; cells of others are left out.
    pub scenes: &'a [SceneFacts<'a>],
    /// The methods, in the order in which they are shown; cells of others are left out.
    pub methods: &'a [MethodFacts<'a>],
    /// The scenes that the small chart of time against error shows.
    pub headline: &'a [&'a str],
    /// The methods that the paper's figures are redrawn for.
    pub published: &'a [&'a str],
}

/// What has to be known of a scene to draw it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SceneFacts<'a> {
    /// As in the tables.
    pub name: &'a str,
    /// What moves: scenes of one shape are joined by a line over its sizes.
    pub shape: &'a str,
    /// The triangles of the mesh that moves.
    pub triangles: usize,
    /// The paper's figure that shows it.
    pub figure: Option<u8>,
}

/// What has to be known of a method to draw it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MethodFacts<'a> {
    /// As in the tables.
    pub name: &'a str,
    /// Whose it is.
    pub family: Family,
    /// What the legend calls it.
    pub label: &'a str,
}

/// Whose a method is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Family {
    /// This project's.
    Ours,
    /// Published, built here to be compared with.
    Rival,
    /// A library in use.
    Peer,
    /// This project's, over another model of the same mesh: in the chart of models only.
    Model,
}

/// A chart.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Drawing {
    /// What its file is called, without the extension.
    pub name: String,
    /// What it shows, in a sentence.
    pub title: String,
    /// The text of its file.
    pub svg: String,
}

/// Why charts cannot be had.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ChartError {
    /// The table has no row of a known scene and a known method.
    #[error("nothing to draw: no row of the table is of a known scene and a known method")]
    NothingToDraw,
    /// The drawing library gave up.
    #[error("chart {name}: {reason}")]
    Drawing {
        /// Which chart.
        name: String,
        /// As the library says it.
        reason: String,
    },
    /// A file cannot be written.
    #[error("cannot write {}: {source}", path.display())]
    Write {
        /// Which.
        path: PathBuf,
        /// Why.
        source: io::Error,
    },
}

impl Charts<'_> {
    /// Writes `NAME.svg` of every chart there is something to draw for; returns their paths.
    ///
    /// # Errors
    /// [`ChartError::NothingToDraw`] of empty tables, [`ChartError::Write`] when a file cannot be
    /// written.
    pub fn write(&self, directory: &Path) -> Result<Vec<PathBuf>, ChartError> {
        self.drawings()?
            .iter()
            .map(|drawing| {
                let path = directory.join(format!("{}.svg", drawing.name));
                match fs::write(&path, &drawing.svg) {
                    Ok(()) => Ok(path),
                    Err(source) => Err(ChartError::Write { path, source }),
                }
            })
            .collect()
    }

    /// Every chart there is something to draw for.
    ///
    /// # Errors
    /// [`ChartError::NothingToDraw`] of empty tables.
    pub fn drawings(&self) -> Result<Vec<Drawing>, ChartError> {
        if self.measured_scenes().is_empty() {
            return Err(ChartError::NothingToDraw);
        }
        let mut drawings = Vec::new();
        drawings.extend(pareto::all_scenes(self)?);
        drawings.extend(pareto::headline(self)?);
        drawings.extend(triangles::chart(self)?);
        drawings.extend(sweep::tolerance(self)?);
        drawings.extend(sweep::steps(self)?);
        drawings.extend(models::chart(self)?);
        drawings.extend(figures::charts(self)?);
        Ok(drawings)
    }

    /// Whether the method was late or missed a contact anywhere.
    pub fn is_unsafe(&self, method: &str) -> bool {
        self.cells
            .iter()
            .any(|cell| cell.method == method && cell.is_unsafe())
    }

    /// The methods, each with the colour it has in every chart, as HTML writes it.
    pub fn colours(&self) -> Vec<(MethodFacts<'_>, String)> {
        let looks = look::looks(self.methods, |_| Fill::Solid);
        let written = |look: &Look| {
            let (red, green, blue) = look.colour.rgb();
            format!("#{red:02x}{green:02x}{blue:02x}")
        };
        let methods = self.methods.iter().copied();
        methods.zip(looks.iter().map(written)).collect()
    }

    /// The scenes that there are cells of.
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

    /// A method's cells of a scene, the coarsest tolerance first.
    fn cells_of(&self, scene: &str, method: &str) -> Vec<&Cell> {
        let mut cells: Vec<_> = self
            .cells
            .iter()
            .filter(|cell| cell.scene == scene && cell.method == method)
            .collect();
        cells.sort_by(|a, b| b.tolerance.total_cmp(&a.tolerance));
        cells
    }

    /// Methods of some families that there are cells of, each with its look.
    fn shown(&self, families: &[Family]) -> Vec<(&MethodFacts<'_>, Look)> {
        let measured = |name: &str| {
            let known = |cell: &&Cell| self.scenes.iter().any(|s| s.name == cell.scene);
            self.cells
                .iter()
                .filter(known)
                .any(|cell| cell.method == name)
        };
        let fill = |name: &str| match self.is_unsafe(name) {
            true => Fill::Hollow,
            false => Fill::Solid,
        };
        self.methods
            .iter()
            .zip(look::looks(self.methods, fill))
            .filter(|(method, _)| families.contains(&method.family) && measured(method.name))
            .collect()
    }
}

impl Family {
    /// Those that are compared with each other.
    const COMPARED: [Family; 3] = [Family::Ours, Family::Rival, Family::Peer];

    /// What the legend calls it.
    fn title(self) -> &'static str {
        match self {
            Family::Ours => "this project",
            Family::Rival => "published rivals",
            Family::Peer => "peer libraries",
            Family::Model => "models",
        }
    }
}

/// Whether a tolerance is the paper's, but for how a table writes it.
fn is_papers(tolerance: f64) -> bool {
    (tolerance / PAPER_TOLERANCE - 1.0).abs() < 1e-9
}

/// Names the chart that the library gave up on.
fn failed(name: &str) -> impl Fn(sheet::DrawError) -> ChartError {
    move |error| ChartError::Drawing {
        name: name.to_owned(),
        reason: error.to_string(),
    }
}
