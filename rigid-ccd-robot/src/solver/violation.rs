//! Whether some pair is nearer than its distance everywhere in a stretch.
//!
//! It is if both bodies are nearer in the middle by more than they move from there.

use super::Question;
use super::measure::{first_axis, vertex};
use super::part_pairs::PartPair;
use super::search::Search;
use super::stretch::Stretch;
use ccd_core::order::greater;
use ccd_distance_gjk::{RequiredBounds, bound_distance};
use rigid_ccd::glam::{DMat3, DVec3};
use rigid_ccd::{Error, Settings};

impl Search<'_> {
    /// Returns whether some pair is certainly nearer than its margin everywhere in a stretch, also if it is farther apart than
    /// it is placed by as much as margins are grown.
    pub(super) fn is_violated(&mut self, stretch: &Stretch) -> Result<bool, Error> {
        let parts = self.cell.parts();
        self.question = Question::AnyContact;
        self.placement.place(self.cell, &self.path, stretch);
        self.candidates.clear();
        self.append_all_pairs();
        let mut pairs = std::mem::take(&mut self.candidates);
        pairs.sort_unstable_by_key(|pair| pair.owners(parts));
        let of_bodies = pairs.chunk_by(|one, other| one.owners(parts) == other.owners(parts));
        let mut is_violated = Ok(false);
        for near in of_bodies {
            is_violated = self.are_nearer(near);
            if !matches!(is_violated, Ok(false)) {
                break;
            }
        }
        self.candidates = pairs;
        is_violated
    }

    /// Returns the same for two bodies in the stretch that is placed. Parts that are left out are not near each other.
    fn are_nearer(&mut self, near: &[PartPair]) -> Result<bool, Error> {
        let pair = &near[0];
        let displacements = near.iter().map(|pair| pair.displacement(&self.placement));
        let displacement = displacements.fold(0.0, greater);
        // The margin is grown once already.
        let distance =
            pair.margin - 2.0 * self.pairs.growth() - displacement - 4.0 * self.placement.rounding;
        if self.is_convex(pair) {
            return Ok(self.are_convex_parts_nearer(pair, distance));
        }
        // Written so that NaN proves nothing.
        if !(distance > 0.0) {
            return Ok(false);
        }
        let [a, b] = pair.owners(self.cell.parts());
        let a = self.placement.body(self.cell, a)?;
        let b = self.placement.body(self.cell, b)?;
        self.solver.set_settings(Settings {
            deadline: self.time_limit.remaining(),
            ..self.settings.clone()
        });
        Ok(self.solver.distance(a, b)?.outcome.upper() < distance)
    }

    /// Returns whether two convex parts are nearer than a distance in the middle of the stretch. If it is negative, they have
    /// to overlap by so much in each direction.
    fn are_convex_parts_nearer(&self, pair: &PartPair, distance: f64) -> bool {
        let parts = [pair.a, pair.b].map(|part| &self.cell.parts()[part as usize]);
        let frames = parts.map(|part| self.placement.frames[part.frame]);
        let [a, b] = parts;
        // The distance of the points, by whose hulls parts are described, for the shapes that the parts enclose.
        let distance = distance + a.radius + b.radius - a.excess - b.excess;
        let centres = [frames[0].point(a.centre), frames[1].point(b.centre)];
        let is_obstacle = pair.b as usize >= self.cell.robot_part_count();
        let axis = first_axis(b, centres, is_obstacle);
        let vertex = |direction: DVec3| vertex(parts, &frames, direction);
        if distance > 0.0 {
            let until = RequiredBounds {
                lower: distance,
                upper: 0.5 * distance,
            };
            bound_distance(vertex, axis, until).upper < distance
        } else {
            contains_ball(|direction| vertex(direction).point, axis, -distance)
        }
    }
}

/// Returns whether a convex set certainly contains the ball of a radius about the origin. `support` returns the point of the
/// set with the least height along a direction.
///
/// Points in six directions, two along each of three axes, are the corners of an octahedron. If all its faces turn the same
/// side to the origin, it surrounds the origin, and is in the set.
fn contains_ball(support: impl Fn(DVec3) -> DVec3, axis: DVec3, radius: f64) -> bool {
    let Some(x) = axis.try_normalize() else {
        return false;
    };
    let axes = DMat3::from_cols(x, x.any_orthonormal_vector(), DVec3::ZERO);
    let axes = [axes.x_axis, axes.y_axis, axes.x_axis.cross(axes.y_axis)];
    let corners = axes.map(|axis| [support(axis), support(-axis)]);
    let size = corners
        .as_flattened()
        .iter()
        .fold(0.0, |size, corner| greater(size, corner.length()));
    // A face's normal and its height are products of two and three lengths, with fewer than 256 rounding errors together.
    let rounding = 256.0 * f64::EPSILON * size.powi(3);
    (0..8_u32).all(|face| {
        let [p, q, r] = [0, 1, 2].map(|k| corners[k][(face >> k & 1) as usize]);
        // Each exchange of a corner for the opposite one turns the face over.
        let side = if face.count_ones() % 2 == 0 {
            -1.0
        } else {
            1.0
        };
        let normal = (q - p).cross(r - p) * side;
        // Written so that NaN, and a face without area, prove nothing.
        normal.dot(p) > radius * normal.length() + rounding
    })
}

#[cfg(test)]
mod tests;
