//! What a certificate states: two meshes, how they move, and what is claimed.

use crate::number::{FRACTION, Number, ONE, Vector};
use crate::reader::Reader;
use crate::rotation::Rotation;
use crate::{Body, Fault, Stop};

/// Times are shares of a power of two that is no less than the duration, in multiples of 2⁻⁶⁰.
pub(crate) const TIME: u32 = 60;

/// Weights of corners are multiples of 2⁻³¹.
const WEIGHT_BITS: u32 = 31;

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
    start: Placed,
    /// How far the centre moves in the unit of time, and the rotation vector of the unit of time.
    pub(crate) travel: Vector,
    pub(crate) turn: Vector,
}

/// A body at a time: its centre in the world, and the columns of its rotation.
pub(crate) struct Placed {
    pub(crate) centre: Vector,
    pub(crate) columns: [Vector; 3],
}

/// The claim that two points are near each other at a time.
pub(crate) struct Contact {
    time: Number,
    distance: i128,
    /// For each body a triangle, and the weights of its corners.
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
        let until = reader.number(time_unit - i128::from(TIME), TIME.into(), Fault::Number)?;
        let margin = reader.number(unit, 50, Fault::Number)?;
        let contact = match reader.unsigned(1)? {
            0 => None,
            1 => Some(Contact {
                time: until,
                distance: margin.mid[0] + reader.number(unit, 50, Fault::Number)?.mid[0],
                points: [read_point(reader)?, read_point(reader)?],
            }),
            _ => return reader.broken(Fault::Format),
        };
        if margin.mid[0] < 0 || until.mid[0] < 0 {
            return reader.broken(Fault::Format);
        }
        let (margin, until) = (margin.size(), until.size());
        Ok(Statement {
            motions,
            margin,
            until,
            contact,
        })
    }
}

/// Reads the number of a triangle in the order of its tree, and the weights of two corners; the third one has the rest.
fn read_point(reader: &mut Reader<'_>) -> Result<(usize, [i128; 3]), Stop> {
    let triangle = reader.unsigned(4)? as usize;
    let (a, b) = (reader.unsigned(4)?, reader.unsigned(4)?);
    let rest = (1 << WEIGHT_BITS) - a - b;
    if rest < 0 {
        return reader.broken(Fault::Witnesses);
    }
    Ok((triangle, [a, b, rest]))
}

impl Contact {
    /// Returns whether both points are within the distance that is claimed.
    pub(crate) fn holds(&self, motions: &[Motion; 2], bodies: [&Body; 2]) -> bool {
        let place = |k: usize| -> Option<Vector> {
            let (triangle, weights) = self.points[k];
            let corners = bodies[k].triangles.get(triangle)?;
            let sum = |axis: usize| (0..3).map(|c| weights[c] * corners[c][axis]).sum::<i128>();
            // Off by less than 1 with the corners, and by as much with what the shift drops.
            let point = Vector {
                mid: [0, 1, 2].map(|axis| sum(axis) >> WEIGHT_BITS),
                rad: 2,
            };
            let placed = motions[k].at(self.time);
            Some(placed.centre + from_columns(placed.columns, point - motions[k].centre))
        };
        let (Some(a), Some(b)) = (place(0), place(1)) else {
            return false;
        };
        let apart = a - b;
        let squares = apart.mid.iter().map(|x| (x.abs() + apart.rad).pow(2));
        self.distance >= 0 && squares.sum::<i128>() <= self.distance.pow(2)
    }
}

impl Motion {
    fn read(reader: &mut Reader<'_>, unit: i128, time_unit: i128) -> Result<Self, Stop> {
        let position = reader.vector(unit, 50, Fault::Number)?;
        let columns = read_rotation(reader)?;
        let travel = reader.vector(unit - time_unit, 50, Fault::Number)?;
        let fraction = i128::from(FRACTION);
        let turn = reader.vector(-fraction - time_unit, fraction + 8, Fault::Turns)?;
        let centre = reader.vector(unit, 50, Fault::Number)?;
        let start = Placed {
            centre: position + from_columns(columns, centre),
            columns,
        };
        Ok(Motion {
            centre,
            start,
            travel,
            turn,
        })
    }

    pub(crate) fn at(&self, time: Number) -> Placed {
        let turned = Rotation::by(self.turn.times(time, TIME));
        Placed {
            centre: self.start.centre + self.travel.times(time, TIME),
            columns: self.start.columns.map(|column| turned.turn(column)),
        }
    }
}

impl Placed {
    /// Returns a direction of the world in the frame of the mesh.
    pub(crate) fn to_mesh(&self, direction: Vector) -> Vector {
        let [x, y, z] = [0, 1, 2].map(|k| self.columns[k].dot(direction, FRACTION));
        Vector {
            mid: [x.mid[0], y.mid[0], z.mid[0]],
            rad: x.rad.max(y.rad).max(z.rad),
        }
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
        return Err(Stop::Unverifiable(Fault::Quaternion));
    }
    // 1 / (1 + e) is 1 − e to within e² / (1 − |e|), which is less than 2e².
    let mut inverse = ONE - excess;
    inverse.rad += 2 * excess.dot(excess, FRACTION).size();
    let rotation = Rotation {
        scalar,
        vector,
        factor: inverse + inverse,
    };
    let one = ONE.mid[0];
    let basis = [[one, 0, 0], [0, one, 0], [0, 0, one]];
    Ok(basis.map(|axis| rotation.turn(Vector::exact(axis))))
}
