//! Links, each of which moves on the one that carries it, and where they are at a time.

use crate::Stop;
use crate::number::{FRACTION, Matrix, Number, ONE, Vector, ZERO};
use crate::reader::Reader;
use crate::rotation;
use alloc::vec::Vec;

/// Times are in multiples of 2⁻⁶⁰ of the unit of time, which is no less than the duration.
pub(crate) const TIME: u32 = 60;

const UNIT: i64 = -(FRACTION as i64);

/// A chain has at most so many links.
const MAX_DEPTH: usize = 1 << 10;

/// Where a point is from another one, how that changes, and how what carries it turns.
#[derive(Clone, Copy)]
pub(crate) struct Motion {
    pub(crate) arm: Vector,
    pub(crate) travel: Vector,
    pub(crate) turn: Vector,
}

impl Motion {
    pub(crate) const NONE: Motion = Motion {
        arm: ZERO,
        travel: ZERO,
        turn: ZERO,
    };
}

/// How a link moves on its parent: its centre along a line, and the link about it at a constant rate.
pub(crate) struct Link {
    /// The number of the link that carries it; 0 is the world.
    parent: usize,
    /// The point of the link about which it turns.
    pub(crate) centre: Vector,
    /// The vector from the parent's centre to that of the link at time 0, and how it changes and the link turns in the unit of time.
    motion: Motion,
    /// The rotation at time 0.
    start: Matrix,
    /// Bounds of the sums of all arms and travels, and of all turns, from the world to the link.
    reach: i128,
    turned: i128,
    /// The number of links from the world to this one.
    depth: usize,
}

impl Link {
    pub(crate) const WORLD: Link = Link {
        parent: 0,
        centre: ZERO,
        motion: Motion::NONE,
        start: Matrix::IDENTITY,
        reach: 0,
        turned: 0,
        depth: 0,
    };

    /// Reads the link after those that are given, of which the first one is the world.
    pub(crate) fn read(
        reader: &mut Reader<'_>,
        units: [i64; 2],
        links: &[Link],
    ) -> Result<Link, Stop> {
        let [length, per_time] = [units[0], units[0] - units[1]];
        let parent = reader.index(links.len())?;
        let kind = reader.unsigned(1)?;
        reader.require(kind < 3, "there is no such kind of link")?;
        let position = reader.vector(length, 50)?;
        let mut start = read_rotation(reader)?;
        let (mut motion, mut centre) = (Motion::NONE, ZERO);
        if kind == 0 {
            motion.travel = reader.vector(per_time, 50)?;
            motion.turn = reader.vector(UNIT - units[1], FRACTION + 8)?;
            centre = reader.vector(length, 50)?;
            motion.arm = start.apply(centre);
        } else {
            // The joint's axis in the frame of the parent.
            let axis = start.apply(reader.vector(UNIT, FRACTION + 1)?);
            if kind == 1 {
                let angle = reader.number(UNIT, FRACTION + 8)?;
                let rate = reader.number(UNIT - units[1], FRACTION + 8)?;
                start = rotation::by(axis.times(angle, FRACTION)).times(start);
                motion.turn = axis.times(rate, FRACTION);
            } else {
                motion.arm = axis.times(reader.number(length, 50)?, FRACTION);
                motion.travel = axis.times(reader.number(per_time, 50)?, FRACTION);
            }
        }
        let on = &links[parent];
        motion.arm = position + motion.arm - on.centre;
        let reach = on.reach + motion.arm.length() + motion.travel.length();
        let (turned, depth) = (on.turned + motion.turn.length(), on.depth + 1);
        if reach > 1 << 51 || turned > 1 << (FRACTION + 8) {
            return Err(Stop::Unverifiable("links reach or turn too far"));
        }
        // What the rotations of a chain are off by adds up.
        if depth > MAX_DEPTH || start.rad > ONE.mid[0] >> 20 {
            return Err(Stop::Unverifiable("a chain is too long, or turns too far"));
        }
        Ok(Link {
            parent,
            centre,
            motion,
            start,
            reach,
            turned,
            depth,
        })
    }
}

/// A link in the middle of a stretch of time, and how it moves in half of it; all in the world.
#[derive(Clone, Copy)]
pub(crate) struct Placed {
    pub(crate) parent: usize,
    pub(crate) rotation: Matrix,
    /// The centre, and how it and the link move.
    pub(crate) whole: Motion,
    /// The same from the parent's centre and on the parent.
    pub(crate) own: Motion,
    /// A bound of the sum of all turns from the world to the link.
    pub(crate) turned: i128,
}

impl Placed {
    /// Returns all links in the middle of a stretch of time. The first one is the world.
    pub(crate) fn all(links: &[Link], middle: Number, half: Number) -> Vec<Placed> {
        let world = Placed {
            parent: 0,
            rotation: Matrix::IDENTITY,
            whole: Motion::NONE,
            own: Motion::NONE,
            turned: 0,
        };
        let mut placed = alloc::vec![world];
        for link in &links[1..] {
            let (on, motion) = (placed[link.parent], link.motion);
            let [travel, mut turn] =
                [motion.travel, motion.turn].map(|v| on.rotation.apply(v.times(half, TIME)));
            let mut rotation = link.start;
            if motion.turn == ZERO {
                turn = ZERO;
            } else {
                rotation = rotation::by(motion.turn.times(middle, TIME)).times(rotation);
            }
            let arm = motion.arm + motion.travel.times(middle, TIME);
            let arm = on.rotation.apply(arm);
            placed.push(Placed {
                parent: link.parent,
                rotation: on.rotation.times(rotation),
                whole: Motion {
                    arm: on.whole.arm + arm,
                    travel: on.whole.travel + on.whole.turn.cross(arm) + travel,
                    turn: on.whole.turn + turn,
                },
                own: Motion { arm, travel, turn },
                turned: on.turned + turn.length(),
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
    Ok(rotation::of_quaternion(scalar, vector, inverse + inverse))
}
