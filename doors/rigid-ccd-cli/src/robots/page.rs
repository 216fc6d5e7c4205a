//! Draws a robot that follows a path, with the distance of the nearest pair over it.

use super::path_table::TablePath;
use crate::picture::{FIXED_COLOR, drawn_mesh, numbered_body_color};
use anyhow::{Result, bail};
use ccd_core::order::greater;
use ccd_view::{
    Animation, GapCurve, GapSample, Keyframe, Meshes, ShownBody, ShownContact, ShownMotion,
};
use rigid_ccd::glam::DVec3;
use rigid_ccd::{Body, Motion, Pose};
use rigid_ccd_robot::{Cell, CellSolver, Item, PathAnswer, PathContact, PathOutcome, PathPoint};
use std::collections::HashMap;

/// The greatest number of poses of a path that are drawn, and of ranges in which the distance is measured.
pub(crate) const MAX_RANGES: usize = 512;
/// The greatest number of halvings of a segment.
const MAX_HALVINGS: u32 = 6;

/// Makes the animations of one page, on which all have the same bodies.
pub(crate) struct RobotPainter<'c> {
    cell: &'c Cell,
    meshes: Meshes,
    drawn: Vec<DrawnBody>,
}

/// The mesh that draws a body, and its pose.
struct DrawnBody {
    /// The number of the mesh.
    mesh: usize,
    /// The pose of the mesh in the body's frame.
    pose: Pose,
}

impl<'c> RobotPainter<'c> {
    pub(crate) fn new(cell: &'c Cell) -> Result<Self> {
        let mut meshes = Meshes::default();
        let mut mesh_by_body: HashMap<*const Body, usize> = HashMap::new();
        let at_rest = cell.robot().configuration_nearest_zero();
        let bodies = cell.placed_bodies(&at_rest)?;
        let size = size_without_planes(cell, &bodies);
        let mut drawn = Vec::new();
        for (number, (_, body, pose)) in bodies.into_iter().enumerate() {
            drawn.push(if cell.is_plane(number) {
                let base = pose.inverse().transform_point(DVec3::ZERO);
                DrawnBody {
                    mesh: meshes.add(&drawn_mesh(&Body::cuboid([size, size, 0.0])?)),
                    pose: Pose::at(base.with_z(0.0))?,
                }
            } else {
                DrawnBody {
                    mesh: *mesh_by_body
                        .entry(body)
                        .or_insert_with(|| meshes.add(&drawn_mesh(body))),
                    pose: Pose::IDENTITY,
                }
            });
        }
        Ok(RobotPainter {
            cell,
            drawn,
            meshes,
        })
    }

    /// Returns the meshes that all animations of this painter draw.
    pub(crate) fn meshes(&self) -> &Meshes {
        &self.meshes
    }

    /// Makes the animation of a path. The clearance is the solver's margin.
    pub(crate) fn animation(
        &self,
        solver: &mut CellSolver<'c>,
        path: &TablePath,
        clearance: f64,
    ) -> Result<Animation> {
        let configurations = &path.configurations;
        let segments = configurations.len() - 1;
        if segments > MAX_RANGES {
            bail!(
                "{}: a path of {segments} segments is too long to draw: at most {MAX_RANGES}",
                path.id
            );
        }
        let halvings = halvings(segments);
        let ranges = solver.distance_curve(configurations, halvings)?;
        let first = solver.first_contact(configurations)?;
        let seconds =
            |time: f64| path.table_time_rounded_down(time) - path.table_time_rounded_down(0.0);
        let mut gap = GapCurve {
            unit: Some("mm".to_owned()),
            ..GapCurve::default()
        };
        for range in &ranges {
            let closest = &range.closest;
            let (lower, upper) = (1e3 * closest.lower(), 1e3 * closest.upper());
            gap.proven.push([seconds(range.from.time()), lower]);
            gap.proven.push([seconds(range.to.time()), lower]);
            if let Some(nearest) = closest.nearest() {
                let time = seconds(nearest.at.time());
                gap.points.push(GapSample { time, lower, upper });
            }
        }
        let least = ranges
            .iter()
            .filter_map(|range| Some((range.closest.upper(), range.closest.nearest()?)));
        let nearest = least.reduce(|one, other| if other.0 < one.0 { other } else { one });
        let contact = first
            .outcome
            .nearest()
            .or(nearest.map(|(_, nearest)| nearest));
        Ok(Animation {
            start: path.table_time_rounded_down(0.0),
            time: contact.map_or(0.0, |contact| seconds(contact.at.time())),
            bodies: self.shown_bodies(path, halvings)?,
            gap: Some(gap).filter(|gap| !gap.points.is_empty()),
            contacts: contact
                .iter()
                .map(|contact| shown_contact(contact, &seconds))
                .collect(),
            ..Animation::new(
                &path.id,
                &verdict(&first, nearest, clearance),
                seconds(segments as f64),
            )
        })
    }

    /// Returns the bodies of the cell with their motions along a path.
    fn shown_bodies(&self, path: &TablePath, halvings: u32) -> Result<Vec<ShownBody>> {
        let mut poses: Vec<Vec<(f64, Pose)>> = vec![Vec::new(); self.drawn.len()];
        let start = path.table_time_rounded_down(0.0);
        for (time, configuration) in samples(&path.configurations, halvings) {
            let seconds = path.table_time_rounded_down(time) - start;
            let placed = self.cell.placed_bodies(&configuration)?;
            let drawn = self.drawn.iter().zip(placed);
            for (keys, (drawn, (_, _, pose))) in poses.iter_mut().zip(drawn) {
                keys.push((seconds, pose.compose(&drawn.pose)));
            }
        }
        let items = self.cell.placed_bodies(&path.configurations[0])?;
        let mut known_items: Vec<Item<'_>> = Vec::new();
        let bodies = items.iter().zip(&self.drawn).zip(poses);
        let bodies = bodies.map(|(((item, ..), drawn), keys)| {
            // All bodies of a link have its colour.
            let number = known_items.iter().position(|other| other == item);
            let number = number.unwrap_or_else(|| {
                known_items.push(*item);
                known_items.len() - 1
            });
            let color = match item {
                Item::Obstacle(_) => FIXED_COLOR.to_owned(),
                _ => numbered_body_color(number),
            };
            ShownBody::new(item.name(), drawn.mesh, &color, shown_motion(&keys))
        });
        Ok(bodies.collect())
    }
}

/// Returns an upper bound on the distance of the cell's bodies, except planes, from the base. A plane is drawn as a square
/// of this size.
fn size_without_planes(cell: &Cell, bodies: &[(Item<'_>, &Body, Pose)]) -> f64 {
    let others = bodies.iter().enumerate();
    let others = others.filter(|&(number, _)| !cell.is_plane(number));
    let sizes =
        others.map(|(_, (_, body, pose))| pose.translation().length() + body.bounding_radius());
    sizes.fold(0.0, greater)
}

/// Returns the number of halvings of each segment of a path for the curve of its distances.
pub(crate) fn halvings(segments: usize) -> u32 {
    let mut halvings = 0;
    while halvings < MAX_HALVINGS && segments << (halvings + 1) <= MAX_RANGES {
        halvings += 1;
    }
    halvings
}

/// Returns configurations along a path at equal steps, each with its time in segments.
fn samples(configurations: &[Vec<f64>], halvings: u32) -> Vec<(f64, Vec<f64>)> {
    let steps = 1usize << halvings;
    let mut samples = Vec::new();
    for (segment, two) in configurations.windows(2).enumerate() {
        for step in 0..steps {
            let fraction = step as f64 / steps as f64;
            let between = two[0]
                .iter()
                .zip(&two[1])
                .map(|(from, to)| from + fraction * (to - from));
            samples.push((segment as f64 + fraction, between.collect()));
        }
    }
    let last = configurations.len() - 1;
    samples.push((last as f64, configurations[last].clone()));
    samples
}

/// Returns the motion through poses, from each to the next by the shortest rotation.
fn shown_motion(keys: &[(f64, Pose)]) -> ShownMotion {
    let first = keys[0].1;
    if keys.iter().all(|(_, pose)| *pose == first) {
        return ShownMotion::from(&Motion::still(first));
    }
    let rotation_vectors = keys.windows(2).map(|pair| {
        let rotation = pair[1].1.rotation() * pair[0].1.rotation().conjugate();
        // The same rotation, by less than half a turn.
        let rotation = if rotation.w < 0.0 {
            -rotation
        } else {
            rotation
        };
        rotation.to_scaled_axis()
    });
    let rotation_vectors = rotation_vectors.chain([DVec3::ZERO]);
    let keys = keys
        .iter()
        .zip(rotation_vectors)
        .map(|((time, pose), rotation)| Keyframe::new(*time, pose, pose.translation(), rotation));
    ShownMotion::Keyframes {
        center: [0.0; 3],
        keys: keys.collect(),
    }
}

fn shown_contact(contact: &PathContact<'_>, seconds: &impl Fn(f64) -> f64) -> ShownContact {
    let time = seconds(contact.at.time());
    let [a, b] = contact.items.map(Item::name);
    ShownContact {
        time,
        words: format!("{a} and {b}"),
        witnesses: contact.witnesses,
        normal: None,
        highlight_a: Vec::new(),
        highlight_b: Vec::new(),
    }
}

/// Describes in words which pair touches first, or how near the nearest pair comes.
fn verdict(
    first: &PathAnswer<'_>,
    nearest: Option<(f64, PathContact<'_>)>,
    clearance: f64,
) -> String {
    let clearance_text = if clearance > 0.0 {
        format!(" with a clearance of {} mm", 1e3 * clearance)
    } else {
        String::new()
    };
    let contact_text = |contact: &PathContact<'_>| {
        let [a, b] = contact.items.map(Item::name);
        format!(
            "{a} and {b} at {:.4} of segment {}",
            rounded_down(contact.at.fraction),
            contact.at.segment
        )
    };
    match (&first.outcome, nearest) {
        (PathOutcome::Contact(contact), _) => {
            format!(
                "First contact{clearance_text}: {}. Proven: free before.",
                contact_text(contact)
            )
        }
        (PathOutcome::Free, Some((distance, contact))) => {
            format!(
                "Free{clearance_text}, proven. Nearest: {}, {:.3} mm apart.",
                contact_text(&contact),
                1e3 * distance
            )
        }
        (PathOutcome::Free, None) => format!("Free{clearance_text}, proven."),
        (outcome, _) => {
            let PathPoint { segment, fraction } = first.free_until;
            let until = format!("{:.4} of segment {segment}", rounded_down(fraction));
            let limit = outcome
                .limit()
                .map_or_else(String::new, |limit| limit.to_string());
            format!("Free{clearance_text} until {until}; then a limit was reached: {limit}.")
        }
    }
}

/// Rounds to four digits after the point, downward.
fn rounded_down(fraction: f64) -> f64 {
    (1e4 * fraction).floor() * 1e-4
}
