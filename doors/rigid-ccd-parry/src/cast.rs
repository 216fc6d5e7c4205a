//! Converts a cast in double precision to a query of the engine.

use crate::half_space::HalfSpace;
use crate::horizon::{MotionWithExtent, QueryDuration, max_relative_displacement};
use crate::interval::Interval;
use crate::leaving::first_contact_unless_separating;
use crate::order::{greater, length, lesser};
use crate::scene::{CastHit, CastStatus, Scene};
use crate::tolerance::{
    MAX_TOLERANCE_RADIUS_RATIO, ROUNDING_ENLARGEMENT, VELOCITY_DIFFERENCE_ROUNDING,
};
use crate::{BodyOfShape, CastError, Options};
use ccd_core::glam::DVec3;
use ccd_core::limits::LEAST_TOLERANCE;
use ccd_core::{DeviationBound, InputError, Motion, Settings, StartPolicy, Stretch, Trajectory};
use rigid_ccd::Solver;
use std::sync::Arc;

/// The arguments of a cast, except for the two shapes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cast {
    pub(crate) motions: [Motion; 2],
    pub(crate) interval: Interval,
    /// The distance at which the two shapes are in contact, in the scene's unit of length.
    pub(crate) target: f64,
    pub(crate) start_policy: StartPolicy,
    pub(crate) options: Options,
    /// The default tolerance, in the scene's unit of length.
    pub(crate) default_tolerance: f64,
}

/// A shape prepared for casts, as a body or as a half-space.
#[derive(Clone, Debug)]
pub(crate) enum PreparedShape {
    Body(Arc<BodyOfShape>),
    HalfSpace(HalfSpace),
}

/// A motion whose time 0 is the start of the cast's interval.
#[derive(Clone, Copy, Debug)]
struct MotionFromCastStart {
    motion: Motion,
    /// A bound on the motion's deviation due to rounding.
    deviation_bound: DeviationBound,
}

impl Cast {
    /// Finds the first contact in the interval of the cast.
    pub(crate) fn answer(
        &self,
        shapes: [&PreparedShape; 2],
        solver: &mut Solver,
    ) -> Result<Option<CastHit>, CastError> {
        self.with_scene(shapes, |scene| self.first_hit(scene, solver))
    }

    /// Builds the engine's scene for a cast, and calls a function with it.
    pub(crate) fn with_scene<T>(
        &self,
        shapes: [&PreparedShape; 2],
        then: impl FnOnce(&Scene<'_>) -> Result<T, CastError>,
    ) -> Result<T, CastError> {
        let shifted = self.relative_motions_from_start()?;
        match shapes {
            [PreparedShape::Body(a), PreparedShape::Body(b)] => {
                then(&self.scene_of_bodies([a, b], shifted)?)
            }
            [PreparedShape::HalfSpace(plane), PreparedShape::Body(body)] => {
                self.with_half_space_scene(plane, 0, body, shifted, then)
            }
            [PreparedShape::Body(body), PreparedShape::HalfSpace(plane)] => {
                self.with_half_space_scene(plane, 1, body, shifted, then)
            }
            [PreparedShape::HalfSpace(_), PreparedShape::HalfSpace(_)] => {
                Err(CastError::BothHalfSpaces)
            }
        }
    }

    fn scene_of_bodies<'b>(
        &self,
        bodies: [&'b BodyOfShape; 2],
        shifted: [MotionFromCastStart; 2],
    ) -> Result<Scene<'b>, CastError> {
        let frames = shifted.map(|shifted| shifted.motion);
        let shifted = [0, 1].map(|k| shifted[k].without_ball_rotation(bodies[k]));
        let sides = [0, 1].map(|k| shifted[k].motion_with_extent(bodies[k]));
        let slack = |k: usize| {
            bodies[k].slack() + max_point_deviation(shifted[k].deviation_bound, &sides[k])
        };
        let rounded = self.displacement_error_bound(max_relative_displacement(
            &sides,
            self.target + self.tolerance(&bodies),
        ));
        let settings = self.settings(&bodies, slack(0) + slack(1) + rounded)?;
        let within = settings.margin + settings.tolerance;
        Ok(Scene {
            bodies,
            motions: sides.map(|side| side.motion),
            frame_motions: frames,
            horizon: QueryDuration::new(sides, within, self.interval.length()),
            interval: self.interval,
            target_distance: self.target,
            settings,
        })
    }

    /// Builds the engine's scene for a cast of a body against a half-space, which is shape `index` (0 or 1) of the
    /// cast.
    fn with_half_space_scene<T>(
        &self,
        plane: &HalfSpace,
        index: usize,
        body: &BodyOfShape,
        shifted: [MotionFromCastStart; 2],
        then: impl FnOnce(&Scene<'_>) -> Result<T, CastError>,
    ) -> Result<T, CastError> {
        let frames = shifted.map(|shifted| shifted.motion);
        let side = shifted[1 - index].without_ball_rotation(body);
        let deviation_bound = side.deviation_bound;
        let side = side.motion_with_extent(body);
        let plane_motion = shifted[index].half_space_motion(&side);
        let within = self.settings(&[body], body.slack())?;
        let within = within.margin + within.tolerance;
        let duration = self.interval.length();
        let reach =
            |horizon: QueryDuration| plane.reach(plane_motion, side, within, horizon.duration());
        let horizon = plane.query_duration(plane_motion, side, within, duration);
        // The box deviates by at most the motion's deviation at its farthest point.
        let reach = reach(horizon);
        let plane_distance_from_center = length(plane_motion.about - plane_motion.motion.center());
        let plane_deviation = shifted[index]
            .deviation_bound
            .at_reach(4.0 * reach + plane_distance_from_center);
        let slack = body.slack()
            + max_point_deviation(deviation_bound, &side)
            + plane_deviation
            + self.displacement_error_bound(reach);
        let settings = self.settings(&[body], slack)?;
        let plane_box = plane
            .covering_box(plane_motion, 2.0 * reach)
            .map_err(|error| CastError::Shape {
                shape_number: index as u8 + 1,
                error,
            })?;
        let (mut bodies, mut motions) = ([&plane_box, body], [plane_motion.motion, side.motion]);
        if index == 1 {
            bodies.reverse();
            motions.reverse();
        }
        then(&Scene {
            bodies,
            motions,
            frame_motions: frames,
            horizon,
            interval: self.interval,
            target_distance: self.target,
            settings,
        })
    }

    /// Returns the first contact; with [`StartPolicy::Leave`], pieces that overlap at the start and begin to separate
    /// are ignored.
    fn first_hit(
        &self,
        scene: &Scene<'_>,
        solver: &mut Solver,
    ) -> Result<Option<CastHit>, CastError> {
        let hit = scene.first_contact(solver)?;
        match hit {
            Some(hit)
                if hit.status == CastStatus::Overlap
                    && self.start_policy == StartPolicy::Leave
                    && scene.may_ignore_overlap() =>
            {
                first_contact_unless_separating(scene, hit, solver)
            }
            _ => Ok(hit),
        }
    }

    /// Returns both motions from the start of the interval on, relative to an observer who moves with the velocity of
    /// the second body. So a large common velocity does not increase rounding errors.
    fn relative_motions_from_start(&self) -> Result<[MotionFromCastStart; 2], CastError> {
        let observer_velocity = self.motions[1].velocity();
        let shifted = |motion: &Motion| {
            MotionFromCastStart::new(motion, self.interval.start, observer_velocity)
        };
        CastError::motions_or_error(self.motions.each_ref().map(shifted))
    }

    /// Bounds the rounding error of subtracting the velocities, for bodies that move `displacement` past each other.
    fn displacement_error_bound(&self, displacement: f64) -> f64 {
        if self.motions[1].velocity() == DVec3::ZERO {
            0.0
        } else {
            VELOCITY_DIFFERENCE_ROUNDING * displacement
        }
    }

    /// Returns the tolerance of the cast: the tolerance of the options, or a default that is smaller for tiny bodies.
    fn tolerance(&self, bodies: &[&BodyOfShape]) -> f64 {
        let sizes = bodies.iter().map(|body| body.enclosing_ball.1);
        let sizes = sizes.filter(|size| *size > 0.0);
        let default = sizes.fold(self.default_tolerance, |least, size| {
            lesser(least, MAX_TOLERANCE_RADIUS_RATIO * size)
        });
        let from_options = self.options.tolerance;
        from_options.unwrap_or(greater(default, LEAST_TOLERANCE))
    }

    /// Returns the engine's settings for bodies whose points deviate by at most `slack`.
    fn settings(&self, bodies: &[&BodyOfShape], slack: f64) -> Result<Settings, CastError> {
        let margin = self.target + slack;
        if !(self.target >= 0.0 && margin.is_finite()) {
            return Err(CastError::InvalidNumber {
                what: "the target distance",
                value: self.target,
                allowed: "at least 0 and finite",
            });
        }
        Ok(Settings {
            tolerance: self.tolerance(bodies),
            margin,
            start_policy: self.start_policy,
            budget: self.options.budget,
            deadline: self.options.deadline,
            ..Settings::DEFAULT
        })
    }
}

impl MotionFromCastStart {
    fn new(motion: &Motion, start: f64, observer_velocity: DVec3) -> Result<Self, InputError> {
        // All points of a body that does not rotate move straight; its origin as the center rounds least.
        let center = if motion.angular_velocity() == DVec3::ZERO {
            DVec3::ZERO
        } else {
            motion.center()
        };
        let motion = Motion::about(
            motion.start(),
            motion.velocity(),
            motion.angular_velocity(),
            center,
        )?;
        let Stretch {
            motion,
            deviation_bound,
            ..
        } = motion.stretch_between(start, start)?;
        let velocity = motion.velocity() - observer_velocity;
        Ok(MotionFromCastStart {
            motion: Motion::about(motion.start(), velocity, motion.angular_velocity(), center)?,
            deviation_bound,
        })
    }

    /// Returns the motion with a ball that contains the body, and whose center moves in a straight line.
    fn motion_with_extent(&self, body: &BodyOfShape) -> MotionWithExtent {
        let (center, radius) = body.enclosing_ball;
        let about = self.rotation_center_or(center);
        MotionWithExtent {
            motion: self.motion,
            about,
            max_radius: (length(center - about) + radius) * ROUNDING_ENLARGEMENT,
        }
    }

    fn rotation_center_or(&self, point: DVec3) -> DVec3 {
        if self.motion.angular_velocity() == DVec3::ZERO {
            point
        } else {
            self.motion.center()
        }
    }

    /// Returns the motion of a half-space, about the other body's start position or, if the half-space rotates, about
    /// the center.
    fn half_space_motion(&self, other: &MotionWithExtent) -> MotionWithExtent {
        let start = self.motion.start();
        let body_start = start.inverse().transform_point(other.start_position());
        MotionWithExtent {
            motion: self.motion,
            about: self.rotation_center_or(body_start),
            max_radius: 0.0,
        }
    }

    /// Returns the motion, without the angular velocity if the body is a ball that rotates about its center.
    fn without_ball_rotation(self, body: &BodyOfShape) -> Self {
        if body.ball_center != Some(self.motion.center()) {
            return self;
        }
        let [velocity, center] = [self.motion.velocity(), self.motion.center()];
        let without_rotation = Motion::about(self.motion.start(), velocity, DVec3::ZERO, center);
        MotionFromCastStart {
            motion: without_rotation.unwrap_or(self.motion),
            ..self
        }
    }
}

/// Returns a bound on the deviation of any point of a body, as a length.
fn max_point_deviation(deviation_bound: DeviationBound, side: &MotionWithExtent) -> f64 {
    deviation_bound.at_reach(side.max_radius + length(side.about - side.motion.center()))
}

#[cfg(test)]
mod tests;
