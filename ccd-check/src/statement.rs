//! What a certificate states: meshes, how they move, which pairs stay apart, and two points that come near.

use crate::motion::{Link, Placed, TIME};
use crate::number::{Number, Vector, product};
use crate::reader::Reader;
use crate::{Body, Stop};
use alloc::vec::Vec;

/// Weights of corners are multiples of 2⁻⁶².
const WEIGHT_BITS: u32 = 62;

pub(crate) struct Statement<'b> {
    pub(crate) links: Vec<Link>,
    pub(crate) bodies: Vec<Carried<'b>>,
    pub(crate) pairs: Vec<Pair>,
    /// Each pair stays farther apart than its margin until then.
    pub(crate) until: i64,
    /// That time as its bits, twice: numbers that are not negative have the order of their bits.
    until_bits: u64,
    witness: Option<Witness>,
}

/// A mesh on a link, with all that is within a radius of it.
pub(crate) struct Carried<'b> {
    pub(crate) mesh: &'b Body,
    /// The number of the link; 0 is the world.
    pub(crate) link: usize,
    /// The point about which the link turns.
    pub(crate) centre: Vector,
    radius: i64,
}

pub(crate) struct Pair {
    pub(crate) bodies: [usize; 2],
    margin: i64,
}

/// The claim that two points of a pair are near each other at a time.
struct Witness {
    pair: usize,
    time: Number,
    tolerance: i64,
    /// For each body a triangle in the order of its tree, and the weights of its corners.
    points: [(usize, [i64; 3]); 2],
}

impl<'b> Statement<'b> {
    pub(crate) fn read(reader: &mut Reader<'_>, meshes: &'b [Body]) -> Result<Self, Stop> {
        let is_proof = reader.take(8)? == b"CCDPROOF";
        reader.require(is_proof, "this is no certificate of a query")?;
        let units = [reader.signed(4)?, reader.signed(4)?];
        let [links, bodies, pairs] = [(); 3].map(|()| reader.unsigned(4));
        let mut statement = Statement {
            links: Vec::new(),
            bodies: Vec::new(),
            pairs: Vec::new(),
            until: 0,
            until_bits: 0,
            witness: None,
        };
        for _ in 0..links? {
            let link = Link::read(reader, units, &statement.links)?;
            statement.links.push(link);
        }
        for _ in 0..bodies? {
            let body = statement.read_body(reader, units[0], meshes)?;
            statement.bodies.push(body);
        }
        for _ in 0..pairs? {
            let count = statement.bodies.len();
            statement.pairs.push(Pair {
                bodies: [reader.index(count)?, reader.index(count)?],
                margin: reader.size(units[0], 50)?,
            });
        }
        let time_unit = units[1] - i64::from(TIME);
        statement.until_bits = reader.clone().unsigned(8)? << 1;
        statement.until = reader.size(time_unit, TIME)?;
        let count = reader.unsigned(1)?;
        reader.require(count < 2, "there is more than one witness")?;
        if count == 1 {
            let witness = statement.read_witness(reader, units)?;
            statement.witness = Some(witness);
        }
        Ok(statement)
    }

    fn read_body(
        &self,
        reader: &mut Reader<'_>,
        unit: i64,
        meshes: &'b [Body],
    ) -> Result<Carried<'b>, Stop> {
        let digest = reader.take(32)?;
        let mesh = meshes.iter().find(|mesh| mesh.digest == digest);
        let mesh = mesh.ok_or(reader.broken("a mesh is none of those that are given"))?;
        reader.require(
            i64::from(mesh.unit) == unit,
            "a mesh was read in another unit",
        )?;
        let link = reader.index(self.links.len() + 1)?;
        let centre = link
            .checked_sub(1)
            .map_or(Vector::exact([0; 3]), |k| self.links[k].centre);
        let radius = reader.size(unit, 50)?;
        Ok(Carried {
            mesh,
            link,
            centre,
            radius,
        })
    }

    fn read_witness(&self, reader: &mut Reader<'_>, units: [i64; 2]) -> Result<Witness, Stop> {
        let pair = reader.index(self.pairs.len())?;
        let time_bits = reader.clone().unsigned(8)? << 1;
        let time = reader.number(units[1] - i64::from(TIME), TIME)?;
        let tolerance = reader.size(units[0], 50)?;
        let mut points = [(0, [0; 3]); 2];
        for (point, body) in points.iter_mut().zip(self.pairs[pair].bodies) {
            let triangle = reader.index(self.bodies[body].mesh.triangles.len())?;
            let (a, b) = (reader.unsigned(8)?, reader.unsigned(8)?);
            let rest = (1u64 << WEIGHT_BITS).checked_sub(a);
            let rest = rest.and_then(|rest| rest.checked_sub(b));
            let rest = rest.ok_or(reader.broken("the weights of a witness are more than 1"))?;
            *point = (triangle, [a, b, rest].map(|weight| weight as i64));
        }
        let is_in_time = time.mid[0] >= 0 && time_bits <= self.until_bits;
        reader.require(is_in_time, "the time of the witness is not from 0 to T")?;
        Ok(Witness {
            pair,
            time,
            tolerance,
            points,
        })
    }

    /// Returns the distance that the meshes of a pair have to exceed: the margin and both radii.
    pub(crate) fn least(&self, pair: usize) -> i128 {
        let Pair { bodies, margin } = &self.pairs[pair];
        i128::from(
            bodies
                .iter()
                .fold(*margin, |sum, &body| sum + self.bodies[body].radius),
        )
    }

    /// Returns whether the witnesses are as near each other as is claimed.
    pub(crate) fn has_near_witnesses(&self) -> bool {
        let Some(witness) = &self.witness else {
            return true;
        };
        let placed = Placed::all(&self.links, witness.time, Number::exact([0]));
        let [a, b] = [0, 1].map(|k| {
            let body = &self.bodies[self.pairs[witness.pair].bodies[k]];
            let (triangle, weights) = witness.points[k];
            let corners = body.mesh.triangles[triangle];
            let sum = |axis| {
                (0..3)
                    .map(|c| product(weights[c], corners[c][axis]))
                    .sum::<i128>()
            };
            // Off by less than 2 with the corners, and by as much with what the shift drops.
            let point = Vector {
                mid: [0, 1, 2].map(|axis| (sum(axis) >> WEIGHT_BITS) as i64),
                rad: 4,
            };
            let link = placed[body.link];
            link.centre + link.rotation.apply(point - body.centre)
        });
        // Margin, radii and tolerance are rounded up: by at most 1 each.
        (b - a).length() + 4 <= self.least(witness.pair) + i128::from(witness.tolerance)
    }
}
