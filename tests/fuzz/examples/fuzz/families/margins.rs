//! Draws queries with margins from a thousandth of the size of the bodies to a hundred times their size.

use super::{passing_case, settings_with_random_tolerance};
use crate::case::Case;
use crate::draw::{RandomSource, scale_array};
use crate::shapes;

pub(super) fn draw(draw: &mut RandomSource) -> Case {
    let bodies = [shapes::any_shape(draw), shapes::any_shape(draw)];
    let mut config = settings_with_random_tolerance(draw);
    config.margin = draw.log_uniform(1e-3..100.0);
    let turn = if draw.bool_with_probability(0.5) {
        0.0
    } else {
        draw.log_uniform(1e-3..10.0)
    };
    let mut case = passing_case(draw, bodies, turn, config);
    if draw.bool_with_probability(0.3) {
        // The start is inside the margin.
        let near = draw.uniform(0.0..1.0);
        for course in &mut case.motions {
            course.start.position = scale_array(course.start.position, near);
        }
    }
    case
}
