//! The report that `ccd clearance` prints.

use crate::robots::page::MAX_RANGES;
use crate::robots::path_table::TablePath;
use ccd_core::order::lesser;
use rigid_ccd::answer::ClearanceVerdict;
use rigid_ccd::trajectory::JointKind;
use rigid_ccd_robot::{
    Cell, ClearanceRange, DistanceRange, Item, PathContact, PathOutcome, PathPoint, UnresolvedPath,
};
use serde_json::{Value, json};
use std::fmt;

/// The greatest number of moving joints whose positions describe a point of the path. With more joints, its time does.
const MAX_NAMED_JOINTS: usize = 3;

/// The distances of a mechanism along a path.
pub(super) struct Report<'a> {
    pub(super) cell: &'a Cell,
    pub(super) path: &'a TablePath,
    /// The greatest distance of points of links from where the path places them.
    pub(super) pose_error: f64,
    /// The clearance that is required, if any.
    pub(super) required: Option<f64>,
    pub(super) closest: PathOutcome<'a>,
    /// The tolerance that the closest approach meets.
    pub(super) tolerance: f64,
    pub(super) ranges: Vec<ClearanceRange>,
}

impl Report<'_> {
    /// Returns the bounds of the least distance. Both bodies of a pair may deviate by the pose error.
    fn distance_bounds(&self, closest: &PathOutcome<'_>) -> [f64; 2] {
        let error = 2.0 * self.pose_error;
        let lower = closest.lower() - error;
        let lower = if lower > 0.0 { lower } else { 0.0 };
        [lower, closest.upper() + error]
    }

    /// Returns the positions of the joints that move, at a point of the path.
    fn moving_positions(&self, point: PathPoint) -> Vec<(&str, f64)> {
        let configurations = &self.path.configurations;
        let from = &configurations[point.segment];
        let to = &configurations[(point.segment + 1).min(configurations.len() - 1)];
        let names = self.cell.robot().independent_joint_names().enumerate();
        let moving = names.filter(|(k, _)| {
            let first = configurations[0][*k];
            configurations
                .iter()
                .any(|configuration| configuration[*k] != first)
        });
        moving
            .map(|(k, name)| (name, from[k] + point.fraction * (to[k] - from[k])))
            .collect()
    }

    /// Describes a point of the path by the positions of the joints that move.
    fn point_text(&self, point: PathPoint) -> String {
        self.point_text_rounded_towards(point, point)
    }

    /// Describes a point of the path; its positions are rounded towards the positions of another point.
    fn point_text_rounded_towards(&self, point: PathPoint, other: PathPoint) -> String {
        let other_positions = self.moving_positions(other);
        if other_positions.len() > MAX_NAMED_JOINTS {
            let [time, other_time] =
                [point, other].map(|point| 1e6 * self.path.table_time_rounded_down(point.time()));
            return format!("time {:.6}", 1e-6 * rounded_towards(time, other_time));
        }
        let positions = self
            .moving_positions(point)
            .into_iter()
            .zip(other_positions);
        let positions = positions.map(|((name, position), (_, other_position))| {
            let text = self.position_text(name, position, other_position);
            format!("{name} = {text}")
        });
        let positions: Vec<String> = positions.collect();
        if positions.is_empty() {
            "rest".to_owned()
        } else {
            positions.join(", ")
        }
    }

    fn position_text(&self, name: &str, position: f64, other_position: f64) -> String {
        let joint = self
            .cell
            .robot()
            .joints()
            .iter()
            .find(|joint| joint.name == name);
        let turns =
            joint.is_some_and(|joint| matches!(joint.geometry.kind(), JointKind::Revolute(_)));
        let (factor, unit) = if turns {
            (1f64.to_degrees(), "°")
        } else {
            (1e3, " mm")
        };
        let scaled = [position, other_position].map(|position| 1e4 * factor * position);
        format!("{:.4}{unit}", 1e-4 * rounded_towards(scaled[0], scaled[1]))
    }

    fn positions_json(&self, point: PathPoint) -> Value {
        let positions = self.moving_positions(point).into_iter();
        Value::Object(
            positions
                .map(|(name, position)| (name.to_owned(), json!(position)))
                .collect(),
        )
    }

    fn closest_json(&self, closest: &PathOutcome<'_>) -> Value {
        let [lower, upper] = self.distance_bounds(closest);
        json!({
            "distance_lower": lower,
            "distance_upper": Some(upper).filter(|upper| upper.is_finite()),
            "nearest": closest.nearest().map(|nearest| self.contact_json(&nearest)),
            "limit": closest.limit().map(|limit| limit.to_string()),
        })
    }

    fn contact_json(&self, contact: &PathContact<'_>) -> Value {
        let [a, b] = contact.items.map(Item::name);
        let witnesses = contact.witnesses;
        let [witness_a, witness_b] = [0, 1].map(|k| witnesses.map(|points| points[k].to_array()));
        json!({
            "time": self.path.table_time_rounded_down(contact.at.time()),
            "positions": self.positions_json(contact.at),
            "a": a,
            "b": b,
            "witness_a": witness_a,
            "witness_b": witness_b,
        })
    }

    /// Returns the report with the curve of the distance; lengths in metres, angles in radians.
    pub(super) fn to_json(&self, curve: &[DistanceRange<'_>]) -> Value {
        // Rounded inwards, so that a verdict holds in the whole range.
        let range = |from: PathPoint, to: PathPoint| {
            json!({
                "from": self.path.table_time_rounded_up(from.time()),
                "to": self.path.table_time_rounded_down(to.time()),
                "from_positions": self.positions_json(from),
                "to_positions": self.positions_json(to),
            })
        };
        let with_entries = |mut range: Value, entries: Value| {
            if let (Some(range), Value::Object(entries)) = (range.as_object_mut(), entries) {
                range.extend(entries);
            }
            range
        };
        json!({
            "closest": self.closest_json(&self.closest),
            "tolerance": self.tolerance,
            "required": self.required,
            "verdict": self.verdict().map(verdict_name),
            "ranges": self.ranges.iter().map(|found| {
                with_entries(range(found.from, found.to), json!({ "clearance": verdict_name(found.verdict) }))
            }).collect::<Vec<_>>(),
            "curve": curve.chunks(curve.len().div_ceil(MAX_RANGES).max(1)).filter_map(|neighbours| {
                let merged = merged(neighbours)?;
                Some(with_entries(range(merged.from, merged.to), self.closest_json(&merged.closest)))
            }).collect::<Vec<_>>(),
            "not_checked": self.pairs_not_checked().map(|([a, b], reason)| {
                json!({ "a": a, "b": b, "reason": reason })
            }).collect::<Vec<_>>(),
        })
    }

    /// Returns the verdict about the whole path, which is the worst of its ranges; `None` if no clearance is required.
    pub(super) fn verdict(&self) -> Option<ClearanceVerdict> {
        self.required?;
        let verdicts = [ClearanceVerdict::Violated, ClearanceVerdict::Unverified];
        let has =
            |verdict: &ClearanceVerdict| self.ranges.iter().any(|range| range.verdict == *verdict);
        Some(
            verdicts
                .into_iter()
                .find(has)
                .unwrap_or(ClearanceVerdict::Kept),
        )
    }

    /// Returns the pairs of links with bodies that are not checked, each with the reason.
    fn pairs_not_checked(&self) -> impl Iterator<Item = ([&str; 2], String)> {
        let (robot, pairs) = (self.cell.robot(), self.cell.link_pairs());
        pairs.skipped_pairs().map(|([one, other], reason)| {
            let names = [one, other].map(|link| robot.links()[link].name.as_str());
            (names, reason.to_string())
        })
    }
}

/// Merges consecutive ranges into one, with the least bounds, the place of the least distance, and a limit if one was
/// reached; `None` without ranges.
fn merged<'a>(ranges: &[DistanceRange<'a>]) -> Option<DistanceRange<'a>> {
    let merge = |one: DistanceRange<'a>, next: &DistanceRange<'a>| DistanceRange {
        from: one.from,
        to: next.to,
        closest: merged_distance(&one.closest, &next.closest),
    };
    let (first, others) = ranges.split_first()?;
    Some(others.iter().fold(*first, merge))
}

/// Returns the least distance of two ranges together.
fn merged_distance<'a>(one: &PathOutcome<'a>, next: &PathOutcome<'a>) -> PathOutcome<'a> {
    let nearer = if next.upper() < one.upper() {
        next
    } else {
        one
    };
    let lower = lesser(one.lower(), next.lower());
    let (upper, nearest) = (nearer.upper(), nearer.nearest());
    match one.limit().or(next.limit()) {
        None => PathOutcome::LeastDistance {
            lower,
            upper,
            nearest,
        },
        Some(limit) => PathOutcome::Unresolved(UnresolvedPath {
            limit,
            lower,
            upper,
            nearest,
        }),
    }
}

/// Rounds to an integer, in the direction of another number.
fn rounded_towards(value: f64, other: f64) -> f64 {
    if other > value {
        value.ceil()
    } else if other < value {
        value.floor()
    } else {
        value.round()
    }
}

fn verdict_name(verdict: ClearanceVerdict) -> &'static str {
    match verdict {
        ClearanceVerdict::Kept => "kept",
        ClearanceVerdict::Violated => "violated",
        ClearanceVerdict::Unverified => "unverified",
    }
}

impl fmt::Display for Report<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [lower, upper] = self
            .distance_bounds(&self.closest)
            .map(|length| 1e3 * length);
        // Rounded down and up.
        let (lower, upper) = ((lower * 1e5).floor() / 1e5, (upper * 1e5).ceil() / 1e5);
        write!(f, "least distance: {lower:.5} to {upper:.5} mm")?;
        if let Some(nearest) = self.closest.nearest() {
            let [a, b] = nearest.items.map(Item::name);
            write!(f, ", {a} and {b} at {}", self.point_text(nearest.at))?;
        }
        if let Some(limit) = self.closest.limit() {
            write!(f, " (a limit was reached: {limit})")?;
        }
        if let (Some(required), Some(verdict)) = (self.required, self.verdict()) {
            write!(
                f,
                "\n{} mm required: {}",
                1e3 * required,
                verdict_name(verdict)
            )?;
        }
        for range in &self.ranges {
            let from = self.point_text_rounded_towards(range.from, range.to);
            let to = self.point_text_rounded_towards(range.to, range.from);
            write!(f, "\n  {:10} {from} to {to}", verdict_name(range.verdict))?;
        }
        Ok(())
    }
}
