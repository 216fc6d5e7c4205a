//! Converts answers to the views of an HTML page, which `ccd-view` writes.
//!
//! The module is public only because the pages of `ccd-bench` share it. Its interface is not stable.

mod drawn;
mod gap;
mod scene;
mod shown_motions;
#[cfg(test)]
mod tests;
mod verdict;

pub use drawn::drawn_mesh;
pub use gap::{GapOverTime, measure_gap_over_time};
pub(crate) use scene::{DrawnBody, FIXED_COLOR, numbered_body_color, scene_verdict, scene_view};
pub use shown_motions::shown_motions;
pub use verdict::{QueryContext, TimeMeaning};

use anyhow::{Result, bail};
use ccd_core::glam::DVec3;
use ccd_core::{Body, Pose};
use ccd_tables::batch::BodyPair;
use ccd_tables::movements::Movements;
use ccd_tables::results::{ResultRow, Status};
use ccd_view::{Animation, Meshes, ShownBody, ShownContact};
use drawn::feature_corners;
use rigid_ccd::Solver;

/// The colours of body A and body B, in CSS.
pub const BODY_COLORS: [&str; 2] = ["#3a9d6e", "#e6c229"];

/// Makes views of a page from answers about two bodies.
pub struct Painter<'a> {
    bodies: BodyPair<'a>,
    query_context: QueryContext,
    meshes: Meshes,
    mesh_indices: [usize; 2],
    solver: Solver,
}

impl<'a> Painter<'a> {
    /// Creates a painter for answers about two bodies to the queries that `query_context` describes.
    pub fn new(bodies: BodyPair<'a>, query_context: QueryContext) -> Self {
        let mut meshes = Meshes::default();
        let numbers = [bodies.a, bodies.b].map(|body| meshes.add(&drawn_mesh(body)));
        Painter {
            bodies,
            query_context,
            meshes,
            mesh_indices: numbers,
            solver: Solver::new(),
        }
    }

    /// Returns the meshes of both bodies, which all views of this painter draw.
    pub(crate) fn meshes(&self) -> &Meshes {
        &self.meshes
    }

    /// Makes the view of a row: its motions, its contact, and the distance over time.
    ///
    /// # Errors
    /// The motions of the row are out of range, or the row is from a table about other bodies or motions.
    pub fn animate_row(&mut self, movements: &Movements, row: &ResultRow) -> Result<Animation> {
        let start = movements.start_time();
        let duration = movements.duration();
        let time = row.time.map(|time| (time - start).clamp(0.0, duration));
        let [a, b] = movements.poses_at(time.unwrap_or(0.0))?;
        if self.query_context.time_meaning == TimeMeaning::TableTime {
            self.check_distance(row, [a, b])?;
        }
        let contact = time.and_then(|time| self.shown_contact(row, time, [a, b]));
        let measured_at = match (self.query_context.time_meaning, row.time) {
            // A path has one row for each of its poses.
            (TimeMeaning::MeasurementTime, Some(time)) => {
                format!(" at {}", verdict::format_rounded_down(time))
            }
            _ => String::new(),
        };
        let name = format!("{}{measured_at} ({})", row.id, row.status.name());
        let mut view = Animation::new(&name, "", duration);
        let (mut proven, mut nearest) = (None, 0.0);
        if row.status != Status::Error {
            let floor = match (row.status, self.query_context.time_meaning) {
                (Status::Free, TimeMeaning::FirstContact | TimeMeaning::SomeContact) => {
                    self.query_context.query_margin
                }
                _ => 0.0,
            };
            let gap_over_time =
                measure_gap_over_time(&mut self.solver, self.bodies, movements, floor)?;
            view.ghost_times = gap_over_time.ghost_times(duration);
            proven = gap_over_time.least_proven_gap();
            nearest = gap_over_time.least_distance_time();
            view.gap = Some(gap_over_time.gap);
        }
        view.verdict = verdict::verdict(row, self.query_context, start + duration, proven);
        let meshes_and_colors = self.mesh_indices.into_iter().zip(BODY_COLORS);
        let bodies = ["A", "B"]
            .iter()
            .zip(meshes_and_colors)
            .zip(shown_motions(movements)?);
        view.bodies = bodies
            .map(|((name, (mesh, color)), motion)| ShownBody::new(name, mesh, color, motion))
            .collect();
        Ok(Animation {
            start,
            // For bodies that do not touch, show the time at which they are nearest.
            time: match row.status {
                Status::Free => nearest,
                _ => time.unwrap_or(nearest),
            },
            origin: (movements.poses_at(0.0)?[1]
                .transform_point(self.meshes.middle(self.mesh_indices[1])))
            .to_array(),
            contacts: contact.into_iter().collect(),
            ..view
        })
    }

    /// Returns an error if the bodies are farther apart than the row of a table of results says.
    fn check_distance(&mut self, row: &ResultRow, [a, b]: [Pose; 2]) -> Result<()> {
        let (Some(time), Some(reported_upper)) = (row.time, row.distance_upper) else {
            return Ok(());
        };
        let answer = (self.solver).distance((self.bodies.a, a), (self.bodies.b, b))?;
        let lower = answer.outcome.lower();
        // The table rounds the poses.
        if lower > reported_upper + answer.tolerance {
            bail!(
                "at {time} the bodies are at least {lower} apart, but the row says at most {reported_upper}: the row is \
                 about other bodies, or about other motions"
            );
        }
        Ok(())
    }

    /// Returns the touching or nearest points of a row, with their features.
    fn shown_contact(&self, row: &ResultRow, time: f64, poses: [Pose; 2]) -> Option<ShownContact> {
        let point = |cells: [Option<f64>; 3]| {
            let [x, y, z] = cells;
            Some(DVec3::new(x?, y?, z?))
        };
        let witnesses = [point(row.witness_a)?, point(row.witness_b)?];
        let feature_corners = |side: usize, body: &Body, feature: &Option<String>| {
            let feature = feature.as_deref().unwrap_or_default();
            feature_corners(body, &poses[side], feature, witnesses[side])
        };
        Some(ShownContact {
            time,
            words: verdict::describe_contact(row),
            witnesses: Some(witnesses),
            normal: point(row.normal),
            highlight_a: feature_corners(0, self.bodies.a, &row.feature_a),
            highlight_b: feature_corners(1, self.bodies.b, &row.feature_b),
        })
    }
}
