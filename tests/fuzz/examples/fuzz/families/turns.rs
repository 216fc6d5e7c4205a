//! Draws queries with rotations of up to a thousand radians.

use super::{passing_case, settings_with_random_tolerance};
use crate::case::Case;
use crate::draw::{RandomSource, scale_array};
use crate::shapes;

pub(super) fn draw(draw: &mut RandomSource) -> Case {
    let bodies = [shapes::any_shape(draw), shapes::any_shape(draw)];
    let mut config = settings_with_random_tolerance(draw);
    if draw.bool_with_probability(0.2) {
        config.margin = draw.log_uniform(1e-3..1.0);
    }
    let turn = draw.log_uniform(0.1..1000.0);
    let mut case = passing_case(draw, bodies, turn, config);
    for course in &mut case.motions {
        if draw.bool_with_probability(0.3) {
            course.center = scale_array(draw.direction(), draw.log_uniform(0.1..10.0));
        }
    }
    case
}
