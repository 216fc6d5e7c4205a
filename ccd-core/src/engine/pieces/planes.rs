//! How long planes keep two placed pieces apart: fixed planes, and planes that turn with one of the bodies.

use super::heights::{Heights, PointHeight, least_free_time, least_free_time_of_many_points};
use super::placed_pair::PlacedPair;
use crate::distance::separation::CheckedClaim;
use crate::engine::shortcuts::turning_pieces::{MovingPiece, PieceMotionToTurningPlane};
use crate::math::order::lesser;
use crate::math::vector::{length, unit};
use crate::motion::bound::{VelocityBound, published_bound, sound_bound};
use crate::motion::free_time::FreeTime;
use crate::motion::gap::{Gap, first_possible_crossing};
use crate::problem::Problem;
use crate::rounding::RATE_ERROR_F64;
use crate::settings::Shortcut;
use crate::tuning::{MAX_NEWTON_STEPS, MIN_ROTATION_GAP_SHARE, SUFFICIENT_FIRST_FREE_TIME};
use glam::DVec3;
use std::iter;

/// A plane that keeps two pieces apart.
pub(crate) struct SeparatingPlane {
    /// The unit normal from A to B, in the problem's coordinates.
    pub(crate) normal: DVec3,
    /// The present excess of the gap over the required gap.
    pub(crate) gap_excess: f64,
}

impl PlacedPair<'_> {
    /// Like [`PlacedPair::free_time`], for the first visit of two pieces. If the fixed plane perpendicular to the claim's
    /// axis keeps them apart for a while at the present rate, no point is followed, and no other plane is tried. Most
    /// pairs are visited only once.
    pub(crate) fn first_visit_free_time(&self, checked: &CheckedClaim, kept: f64) -> FreeTime {
        let direct = self.plane_of_claim(checked, kept);
        match self.free_time_at_present_rate(&direct) {
            Some(free) if free >= FreeTime::AtLeast(SUFFICIENT_FIRST_FREE_TIME) => free,
            _ => match self.fixed_plane_free_time(direct.normal, direct.gap_excess) {
                free if free >= FreeTime::AtLeast(SUFFICIENT_FIRST_FREE_TIME) => free,
                free => self.longest_free_time(checked, kept, &direct, free),
            },
        }
    }

    /// Returns a time for which the pieces certainly stay farther apart than `kept`. The function tries two normals, the
    /// claim's axis and the direction in which the nearest points pass each other. The planes are fixed, or turn with one
    /// of the bodies.
    pub(crate) fn free_time(&self, checked: &CheckedClaim, kept: f64) -> FreeTime {
        let direct = self.plane_of_claim(checked, kept);
        let free = self.fixed_plane_free_time(direct.normal, direct.gap_excess);
        self.longest_free_time(checked, kept, &direct, free)
    }

    /// Returns the longest free time of the planes that are tried; `free` is the time of the fixed plane perpendicular
    /// to the claim's axis.
    fn longest_free_time(
        &self,
        checked: &CheckedClaim,
        kept: f64,
        direct: &SeparatingPlane,
        mut free: FreeTime,
    ) -> FreeTime {
        if free == FreeTime::ToEnd {
            return free;
        }
        let passing = self.plane_of_closest_approach(checked, kept);
        if let Some(passing) = &passing {
            free =
                free.or_longer(|_| self.fixed_plane_free_time(passing.normal, passing.gap_excess));
        }
        let members = self.moving_pieces();
        for plane in iter::once(direct).chain(&passing) {
            free = free.or_longer(|free| self.turning_plane_free_time(&members, plane, free));
        }
        free
    }

    /// Returns a time for which a plane certainly keeps the pieces apart. The plane is fixed, or turns with one of the
    /// bodies.
    pub(crate) fn plane_free_time(&self, plane: &SeparatingPlane) -> FreeTime {
        self.fixed_plane_free_time(plane.normal, plane.gap_excess)
            .or_longer(|free| self.turning_plane_free_time(&self.moving_pieces(), plane, free))
    }

    /// Returns the plane perpendicular to the claim's axis.
    fn plane_of_claim(&self, checked: &CheckedClaim, kept: f64) -> SeparatingPlane {
        SeparatingPlane {
            normal: self.frames[0].rotation * checked.axis,
            gap_excess: checked.lower - kept,
        }
    }

    /// Moves the nearest points on at constant velocities to the time when they are closest, and returns the plane
    /// perpendicular to the vector between them; `None` if that plane does not separate the pieces at present.
    fn plane_of_closest_approach(
        &self,
        checked: &CheckedClaim,
        kept: f64,
    ) -> Option<SeparatingPlane> {
        let [a, b] =
            [checked.witness_a, checked.witness_b].map(|w| self.frames[0].transform_point(w));
        let velocity = self.problem.a.path.velocity_at(a, self.clock)
            - self.problem.b.path.velocity_at(b, self.clock);
        let nearest = (b - a).dot(velocity) / velocity.length_squared();
        let way = b - a - velocity * nearest.clamp(0.0, self.time_left());
        let normal = unit(way)?;
        let axis = self.frames[0].inverse_transform_vector(normal);
        let slack = self.gap_along(axis, checked.witness_a) - kept;
        (slack > 0.0).then_some(SeparatingPlane {
            normal,
            gap_excess: slack,
        })
    }

    /// Like [`PlacedPair::fixed_plane_free_time`], with planes that turn with one of the bodies. Returns [`FreeTime::NONE`] if such a plane is
    /// not worth trying: the rotation of that body does not use up the slack within `free`.
    pub(crate) fn turning_plane_free_time(
        &self,
        members: &[MovingPiece<'_>; 2],
        plane: &SeparatingPlane,
        free: f64,
    ) -> FreeTime {
        if !self.problem.uses_shortcut(Shortcut::TurningPieces) {
            return FreeTime::NONE;
        }
        let [a, b] = members;
        let uses_up =
            |relative_speed: f64| relative_speed * free > MIN_ROTATION_GAP_SHARE * plane.gap_excess;
        let mut longest = FreeTime::NONE;
        for (holder, other, normal) in [(a, b, plane.normal), (b, a, -plane.normal)] {
            if uses_up(holder.rotational_speed_bound)
                && uses_up(holder.rotational_speed_bound_along(normal))
            {
                let sweep =
                    PieceMotionToTurningPlane::new(holder, other, normal, self.problem.rounding);
                longest =
                    longest.or_longer(|_| sweep.free_time(plane.gap_excess, self.time_left()));
                self.record_evaluations(sweep.evaluations.get());
                if longest == FreeTime::ToEnd {
                    break;
                }
            }
        }
        longest
    }

    /// Returns a time for which the gap along a fixed unit vector certainly stays above the required gap. `slack` is the
    /// present excess over the required gap.
    ///
    /// Every point's height along the axis is known exactly
    /// ([`HeightFunction`](crate::motion::track::HeightFunction)). Newton's method follows the least gap between any
    /// two points, with a bound on its curvature.
    pub(crate) fn fixed_plane_free_time(&self, normal: DVec3, slack: f64) -> FreeTime {
        let (problem, [frame_a, frame_b]) = (self.problem, &self.frames);
        // The highest point along an axis is the lowest along its opposite.
        let clock = self.clock;
        let a = Heights::new(&problem.a, &self.pieces.a, frame_a, -normal, clock);
        let b = Heights::new(&problem.b, &self.pieces.b, frame_b, normal, clock);
        let rounding = RATE_ERROR_F64 * (a.speed_bound + b.speed_bound);
        let linear_acceleration =
            a.linear_acceleration_lower_bound() + b.linear_acceleration_lower_bound();
        let rounds = if a.is_nonrotating() && b.is_nonrotating() {
            1
        } else {
            MAX_NEWTON_STEPS
        };
        // The offset of the heights makes the nearest two points `slack` apart.
        let free = |above: &PointHeight, below: &PointHeight| {
            let gap = Gap {
                gap: slack + (above.height - b.least_height) + (below.height - a.least_height),
                rate: -below.rate - above.rate + rounding,
                second_derivative: (above.second_derivative + below.second_derivative)
                    * (1.0 + RATE_ERROR_F64)
                    - linear_acceleration,
            };
            gap.free_time()
        };
        let points = self.pieces.points_per_support_search();
        self.record_evaluations(points);
        let found = match (a.tracks_if_few_points(), b.tracks_if_few_points()) {
            (Some(below), Some(above)) => {
                first_possible_crossing(self.time_left(), rounds, |tau| {
                    self.record_evaluations(points);
                    least_free_time(
                        &above.heights_at(b.angle_sin_cos(tau), tau),
                        &below.heights_at(a.angle_sin_cos(tau), tau),
                        free,
                    )
                })
            }
            _ => first_possible_crossing(self.time_left(), rounds, |tau| {
                self.record_evaluations(points);
                least_free_time_of_many_points(&b, &a, tau, free)
            }),
        };
        if found == FreeTime::ToEnd || self.stays_apart_despite_rotation(&a, &b, slack) {
            FreeTime::ToEnd
        } else {
            found
        }
    }

    /// Returns whether the pieces certainly stay apart to the end, because rotation lowers their points by less than
    /// the slack that the straight motion leaves. Without this test, the steps towards the time of closest approach
    /// become ever shorter.
    fn stays_apart_despite_rotation(&self, a: &Heights<'_>, b: &Heights<'_>, slack: f64) -> bool {
        let horizon = self.time_left();
        let (of_a, of_b) = (&a.motion_along_axis, &b.motion_along_axis);
        let displacement = least_linear_displacement(
            of_a.linear_rate + of_b.linear_rate,
            of_a.linear_acceleration + of_b.linear_acceleration,
            horizon,
        );
        let left =
            slack + displacement - RATE_ERROR_F64 * (a.speed_bound + b.speed_bound) * horizon;
        // Written so that NaN is not past.
        if (a.is_nonrotating() && b.is_nonrotating()) || !(left > 0.0) {
            return false;
        }
        let descents = || {
            Some(
                a.max_rotational_descent_until(horizon)?
                    + b.max_rotational_descent_until(horizon)?,
            )
        };
        descents().is_some_and(|descents| left - descents > 0.0)
    }

    /// Like [`PlacedPair::free_time`], along the claim's axis alone, by a bound of each body's velocity along it `[FAST06
    /// §4.2]`. `reaches` are the largest distances of the pieces' points from their body's axis of rotation.
    ///
    /// # Guarantee
    /// No guarantee with [`VelocityBound::Published`].
    pub(crate) fn free_time_along_axis(
        &self,
        checked: &CheckedClaim,
        kept: f64,
        bound: VelocityBound,
        reaches: [f64; 2],
    ) -> FreeTime {
        let Problem { a, b, .. } = self.problem;
        let normal = self.frames[0].rotation * checked.axis;
        let sides = [
            (a, normal, self.pieces.a, &self.frames[0], reaches[0]),
            (b, -normal, self.pieces.b, &self.frames[1], reaches[1]),
        ];
        let (mut rate, mut speed) = (0.0, 0.0);
        for (side, n, piece, frame, reach) in sides {
            let motion = side.path.velocities();
            rate += match bound {
                VelocityBound::Sound => sound_bound(&motion, n, reach),
                VelocityBound::Published => published_bound(&motion, n, |c| {
                    let farthest = piece.extremal_position(frame.inverse_transform_vector(c));
                    frame.rotation * (farthest - side.path.center)
                }),
            };
            speed += length(motion.linear_velocity) + side.path.angular_speed * reach;
        }
        let gap = Gap {
            gap: checked.lower - kept,
            rate: rate + RATE_ERROR_F64 * speed,
            second_derivative: 0.0,
        };
        FreeTime::up_to(gap.free_time(), self.time_left())
    }
}

/// Returns the least value of `rate τ + linear_acceleration τ²/2` for τ up to a horizon.
fn least_linear_displacement(rate: f64, linear_acceleration: f64, horizon: f64) -> f64 {
    let nearest = -rate / linear_acceleration;
    // Written so that NaN is none.
    if linear_acceleration > 0.0 && nearest > 0.0 && nearest < horizon {
        0.5 * rate * nearest
    } else {
        lesser(0.0, (rate + 0.5 * linear_acceleration * horizon) * horizon)
    }
}

#[cfg(test)]
mod tests;
