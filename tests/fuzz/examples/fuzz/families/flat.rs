//! Draws queries of faces that move flat onto each other, or pass each other in one plane.

use super::{motion_at_rest, settings_with_random_tolerance};
use crate::case::{Case, Expectation, Shape};
use crate::draw::{RandomSource, add_arrays, scale_array};
use crate::raw_motion::{RawMotion, RawPose};
use crate::shapes;

pub(super) fn draw(draw: &mut RandomSource) -> Case {
    let bodies = [polygon_or_box_on_plane(draw), polygon_or_box_on_plane(draw)];
    let mut config = settings_with_random_tolerance(draw);
    if draw.bool_with_probability(0.3) {
        config.margin = draw.pick(&[0.125, 0.5, 1.0]);
    }
    let high = draw.pick(&[0.0, 0.0, 0.25, 1.0, 1.5]);
    let aside = [
        draw.pick(&[-3.0, -2.0, 0.0]),
        draw.pick(&[-1.0, -0.5, 0.0, 0.25]),
    ];
    let start = [aside[0], aside[1], high];
    let down = if draw.bool_with_probability(0.5) {
        -2.0 * high
    } else {
        0.0
    };
    let along = [
        draw.pick(&[0.0, 1.0, 4.0]),
        draw.pick(&[0.0, 0.0, 1.0]),
        down,
    ];
    let spin = if draw.bool_with_probability(0.7) {
        [0.0; 3]
    } else {
        scale_array(
            draw.pick(&[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]),
            draw.uniform(-2.0..2.0),
        )
    };
    let mut courses = [
        motion_at_rest(),
        RawMotion::from_velocities(RawPose::at(start), along, spin),
    ];
    if draw.bool_with_probability(0.3) {
        // The same scene in another frame.
        let far = scale_array(draw.point(), draw.log_uniform(1.0..1e4));
        for course in &mut courses {
            course.start.position = add_arrays(course.start.position, far);
        }
    }
    Case {
        shapes: bodies,
        motions: courses,
        duration: 1.0,
        config,
        expected: Expectation::Unknown,
    }
}

/// Returns a polygon in the plane z = 0, or a box with its lower face there.
fn polygon_or_box_on_plane(draw: &mut RandomSource) -> Shape {
    if draw.bool_with_probability(0.4) {
        let half = [(); 3].map(|()| draw.pick(&[0.25, 0.5, 1.0]));
        return shapes::cuboid(half).map(|[x, y, z]| [x, y, z + half[2]]);
    }
    let count = draw.count(1..5);
    let flat = shapes::soup(draw, count).map(|[x, y, _]| [x, y, 0.0]);
    if draw.bool_with_probability(0.5) {
        flat.map(|v| v.map(|x| (4.0 * x).round() / 4.0))
    } else {
        flat
    }
}
