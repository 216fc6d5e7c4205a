//! What a certificate states: two meshes, how they move, and what is claimed.

use crate::number::{FRACTION, Number, ONE, Vector};
use crate::reader::Reader;
use crate::rotation::Rotation;
use crate::{Body, Fault, Stop, Verdict};

/// Times are shares of a power of two that is no less than the duration, in multiples of 2⁻⁶⁰.
pub(crate) const TIME: u32 = 60;

pub(crate) struct Statement {
    pub(crate) motions: [Motion; 2],
    /// The bodies stay farther apart than this until the time `until`.
    pub(crate) margin: i128,
    pub(crate) until: i128,
    pub(crate) contact: Option<Contact>,
}

/// How a body moves: its centre of rotation along a line, and the body about it at a constant rate.
pub(crate) struct Motion {
    /// The centre in the frame of the mesh.
    pub(crate) centre: Vector,
    /// The centre in the world at the start, and how far it moves in the unit of time.
    start: Vector,
    pub(crate) travel: Vector,
    /// The columns of the rotation at the start.
    columns: [Vector; 3],
    /// The rotation vector of the unit of time; `None` if the body does not turn.
    pub(crate) turn: Option<Vector>,
}

/// The claim that two points are near each other at a time.
pub(crate) struct Contact {
    time: Number,
    distance: i128,
    /// For each body a triangle, and the weights of its corners as multiples of 2⁻³².
    points: [(usize, [i128; 3]); 2],
}

impl Statement {
    pub(crate) fn read(reader: &mut Reader<'_>, bodies: [&Body; 2]) -> Result<Self, Stop> {
        reader.require(b"CCDPROOF", Fault::Format)?;
        let (unit, time_unit) = (reader.signed(4)?, reader.signed(4)?);
        for body in bodies {
            reader.require(&body.digest, Fault::OtherMesh)?;
        }
        if bodies.iter().any(|body| i128::from(body.unit) != unit) {
            return reader.broken(Fault::OtherUnit);
        }
        let motions = [
            Motion::read(reader, unit, time_unit)?,
            Motion::read(reader, unit, time_unit)?,
        ];
        let (time_unit, bits) = (time_unit - i128::from(TIME), TIME.into());
        let duration = reader.number(time_unit, bits, Fault::Number)?;
        let margin = reader.number(unit, 50, Fault::Number)?;
        let contact = match reader.unsigned(1)? {
            0 => None,
            1 => Some(Contact {
                time: reader.number(time_unit, bits, Fault::Number)?,
                distance: margin.mid[0] + reader.number(unit, 50, Fault::Number)?.mid[0],
                points: [read_point(reader)?, read_point(reader)?],
            }),
            _ => return reader.broken(Fault::Format),
        };
        let until = contact.as_ref().map_or(duration, |contact| contact.time);
        if margin.mid[0] < 0 || until.mid[0] < 0 || until.mid[0] > duration.mid[0] {
            return reader.broken(Fault::Format);
        }
        Ok(Statement {
            motions,
            margin: margin.size(),
            until: until.size(),
            contact,
        })
    }
}

/// Reads the number of a triangle in the order of its tree, and the weights of its corners.
fn read_point(reader: &mut Reader<'_>) -> Result<(usize, [i128; 3]), Stop> {
    let triangle = reader.unsigned(4)? as usize;
    let weights = [
        reader.unsigned(4)?,
        reader.unsigned(4)?,
        reader.unsigned(4)?,
    ];
    if weights.iter().sum::<i128>() == 1 << 32 {
        Ok((triangle, weights))
    } else {
        reader.broken(Fault::Witnesses)
    }
}

impl Contact {
    /// Returns whether both points are within the distance that is claimed.
    pub(crate) fn holds(&self, motions: &[Motion; 2], bodies: [&Body; 2]) -> bool {
        let place = |k: usize| -> Option<Vector> {
            let (triangle, weights) = self.points[k];
            let corners = bodies[k].triangles.get(triangle)?;
            // Off by less than 1 with the corners, and by as much with what the shift drops.
            let mid = [0, 1, 2]
                .map(|axis| (0..3).map(|c| weights[c] * corners[c][axis]).sum::<i128>() >> 32);
            Some(motions[k].point_at(Vector { mid, rad: 2 }, self.time))
        };
        let (Some(a), Some(b)) = (place(0), place(1)) else {
            return false;
        };
        let apart = a - b;
        let square: i128 = apart.mid.iter().map(|x| (x.abs() + apart.rad).pow(2)).sum();
        self.distance >= 0 && square <= self.distance.pow(2)
    }
}

impl Motion {
    fn read(reader: &mut Reader<'_>, unit: i128, time_unit: i128) -> Result<Self, Stop> {
        let position = reader.vector(unit, 50, Fault::Number)?;
        let columns = read_rotation(reader)?;
        let travel = reader.vector(unit - time_unit, 50, Fault::Number)?;
        // A body turns by at most 2⁸ radians about each axis.
        let fraction = i128::from(FRACTION);
        let turn = reader.vector(-fraction - time_unit, fraction + 8, Fault::Turns)?;
        let centre = reader.vector(unit, 50, Fault::Number)?;
        let start = position + from_columns(columns, centre);
        let turn = (turn.size() > 0).then_some(turn);
        Ok(Motion {
            centre,
            start,
            travel,
            columns,
            turn,
        })
    }

    /// Returns the centre of rotation at a time.
    pub(crate) fn centre_at(&self, time: Number) -> Vector {
        self.start + self.travel.times(time, TIME)
    }

    /// Returns the rotation since the start, at a time.
    pub(crate) fn turned_at(&self, time: Number) -> Option<Rotation> {
        Some(Rotation::by(self.turn?.times(time, TIME)))
    }

    /// Returns a direction of the world in the frame of the mesh.
    pub(crate) fn to_mesh(&self, direction: Vector, turned: Option<Rotation>) -> Vector {
        let direction = turned.map_or(direction, |turned| turned.inverse().turn(direction));
        let [x, y, z] = self.columns.map(|column| column.dot(direction, FRACTION));
        Vector {
            mid: [x.mid[0], y.mid[0], z.mid[0]],
            rad: x.rad.max(y.rad).max(z.rad),
        }
    }

    /// Returns a point of the mesh in the world at a time.
    fn point_at(&self, point: Vector, time: Number) -> Vector {
        let arm = from_columns(self.columns, point - self.centre);
        self.centre_at(time) + self.turned_at(time).map_or(arm, |turned| turned.turn(arm))
    }
}

/// Returns the sum of the columns of a rotation, times the coordinates of a vector.
fn from_columns([x, y, z]: [Vector; 3], v: Vector) -> Vector {
    let [a, b, c] = v.mid.map(|mid| Number {
        mid: [mid],
        rad: v.rad,
    });
    x.times(a, FRACTION) + y.times(b, FRACTION) + z.times(c, FRACTION)
}

/// Reads a quaternion x, y, z, w, and returns the columns of its rotation.
fn read_rotation(reader: &mut Reader<'_>) -> Result<[Vector; 3], Stop> {
    let fraction = i128::from(FRACTION);
    let vector = reader.vector(-fraction, fraction + 1, Fault::Quaternion)?;
    let scalar = reader.number(-fraction, fraction + 1, Fault::Quaternion)?;
    let excess = vector.dot(vector, FRACTION) + scalar.times(scalar, FRACTION) - ONE;
    if excess.size() > ONE.mid[0] >> 20 {
        return Err(Verdict::Unverifiable(Fault::Quaternion));
    }
    // 1 / (1 + e) is 1 − e to within e² / (1 − |e|), which is less than 2e².
    let mut inverse = ONE - excess;
    inverse.rad += 2 * excess.dot(excess, FRACTION).size();
    let basis = [0, 1, 2].map(|k| {
        Vector::exact(core::array::from_fn(
            |j| if j == k { ONE.mid[0] } else { 0 },
        ))
    });
    // v + 2 s u×v + 2 u×(u×v), over the square of the quaternion's length.
    Ok(basis.map(|v| {
        let once = vector.cross(v, FRACTION);
        let half = once.times(scalar, FRACTION) + vector.cross(once, FRACTION);
        v + (half + half).times(inverse, FRACTION)
    }))
}
