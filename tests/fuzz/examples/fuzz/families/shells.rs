//! Draws queries of closed parts next to each other and nested, oriented outward or inward.

use super::{motion_at_rest, passing_case, settings_with_random_tolerance};
use crate::case::{Case, Expectation, MeshClass, Shape};
use crate::draw::{RandomSource, add_arrays, scale_array};
use crate::raw_motion::RawMotion;
use crate::shapes;

pub(super) fn draw(draw: &mut RandomSource) -> Case {
    let several = closed_parts(draw);
    let other = if draw.bool_with_probability(0.3) {
        self::closed_parts(draw)
    } else {
        shapes::any_shape(draw)
    };
    let size = draw.pick(&[0.1, 0.3, 1.0]);
    let other = other.map(|v| scale_array(v, size));
    let config = settings_with_random_tolerance(draw);
    let turn = if draw.bool_with_probability(0.5) {
        0.0
    } else {
        draw.log_uniform(0.01..6.0)
    };
    if draw.bool_with_probability(0.5) {
        return passing_case(draw, [several, other], turn, config);
    }
    // The position is somewhere within, or on, the parts.
    let at = if draw.bool_with_probability(0.3) {
        draw.pick(&several.vertices)
    } else {
        scale_array(draw.point(), several.radius())
    };
    let start = draw.pose(at);
    let velocity = scale_array(draw.direction(), draw.uniform(0.0..4.0));
    let spin = scale_array(draw.direction(), turn);
    let courses = [
        motion_at_rest(),
        RawMotion::from_velocities(start, velocity, spin),
    ];
    Case {
        shapes: [several, other],
        motions: courses,
        duration: 1.0,
        config,
        expected: Expectation::Unknown,
    }
}

/// Returns a shape of one to four closed parts. Some are inside out, and some are nested.
fn closed_parts(draw: &mut RandomSource) -> Shape {
    let count = draw.count(1..5);
    let mut all = Shape::default();
    let (mut at, mut size) = ([0.0; 3], 1.0);
    for _ in 0..count {
        let part = if draw.bool_with_probability(0.6) {
            shapes::cuboid([0.5; 3])
        } else {
            shapes::closed_shape(draw)
        };
        let (here, scale) = (at, size);
        let part = part.map(|v| add_arrays(scale_array(v, scale), here));
        let part = if draw.bool_with_probability(0.5) {
            part.with_reversed_faces()
        } else {
            part
        };
        all = all.joined_with(&part);
        match draw.count(0..3) {
            // The part is within the last one, next to it, or flush with it.
            0 => size *= draw.uniform(0.1..0.8),
            1 => {
                at = add_arrays(
                    at,
                    scale_array(draw.direction(), draw.uniform(2.0..4.0) * size),
                );
            }
            _ => at[draw.count(0..3)] += size,
        }
    }
    all.mesh_class = MeshClass::TriangleSoup;
    all
}
