//! Draws queries with budgets too small for most of them.

use super::margins;
use crate::case::Case;
use crate::draw::{RandomSource, scale_array};
use crate::shapes;

pub(super) fn draw(draw: &mut RandomSource) -> Case {
    let mut case = margins::draw(draw);
    if draw.bool_with_probability(0.5) {
        case.shapes[0] = shapes::ring(draw.count(4..9) as u32, draw.count(3..5) as u32, 0.2);
        case.shapes[1] = shapes::ring(draw.count(4..9) as u32, 3, 0.3);
    }
    if draw.bool_with_probability(0.3) {
        case.config.margin = 0.0;
    }
    if draw.bool_with_probability(0.4) {
        let near = draw.log_uniform(1e-3..1.0);
        for course in &mut case.motions {
            course.start.position = scale_array(course.start.position, near);
        }
    }
    case.config.budget = if draw.bool_with_probability(0.5) {
        draw.count(0..100) as u64
    } else {
        draw.count(0..2000) as u64
    };
    case
}
