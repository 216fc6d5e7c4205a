//! Bounding boxes of bodies over their whole motion, for the broad phase of a query about many bodies.

use crate::body::Body;
use crate::error::InputError;
use crate::math::order::lesser;
use crate::math::vector::{componentwise_max, componentwise_min, distance, length};
use crate::motion::Motion;
use crate::motion::path::Path;
use crate::motion::trajectory::{Stretch, Trajectory};
use crate::problem::{BodyWithPath, check_coordinates};
use crate::query::{Movement, MovingBody};
use crate::rounding::{RETIMED_POSE_ERROR_F64, body_distance_rounding, least_tolerance};
use crate::settings::{QuerySettings, Settings};
use glam::DVec3;

/// An axis-aligned box in the world that contains a moving body at all times, grown by half the contact distance.
///
/// # Guarantee
/// Two bodies are free, over the same duration and with the same settings, if their boxes have no point in common.
///
/// ```
/// use ccd_core::{Body, Motion, MovingBody, Pose, Settings};
/// let ball = Body::sphere(0.5)?;
/// let flies = Motion::new(Pose::IDENTITY, [3.0, 0.0, 0.0], [0.0; 3])?;
/// let swept = MovingBody::from((&ball, flies)).swept_box(1.0, &Settings::DEFAULT)?;
/// assert!((swept.max.x - 3.5).abs() < 1e-3 && (swept.max.y - 0.5).abs() < 1e-3);
///
/// let beside = Motion::still(Pose::at([2.0, 1.1, 0.0])?);
/// let other = MovingBody::from((&ball, beside)).swept_box(1.0, &Settings::DEFAULT)?;
/// assert!(!swept.meets(&other));
/// # Ok::<(), ccd_core::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SweptBox {
    /// The corner with the least coordinates.
    pub min: DVec3,
    /// The corner with the greatest coordinates.
    pub max: DVec3,
}

impl SweptBox {
    /// Returns whether two boxes overlap or touch.
    pub fn meets(&self, other: &SweptBox) -> bool {
        self.min.cmple(other.max).all() && other.min.cmple(self.max).all()
    }
}

impl MovingBody<'_> {
    /// Computes a box that contains the body from time 0 to `duration`.
    ///
    /// The box contains all poses. It is the box at the start, moved along the path and grown by the displacement due
    /// to turning. For a body that turns farther, it is the box of the ball that contains the turning body.
    ///
    /// # Errors
    /// [`InputError::OutOfRange`] for values that [`Query::new`](crate::Query::new) refuses, with a travel of at most
    /// 1e12 from the world's origin.
    pub fn swept_box(&self, duration: f64, settings: &Settings) -> Result<SweptBox, InputError> {
        let terms = settings.to_query_settings();
        terms.check(duration)?;
        match self.movement {
            Movement::Motion(motion) => swept_box_of_motion(self.body, &motion, duration, &terms),
            Movement::Trajectory(trajectory) => {
                swept_box_of_stretches(self.body, trajectory, duration, &terms)
            }
        }
    }
}

/// The number of equal parts into which the duration of a trajectory is cut; each part is cut again at a corner.
const DURATION_PART_COUNT: usize = 16;

/// Computes a box that contains the body on its whole trajectory, as the union of the boxes of short stretches.
fn swept_box_of_stretches(
    body: &Body,
    trajectory: &dyn Trajectory,
    duration: f64,
    terms: &QuerySettings<'_>,
) -> Result<SweptBox, InputError> {
    let (mut whole, mut from): (Option<SweptBox>, f64) = (None, 0.0);
    for k in 1..=DURATION_PART_COUNT {
        let to = if k < DURATION_PART_COUNT {
            duration * (k as f64 / DURATION_PART_COUNT as f64)
        } else {
            duration
        };
        // A stretch that ends at a corner has a better bound. If one part has many corners, some are left out.
        let corner = trajectory
            .velocity_jump_time(from, to)
            .filter(|&at| at > from && at < to);
        for end in corner.into_iter().chain([to]) {
            let part = swept_box_of_stretch(
                body,
                &trajectory.stretch_between(from, end)?,
                end - from,
                terms,
            )?;
            whole = Some(whole.map_or(part, |whole| SweptBox {
                min: componentwise_min(whole.min, part.min),
                max: componentwise_max(whole.max, part.max),
            }));
            from = end;
        }
    }
    // `DURATION_PART_COUNT` is not 0.
    whole.map_or_else(
        || swept_box_of_motion(body, &Motion::STILL, duration, terms),
        Ok,
    )
}

/// Computes a box that contains the body throughout one stretch of a trajectory.
fn swept_box_of_stretch(
    body: &Body,
    stretch: &Stretch,
    time: f64,
    terms: &QuerySettings<'_>,
) -> Result<SweptBox, InputError> {
    let swept = swept_box_of_motion(body, &stretch.motion, time, terms)?;
    let reach = body.tree().max_distance_from(stretch.motion.center());
    let moved = 0.5 * (time * (time * length(stretch.acceleration)));
    let room = (moved + stretch.deviation_bound.at_reach(reach)) * (1.0 + RETIMED_POSE_ERROR_F64);
    // A value that is no bound is NaN. Then the body may be anywhere.
    let room = DVec3::splat(if room >= 0.0 { room } else { f64::INFINITY });
    let rounding =
        DVec3::splat(2.0 * f64::EPSILON) * componentwise_max(swept.min.abs(), swept.max.abs());
    Ok(SweptBox {
        min: swept.min - room - rounding,
        max: swept.max + room + rounding,
    })
}

fn swept_box_of_motion(
    body: &Body,
    motion: &Motion,
    duration: f64,
    terms: &QuerySettings<'_>,
) -> Result<SweptBox, InputError> {
    check_coordinates("position", motion.start().translation())?;
    check_coordinates("center", motion.center())?;
    let side = BodyWithPath {
        body,
        given_body: None,
        path: Path::new(motion, DVec3::ZERO, duration),
    };
    side.check()?;
    let BodyWithPath { path, .. } = &side;
    let (low, high) = box_of_all_orientations(&side);
    // As seen from the center of rotation, which moves straight, the body only turns.
    let way = path.velocity;
    let room = DVec3::splat(box_padding(&side, terms));
    Ok(SweptBox {
        min: low + componentwise_min(way, DVec3::ZERO) - room,
        max: high + componentwise_max(way, DVec3::ZERO) + room,
    })
}

/// Returns a box, by its least and greatest corner, that contains the body in all orientations of its motion with its
/// center of rotation held at the start.
fn box_of_all_orientations(side: &BodyWithPath<'_>) -> (DVec3, DVec3) {
    let path = &side.path;
    let whole = &side.body.tree().body_box;
    let frame = path.frame(0.0);
    let center = frame.transform_point(whole.center);
    let reach = DVec3::AXES.map(|axis| {
        let along = frame.inverse_transform_vector(axis);
        let half = (whole.axes.transpose() * along)
            .abs()
            .dot(whole.half_extents)
            + whole.slack;
        lesser(half, whole.radius)
    });
    // No point is farther from the center of rotation.
    let arm = distance(whole.center, path.center) + whole.radius;
    let swing = lesser(path.angular_speed, 2.0) * arm;
    let reach = DVec3::from_array(reach) + swing;
    let (pivot, arm) = (path.center_at(0.0), DVec3::splat(arm));
    (
        componentwise_max(center - reach, pivot - arm),
        componentwise_min(center + reach, pivot + arm),
    )
}

/// Returns the length by which a box is grown: half the contact distance plus a bound of the rounding of the box. The
/// contact distance is the margin plus the tolerance, which may be raised to the least that can be certified.
fn box_padding(side: &BodyWithPath<'_>, terms: &QuerySettings<'_>) -> f64 {
    let path = &side.path;
    let way = length(path.center_at(0.0)) + path.speed_bound() + terms.margin;
    let rounding = body_distance_rounding(side.extent_with_center(), path.angular_speed, way);
    // The box takes no more operations than a distance, and its sums round by a few units of the greatest number.
    0.5 * (terms.margin + terms.tolerance) + least_tolerance(rounding) + 2.0 * rounding
}

#[cfg(test)]
mod tests;
