//! What a certificate states: meshes, how they move, which pairs stay apart, and two points that come near.

use crate::motion::{Link, Placed, TIME};
use crate::number::{Number, Point, Vector, dot};
use crate::reader::Reader;
use crate::way::Way;
use crate::{Body, Stop};
use alloc::vec::Vec;

/// Weights of corners are multiples of 2⁻⁶².
const WEIGHT_BITS: u32 = 62;

pub(crate) struct Statement<'b> {
    /// The world and all links.
    pub(crate) links: Vec<Link>,
    pub(crate) bodies: Vec<Carried<'b>>,
    /// Both bodies of each pair, and the margin.
    pub(crate) pairs: Vec<([usize; 2], i64)>,
    /// The pairs stay apart until then.
    pub(crate) until: i64,
}

/// A mesh on a link.
pub(crate) struct Carried<'b> {
    pub(crate) mesh: &'b Body,
    /// The number of the link; 0 is the world.
    pub(crate) link: usize,
    /// The point about which the link turns, off by less than 2.
    pub(crate) centre: Point,
}

impl<'b> Statement<'b> {
    /// Reads what is stated, and checks the witness.
    pub(crate) fn read(reader: &mut Reader<'_>, meshes: &'b [Body]) -> Result<Self, Stop> {
        reader.name(b"CCDPROOF")?;
        let units = [reader.signed(4)?, reader.signed(4)?];
        let [links, bodies, pairs] = [(); 3].map(|()| reader.unsigned(4));
        let mut statement = Statement { links: alloc::vec![Link::WORLD], bodies: Vec::new(), pairs: Vec::new(), until: 0 };
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
            let bodies = [reader.index(count)?, reader.index(count)?];
            statement.pairs.push((bodies, reader.size(units[0], 50)?));
        }
        let mut exact = reader.clone();
        statement.until = reader.size(units[1] - i64::from(TIME), TIME)?;
        let count = reader.unsigned(1)?;
        reader.require(count < 2, "there is more than one witness")?;
        if count == 1 {
            statement.check_witness(reader, units, exact.unsigned(8)?)?;
        }
        Ok(statement)
    }

    fn read_body(&self, reader: &mut Reader<'_>, unit: i64, meshes: &'b [Body]) -> Result<Carried<'b>, Stop> {
        let digest = reader.take(32)?;
        let mesh = meshes.iter().find(|mesh| mesh.digest == digest);
        let mesh = mesh.ok_or(reader.broken("a mesh is none of those that are given"))?;
        let is_in_unit = i64::from(mesh.unit) == unit;
        reader.require(is_in_unit, "a mesh was read in another unit")?;
        let link = reader.index(self.links.len())?;
        Ok(Carried { mesh, link, centre: self.links[link].centre.mid })
    }

    /// Reads the claim that two points of a pair are near each other at a time, and checks it. The end of the time is given by its
    /// bits: numbers that are not negative have the order of their bits, but for the sign of 0.
    fn check_witness(&self, reader: &mut Reader<'_>, units: [i64; 2], until: u64) -> Result<(), Stop> {
        let (bodies, margin) = self.pairs[reader.index(self.pairs.len())?];
        let is_in_time = reader.clone().unsigned(8)? << 1 <= until << 1;
        let time = reader.number(units[1] - i64::from(TIME), TIME)?;
        reader.require(is_in_time && time.mid[0] >= 0, "the time of the witness is not from 0 to T")?;
        let tolerance = reader.size(units[0], 50)?;
        let placed = Placed::all(&self.links, time, Number::exact([0]));
        let [a, b] = bodies.map(|body| {
            let body = &self.bodies[body];
            let corners = body.mesh.triangles[reader.index(body.mesh.triangles.len())?];
            let (a, b) = (reader.unsigned(8)?, reader.unsigned(8)?);
            let rest = (1u64 << WEIGHT_BITS).checked_sub(a).and_then(|rest| rest.checked_sub(b));
            let rest = rest.ok_or(reader.broken("the weights of a witness are more than 1"))?;
            let weights = [a, b, rest].map(|weight| weight as i64);
            let [x, y, z, radius] = [0, 1, 2, 3].map(|k| (dot(weights, corners.map(|corner| corner[k])) >> WEIGHT_BITS) as i64);
            // Off by less than 2 with the corners, and by as much with what the shift drops.
            let point = Vector { mid: [x, y, z], rad: 4 };
            let place = Way::new(&placed, 0, body.link).arm;
            Ok((place + placed[body.link].rotation.apply(point - self.links[body.link].centre), radius))
        });
        let ((a, radius_a), (b, radius_b)) = (a?, b?);
        // Margin, radii and tolerance are rounded up: by at most 1 each.
        let is_near = (b - a).length() + 4 <= i128::from(margin + radius_a + radius_b + tolerance);
        reader.require(is_near, "the witnesses are too far from each other")
    }
}
