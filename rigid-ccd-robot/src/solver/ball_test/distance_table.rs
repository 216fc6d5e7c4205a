//! Lower bounds of the distances of two links for all angles of the joints between them.
//!
//! Many pairs of links are near each other wherever the arm is, such as a wrist and the flange behind it. One or two
//! revolute joints move them relative to each other. A table holds a lower bound of their distance for each cell of a
//! grid of angles: the distance at the cell's center, minus the largest displacement from there.

use crate::cell::Cell;
use crate::cell::ball_model::{DistanceTable, TableAxis};
use crate::cell::part::HullPart;
use crate::kinematics::Kinematics;
use crate::kinematics::joint_arms::JointArms;
use crate::solver::measure::minkowski_support_vertex;
use crate::solver::part_pairs::PartPair;
use crate::tuning::{MAX_TABLE_CELLS, MAX_TABLE_DISTANCE, TABLE_ACCURACY};
use ccd_core::order::{greater, lesser};
use ccd_distance_gjk::bound_distance;
use rigid_ccd::glam::DVec3;
use rigid_ccd::oracle::Frame;
use std::f64::consts::TAU;

/// Returns the tables of pairs of the robot's own parts; `None` for a pair that other joints move than one or two
/// revolute ones.
pub(super) fn tables_of(cell: &Cell, pairs: &[PartPair]) -> Vec<Option<DistanceTable>> {
    let (kinematics, limits) = (cell.kinematics(), cell.robot().limits().collect::<Vec<_>>());
    let jointed = pairs.iter().map(|pair| {
        let parts = [pair.a, pair.b].map(|part| &cell.parts()[part as usize]);
        JointedParts::new(kinematics, parts)
    });
    let jointed: Vec<Option<JointedParts<'_>>> = jointed.collect();
    let max_cells = cells_per_table(jointed.iter().flatten().count());
    // The limits of a joint that follows another joint are those of the other joint, if it follows at a distance.
    let range = |joint: usize| {
        let source = &kinematics.joints()[joint].source;
        let mut limit = limits[source.position_index];
        limit = limit.map(|position| source.multiplier * position + source.offset);
        [lesser(limit[0], limit[1]), greater(limit[0], limit[1])]
    };
    let tables = jointed.iter();
    tables
        .map(|jointed| Some(jointed.as_ref()?.table(max_cells, range)))
        .collect()
}

/// Two parts of a robot, and the joints between them.
struct JointedParts<'c> {
    kinematics: &'c Kinematics,
    parts: [&'c HullPart; 2],
    common_frame: usize,
    /// For each part the joints between the common frame and the part, parents first.
    joints: [Vec<usize>; 2],
    /// The joints between both parts, with the lengths of their arms.
    arms: Vec<(usize, f64)>,
}

impl<'c> JointedParts<'c> {
    /// Returns the parts if one or two revolute joints are between them.
    fn new(kinematics: &'c Kinematics, parts: [&'c HullPart; 2]) -> Option<Self> {
        if parts[1].plane.is_some() {
            return None;
        }
        let common_frame = kinematics.common_frame(parts.map(|part| part.frame));
        let arms_of = |part: &HullPart| {
            let points = (part.frame, part.points());
            JointArms::new(kinematics, points, common_frame).revolute()
        };
        let of_parts = [arms_of(parts[0])?, arms_of(parts[1])?];
        let arms = of_parts.concat();
        let joints_of = |arms: &Vec<(usize, f64)>| arms.iter().rev().map(|arm| arm.0).collect();
        (1..=2).contains(&arms.len()).then_some(JointedParts {
            kinematics,
            parts,
            common_frame,
            joints: of_parts.each_ref().map(joints_of),
            arms,
        })
    }

    /// Computes the table, with at most `max_cells` cells. `range` returns the limits of a joint.
    fn table(&self, max_cells: usize, range: impl Fn(usize) -> [f64; 2]) -> DistanceTable {
        let max_count = match self.arms[..] {
            [_] => max_cells,
            _ => max_cells.isqrt(),
        };
        let axes = self
            .arms
            .iter()
            .map(|&(joint, arm_length)| table_axis((joint, arm_length), range(joint), max_count));
        let axes: Vec<TableAxis> = axes.collect();
        let displacements = axes.iter().map(|axis| axis.half_cell() * axis.arm_length);
        let displacement: f64 = displacements.sum();
        let mut positions = vec![0.0; self.kinematics.joints().len()];
        let mut frames = Vec::new();
        let mut first_axis = DVec3::ZERO;
        let rows = axes.get(1).map_or(1, |axis| axis.cell_count);
        let mut distances = Vec::with_capacity(rows * axes[0].cell_count);
        for row in 0..rows {
            for column in 0..axes[0].cell_count {
                for (axis, cell) in axes.iter().zip([column, row]) {
                    positions[axis.joint] = axis.center(cell);
                }
                let distance = self.distance(&positions, &mut first_axis, &mut frames);
                distances.push(((distance - displacement) * (1.0 - 1e-6)) as f32);
            }
        }
        DistanceTable { axes, distances }
    }

    /// Returns a lower bound of the distance at a configuration, up to the rounding of poses. `first_axis` is an axis
    /// that may separate the parts, and becomes the one that separates them best.
    fn distance(&self, positions: &[f64], first_axis: &mut DVec3, frames: &mut Vec<Frame>) -> f64 {
        for joints in &self.joints {
            let chain = (self.common_frame, &joints[..]);
            let position = |joint: usize| positions[joint];
            self.kinematics.place_joints_at(chain, position, frames);
        }
        let placed = self.parts.map(|part| frames[part.frame]);
        let [a, b] = self.parts;
        let vertex = |direction: DVec3| minkowski_support_vertex([a, b], &placed, direction);
        if *first_axis == DVec3::ZERO {
            let centers = [
                placed[0].transform_point(a.center),
                placed[1].transform_point(b.center),
            ];
            *first_axis = centers[1] - centers[0];
        }
        let radii = a.radius + b.radius;
        let bounds = bound_distance(vertex, *first_axis, |bounds| {
            let gap = bounds.lower - radii;
            gap > MAX_TABLE_DISTANCE || gap > TABLE_ACCURACY * (bounds.upper - radii)
        });
        *first_axis = bounds.axis;
        bounds.lower - radii
    }
}

/// Divides the angles of a joint into cells.
fn table_axis(
    (joint, arm_length): (usize, f64),
    [low, high]: [f64; 2],
    max_count: usize,
) -> TableAxis {
    let length = high - low;
    // Half a cell beyond each end, so that rounding never leads out of the table.
    let cell_size = length / (max_count - 2) as f64;
    // Written so that a NaN length is a whole turn.
    if !(length + 2.0 * cell_size < TAU) {
        return TableAxis {
            joint,
            low: 0.0,
            cell_size: TAU / max_count as f64,
            cell_count: max_count,
            arm_length,
        };
    }
    let cell_size = greater(cell_size, TAU / max_count as f64 / 4.0);
    let count = (length / cell_size).ceil() as usize + 1;
    TableAxis {
        joint,
        low: low - 0.5 * cell_size,
        cell_size,
        cell_count: count.min(max_count),
        arm_length,
    }
}

/// Returns the number of cells for each of some tables, so that all together are small enough.
fn cells_per_table(table_count: usize) -> usize {
    (MAX_TABLE_CELLS / table_count.max(1)).clamp(64, MAX_TABLE_CELLS / 4)
}
