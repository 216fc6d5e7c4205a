//! Proves that two parts stay apart over a stretch of time, along one axis: the lemma of the README.

use crate::body::{AXIS_BITS, CORNER_ERROR, Part};
use crate::number::{Ball, FRACTION_BITS, Sign, Vector, add_signed, cross, dot, length, scale};
use crate::reader::Reader;
use crate::rotation::Rotation;
use crate::statement::{Motion, Statement, TIME_BITS, turning};
use crate::{Body, Fault, Stop};

/// Fine axes are multiples of 2⁻³⁰.
const FINE_AXIS_BITS: u32 = 30;

/// Where both bodies are in the middle of a stretch of time, and how they move in half of it.
pub(crate) struct Stretch {
    pub(crate) from: i128,
    pub(crate) to: i128,
    /// From the centre of A to that of B.
    offset: Vector,
    /// By how much that changes in half of the stretch.
    change: Vector,
    turned: [Option<Rotation>; 2],
    /// The rotation vector of each body in half of the stretch.
    turn: [Option<Vector>; 2],
}

/// What an axis turns with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Frame {
    World,
    Body(usize),
}

impl Stretch {
    pub(crate) fn new([a, b]: &[Motion; 2], from: i128, to: i128) -> Self {
        let middle = (from + to) >> 1;
        let half = Ball::exact(to - middle);
        let middle = Ball::exact(middle);
        Stretch {
            from,
            to,
            offset: add_signed(b.centre_at(middle), a.centre_at(middle), Sign::Minus),
            change: scale(add_signed(b.travel, a.travel, Sign::Minus), half, TIME_BITS),
            turned: [a.turned_at(middle), b.turned_at(middle)],
            turn: [a, b].map(|motion| Some(scale(motion.turn?, half, TIME_BITS))),
        }
    }
}

/// Reads an axis, and checks that it keeps two parts apart by more than the margin over a stretch of time.
pub(crate) fn check_leaf(
    reader: &mut Reader<'_>,
    (statement, bodies): (&Statement, [&Body; 2]),
    stretch: &Stretch,
    (parts, frame, is_fine): ([Part; 2], Frame, bool),
) -> Result<(), Stop> {
    let (axis, axis_bits) = if is_fine {
        (reader.fine_axis()?, FINE_AXIS_BITS)
    } else {
        (reader.axis()?, AXIS_BITS)
    };
    if axis.iter().map(|x| x * x).sum::<i128>() > 1 << (2 * axis_bits) {
        return reader.broken(Fault::Axis);
    }
    let axis = axis.map(|x| Ball::exact(x << (FRACTION_BITS - axis_bits)));
    let axis_turn = match frame {
        Frame::World => None,
        Frame::Body(k) => stretch.turn[k],
    };
    // The linear part: in the middle, and its change to either end.
    let axis_change = turning(axis, axis_turn);
    let mut gaps = [Sign::Minus, Sign::Plus].map(|sign| {
        let along = dot(add_signed(axis, axis_change, sign), stretch.offset, 0);
        let gap = add_signed([along; 3], [dot(axis, stretch.change, 0); 3], sign)[0];
        gap.mid - gap.rad
    });
    let mut curvature = {
        let (turn, change) = (size(axis_turn), length(stretch.change.map(Ball::size)));
        let offset = length(stretch.offset.map(Ball::size)) + change;
        up(up(turn, turn), offset) + 2 * up(turn, change)
    };
    for k in 0..2 {
        let relative = relative_turn(
            stretch.turn[k],
            (frame != Frame::Body(k)).then_some(axis_turn),
        );
        let axis_in_body =
            relative.map_or([Ball::ZERO; 3], |turn| cross(axis, turn, FRACTION_BITS));
        let mut reach = 0;
        for (gap, sign) in gaps.iter_mut().zip([Sign::Minus, Sign::Plus]) {
            let direction = add_signed(axis, axis_in_body, sign);
            let direction = if k == 0 {
                direction.map(Ball::neg)
            } else {
                direction
            };
            let turned =
                stretch.turned[k].map_or(direction, |turned| turned.turn(direction, Sign::Minus));
            let direction = statement.motions[k].to_mesh(turned);
            let seen = bodies[k].seen_from(
                parts[k],
                statement.motions[k].centre,
                direction.map(|x| x.mid),
            );
            reach = seen.reach + 2 * CORNER_ERROR;
            let sizes: i128 = direction.iter().map(|x| x.size()).sum();
            let radii: i128 = direction.iter().map(|x| x.rad).sum();
            *gap += seen.least_height - radii * reach - CORNER_ERROR * sizes;
        }
        let turns = size(axis_turn) + size(stretch.turn[k]);
        curvature += up(up(size(relative), turns), reach);
    }
    let least = (statement.margin + curvature / 2 + 1) << FRACTION_BITS;
    if gaps.iter().all(|&gap| gap > least) {
        Ok(())
    } else {
        reader.broken(Fault::NotApart)
    }
}

/// Returns the rotation vector of a body relative to an axis; `None` if they turn alike, which they do if the axis is the body's
/// own.
fn relative_turn(body: Option<Vector>, axis: Option<Option<Vector>>) -> Option<Vector> {
    match (body, axis?) {
        (body, None) => body,
        (None, Some(axis)) => Some(axis.map(Ball::neg)),
        (Some(body), Some(axis)) => Some(add_signed(body, axis, Sign::Minus)),
    }
}

/// Returns an upper bound of the length of a rotation vector.
fn size(turn: Option<Vector>) -> i128 {
    turn.map_or(0, |turn| length(turn.map(Ball::size)))
}

/// Returns the product of a number and a fraction, rounded up.
fn up(fraction: i128, number: i128) -> i128 {
    if fraction == 0 || number == 0 {
        return 0;
    }
    ((fraction * number) >> FRACTION_BITS) + 1
}
