//! What a certificate states: two meshes, how they move, and what is claimed.

use crate::number::{Ball, FRACTION_BITS, ONE, Sign, Vector, add, cross, dot, scale};
use crate::reader::{Binary64, Reader};
use crate::rotation::Rotation;
use crate::{Body, Fault, Reason, Stop, Verdict};

/// Times are shares of a power of two that is no less than the duration, in multiples of 2⁻⁶⁰.
pub(crate) const TIME_BITS: u32 = 60;

/// Bodies turn by at most 2⁸ radians about each axis.
const MAX_TURN_BITS: i32 = FRACTION_BITS as i32 + 8;

/// How a body moves: its centre of rotation along a line, and the body about it at a constant rate.
#[derive(Clone, Debug)]
pub(crate) struct Motion {
    /// The centre in the frame of the mesh.
    pub(crate) centre: [i128; 3],
    /// The centre in the world at the start, and how far it moves in the unit of time.
    start: Vector,
    pub(crate) travel: Vector,
    /// The rows of the rotation at the start.
    rotation: [Vector; 3],
    /// The rotation vector of the unit of time; `None` if the body does not turn.
    pub(crate) turn: Option<Vector>,
}

pub(crate) struct Statement {
    pub(crate) motions: [Motion; 2],
    /// The bodies stay farther apart than this until the time `until`.
    pub(crate) margin: i128,
    pub(crate) until: i128,
    pub(crate) contact: Option<Contact>,
}

/// The claim that two points are near each other at a time.
pub(crate) struct Contact {
    pub(crate) time: Ball,
    pub(crate) triangles: [usize; 2],
    /// The weights of the corners of each triangle, as multiples of 2⁻³².
    pub(crate) weights: [[u32; 3]; 2],
    pub(crate) distance: i128,
}

impl Statement {
    pub(crate) fn read(reader: &mut Reader<'_>, bodies: [&Body; 2]) -> Result<Self, Stop> {
        reader.require(b"CCDPROOF")?;
        let (unit, time_unit) = (reader.i32()?, reader.i32()?);
        for body in bodies {
            if reader.array()? != body.digest || body.unit != unit {
                return reader.broken(Fault::OtherMesh);
            }
        }
        let motions = [
            Motion::read(reader, unit, time_unit)?,
            Motion::read(reader, unit, time_unit)?,
        ];
        let (duration, margin) = (reader.binary64()?, reader.binary64()?);
        if duration.is_negative() || margin.is_negative() {
            return reader.broken(Fault::Format);
        }
        let margin = margin.length(unit)?;
        let time = |time: Binary64| time.in_unit(time_unit - TIME_BITS as i32, TIME_BITS as i32);
        let whole = time(duration)?;
        let contact = match reader.u8()? {
            0 => None,
            1 => {
                let (at, tolerance) = (time(reader.binary64()?)?, reader.binary64()?);
                let place = |reader: &mut Reader<'_>| reader.u32().map(|place| place as usize);
                let weights = |reader: &mut Reader<'_>| -> Result<_, Stop> {
                    Ok([reader.u32()?, reader.u32()?, reader.u32()?])
                };
                if at.mid < 0 || at.mid > whole.mid || tolerance.is_negative() {
                    return reader.broken(Fault::Format);
                }
                Some(Contact {
                    time: at,
                    triangles: [place(reader)?, place(reader)?],
                    weights: [weights(reader)?, weights(reader)?],
                    distance: margin.mid + tolerance.length(unit)?.mid,
                })
            }
            _ => return reader.broken(Fault::Format),
        };
        let until = contact.as_ref().map_or(whole, |contact| contact.time);
        Ok(Statement {
            motions,
            margin: margin.size(),
            until: until.size(),
            contact,
        })
    }

    /// Returns whether the witnesses of a contact are within the distance that is claimed.
    pub(crate) fn witnesses_hold(&self, contact: &Contact, bodies: [&Body; 2]) -> bool {
        let place = |k: usize| {
            let triangle = bodies[k].triangle(contact.triangles[k])?;
            let weights = contact.weights[k].map(i128::from);
            let is_whole = weights.iter().sum::<i128>() == 1 << 32;
            let point = [0, 1, 2].map(|axis| {
                let sum: i128 = (0..3).map(|c| weights[c] * triangle[c][axis]).sum();
                // The corners are off by less than 1, and so is what the shift drops.
                Ball {
                    mid: sum >> 32,
                    rad: 2,
                }
            });
            is_whole.then(|| self.motions[k].point_at(point, contact.time))
        };
        let (Some(a), Some(b)) = (place(0), place(1)) else {
            return false;
        };
        let squares = [0, 1, 2].map(|k| a[k].sub(b[k]).size().pow(2));
        squares.iter().sum::<i128>() <= contact.distance.pow(2)
    }
}

impl Motion {
    fn read(reader: &mut Reader<'_>, unit: i32, time_unit: i32) -> Result<Self, Stop> {
        let position = lengths(reader.vector()?, unit)?;
        let rotation = read_rotation(reader)?;
        let (velocity, spin) = (reader.vector()?, reader.vector()?);
        let centre = lengths(reader.vector()?, unit)?;
        let mut turn = [Ball::ZERO; 3];
        for (place, rate) in turn.iter_mut().zip(spin) {
            let unit = -(FRACTION_BITS as i32) - time_unit;
            let converted = rate.in_unit(unit, MAX_TURN_BITS);
            *place = converted.map_err(|_| Verdict::Unverifiable(Reason::Turns))?;
        }
        let turns = turn.iter().any(|x| x.size() > 0);
        Ok(Motion {
            start: add(
                position,
                rotation.map(|row| dot(row, centre, FRACTION_BITS)),
            ),
            travel: lengths(velocity, unit - time_unit)?,
            rotation,
            turn: turns.then_some(turn),
            // The radius of the centre is that of the corners, and is allowed for with it.
            centre: centre.map(|x| x.mid),
        })
    }

    /// Returns the centre of rotation at a time.
    pub(crate) fn centre_at(&self, time: Ball) -> Vector {
        add(self.start, scale(self.travel, time, TIME_BITS))
    }

    /// Returns the rotation since the start, at a time.
    pub(crate) fn turned_at(&self, time: Ball) -> Option<Rotation> {
        Some(Rotation::by(scale(self.turn?, time, TIME_BITS)))
    }

    /// Returns a direction of the world in the frame of the mesh at the start.
    pub(crate) fn to_mesh(&self, direction: Vector) -> Vector {
        let [x, y, z] = self.rotation;
        [0, 1, 2].map(|k| dot([x[k], y[k], z[k]], direction, FRACTION_BITS))
    }

    /// Returns a point of the mesh in the world at a time.
    fn point_at(&self, point: Vector, time: Ball) -> Vector {
        let arm = [0, 1, 2].map(|k| {
            point[k].sub(Ball {
                mid: self.centre[k],
                rad: 1,
            })
        });
        let arm = self.rotation.map(|row| dot(row, arm, FRACTION_BITS));
        let arm = self
            .turned_at(time)
            .map_or(arm, |turned| turned.turn(arm, Sign::Plus));
        add(self.centre_at(time), arm)
    }
}

fn lengths(numbers: [Binary64; 3], unit: i32) -> Result<Vector, Stop> {
    let [x, y, z] = numbers;
    Ok([x.length(unit)?, y.length(unit)?, z.length(unit)?])
}

/// Reads a quaternion x, y, z, w, and returns the rows of its rotation.
fn read_rotation(reader: &mut Reader<'_>) -> Result<[Vector; 3], Stop> {
    let mut q = [Ball::ZERO; 4];
    for place in &mut q {
        let converted = reader
            .binary64()?
            .in_unit(-(FRACTION_BITS as i32), FRACTION_BITS as i32 + 1);
        *place = converted.map_err(|_| Verdict::Unverifiable(Reason::Quaternion))?;
    }
    let by = |a: Ball, b: Ball| a.mul(b, FRACTION_BITS);
    let [x, y, z, w] = q;
    let excess = by(x, x)
        .add(by(y, y))
        .add(by(z, z))
        .add(by(w, w))
        .sub(Ball::exact(ONE));
    if excess.size() > ONE >> 20 {
        return Err(Verdict::Unverifiable(Reason::Quaternion));
    }
    // 1 / (1 + e) is 1 − e to within e² / (1 − |e|), which is less than 2e².
    let mut inverse = Ball::exact(ONE).sub(excess);
    inverse.rad += 2 * by(excess, excess).size();
    let twice = |a: Ball| by(a.add(a), inverse);
    let diagonal = |a: Ball, b: Ball| Ball::exact(ONE).sub(twice(by(a, a).add(by(b, b))));
    let (sum, difference) = (
        |a, b, c, d| twice(by(a, b).add(by(c, d))),
        |a, b, c, d| twice(by(a, b).sub(by(c, d))),
    );
    Ok([
        [diagonal(y, z), difference(x, y, z, w), sum(x, z, y, w)],
        [sum(x, y, z, w), diagonal(x, z), difference(y, z, x, w)],
        [difference(x, z, y, w), sum(y, z, x, w), diagonal(x, y)],
    ])
}

/// Returns the derivative of a vector that turns by a rotation vector.
pub(crate) fn turning(vector: Vector, turn: Option<Vector>) -> Vector {
    turn.map_or([Ball::ZERO; 3], |turn| cross(turn, vector, FRACTION_BITS))
}
