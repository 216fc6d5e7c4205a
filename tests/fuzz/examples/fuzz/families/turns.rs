//! Draws queries with rotations of up to a thousand radians.

use super::{pass, tolerance};
use crate::case::Case;
use crate::draw::{Draw, times};
use crate::shapes;

pub(super) fn draw(draw: &mut Draw) -> Case {
    let bodies = [shapes::any(draw), shapes::any(draw)];
    let mut config = tolerance(draw);
    if draw.chance(0.2) {
        config.margin = draw.log(1e-3..1.0);
    }
    let turn = draw.log(0.1..1000.0);
    let mut case = pass(draw, bodies, turn, config);
    for course in &mut case.courses {
        if draw.chance(0.3) {
            course.centre = times(draw.direction(), draw.log(0.1..10.0));
        }
    }
    case
}
