//! Draws queries of bodies of very different sizes.

use super::{pass, tolerance};
use crate::case::Case;
use crate::draw::{Draw, plus, times};
use crate::raw_motion::Goal;
use crate::shapes;
use ccd_core::order::{greater, lesser};

pub(super) fn draw(draw: &mut Draw) -> Case {
    let sizes = [draw.log(1e-9..1e9), draw.log(1e-9..1e9)];
    let large = greater(sizes[0], sizes[1]);
    let bodies = sizes.map(|size| shapes::any(draw).map(|v| times(v, size)));
    let mut config = tolerance(draw);
    config.tolerance *= if draw.chance(0.5) {
        large
    } else {
        lesser(sizes[0], sizes[1])
    };
    let turn = if draw.chance(0.5) {
        0.0
    } else {
        draw.log(1e-3..6.0)
    };
    let target = draw.pick(&bodies[0].vertices);
    let mut case = pass(draw, bodies, turn, config);
    if draw.chance(0.5) && turn == 0.0 {
        // A corner of one flies straight at the other, since small ones would never be hit otherwise.
        case.courses[0].start.quaternion = [1.0, 0.0, 0.0, 0.0];
        let start = plus(
            case.courses[1].start.position,
            times(draw.direction(), 2.0 * large),
        );
        case.courses[0].start.position = plus(start, times(target, -1.0));
        let way = plus(case.courses[1].start.position, times(start, -1.0));
        let linear = times(way, draw.within(0.7..1.5));
        case.courses[0].goal = Goal::Velocities {
            linear,
            spin: [0.0; 3],
        };
        case.courses[1].goal = Goal::Velocities {
            linear: [0.0; 3],
            spin: [0.0; 3],
        };
    }
    case
}
