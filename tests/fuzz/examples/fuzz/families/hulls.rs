//! Draws queries of convex pieces of 4 to 2,000 points each.

use super::{passing_case, settings_with_random_tolerance};
use crate::case::Case;
use crate::draw::RandomSource;
use crate::shapes;

pub(super) fn draw(draw: &mut RandomSource) -> Case {
    let many = if draw.bool_with_probability(0.05) {
        draw.log_uniform(4.0..2000.0) as usize
    } else {
        draw.log_uniform(4.0..60.0) as usize
    };
    let few = (2000 / many).clamp(4, 30) as f64;
    let other = if draw.bool_with_probability(0.5) {
        shapes::any_shape(draw)
    } else {
        let few = draw.log_uniform(4.0..few + 1.0) as usize;
        shapes::hull(draw, few)
    };
    let mut config = settings_with_random_tolerance(draw);
    if draw.bool_with_probability(0.4) {
        config.margin = draw.log_uniform(1e-3..10.0);
    }
    let turn = if draw.bool_with_probability(0.4) {
        0.0
    } else {
        draw.log_uniform(1e-3..10.0)
    };
    let bodies = [shapes::hull(draw, many), other];
    passing_case(draw, bodies, turn, config)
}
