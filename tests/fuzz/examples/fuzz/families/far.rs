//! Draws queries with end poses and centers of rotation far from the origin, and with tight tolerances.

use super::passing_case;
use crate::case::Case;
use crate::draw::{RandomSource, add_arrays, scale_array};
use crate::raw_motion::{MotionSpec, RawMotion, RawPose};
use crate::shapes;
use ccd_core::Settings;

pub(super) fn draw(draw: &mut RandomSource) -> Case {
    let config = Settings {
        tolerance: draw.log_uniform(1e-12..1e-2),
        ..Settings::DEFAULT
    };
    let bodies = [shapes::any_shape(draw), shapes::any_shape(draw)];
    let mut case = passing_case(draw, bodies, 0.0, config);
    let far = if draw.bool_with_probability(0.7) {
        scale_array(draw.direction(), draw.log_uniform(1.0..1e12))
    } else {
        [0.0; 3]
    };
    let whole = draw.bool_with_probability(0.5);
    case.duration = if draw.bool_with_probability(0.5) {
        1.0
    } else {
        draw.log_uniform(1e-6..1e6)
    };
    for course in &mut case.motions {
        *course = far_motion(draw, course, far, case.duration);
        if whole {
            course.start.position = course.start.position.map(f64::round);
        }
    }
    case
}

/// Returns a motion with the displacement of `course` and a start moved by `far`, in most cases between end poses and
/// about a random center.
fn far_motion(
    draw: &mut RandomSource,
    course: &RawMotion,
    far: [f64; 3],
    duration: f64,
) -> RawMotion {
    let MotionSpec::Velocities { linear, .. } = course.spec else {
        return *course;
    };
    let start = RawPose {
        position: add_arrays(course.start.position, far),
        ..course.start
    };
    let center = match draw.count(0..3) {
        0 => [0.0; 3],
        1 => draw.point(),
        _ => scale_array(draw.direction(), draw.log_uniform(1.0..1e9)),
    };
    if draw.bool_with_probability(0.15) {
        let slow = |v: [f64; 3]| scale_array(v, 1.0 / duration);
        let goal = MotionSpec::Velocities {
            linear: slow(linear),
            spin: slow(draw.point()),
        };
        return RawMotion {
            start,
            spec: goal,
            center,
        };
    }
    let quaternion = match draw.count(0..3) {
        0 => start.quaternion,
        1 => draw.quaternion(),
        // The rotation is small.
        _ => {
            let (by, turn) = (draw.quaternion(), draw.log_uniform(1e-9..1.0));
            [0, 1, 2, 3].map(|k| start.quaternion[k] + turn * by[k])
        }
    };
    let end = RawPose {
        position: add_arrays(start.position, linear),
        quaternion,
    };
    RawMotion {
        start,
        spec: MotionSpec::EndPose(end),
        center,
    }
}
