//! Draws queries under `StartPolicy::Leave` of bodies in contact at the start, which separate, slide, approach or
//! rotate.

use super::{motion_at_rest, settings_with_random_tolerance};
use crate::case::{Case, Expectation, Shape};
use crate::draw::{RandomSource, add_arrays, scale_array};
use crate::raw_motion::{RawMotion, RawPose};
use crate::shapes;
use ccd_core::StartPolicy;

pub(super) fn draw(draw: &mut RandomSource) -> Case {
    let half = [(); 3].map(|()| draw.log_uniform(0.2..2.0));
    let floor = shapes::cuboid([8.0, 8.0, 0.5]).map(|[x, y, z]| [x, y, z - 0.5]);
    let floor = if draw.bool_with_probability(0.2) {
        floor.with_reversed_faces()
    } else {
        floor
    };
    let (top, half_height) = match draw.count(0..4) {
        0 => (shapes::cuboid(half), half[2]),
        1 => put_on_floor(shapes::closed_shape(draw)),
        2 => put_on_floor(shapes::tetrahedron(draw)),
        _ => {
            let count = draw.count(1..5);
            put_on_floor(shapes::soup(draw, count))
        }
    };
    let mut config = settings_with_random_tolerance(draw);
    config.start_policy = StartPolicy::Leave;
    if draw.bool_with_probability(0.3) {
        config.margin = draw.log_uniform(1e-3..1.0);
    }
    // The body is on the floor, within the tolerance of it, or within the margin.
    let gap = match draw.count(0..4) {
        0 | 1 => 0.0,
        2 => config.tolerance * draw.uniform(0.01..1.0),
        _ => config.margin * draw.uniform(0.0..1.0),
    };
    let at = [
        draw.uniform(-1.0..1.0),
        draw.uniform(-1.0..1.0),
        half_height + gap,
    ];
    let (velocity, spin, expect) = random_velocities_and_expectation(draw, gap, config.margin);
    let mut courses = [
        motion_at_rest(),
        RawMotion::from_velocities(RawPose::at(at), velocity, spin),
    ];
    if draw.bool_with_probability(0.3) {
        // The tangential velocity has no upward part, so that the gap is unchanged.
        let by = [draw.uniform(-1e3..1e3), draw.uniform(-1e3..1e3), 0.0];
        courses
            .iter_mut()
            .for_each(|c| c.start.position = add_arrays(c.start.position, by));
    }
    let mut shapes = [floor, top];
    if draw.bool_with_probability(0.5) {
        shapes.swap(0, 1);
        courses.swap(0, 1);
    }
    Case {
        shapes,
        motions: courses,
        duration: 1.0,
        config,
        expected: expect,
    }
}

/// Returns a shape moved so that its lowest corner is at z = 0, with 0 as the height of its origin above that plane.
fn put_on_floor(shape: Shape) -> (Shape, f64) {
    let lowest = shape
        .vertices
        .iter()
        .fold(f64::INFINITY, |m, v| if v[2] < m { v[2] } else { m });
    (shape.map(|[x, y, z]| [x, y, z - lowest]), 0.0)
}

/// Returns a random velocity and angular velocity of a body in contact at the start, and the expected result.
fn random_velocities_and_expectation(
    draw: &mut RandomSource,
    gap: f64,
    margin: f64,
) -> ([f64; 3], [f64; 3], Expectation) {
    let along = scale_array(draw.point(), draw.uniform(0.0..3.0));
    match draw.count(0..5) {
        0 => (
            [0.0, 0.0, draw.uniform(0.0..3.0)],
            [0.0; 3],
            Expectation::Free,
        ),
        // Inside the margin, motion over the next triangle of the floor is a contact.
        1 if margin == 0.0 => (
            [along[0], along[1], draw.uniform(0.1..2.0)],
            [0.0; 3],
            Expectation::Free,
        ),
        2 => ([along[0], along[1], 0.0], [0.0; 3], Expectation::Unknown),
        3 => {
            let down = draw.log_uniform(1e-3..3.0);
            // All of the gap is closed by then.
            let by = (1.001 * gap + 1e-6) / down;
            let expect = if by < 1.0 {
                Expectation::ContactBy(by)
            } else {
                Expectation::Unknown
            };
            ([along[0], along[1], -down], [0.0; 3], expect)
        }
        _ => (
            along,
            scale_array(draw.direction(), draw.log_uniform(1e-3..6.0)),
            Expectation::Unknown,
        ),
    }
}
