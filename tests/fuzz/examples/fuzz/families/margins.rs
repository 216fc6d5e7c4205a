//! Draws queries with margins from a thousandth of the size of the bodies to a hundred times their size.

use super::{pass, tolerance};
use crate::case::Case;
use crate::draw::{Draw, times};
use crate::shapes;

pub(super) fn draw(draw: &mut Draw) -> Case {
    let bodies = [shapes::any(draw), shapes::any(draw)];
    let mut config = tolerance(draw);
    config.margin = draw.log(1e-3..100.0);
    let turn = if draw.chance(0.5) {
        0.0
    } else {
        draw.log(1e-3..10.0)
    };
    let mut case = pass(draw, bodies, turn, config);
    if draw.chance(0.3) {
        // The start is inside the margin.
        let near = draw.within(0.0..1.0);
        for course in &mut case.courses {
            course.start.position = times(course.start.position, near);
        }
    }
    case
}
