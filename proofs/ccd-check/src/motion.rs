//! The motion of links: the pose of each link at the middle of an interval of time, and its motion over half of the interval.

use crate::{Checked, number::*, reader::Reader, verifiable};
use alloc::vec::Vec;

/// The motion of a link relative to its parent. Its center moves along a line, and the link rotates about its center, both at
/// constant rates.
pub(crate) struct Link {
    /// The index of the parent. Index 0 is the world.
    parent: usize,
    /// The point of the link about which it rotates, in the frame of the link.
    pub(crate) center: Vector,
    /// The rotation of the link relative to its parent without the rotation of the joint.
    start: Rotation,
    /// The vector from the center of the parent to the center of the link at time 0, and its change in the unit of time.
    offset: [Vector; 2],
    /// The rotation vector of the joint at time 0, and its change in the unit of time.
    rotation_vector: [Vector; 2],
}

/// The world and all links, and the sums that bound the rounding errors of their poses.
pub(crate) struct Links {
    pub(crate) all: Vec<Link>,
    /// E of the README: the error bound of any rotation, as a fraction.
    rotation_error: i64,
    /// S of the README: the sum of all link offsets.
    offset_sum: i64,
}

impl Links {
    /// Reads `count` links.
    pub(crate) fn read(reader: &mut Reader<'_>, count: u64, [length, time]: [i64; 2]) -> Checked<Links> {
        let world = Link { parent: 0, center: ZERO, start: IDENTITY, offset: [ZERO; 2], rotation_vector: [ZERO; 2] };
        let mut links = Links { all: alloc::vec![world], rotation_error: 0, offset_sum: 1 << (LENGTH_BITS - 6) };
        for _ in 0..count {
            let parent = reader.index(links.all.len())?;
            let position = reader.array(|reader| reader.number(length, [LENGTH_BITS, 0]))?;
            let q: [i64; 4] = reader.array(|reader| reader.number(0, [1, FRACTION_BITS]))?;
            let square = dot(q, q);
            verifiable((square - (1 << 120)).abs() <= 1 << 100, "a quaternion is not of unit length")?;
            let [x, y, z, w] = q.map(|x| ((i128::from(x) << FRACTION_BITS) / square.isqrt()) as i64);
            let (start, center) = (([x, y, z], w), reader.array(|reader| reader.number(length, [LENGTH_BITS, 0]))?);
            // The coordinates of the velocity and the axis are along the axes of the parent (0) or along the axes of the joint (1).
            let axes = [IDENTITY, start][reader.index(2)?];
            let velocity = rotated(axes, reader.array(|reader| reader.number(length, [LENGTH_BITS, 6]))?);
            let axis = rotated(axes, reader.array(|reader| reader.number(0, [0, FRACTION_BITS]))?);
            let parameter = [reader.number(0, [8, ROTATION_BITS])?, reader.number(-time, [8, ROTATION_BITS])?];
            let mut offset = parameter.map(|x| scaled(velocity, x, ROTATION_BITS + 6));
            offset[0] = sub(add(add(position, rotated(start, center)), offset[0]), links.all[parent].center);
            let rotation_vector = parameter.map(|x| scaled(axis, x, FRACTION_BITS));
            links.rotation_error += (3 + ((parameter[0].abs() + parameter[1].abs()) >> ROTATION_BITS)) << 10;
            links.offset_sum = offset.as_flattened().iter().fold(links.offset_sum, |sum, x| sum.saturating_add(x.abs()));
            verifiable(
                links.rotation_error <= ONE >> 30 && links.offset_sum <= 1 << (LENGTH_BITS + 6),
                "the link angles or link offsets are too large",
            )?;
            links.all.push(Link { parent, center, start, offset, rotation_vector });
        }
        Ok(links)
    }

    /// Returns L(`distance`) of the README. A small multiple of it bounds the rounding error of any point within `distance` of the
    /// center of its link.
    pub(crate) fn error_bound(&self, distance: i128) -> i128 {
        13 * (self.all.len() as i128 + 1) + mul_up(self.rotation_error.into(), distance + i128::from(self.offset_sum))
    }

    /// Returns the states of the world and of all links for the interval of time with this middle and half-length.
    pub(crate) fn over_interval(&self, middle: i64, half: i64) -> Interval<'_> {
        let (offset_error, rotation_error) = (self.error_bound(0), 3 * i128::from(self.rotation_error));
        let mut states: Vec<LinkState> = Vec::with_capacity(self.all.len());
        for link in &self.all {
            let parent = states.get(link.parent).map_or((ZERO, IDENTITY), |parent| (parent.position, parent.rotation));
            let at_middle = |[start, rate]: [Vector; 2]| add(start, scaled(rate, middle, FRACTION_BITS));
            let (offset, rotation_vector) = (at_middle(link.offset), at_middle(link.rotation_vector));
            let rotation = if rotation_vector == ZERO { link.start } else { compose(exp(rotation_vector), link.start) };
            // The clamp avoids an overflow. `RelativeMotion::new` rejects rotations of more than 2 radians.
            let rotation_vector = link.rotation_vector[1]
                .map(|x| (product(x, half) >> ROTATION_BITS).clamp(-product(2, ONE), product(2, ONE)) as i64);
            let in_world = |v, error| (rotated(parent.1, v), length_bound(v) + error);
            let offset_change = in_world(scaled(link.offset[1], half, FRACTION_BITS), offset_error);
            let (offset, rotation_vector) = (in_world(offset, offset_error), in_world(rotation_vector, rotation_error));
            let (position, rotation) = (add(parent.0, offset.0), compose(parent.1, rotation));
            states.push(LinkState { position, rotation, offset, offset_change, rotation_vector });
        }
        Interval { links: self, states }
    }
}

/// The states of all links for an interval of time.
pub(crate) struct Interval<'a> {
    pub(crate) links: &'a Links,
    pub(crate) states: Vec<LinkState>,
}

/// The pose of a link at the middle of an interval, and its motion relative to its parent over half of the interval. The
/// coordinates of all vectors are along the axes of the world.
pub(crate) struct LinkState {
    /// The position of the center of the link.
    pub(crate) position: Vector,
    pub(crate) rotation: Rotation,
    /// The vector from the center of the parent to the center of the link, and an upper bound of its length.
    offset: (Vector, i128),
    /// The change of that vector over half of the interval, and an upper bound of its length.
    offset_change: (Vector, i128),
    /// The rotation vector of the joint over half of the interval, and an upper bound of its length.
    rotation_vector: (Vector, i128),
}

/// The motion of a link relative to another link over half of an interval, with the bounds of the README's lemmas.
#[derive(Default)]
pub(crate) struct RelativeMotion {
    /// P′ of the README: the first-order change of the vector between the centers of both links.
    pub(crate) displacement: Vector,
    /// Ω of the README: the first-order rotation vector of the link.
    pub(crate) rotation_vector: Vector,
    /// θ of the README: the sum of the angles of all joints on the path between both links.
    angle: i128,
    /// K of the README: an upper bound of the second derivative of the vector between the centers.
    center_second_derivative: i128,
}

impl RelativeMotion {
    /// Returns the motion of the link `to` relative to the link `from`. Returns `None` if the sum of the joint angles between them is
    /// more than 2 radians. Beyond 2 radians the rounding errors are not bounded.
    pub(crate) fn new(Interval { links, states }: &Interval<'_>, from: usize, to: usize) -> Option<RelativeMotion> {
        let (mut motion, mut up, mut down, mut path) = (RelativeMotion::default(), from, to, Vec::with_capacity(8));
        while up != down {
            if up > down {
                motion.add_rotation(&states[up], -1)?;
                motion.add_offset(&states[up], -1);
                up = links.all[up].parent;
            } else {
                path.push(down);
                down = links.all[down].parent;
            }
        }
        for link in path.into_iter().rev() {
            motion.add_offset(&states[link], 1);
            motion.add_rotation(&states[link], 1)?;
        }
        Some(motion)
    }

    /// Returns a bound of the second derivative of the sum of two vectors: the vector between the centers, and a vector that rotates
    /// with the link. The second vector has at most this length, and changes at this rate.
    pub(crate) fn second_derivative(&self, length: i128, rate: i128) -> i128 {
        self.center_second_derivative + mul_up(self.angle, mul_up(self.angle, length + rate) + 2 * rate)
    }

    fn add_rotation(&mut self, &LinkState { rotation_vector: (vector, angle), .. }: &LinkState, sign: i64) -> Option<()> {
        self.rotation_vector = add(self.rotation_vector, vector.map(|x| sign * x));
        self.angle += angle;
        (self.angle <= product(2, ONE)).then_some(())
    }

    fn add_offset(&mut self, state: &LinkState, sign: i64) {
        let ((offset, length), (change, rate)) = (state.offset, state.offset_change);
        let change = add(change, cross(self.rotation_vector, offset));
        self.displacement = add(self.displacement, change.map(|x| sign * x));
        self.center_second_derivative = self.second_derivative(length, rate);
    }
}
