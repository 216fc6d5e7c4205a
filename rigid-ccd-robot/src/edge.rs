//! Questions about edges: a robot moves between two configurations, all joints at constant rates.

mod boxes;
mod displacement;
mod exact;
pub(crate) mod kinematics;
mod rounding;
mod search;

use crate::cell::Cell;
use crate::error::EdgeError;
use rigid_ccd::Settings;
use search::{Candidate, Search};

/// Answers questions about edges in a cell, one after another.
pub struct EdgeSolver<'c> {
    cell: &'c Cell,
    search: Search<'c>,
}

/// A contact on an edge: which bodies touch, and where.
#[derive(Clone, Debug, PartialEq)]
pub struct EdgeContact {
    /// The share of the edge at which the bodies touch, from 0 to 1.
    pub share: f64,
    /// The name of the link that touches something.
    pub link: String,
    /// What it touches.
    pub other: Other,
}

/// What a link touches.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Other {
    /// An obstacle, by its name.
    Obstacle(String),
    /// Another link, by its name.
    Link(String),
}

impl Cell {
    /// Returns a solver for edges in this cell. It keeps memory from one question to the next.
    pub fn edges(&self) -> EdgeSolver<'_> {
        EdgeSolver {
            cell: self,
            search: Search::new(self),
        }
    }
}

impl EdgeSolver<'_> {
    /// Sets the tolerance and the margin of the questions that follow. Limits of work and time are for each query of two
    /// bodies that an edge leaves to the engine.
    #[must_use]
    pub fn with_settings(mut self, settings: Settings) -> Self {
        self.search.settings = settings;
        self
    }

    /// Returns whether the robot touches nothing between two configurations, itself included.
    ///
    /// # Guarantee
    /// On a free edge all pairs that are checked stay apart by more than the margin. On other edges a pair comes within
    /// margin + tolerance.
    ///
    /// # Errors
    /// [`EdgeError`].
    pub fn is_free(&mut self, from: &[f64], to: &[f64]) -> Result<bool, EdgeError> {
        Ok(self.any_contact(from, to)?.is_none())
    }

    /// Returns any contact between two configurations; perhaps not the first one.
    ///
    /// # Errors
    /// [`EdgeError`].
    pub fn any_contact(
        &mut self,
        from: &[f64],
        to: &[f64],
    ) -> Result<Option<EdgeContact>, EdgeError> {
        for configuration in [from, to] {
            self.cell.robot().check(configuration)?;
        }
        let settings = self.search.settings.check();
        settings.map_err(rigid_ccd::Error::from)?;
        let found = self.search.any_contact(from, to)?;
        Ok(found.map(|(share, pair)| self.contact(share, pair)))
    }

    fn contact(&self, share: f64, pair: Candidate) -> EdgeContact {
        let cell = self.cell;
        let [a, b] = pair.owners(cell.parts());
        let name = |body| cell.robot().links()[cell.link_of(body)].name.clone();
        EdgeContact {
            share,
            link: name(a),
            other: if b < cell.robot_body_count() {
                Other::Link(name(b))
            } else {
                Other::Obstacle(cell.obstacle_name(b).to_owned())
            },
        }
    }
}

#[cfg(test)]
mod tests;
