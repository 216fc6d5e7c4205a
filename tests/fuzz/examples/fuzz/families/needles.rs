//! Draws queries of needles and slivers, with denormal components and faces without area.

use super::{motion_at_rest, passing_case, settings_with_random_tolerance};
use crate::case::{Case, Shape};
use crate::draw::{RandomSource, add_arrays, scale_array};
use crate::raw_motion::MotionSpec;
use crate::shapes;

pub(super) fn draw(draw: &mut RandomSource) -> Case {
    let thin = thin_triangles(draw);
    let other = if draw.bool_with_probability(0.5) {
        self::thin_triangles(draw)
    } else {
        shapes::any_shape(draw)
    };
    let mut config = settings_with_random_tolerance(draw);
    if draw.bool_with_probability(0.4) {
        config.margin = draw.log_uniform(1e-2..2.0);
    }
    let turn = if draw.bool_with_probability(0.4) {
        0.0
    } else {
        draw.log_uniform(1e-3..6.0)
    };
    let shapes = if draw.bool_with_probability(0.5) {
        [thin, other]
    } else {
        [other, thin]
    };
    let mut case = passing_case(draw, shapes, turn, config.clone());
    if draw.bool_with_probability(0.3) {
        for course in &mut case.motions {
            course.start.quaternion = [1.0, 0.0, 0.0, 0.0];
        }
    }
    if draw.bool_with_probability(0.3) {
        // The body moves straight at the other one, across a plane that holds needles.
        let reach = case.shapes[0].radius() + case.shapes[1].radius() + config.margin;
        let way = lattice_or_unit_direction(draw);
        case.motions = [motion_at_rest(), motion_at_rest()];
        case.motions[0].start.position = scale_array(way, -1.5 * reach);
        let linear = scale_array(way, reach * draw.uniform(0.5..2.0));
        case.motions[0].spec = MotionSpec::Velocities {
            linear,
            spin: [0.0; 3],
        };
    }
    case
}

/// Returns thin triangles: in one plane, around one axis, or anywhere.
fn thin_triangles(draw: &mut RandomSource) -> Shape {
    let width = match draw.count(0..3) {
        0 => draw.log_uniform(1e-300..1e-140),
        // The squares are denormal.
        1 => draw.log_uniform(1e-163..1e-160),
        _ => draw.log_uniform(1e-14..1e-1),
    };
    let count = draw.log_uniform(1.0..9.0) as usize;
    let common = draw
        .bool_with_probability(0.5)
        .then(|| lattice_or_unit_direction(draw));
    let about = draw.bool_with_probability(0.5).then_some([0.0; 3]);
    let mut shape = Shape::default();
    for _ in 0..count {
        let at = about.unwrap_or_else(|| scale_array(draw.point(), 0.5));
        let along = common.unwrap_or_else(|| lattice_or_unit_direction(draw));
        let aside = scale_array(lattice_or_unit_direction(draw), width);
        let fraction = draw.pick(&[0.0, 0.5, 1.0, 0.3, -0.7]);
        let third = match draw.count(0..5) {
            // The area is zero.
            0 => add_arrays(at, scale_array(along, fraction)),
            1 => at,
            2 => add_arrays(at, add_arrays(along, aside)),
            _ => add_arrays(add_arrays(at, scale_array(along, fraction)), aside),
        };
        let first = if draw.bool_with_probability(0.3) {
            add_arrays(at, scale_array(aside, -0.5))
        } else {
            at
        };
        let base = shape.vertices.len() as u32;
        shape.vertices.extend([first, add_arrays(at, along), third]);
        shape.faces.push([base, base + 1, base + 2]);
    }
    shape
}

/// Returns a vector with whole components from −2 to 2, or a random unit vector.
fn lattice_or_unit_direction(draw: &mut RandomSource) -> [f64; 3] {
    if draw.bool_with_probability(0.3) {
        return draw.direction();
    }
    let whole = [(); 3].map(|()| draw.pick(&[-2.0, -1.0, 0.0, 0.0, 1.0, 1.0, 2.0]));
    if whole == [0.0; 3] {
        [1.0, 0.0, 0.0]
    } else {
        whole
    }
}
