//! Computes the screw motion between two poses.

use ccd_core::glam::{DQuat, DVec3};
use ccd_core::{InputError, Motion};
use ccd_tables::motions::Motions;

/// The least |sin(angle / 2)| for which the screw axis is computed; rotations near a multiple of 2π have no stable
/// axis.
///
/// The axis lies up to travel / (2 · this) away, and rounding moves the end pose by 2⁻⁵³ of that:
/// at 2⁻¹² about 3e-13 of the travel.
const MIN_HALF_ANGLE_SINE: f64 = 1.0 / 4096.0;

/// The largest distance of two positions that count as equal up to rounding, as a fraction of the motion's displacement.
const MAX_ROUNDING_PER_TRAVEL: f64 = 1e-9;

/// Returns the query with every motion replaced by the screw from its start pose to its end pose
/// \[CONTACT02\].
///
/// The turn is the same, whole turns included. The center moves to the screw axis, and its velocity
/// is along the axis. A motion without turn is unchanged, and so is one whose turn is too near to a
/// multiple of 2π for the axis to be computed.
///
/// # Errors
/// If a screw's parameters overflow.
pub fn to_screw_motions(query: &Motions) -> Result<Motions, InputError> {
    Ok(Motions {
        id: query.id.clone(),
        a: screw_motion(&query.a, query.duration)?,
        b: screw_motion(&query.b, query.duration)?,
        duration: query.duration,
    })
}

/// Returns whether both motions of a query are already screws, up to rounding.
pub fn are_screw_motions(query: &Motions) -> bool {
    let same = |motion: &Motion| {
        let Ok(screw) = screw_motion(motion, query.duration) else {
            return false;
        };
        let travel = motion.velocity().length() * query.duration;
        let apart = |fraction: f64| {
            let time = fraction * query.duration;
            let [given, along] =
                [motion, &screw].map(|m| m.pose(time).transform_point(motion.center()));
            given.distance(along)
        };
        [0.25, 0.5, 0.75]
            .into_iter()
            .all(|fraction| apart(fraction) <= MAX_ROUNDING_PER_TRAVEL * travel)
    };
    same(&query.a) && same(&query.b)
}

fn screw_motion(motion: &Motion, duration: f64) -> Result<Motion, InputError> {
    let half_turn = 0.5 * motion.angular_velocity().length() * duration;
    let Some(axis) = motion.angular_velocity().try_normalize() else {
        return Ok(*motion);
    };
    if !(half_turn.sin().abs() >= MIN_HALF_ANGLE_SINE) {
        return Ok(*motion);
    }
    let along = motion.velocity().dot(axis) * axis;
    let across = (motion.velocity() - along) * duration;
    // The turn by 2h about the axis at `offset` from the center moves the center by `across`: the
    // center, its image and the axis are an isosceles triangle with the angle 2h at the axis.
    let offset = 0.5 * (across + axis.cross(across) * (half_turn.cos() / half_turn.sin()));
    let center = motion.center() + to_body_frame(motion.start().rotation(), offset);
    Motion::about(motion.start(), along, motion.angular_velocity(), center)
}

fn to_body_frame(rotation: DQuat, vector: DVec3) -> DVec3 {
    rotation.conjugate() * vector
}

#[cfg(test)]
mod tests;
