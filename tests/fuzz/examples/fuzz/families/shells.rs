//! Draws queries of closed parts next to each other and nested, oriented outward or inward.

use super::{pass, still, tolerance};
use crate::case::{Case, Expect, Form, Shape};
use crate::draw::{Draw, plus, times};
use crate::raw_motion::RawMotion;
use crate::shapes;

pub(super) fn draw(draw: &mut Draw) -> Case {
    let several = several(draw);
    let other = if draw.chance(0.3) {
        self::several(draw)
    } else {
        shapes::any(draw)
    };
    let size = draw.pick(&[0.1, 0.3, 1.0]);
    let other = other.map(|v| times(v, size));
    let config = tolerance(draw);
    let turn = if draw.chance(0.5) {
        0.0
    } else {
        draw.log(0.01..6.0)
    };
    if draw.chance(0.5) {
        return pass(draw, [several, other], turn, config);
    }
    // The position is somewhere within, or on, the parts.
    let at = if draw.chance(0.3) {
        draw.pick(&several.vertices)
    } else {
        times(draw.point(), several.radius())
    };
    let start = draw.pose(at);
    let velocity = times(draw.direction(), draw.within(0.0..4.0));
    let spin = times(draw.direction(), turn);
    let courses = [still(), RawMotion::velocities(start, velocity, spin)];
    Case {
        shapes: [several, other],
        courses,
        duration: 1.0,
        config,
        expect: Expect::Nothing,
    }
}

/// Returns one to four closed parts. Some are inside out, and some are nested.
fn several(draw: &mut Draw) -> Shape {
    let count = draw.count(1..5);
    let mut all = Shape::default();
    let (mut at, mut size) = ([0.0; 3], 1.0);
    for _ in 0..count {
        let part = if draw.chance(0.6) {
            shapes::cuboid([0.5; 3])
        } else {
            shapes::solid(draw)
        };
        let (here, scale) = (at, size);
        let part = part.map(|v| plus(times(v, scale), here));
        let part = if draw.chance(0.5) {
            part.flipped()
        } else {
            part
        };
        all = all.with(&part);
        match draw.count(0..3) {
            // The part is within the last one, next to it, or flush with it.
            0 => size *= draw.within(0.1..0.8),
            1 => at = plus(at, times(draw.direction(), draw.within(2.0..4.0) * size)),
            _ => at[draw.count(0..3)] += size,
        }
    }
    all.form = Form::Soup;
    all
}
