//! Links, each of which moves on the one that carries it, and where they are at a time.

use crate::Stop;
use crate::number::{FRACTION, Matrix, Number, ONE, Vector, ZERO};
use crate::reader::Reader;
use crate::rotation::Rotation;
use alloc::vec::Vec;

/// Times are in multiples of 2⁻⁶⁰ of the unit of time, which is no less than the duration.
pub(crate) const TIME: u32 = 60;

const UNIT: i64 = -(FRACTION as i64);

/// A chain has at most so many links.
const MAX_DEPTH: usize = 1 << 10;

/// How a link moves on its parent: its centre along a line, and the link about it at a constant rate.
pub(crate) struct Link {
    /// The number of the link that carries it; 0 is the world, which is no link.
    pub(crate) parent: usize,
    /// The point of the link about which it turns.
    pub(crate) centre: Vector,
    /// The vector from the parent's centre to that of the link, and how it changes in the unit of time.
    arm: Vector,
    travel: Vector,
    /// The rotation at time 0, and the rotation vector of the unit of time.
    start: Matrix,
    turn: Vector,
    /// Bounds of the sums of all arms and travels, and of all turns, from the world to the link.
    reach: i128,
    turned: i128,
    /// The number of links from the world to this one.
    depth: usize,
}

impl Link {
    /// Reads the link after those that are given.
    pub(crate) fn read(
        reader: &mut Reader<'_>,
        units: [i64; 2],
        links: &[Link],
    ) -> Result<Link, Stop> {
        let [length, per_time] = [units[0], units[0] - units[1]];
        let parent = reader.index(links.len() + 1)?;
        let kind = reader.unsigned(1)?;
        reader.require(kind < 3, "there is no such kind of link")?;
        let position = reader.vector(length, 50)?;
        let start = read_rotation(reader)?;
        let mut link = Link {
            parent,
            centre: ZERO,
            arm: position,
            travel: ZERO,
            start,
            turn: ZERO,
            reach: 0,
            turned: 0,
            depth: 1,
        };
        if kind == 0 {
            link.travel = reader.vector(per_time, 50)?;
            link.turn = reader.vector(UNIT - units[1], FRACTION + 8)?;
            link.centre = reader.vector(length, 50)?;
            link.arm = position + start.apply(link.centre);
        } else {
            // The joint's axis in the frame of the parent.
            let axis = start.apply(reader.vector(UNIT, FRACTION + 1)?);
            if kind == 1 {
                let angle = reader.number(UNIT, FRACTION + 8)?;
                let rate = reader.number(UNIT - units[1], FRACTION + 8)?;
                let turned = Rotation::by(axis.times(angle, FRACTION));
                link.start = turned.matrix().times(start);
                link.turn = axis.times(rate, FRACTION);
            } else {
                link.arm = position + axis.times(reader.number(length, 50)?, FRACTION);
                link.travel = axis.times(reader.number(per_time, 50)?, FRACTION);
            }
        }
        if let Some(parent) = parent.checked_sub(1).map(|k| &links[k]) {
            link.arm = link.arm - parent.centre;
            (link.reach, link.turned) = (parent.reach, parent.turned);
            link.depth += parent.depth;
        }
        link.reach += link.arm.length() + link.travel.length();
        link.turned += link.turn.length();
        if link.reach > 1 << 51 || link.turned > 1 << (FRACTION + 8) {
            return Err(Stop::Unverifiable("links reach or turn too far"));
        }
        // What the rotations of a chain are off by adds up.
        if link.depth > MAX_DEPTH || link.start.rad > ONE.mid[0] >> 20 {
            return Err(Stop::Unverifiable("a chain is too long, or turns too far"));
        }
        Ok(link)
    }
}

/// A link in the middle of a stretch of time, and how it moves in half of it; all in the world.
#[derive(Clone, Copy)]
pub(crate) struct Placed {
    pub(crate) parent: usize,
    pub(crate) centre: Vector,
    pub(crate) rotation: Matrix,
    /// How the centre moves, and how the link turns.
    pub(crate) velocity: Vector,
    pub(crate) turn: Vector,
    /// The vector from the parent's centre to this one, and how that moves and the link turns on the parent.
    pub(crate) arm: Vector,
    pub(crate) travel: Vector,
    pub(crate) own_turn: Vector,
    /// A bound of the sum of all turns from the world to the link.
    pub(crate) turned: i128,
}

impl Placed {
    /// Returns the world and all links in the middle of a stretch of time.
    pub(crate) fn all(links: &[Link], middle: Number, half: Number) -> Vec<Placed> {
        let mut placed = alloc::vec![Placed {
            parent: 0,
            centre: ZERO,
            rotation: Matrix::IDENTITY,
            velocity: ZERO,
            turn: ZERO,
            arm: ZERO,
            travel: ZERO,
            own_turn: ZERO,
            turned: 0,
        }];
        for link in links {
            let on = placed[link.parent];
            let (mut rotation, mut own_turn) = (link.start, ZERO);
            if link.turn != ZERO {
                let turned = Rotation::by(link.turn.times(middle, TIME));
                rotation = turned.matrix().times(link.start);
                own_turn = on.rotation.apply(link.turn.times(half, TIME));
            }
            let arm = link.arm + link.travel.times(middle, TIME);
            let arm = on.rotation.apply(arm);
            let travel = on.rotation.apply(link.travel.times(half, TIME));
            placed.push(Placed {
                parent: link.parent,
                centre: on.centre + arm,
                rotation: on.rotation.times(rotation),
                velocity: on.velocity + on.turn.cross(arm) + travel,
                turn: on.turn + own_turn,
                arm,
                travel,
                own_turn,
                turned: on.turned + own_turn.length(),
            });
        }
        placed
    }
}

/// Reads a quaternion x, y, z, w, and returns its rotation.
fn read_rotation(reader: &mut Reader<'_>) -> Result<Matrix, Stop> {
    let vector = reader.vector(UNIT, FRACTION + 1)?;
    let scalar = reader.number(UNIT, FRACTION + 1)?;
    let excess = vector.dot(vector) + scalar.times(scalar, FRACTION) - ONE;
    if excess.size() > ONE.mid[0] >> 20 {
        return Err(Stop::Unverifiable("a quaternion is not of unit length"));
    }
    // 1 / (1 + e) is 1 − e to within e² / (1 − |e|), which is less than 2e².
    let mut inverse = ONE - excess;
    inverse.rad += 2 * excess.times(excess, FRACTION).size();
    let rotation = Rotation {
        scalar,
        vector,
        factor: inverse + inverse,
    };
    Ok(rotation.matrix())
}
