//! The motion of links: the pose of each link at the middle of an interval of time, and its motion over half of the interval.

use crate::{Checked, number::*, reader::Reader, verifiable};
use alloc::vec::Vec;

/// The motion of a link on its parent. Its center moves along a line, and the link turns about its center at a constant rate.
pub(crate) struct Link {
    /// The index of the parent. Index 0 is the world.
    parent: usize,
    /// The point of the link about which it turns, in the frame of the link.
    pub(crate) center: Vector,
    /// The rotation of the link on its parent without the turn of the joint.
    start: Rotation,
    /// The vector from the center of the parent to the center of the link at time 0, and its change in the unit of time.
    arm: [Vector; 2],
    /// The rotation vector of the joint at time 0, and its change in the unit of time.
    turn: [Vector; 2],
}

/// The world and all links, and the sums that bound the rounding errors of their poses.
pub(crate) struct Links {
    pub(crate) all: Vec<Link>,
    /// E of the README: a bound of the error of any rotation, as a fraction.
    rotation_error: i64,
    /// S of the README: the sum of the lengths of all arms.
    arm_sum: i64,
}

impl Links {
    /// Reads `count` links.
    pub(crate) fn read(reader: &mut Reader<'_>, count: u64, [length, time]: [i64; 2]) -> Checked<Links> {
        let world = Link { parent: 0, center: ZERO, start: IDENTITY, arm: [ZERO; 2], turn: [ZERO; 2] };
        let mut links = Links { all: alloc::vec![world], rotation_error: 0, arm_sum: 1 << (LENGTH - 6) };
        for _ in 0..count {
            let parent = reader.index(links.all.len())?;
            let position = reader.array(|reader| reader.number(length, [LENGTH, 0]))?;
            let q: [i64; 4] = reader.array(|reader| reader.number(0, [1, FRACTION]))?;
            let square = dot(q, q);
            verifiable((square - (1 << 120)).abs() <= 1 << 100, "a quaternion is not of unit length")?;
            let [x, y, z, w] = q.map(|x| ((i128::from(x) << FRACTION) / square.isqrt()) as i64);
            let (start, center) = (([x, y, z], w), reader.array(|reader| reader.number(length, [LENGTH, 0]))?);
            // The velocity and the axis are given along the axes of the parent (0), or along the axes of the joint (1).
            let axes = [IDENTITY, start][reader.index(2)?];
            let velocity = rotated(axes, reader.array(|reader| reader.number(length, [LENGTH, 6]))?);
            let axis = rotated(axes, reader.array(|reader| reader.number(0, [0, FRACTION]))?);
            let parameter = [reader.number(0, [8, RADIAN])?, reader.number(-time, [8, RADIAN])?];
            let mut arm = parameter.map(|x| scaled(velocity, x, RADIAN + 6));
            arm[0] = sub(add(add(position, rotated(start, center)), arm[0]), links.all[parent].center);
            let turn = parameter.map(|x| scaled(axis, x, FRACTION));
            links.rotation_error += (3 + ((parameter[0].abs() + parameter[1].abs()) >> RADIAN)) << 10;
            links.arm_sum = arm.as_flattened().iter().fold(links.arm_sum, |sum, x| sum.saturating_add(x.abs()));
            verifiable(
                links.rotation_error <= ONE >> 30 && links.arm_sum <= 1 << (LENGTH + 6),
                "the links turn or reach too far",
            )?;
            links.all.push(Link { parent, center, start, arm, turn });
        }
        Ok(links)
    }

    /// Returns L(`reach`) of the README. A small multiple of it bounds the rounding error of any point within `reach` of the
    /// center of its link.
    pub(crate) fn error_bound(&self, reach: i128) -> i128 {
        13 * (self.all.len() as i128 + 1) + mul_up(self.rotation_error.into(), reach + i128::from(self.arm_sum))
    }

    /// Computes the states of all links for the interval of time with this middle and half-length. The first one is the world.
    pub(crate) fn over_interval(&self, middle: i64, half: i64) -> Interval<'_> {
        let (arm_error, turn_error) = (self.error_bound(0), 3 * i128::from(self.rotation_error));
        let mut states: Vec<LinkState> = Vec::with_capacity(self.all.len());
        for link in &self.all {
            let parent = states.get(link.parent).map_or((ZERO, IDENTITY), |parent| (parent.position, parent.rotation));
            let [arm, turn] = [link.arm, link.turn].map(|[start, rate]| add(start, scaled(rate, middle, FRACTION)));
            let rotation = if turn == ZERO { link.start } else { compose(exp(turn), link.start) };
            // Saturates: `RelativeMotion::new` rejects rotations above 2 radians.
            let turn = link.turn[1].map(|x| (product(x, half) >> RADIAN).clamp(-product(2, ONE), product(2, ONE)) as i64);
            let in_world = |v, error| (rotated(parent.1, v), length_bound(v) + error);
            let arm_change = in_world(scaled(link.arm[1], half, FRACTION), arm_error);
            let (arm, turn) = (in_world(arm, arm_error), in_world(turn, turn_error));
            let (position, rotation) = (add(parent.0, arm.0), compose(parent.1, rotation));
            states.push(LinkState { position, rotation, arm, arm_change, turn });
        }
        Interval { links: self, states }
    }
}

/// The states of all links for an interval of time.
pub(crate) struct Interval<'a> {
    pub(crate) links: &'a Links,
    pub(crate) states: Vec<LinkState>,
}

/// The pose of a link at the middle of an interval, and its motion on its parent over half of the interval. All vectors are
/// along the axes of the world.
pub(crate) struct LinkState {
    /// The position of the center of the link.
    pub(crate) position: Vector,
    pub(crate) rotation: Rotation,
    /// The vector from the center of the parent to the center of the link, and an upper bound of its length.
    arm: (Vector, i128),
    /// The change of the arm over half of the interval, and an upper bound of its length.
    arm_change: (Vector, i128),
    /// The rotation vector of the joint over half of the interval, and an upper bound of its length.
    turn: (Vector, i128),
}

/// The motion of a link relative to another link over half of an interval, as the lemmas of the README need it.
#[derive(Default)]
pub(crate) struct RelativeMotion {
    /// P′ of the README: the first-order change of the vector between the centers of both links.
    pub(crate) displacement: Vector,
    /// Ω of the README: the first-order rotation vector of the link.
    pub(crate) turn: Vector,
    /// θ of the README: the sum of the angles of all joints on the path between both links.
    angle: i128,
    /// K of the README: an upper bound of the second derivative of the vector between the centers.
    center_second_derivative: i128,
}

impl RelativeMotion {
    /// Computes the motion of the link `to` relative to the link `from`. Returns `None` if the joints between them turn by more
    /// than 2 radians in total. The lemmas prove nothing beyond that.
    pub(crate) fn new(Interval { links, states }: &Interval<'_>, from: usize, to: usize) -> Option<RelativeMotion> {
        let (mut motion, mut left, mut entered, mut path) = (RelativeMotion::default(), from, to, Vec::with_capacity(8));
        while left != entered {
            if left > entered {
                motion.add_turn(&states[left], -1)?;
                motion.add_arm(&states[left], -1);
                left = links.all[left].parent;
            } else {
                path.push(entered);
                entered = links.all[entered].parent;
            }
        }
        for link in path.into_iter().rev() {
            motion.add_arm(&states[link], 1);
            motion.add_turn(&states[link], 1)?;
        }
        Some(motion)
    }

    /// Returns a bound of the second derivative of the vector between the centers plus one more vector. The link carries that
    /// vector, which has at most this length and changes at this rate.
    pub(crate) fn second_derivative(&self, length: i128, rate: i128) -> i128 {
        self.center_second_derivative + mul_up(self.angle, mul_up(self.angle, length + rate) + 2 * rate)
    }

    fn add_turn(&mut self, &LinkState { turn: (turn, angle), .. }: &LinkState, sign: i64) -> Option<()> {
        self.turn = add(self.turn, turn.map(|x| sign * x));
        self.angle += angle;
        (self.angle <= product(2, ONE)).then_some(())
    }

    fn add_arm(&mut self, &LinkState { arm: (arm, length), arm_change: (change, rate), .. }: &LinkState, sign: i64) {
        let change = add(change, cross(self.turn, arm));
        self.displacement = add(self.displacement, change.map(|x| sign * x));
        self.center_second_derivative = self.second_derivative(length, rate);
    }
}
