//! Boxes that moving bodies do not leave, for a broad phase over many of them.

use crate::config::Config;
use crate::error::InputError;
use crate::math::order::{greater, lesser};
use crate::math::vector::{distance, length};
use crate::motion::path::Path;
use crate::problem::{Moving, Side, check_config, check_coordinates};
use crate::tolerance::{least_tolerance, share_of_rounding};
use glam::DVec3;

/// A box along the world's axes that a moving body does not leave, grown by half the distance of a contact.
///
/// # Guarantee
/// Two bodies are free, over the same duration and with the same settings, if their boxes have no point in common.
///
/// ```
/// use ccd_core::{Body, Config, Motion, Moving, Pose};
/// let ball = Body::ball(0.5)?;
/// let flies = Motion::new(Pose::IDENTITY, [3.0, 0.0, 0.0], [0.0; 3])?;
/// let swept = Moving::from((&ball, flies)).swept_box(1.0, &Config::default())?;
/// assert!((swept.max.x - 3.5).abs() < 1e-3 && (swept.max.y - 0.5).abs() < 1e-3);
///
/// let beside = Motion::still(Pose::at([2.0, 1.1, 0.0])?);
/// let other = Moving::from((&ball, beside)).swept_box(1.0, &Config::default())?;
/// assert!(!swept.meets(&other));
/// # Ok::<(), ccd_core::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SweptBox {
    /// The corner of least coordinates.
    pub min: DVec3,
    /// The corner of greatest coordinates.
    pub max: DVec3,
}

impl SweptBox {
    /// Returns whether two boxes have a point in common.
    pub fn meets(&self, other: &SweptBox) -> bool {
        self.min.cmple(other.max).all() && other.min.cmple(self.max).all()
    }
}

impl Moving<'_> {
    /// Returns a box that the body does not leave from time 0 to `duration`.
    ///
    /// The box is about all poses: that at the start, moved along, and grown by what the body turns; or the ball
    /// that a body which turns farther stays in.
    ///
    /// # Errors
    /// [`InputError::OutOfRange`] for what [`Problem::new`](crate::Problem::new) refuses, with a travel at most 1e12
    /// from the world's origin.
    pub fn swept_box(&self, duration: f64, config: &Config) -> Result<SweptBox, InputError> {
        check_config(duration, config)?;
        check_coordinates("position", self.motion.start().translation())?;
        check_coordinates("centre", self.motion.centre())?;
        let side = Side {
            body: self.body,
            given: None,
            path: Path::new(&self.motion, DVec3::ZERO, duration),
        };
        side.check()?;
        let Side { path, .. } = &side;
        let (low, high) = at_start(&side);
        // As seen from the centre of rotation, which goes straight, the body only turns.
        let way = path.velocity;
        let room = DVec3::splat(room(&side, config));
        Ok(SweptBox {
            min: low + least(way, DVec3::ZERO) - room,
            max: high + most(way, DVec3::ZERO) + room,
        })
    }
}

/// Returns the box at the start about all that the body turns to while its centre of rotation stands still.
fn at_start(side: &Side<'_>) -> (DVec3, DVec3) {
    let path = &side.path;
    let whole = side.body.tree().whole();
    let frame = path.frame(0.0);
    let centre = frame.point(whole.centre);
    let reach = DVec3::AXES.map(|axis| {
        let along = frame.inverse_vector(axis);
        let half = (whole.axes.transpose() * along).abs().dot(whole.half) + whole.slack;
        lesser(half, whole.radius)
    });
    // No point is farther from the centre of rotation.
    let arm = distance(whole.centre, path.centre) + whole.radius;
    let swing = lesser(path.rate, 2.0) * arm;
    let reach = DVec3::from_array(reach) + swing;
    let (pivot, arm) = (path.centre_at(0.0), DVec3::splat(arm));
    (
        most(centre - reach, pivot - arm),
        least(centre + reach, pivot + arm),
    )
}

/// Bounds half the distance of a contact, which is the greater one of the settings and the least that can be
/// certified, and the rounding of the box.
fn room(side: &Side<'_>, config: &Config) -> f64 {
    let path = &side.path;
    let way = length(path.centre_at(0.0)) + path.speed() + config.margin;
    let rounding = share_of_rounding(side.span(), path.rate, way);
    // The box is made by no more operations than a distance; its sums round by a few units of the greatest number.
    0.5 * (config.margin + config.tolerance) + least_tolerance(rounding) + 2.0 * rounding
}

fn least(a: DVec3, b: DVec3) -> DVec3 {
    DVec3::new(lesser(a.x, b.x), lesser(a.y, b.y), lesser(a.z, b.z))
}

fn most(a: DVec3, b: DVec3) -> DVec3 {
    DVec3::new(greater(a.x, b.x), greater(a.y, b.y), greater(a.z, b.z))
}

#[cfg(test)]
mod tests;
