//! Links, each of which moves on the one that carries it, where they are in the middle of a stretch of time, and how they move in
//! half of it.

use crate::{Checked, number::*, reader::Reader, verifiable};
use alloc::vec::Vec;

/// How a link moves on its parent: its centre along a line, and the link about it at a constant rate.
pub(crate) struct Link {
    /// The number of the link that carries it; 0 is the world.
    parent: usize,
    /// The point of the link about which it turns.
    pub(crate) centre: Vector,
    /// The rotation on the parent before any turn.
    start: Rotation,
    /// From the centre of the parent to that of the link, and the turn: both at time 0, and how they change in the unit of time.
    arm: [Vector; 2],
    turn: [Vector; 2],
}

/// The world and all links, and how well their places are known.
pub(crate) struct Links {
    pub(crate) all: Vec<Link>,
    /// E of the README, of which bounds for what rotations lose are made, in fractions.
    off: i64,
    /// S of the README: all lengths that are turned, in all.
    size: i64,
}

impl Links {
    /// Reads so many links.
    pub(crate) fn read(reader: &mut Reader<'_>, count: u64, [length, time]: [i64; 2]) -> Checked<Links> {
        let world = Link { parent: 0, centre: ZERO, start: IDENTITY, arm: [ZERO; 2], turn: [ZERO; 2] };
        let mut links = Links { all: alloc::vec![world], off: 0, size: 1 << (LENGTH - 6) };
        for _ in 0..count {
            let parent = reader.index(links.all.len())?;
            let position = reader.all(|reader| reader.number(length, [LENGTH, 0]))?;
            let q: [i64; 4] = reader.all(|reader| reader.number(0, [1, FRACTION]))?;
            let square = dot(q, q);
            verifiable((square - (1 << 120)).abs() <= 1 << 100, "a quaternion is not of unit length")?;
            let [x, y, z, w] = q.map(|x| ((i128::from(x) << FRACTION) / square.isqrt()) as i64);
            let (start, centre) = (([x, y, z], w), reader.all(|reader| reader.number(length, [LENGTH, 0]))?);
            // What is read next is along the axes of the parent, or along those of the joint.
            let axes = [IDENTITY, start][reader.index(2)?];
            let slide = turned(axes, reader.all(|reader| reader.number(length, [LENGTH, 6]))?);
            let axis = turned(axes, reader.all(|reader| reader.number(0, [0, FRACTION]))?);
            let at = [reader.number(0, [8, RADIAN])?, reader.number(-time, [8, RADIAN])?];
            let mut arm = at.map(|at| scaled(slide, at, RADIAN + 6));
            arm[0] = sub(add(add(position, turned(start, centre)), arm[0]), links.all[parent].centre);
            let turn = at.map(|at| scaled(axis, at, FRACTION));
            links.off += (3 + ((at[0].abs() + at[1].abs()) >> RADIAN)) << 10;
            links.size = arm.as_flattened().iter().fold(links.size, |size, x| size.saturating_add(x.abs()));
            verifiable(links.off <= ONE >> 30 && links.size <= 1 << (LENGTH + 6), "links turn or reach too far in all")?;
            links.all.push(Link { parent, centre, start, arm, turn });
        }
        Ok(links)
    }

    /// Returns L of the README, of which bounds for what is lost are made, for points that are so far from the centre of a link.
    pub(crate) fn loss(&self, reach: i128) -> i128 {
        13 * (self.all.len() as i128 + 1) + up(self.off.into(), reach + i128::from(self.size))
    }

    /// Returns all links in the middle of a stretch of time. The first one is the world.
    pub(crate) fn stretch(&self, middle: i64, half: i64) -> Stretch<'_> {
        let (loss, loss_of_turns) = (self.loss(0), 3 * i128::from(self.off));
        let mut placed: Vec<Placed> = Vec::with_capacity(self.all.len());
        for link in &self.all {
            let (place, on) = placed.get(link.parent).map_or((ZERO, IDENTITY), |on| (on.place, on.rotation));
            let [arm, turn] = [link.arm, link.turn].map(|[at, rate]| add(at, scaled(rate, middle, FRACTION)));
            let rotation = if turn == ZERO { link.start } else { times(exp(turn), link.start) };
            // More than the two radians that a way may turn by is as good as any more.
            let turn = link.turn[1].map(|x| (product(x, half) >> RADIAN).clamp(-product(2, ONE), product(2, ONE)) as i64);
            let seen = |v, loss| (turned(on, v), length(v) + loss);
            let (arm, travel) = (seen(arm, loss), seen(scaled(link.arm[1], half, FRACTION), loss));
            let (place, rotation, turn) = (add(place, arm.0), times(on, rotation), seen(turn, loss_of_turns));
            placed.push(Placed { place, rotation, arm, travel, turn });
        }
        Stretch { links: self, placed }
    }
}

/// All links in the middle of a stretch of time.
pub(crate) struct Stretch<'a> {
    pub(crate) links: &'a Links,
    pub(crate) placed: Vec<Placed>,
}

/// A link in the middle of a stretch of time, and how it moves on its parent in half of it; all along the axes of the world.
pub(crate) struct Placed {
    /// The point about which it turns.
    pub(crate) place: Vector,
    pub(crate) rotation: Rotation,
    /// From the centre of the parent to that of the link, how that changes, and how the link turns; each with a bound of its length.
    arm: (Vector, i128),
    travel: (Vector, i128),
    turn: (Vector, i128),
}

/// How a link moves in half of a stretch of time as it is seen from another one: what the lemmas of the README need.
#[derive(Default)]
pub(crate) struct Way {
    /// How the vector from centre to centre changes, and how the link turns.
    pub(crate) change: Vector,
    pub(crate) turn: Vector,
    /// The sum of the angles of all joints, and a bound of the second derivative of the vector.
    angle: i128,
    bend: i128,
}

impl Way {
    /// Returns the way from a link to another one; `None` if the joints turn by more than two radians, over which nothing is proven.
    pub(crate) fn new(Stretch { links, placed }: &Stretch<'_>, from: usize, to: usize) -> Option<Way> {
        let (mut way, mut left, mut entered, mut path) = (Way::default(), from, to, Vec::with_capacity(8));
        while left != entered {
            if left > entered {
                way.turn_by(&placed[left], -1)?;
                way.move_by(&placed[left], -1);
                left = links.all[left].parent;
            } else {
                path.push(entered);
                entered = links.all[entered].parent;
            }
        }
        for link in path.into_iter().rev() {
            way.move_by(&placed[link], 1);
            way.turn_by(&placed[link], 1)?;
        }
        Some(way)
    }

    /// Returns a bound of the second derivative of the vector and one more, so long, that the link carries and that changes at a rate.
    pub(crate) fn bend(&self, long: i128, rate: i128) -> i128 {
        self.bend + up(self.angle, up(self.angle, long + rate) + 2 * rate)
    }

    fn turn_by(&mut self, &Placed { turn: (turn, angle), .. }: &Placed, sign: i64) -> Option<()> {
        self.turn = add(self.turn, turn.map(|x| sign * x));
        self.angle += angle;
        (self.angle <= product(2, ONE)).then_some(())
    }

    fn move_by(&mut self, &Placed { arm: (arm, long), travel: (travel, rate), .. }: &Placed, sign: i64) {
        let change = add(travel, cross(self.turn, arm));
        self.change = add(self.change, change.map(|x| sign * x));
        self.bend = self.bend(long, rate);
    }
}
