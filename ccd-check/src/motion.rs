//! Links, each of which moves on the one that carries it, and where they are at a time.

use crate::number::*;
use crate::reader::Reader;
use crate::{Stop, verifiable};
use alloc::vec::Vec;

/// Times are in multiples of 2⁻⁶⁰ of the unit of time, which is no less than the duration.
pub(crate) const TIME: u32 = 60;

/// How a link moves on its parent: its centre along a line, and the link about it at a constant rate.
pub(crate) struct Link {
    /// The number of the link that carries it; 0 is the world.
    parent: usize,
    /// The point of the link about which it turns.
    pub(crate) centre: Vector,
    /// From the centre of the parent to that of the link at time 0, and how that changes in the unit of time.
    arm: Vector,
    travel: Vector,
    /// The rotation on the parent before any turn, the turn at time 0, and that in the unit of time.
    start: Matrix,
    turned: Vector,
    turn: Vector,
}

impl Link {
    const WORLD: Link = Link { parent: 0, centre: ZERO, arm: ZERO, travel: ZERO, start: IDENTITY, turned: ZERO, turn: ZERO };
}

/// The world and all links, and how well their places are known.
pub(crate) struct Links {
    pub(crate) all: Vec<Link>,
    /// No rotation of a link is off by a matrix whose norm is more, in fractions.
    off: i64,
    /// The sum of all arms and travels.
    size: i64,
}

impl Links {
    /// Returns the world alone.
    pub(crate) fn new() -> Links {
        Links { all: alloc::vec![Link::WORLD], off: 0, size: 0 }
    }

    /// Reads the next link.
    pub(crate) fn read(&mut self, reader: &mut Reader<'_>, units: [i64; 2]) -> Result<(), Stop> {
        let ([length, time], [fraction, radian]) = (units, [FRACTION, RADIAN].map(|bits| -i64::from(bits)));
        let parent = reader.index(self.all.len())?;
        let kind = reader.unsigned(1)?;
        reader.require(kind < 3, "there is no such kind of link")?;
        let position = reader.vector(length, 50)?;
        let start = read_rotation(reader)?;
        let mut link = Link { parent, start, ..Link::WORLD };
        let mut angles = 0;
        if kind == 0 {
            link.travel = reader.vector(length - time, 50)?;
            link.turn = reader.vector(radian - time, RADIAN + 8)?;
            link.centre = reader.vector(length, 50)?;
            link.arm = turned(&start, link.centre);
            angles = link.turn.iter().map(|x| x.abs()).sum();
        } else {
            // The joint's axis in the frame of the parent.
            let axis = turned(&start, reader.vector(fraction, FRACTION)?);
            let (unit, bits) = if kind == 1 { (radian, RADIAN + 8) } else { (length, 50) };
            let [at, rate] = [reader.number(unit, bits)?, reader.number(unit - time, bits)?];
            let [from, change] = [at, rate].map(|x| scaled(axis, x, FRACTION));
            if kind == 1 {
                (link.turned, link.turn, angles) = (from, change, at.abs() + rate.abs());
            } else {
                (link.arm, link.travel) = (from, change);
            }
        }
        link.arm = sub(add(position, link.arm), self.all[parent].centre);
        self.off += (3 + (angles >> RADIAN)) << 10;
        self.size += [link.arm, link.travel].iter().flatten().map(|x| x.abs()).sum::<i64>();
        self.all.push(link);
        let is_known = self.off <= ONE >> 20 && self.size <= 1 << 56;
        verifiable(is_known, "there are too many links, or they turn or reach too far")
    }

    /// Returns L of the README, of which bounds for what is lost are made, for points that are so far from the centre of a link.
    pub(crate) fn loss(&self, reach: i128) -> i128 {
        8 * (self.all.len() as i128 + 1) + up(self.off.into(), reach + i128::from(self.size))
    }

    /// Returns a bound of what turns, and sums of turns, are off by.
    pub(crate) fn loss_of_turns(&self) -> i128 {
        3 * i128::from(self.off)
    }

    /// Returns all links in the middle of a stretch of time. The first one is the world.
    pub(crate) fn placed(&self, middle: i64, half: i64) -> Vec<Placed> {
        let [loss, loss_of_turns] = [self.loss(0), self.loss_of_turns()];
        // More than what a short way turns is as good as any more.
        let most = 3 * i128::from(ONE);
        let mut all: Vec<Placed> = Vec::with_capacity(self.all.len());
        for link in &self.all {
            let on = all.get(link.parent).map_or(IDENTITY, |on| on.rotation);
            let turn = add(link.turned, scaled(link.turn, middle, TIME));
            let rotation = if turn == ZERO { link.start } else { times(&exp(turn), &link.start) };
            let moves = [
                add(link.arm, scaled(link.travel, middle, TIME)),
                scaled(link.travel, half, TIME),
                link.turn.map(|x| (product(x, half) >> (RADIAN + TIME - FRACTION)).clamp(-most, most) as i64),
            ]
            .map(|v| turned(&on, v));
            let [arm, travel, turn] = moves.map(length);
            let lengths = [arm + loss, travel + loss, turn + loss_of_turns];
            let rotation = times(&on, &rotation);
            all.push(Placed { parent: link.parent, rotation, moves, lengths });
        }
        all
    }
}

/// A link in the middle of a stretch of time, and how it moves on its parent in half of it; all along the axes of the world.
#[derive(Clone, Copy)]
pub(crate) struct Placed {
    pub(crate) parent: usize,
    pub(crate) rotation: Matrix,
    /// From the centre of the parent to that of the link, how that changes, and how the link turns; bounds of the lengths of these.
    pub(crate) moves: [Vector; 3],
    pub(crate) lengths: [i128; 3],
}

/// Reads a quaternion x, y, z, w, and returns its rotation.
fn read_rotation(reader: &mut Reader<'_>) -> Result<Matrix, Stop> {
    let vector = reader.vector(-i64::from(FRACTION), FRACTION + 1)?;
    let scalar = reader.number(-i64::from(FRACTION), FRACTION + 1)?;
    let excess = ((dot(vector, vector) + product(scalar, scalar)) >> FRACTION) - i128::from(ONE);
    verifiable(excess.abs() <= i128::from(ONE >> 20), "a quaternion is not of unit length")?;
    // 1 / (1 + e) is 1 − e + e² to within |e|³ / (1 − |e|).
    let twice = 2 * (i128::from(ONE) - excess + ((excess * excess) >> FRACTION)) as i64;
    Ok(about(vector, (product(scalar, twice) >> FRACTION) as i64, twice))
}
