//! Links, each of which moves on the one that carries it, and where they are at a time.

use crate::Stop;
use crate::number::{FRACTION, Matrix, Number, Vector, ZERO};
use crate::reader::Reader;
use crate::rotation;
use alloc::vec::Vec;

/// Times are in multiples of 2⁻⁶⁰ of the unit of time, which is no less than the duration.
pub(crate) const TIME: u32 = 60;

const UNIT: i64 = -(FRACTION as i64);

/// Where the centre of a link is from that of its parent, how that changes, and how the link turns on the parent.
#[derive(Clone, Copy)]
pub(crate) struct Motion {
    pub(crate) arm: Vector,
    pub(crate) travel: Vector,
    pub(crate) turn: Vector,
}

/// How a link moves on its parent: its centre along a line, and the link about it at a constant rate.
pub(crate) struct Link {
    /// The number of the link that carries it; 0 is the world.
    parent: usize,
    /// The point of the link about which it turns.
    pub(crate) centre: Vector,
    /// The motion on the parent, from time 0, in the unit of time.
    motion: Motion,
    /// The rotation on the parent before any turn, and the turn at time 0.
    start: Matrix,
    turned: Vector,
}

impl Link {
    pub(crate) const WORLD: Link = Link {
        parent: 0,
        centre: ZERO,
        motion: Motion { arm: ZERO, travel: ZERO, turn: ZERO },
        start: Matrix::IDENTITY,
        turned: ZERO,
    };

    /// Reads the link after those that are given, of which the first one is the world.
    pub(crate) fn read(reader: &mut Reader<'_>, units: [i64; 2], links: &[Link]) -> Result<Link, Stop> {
        let [length, per_time] = [units[0], units[0] - units[1]];
        let mut link = Link { parent: reader.index(links.len())?, ..Link::WORLD };
        let (motion, kind) = (&mut link.motion, reader.unsigned(1)?);
        reader.require(kind < 3, "there is no such kind of link")?;
        let position = reader.vector(length, 50)?;
        link.start = rotation::read(reader)?;
        if kind == 0 {
            motion.travel = reader.vector(per_time, 50)?;
            motion.turn = reader.vector(UNIT - units[1], FRACTION + 8)?;
            link.centre = reader.vector(length, 50)?;
            motion.arm = link.start.apply(link.centre);
        } else {
            // The joint's axis in the frame of the parent.
            let axis = link.start.apply(reader.vector(UNIT, FRACTION + 1)?);
            let bits = [50, FRACTION + 8][usize::from(kind == 1)];
            let unit = if kind == 1 { UNIT } else { length };
            let [start, rate] =
                [reader.number(unit, bits)?, reader.number(unit - units[1], bits)?].map(|x| axis.times(x, FRACTION));
            if kind == 1 {
                (link.turned, motion.turn) = (start, rate);
            } else {
                (motion.arm, motion.travel) = (start, rate);
            }
        }
        motion.arm = position + motion.arm - links[link.parent].centre;
        Ok(link)
    }
}

/// A link in the middle of a stretch of time, and how it moves on its parent in half of it; all along the axes of the world.
#[derive(Clone, Copy)]
pub(crate) struct Placed {
    pub(crate) parent: usize,
    pub(crate) rotation: Matrix,
    pub(crate) motion: Motion,
}

impl Placed {
    /// Returns all links in the middle of a stretch of time. The first one is the world.
    pub(crate) fn all(links: &[Link], middle: Number, half: Number) -> Vec<Placed> {
        let mut all: Vec<Placed> = Vec::with_capacity(links.len());
        for &Link { parent, motion, start, turned, .. } in links {
            let on = all.get(parent).map_or(Matrix::IDENTITY, |on| on.rotation);
            // What does not turn at all is seen to rest by `Way`. A product is never exact, not even that with a rate of 0.
            let turns = motion.turn != ZERO;
            let turned = if turns { turned + motion.turn.times(middle, TIME) } else { turned };
            let turned = if turned == ZERO { start } else { rotation::exp(turned).times(start) };
            let in_half = |v: Vector| on.apply(v.times(half, TIME));
            all.push(Placed {
                parent,
                rotation: on.times(turned),
                motion: Motion {
                    arm: on.apply(motion.arm + motion.travel.times(middle, TIME)),
                    travel: in_half(motion.travel),
                    turn: if turns { in_half(motion.turn) } else { ZERO },
                },
            });
        }
        all
    }
}
