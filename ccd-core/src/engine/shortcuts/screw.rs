//! Proves nodes apart if one body turns about an axis that hardly moves relative to the other body, such as a bolt in a
//! nut, a shaft in a sleeve, a wheel or a hinge.
//!
//! With `r` the distance of a point from the axis, `φ` its azimuth, `z` its height along the axis
//! and `p` the advance per radian, neither `r` nor `ζ = z − p φ` changes while the point moves. A
//! surface `f = a r + b ζ = constant` is carried into itself, and keeps two nodes apart for good.
//! Fixed planes do so only for as long as the curvature of the points' paths allows.
//!
//! The azimuth is known up to whole turns, and so is `ζ` up to whole pitches: for each number of
//! pitches there has to be a surface that keeps the nodes apart.

mod outline;
mod profile;

use super::placed::PlacedNode;
use super::screw::profile::{NodeScrewBounds, ScrewAxis, ScrewPath, profiles_keep_apart};
use crate::body::tree::{NodeChildren, NodeId, NodeOrTriangle};
use crate::engine::capacity::clear_and_shrink;
use crate::math::order::lesser;
use crate::math::vector::length;
use crate::motion::free_time::FreeTime;
use crate::problem::{BodyWithPath, Problem, WhichBody};
use crate::rounding::{RATE_ERROR_F64, SCREW_VELOCITY_ERROR_F64};
use crate::tuning::{CLOSED_GAP_TOLERANCE_SHARE, MAX_SCREW_DRIFT, MIN_SCREW_ADVANCE};
use std::f64::consts::TAU;
use std::ops::Range;

/// The screw motion of one body relative to the other, to prove pairs of nodes apart.
#[derive(Debug)]
pub(crate) struct Screw {
    turning_body: WhichBody,
    axis: ScrewAxis,
    /// The part of the screw motion from the start to the end of the query, and the distance to keep. The distance
    /// includes the drift of the axis.
    path: ScrewPath,
}

/// The profiles of both bodies' nodes and triangles, each computed when first needed.
#[derive(Debug, Default)]
pub(crate) struct ProfileCache([BodyProfileCache; 2]);

#[derive(Debug, Default)]
struct BodyProfileCache {
    /// For each node or triangle, by its id, the index of its profile among the known ones, or a mark that it is unknown or
    /// that there is none.
    profile_index_by_node: Vec<u32>,
    computed_profiles: Vec<NodeScrewBounds>,
}

/// The entry of `profile_index_by_node` for a node whose profile is not computed yet.
const UNCOMPUTED_PROFILE: u32 = u32::MAX;
const NO_PROFILE: u32 = u32::MAX - 1;

impl Screw {
    /// Returns the screw motion of one body relative to the other, and clears all profiles. It is `None` unless exactly
    /// one body turns, and its axis hardly moves relative to the other body.
    pub(crate) fn for_problem(problem: &Problem<'_>, profiles: &mut ProfileCache) -> Option<Self> {
        let turning = match (problem.a.path.is_turning(), problem.b.path.is_turning()) {
            (true, false) => WhichBody::A,
            (false, true) => WhichBody::B,
            _ => return None,
        };
        let (side, other) = (
            turning.body_in_problem(problem),
            turning.other().body_in_problem(problem),
        );
        let unit = side.path.axis;
        let velocity = side.path.velocity - other.path.velocity;
        let along = velocity.dot(unit);
        let [a, b] = [&problem.a, &problem.b].map(|side| f64::from(side.body.tree().radius()));
        let size = lesser(a, b);
        // A tiny advance would make a tiny pitch.
        let along = if along.abs() > MIN_SCREW_ADVANCE * size {
            along
        } else {
            0.0
        };
        // The advance is off by a few units in the last place, which counts as drift too.
        let drift = length(velocity - along * unit) + SCREW_VELOCITY_ERROR_F64 * length(velocity);
        // Bodies with the same acceleration do not accelerate relative to each other.
        let acceleration = side.path.acceleration - other.path.acceleration;
        let drift = drift + 0.5 * length(acceleration);
        // Written so that NaN is no screw.
        if !(drift <= MAX_SCREW_DRIFT * size) {
            return None;
        }
        // Rounding counts once for the positions, and once for the axis.
        let kept = problem.kept_node_gap()
            + 2.0 * problem.rounding
            + CLOSED_GAP_TOLERANCE_SHARE * problem.tolerance;
        profiles.0[0].reset_cache(&problem.a);
        profiles.0[1].reset_cache(&problem.b);
        Some(Screw {
            turning_body: turning,
            axis: ScrewAxis::new(
                side.path.center_at(0.0),
                unit,
                along / side.path.angular_speed,
            ),
            path: ScrewPath {
                pitch: TAU * (along / side.path.angular_speed),
                angle_range: [0.0, side.path.angular_speed],
                needed_gap: kept + drift * (1.0 + RATE_ERROR_F64),
            },
        })
    }

    /// Returns [`FreeTime::ToEnd`] if a node of A and a node of B certainly keep the required gap from clock `s` on, and
    /// [`FreeTime::NONE`] otherwise; `None` if one of them surrounds the axis, or nearly does.
    pub(crate) fn free_time(
        &self,
        problem: &Problem<'_>,
        profiles: &mut ProfileCache,
        [a, b]: [NodeId; 2],
        s: f64,
    ) -> Option<FreeTime> {
        if self.free_time_of_nodes(problem, profiles, [a, b], s)? == FreeTime::ToEnd {
            return Some(FreeTime::ToEnd);
        }
        let of_a = triangle_ids(&problem.a, a);
        let of_b = triangle_ids(&problem.b, b);
        let (Some(of_a), Some(of_b)) = (of_a, of_b) else {
            return Some(FreeTime::NONE);
        };
        // In groups with overlapping outlines, hardly any two triangles have overlapping outlines. Comparing
        // triangles costs less than splitting the groups.
        let mut of_a = of_a;
        let all_apart = of_a.all(|x| {
            let mut apart =
                |pair| self.free_time_of_nodes(problem, profiles, pair, s) == Some(FreeTime::ToEnd);
            apart([x, b]) || of_b.clone().all(|y| apart([x, y]))
        });
        Some(FreeTime::to_end_if(all_apart))
    }

    /// Like [`Screw::free_time`], but without a test of the triangles below the nodes.
    fn free_time_of_nodes(
        &self,
        problem: &Problem<'_>,
        ProfileCache([of_a, of_b]): &mut ProfileCache,
        [a, b]: [NodeId; 2],
        s: f64,
    ) -> Option<FreeTime> {
        let a = of_a.profile_of_node(&problem.a, a, &self.axis)?;
        let b = of_b.profile_of_node(&problem.b, b, &self.axis)?;
        let (turning, still) = match self.turning_body {
            WhichBody::A => (a, b),
            WhichBody::B => (b, a),
        };
        let [_, end] = self.path.angle_range;
        let way = ScrewPath {
            angle_range: [s * end, end],
            ..self.path
        };
        let apart = profiles_keep_apart(turning, still, &self.axis, &way);
        Some(FreeTime::to_end_if(apart))
    }
}

impl BodyProfileCache {
    fn reset_cache(&mut self, side: &BodyWithPath<'_>) {
        let count = side.body.tree().node_count() + side.body.pieces().len();
        clear_and_shrink(&mut self.computed_profiles);
        clear_and_shrink(&mut self.profile_index_by_node);
        self.profile_index_by_node.resize(count, UNCOMPUTED_PROFILE);
    }

    /// Returns the profile of a node or triangle; `None` if the node surrounds the axis, or nearly does.
    fn profile_of_node(
        &mut self,
        side: &BodyWithPath<'_>,
        id: NodeId,
        axis: &ScrewAxis,
    ) -> Option<&NodeScrewBounds> {
        let place = &mut self.profile_index_by_node[id as usize];
        if *place == UNCOMPUTED_PROFILE {
            *place = match compute_profile(side, id, axis) {
                Some(profile) if self.computed_profiles.len() < NO_PROFILE as usize => {
                    self.computed_profiles.push(profile);
                    self.computed_profiles.len() as u32 - 1
                }
                _ => NO_PROFILE,
            };
        }
        self.computed_profiles.get(*place as usize)
    }
}

/// Computes the profile of a node in its pose at the start of the query; `None` if the node surrounds the axis, or
/// nearly does. A profile of a few triangles is smaller than that of their box.
fn compute_profile(
    side: &BodyWithPath<'_>,
    id: NodeId,
    axis: &ScrewAxis,
) -> Option<NodeScrewBounds> {
    let place = |id: NodeId| PlacedNode::new(side, id, 0.0);
    match triangle_ids(side, id) {
        Some(few) => NodeScrewBounds::union_of(few.map(place), axis),
        None => NodeScrewBounds::new(&place(id), axis),
    }
}

/// Returns the ids of the triangles of a lowest node, or of a single triangle; `None` for all other nodes.
fn triangle_ids(side: &BodyWithPath<'_>, id: NodeId) -> Option<Range<NodeId>> {
    let tree = side.body.tree();
    match tree.get(id) {
        NodeOrTriangle::Triangle(_) => Some(id..id + 1),
        NodeOrTriangle::Node(node) => match node.children {
            NodeChildren::Triangles(group) => Some(tree.triangle_group_header(group).children()),
            _ => None,
        },
    }
}

#[cfg(test)]
mod tests;
