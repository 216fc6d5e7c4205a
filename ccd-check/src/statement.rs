//! What a certificate states: meshes, how they move, which pairs stay apart, and two points that come near.

use crate::motion::{Links, TIME};
use crate::number::*;
use crate::reader::Reader;
use crate::way::Way;
use crate::{Body, Stop};
use alloc::vec::Vec;

/// Weights of corners are multiples of 2⁻⁶².
const WEIGHT_BITS: u32 = 62;

pub(crate) struct Statement<'b> {
    pub(crate) links: Links,
    /// The mesh of each body, and the number of its link; 0 is the world.
    pub(crate) bodies: Vec<(&'b Body, usize)>,
    /// Both bodies of each pair, and the margin.
    pub(crate) pairs: Vec<([usize; 2], i64)>,
    /// The pairs stay apart until then.
    pub(crate) until: i64,
}

impl<'b> Statement<'b> {
    /// Reads what is stated, and checks the witness.
    pub(crate) fn read(reader: &mut Reader<'_>, meshes: &'b [Body]) -> Result<Self, Stop> {
        let units = [reader.signed(4)?, reader.signed(4)?];
        let [links, bodies, pairs] = [(); 3].map(|()| reader.unsigned(4));
        let mut statement = Statement { links: Links::new(), bodies: Vec::new(), pairs: Vec::new(), until: 0 };
        for _ in 0..links? {
            statement.links.read(reader, units)?;
        }
        for _ in 0..bodies? {
            let digest = reader.take(32)?;
            let mesh = meshes.iter().find(|mesh| mesh.digest == digest && mesh.unit == units[0]);
            let mesh = mesh.ok_or(reader.broken("a mesh is none of those that are given, in this unit"))?;
            statement.bodies.push((mesh, reader.index(statement.links.all.len())?));
        }
        for _ in 0..pairs? {
            let count = statement.bodies.len();
            let bodies = [reader.index(count)?, reader.index(count)?];
            statement.pairs.push((bodies, reader.size(units[0], 50)?));
        }
        statement.until = reader.size(units[1] - i64::from(TIME), TIME)?;
        let count = reader.unsigned(1)?;
        reader.require(count < 2, "there is more than one witness")?;
        if count == 1 {
            statement.check_witness(reader, units)?;
        }
        Ok(statement)
    }

    /// Reads the claim that two points of a pair are near each other at a time, and checks it.
    fn check_witness(&self, reader: &mut Reader<'_>, units: [i64; 2]) -> Result<(), Stop> {
        let (bodies, margin) = self.pairs[reader.index(self.pairs.len())?];
        let time = reader.number(units[1] - i64::from(TIME), TIME)?;
        reader.require(time >= 0, "the time of the witness is negative")?;
        let tolerance = reader.size(units[0], 50)?;
        let placed = self.links.placed(time, 0);
        let ways = Way::all(&self.links, &placed, 0);
        let [a, b] = bodies.map(|body| {
            let (mesh, link) = self.bodies[body];
            let corners = mesh.triangles[reader.index(mesh.triangles.len())?];
            let (a, b) = (reader.unsigned(8)?, reader.unsigned(8)?);
            let rest = (1u64 << WEIGHT_BITS).checked_sub(a).and_then(|rest| rest.checked_sub(b));
            let rest = rest.ok_or(reader.broken("the weights of a witness are more than 1"))?;
            let weights = [a, b, rest].map(|weight| weight as i64);
            let [x, y, z, radius] = [0, 1, 2, 3].map(|k| (dot(weights, corners.map(|corner| corner[k])) >> WEIGHT_BITS) as i64);
            let arm = sub([x, y, z], self.links.all[link].centre);
            let place = add(ways[link].arm, turned(&placed[link].rotation, arm));
            Ok((place, radius - 3 * self.links.loss(length(arm)) as i64))
        });
        let ((a, radius_a), (b, radius_b)) = (a?, b?);
        // Margin, radii and tolerance are rounded up: by at most 1 each.
        let (apart, limit) = (sub(b, a), margin + tolerance + radius_a + radius_b - 4);
        let is_near = limit >= 0 && dot(apart, apart) <= product(limit, limit);
        reader.require(is_near, "the witnesses are too far from each other")
    }
}
