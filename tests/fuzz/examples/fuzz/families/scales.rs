//! Draws queries of bodies of very different sizes.

use super::{passing_case, settings_with_random_tolerance};
use crate::case::Case;
use crate::draw::{RandomSource, add_arrays, scale_array};
use crate::raw_motion::MotionSpec;
use crate::shapes;
use ccd_core::order::{greater, lesser};

pub(super) fn draw(draw: &mut RandomSource) -> Case {
    let sizes = [draw.log_uniform(1e-9..1e9), draw.log_uniform(1e-9..1e9)];
    let large = greater(sizes[0], sizes[1]);
    let bodies = sizes.map(|size| shapes::any_shape(draw).map(|v| scale_array(v, size)));
    let mut config = settings_with_random_tolerance(draw);
    config.tolerance *= if draw.bool_with_probability(0.5) {
        large
    } else {
        lesser(sizes[0], sizes[1])
    };
    let turn = if draw.bool_with_probability(0.5) {
        0.0
    } else {
        draw.log_uniform(1e-3..6.0)
    };
    let target = draw.pick(&bodies[0].vertices);
    let mut case = passing_case(draw, bodies, turn, config);
    if draw.bool_with_probability(0.5) && turn == 0.0 {
        // A corner of one flies straight at the other, since small ones would never be hit otherwise.
        case.motions[0].start.quaternion = [1.0, 0.0, 0.0, 0.0];
        let start = add_arrays(
            case.motions[1].start.position,
            scale_array(draw.direction(), 2.0 * large),
        );
        case.motions[0].start.position = add_arrays(start, scale_array(target, -1.0));
        let way = add_arrays(case.motions[1].start.position, scale_array(start, -1.0));
        let linear = scale_array(way, draw.uniform(0.7..1.5));
        case.motions[0].spec = MotionSpec::Velocities {
            linear,
            spin: [0.0; 3],
        };
        case.motions[1].spec = MotionSpec::Velocities {
            linear: [0.0; 3],
            spin: [0.0; 3],
        };
    }
    case
}
