//! The check of a certificate: a tree of splits, whose leaves cover all pairs of triangles at all times.

use crate::body::halves;
use crate::leaf::Plane;
use crate::motion::Placed;
use crate::number::{FRACTION, Number, dot, product};
use crate::reader::Reader;
use crate::statement::Statement;
use crate::way::Way;
use crate::{Body, Stop};
use alloc::collections::BTreeMap;

/// All links in the middle of a stretch of time are kept: no more than so many, which is 200 MB.
const MAX_PLACED: usize = 1 << 20;

/// Checks a certificate about meshes. Nothing is said of any other statement than the one in the certificate: the caller
/// compares it with the one that he wants.
///
/// # Errors
/// [`Stop`] if the certificate does not prove its statement, or the checker cannot tell.
pub fn check(meshes: &[Body], certificate: &[u8]) -> Result<(), Stop> {
    let mut reader = Reader::new(certificate);
    let statement = Statement::read(&mut reader, meshes)?;
    // For each stretch of time all links in its middle, and the ways between them that a leaf has asked for.
    let mut stretches = BTreeMap::new();
    for &(bodies, margin) in &statement.pairs {
        let bodies = bodies.map(|body| &statement.bodies[body]);
        let numbers = bodies.map(|body| body.link);
        // What is to be proven: first both whole bodies over the whole time. Each step splits the last entry, or proves it.
        let wholes = bodies.map(|body| [0, body.mesh.triangles.len()]);
        let mut waiting = alloc::vec![(wholes, [0, statement.until])];
        while let Some((parts, times @ [from, to])) = waiting.pop() {
            match reader.unsigned(1)? as usize {
                side @ 0..=1 => {
                    let [first, end] = parts[side];
                    reader.require(end - first > 1, "a triangle is split")?;
                    waiting.extend(halves(parts[side]).into_iter().rev().map(|half| {
                        let mut parts = parts;
                        parts[side] = half;
                        (parts, times)
                    }));
                }
                2 => {
                    let at = from + (product(to - from, reader.unsigned(2)? as i64) >> 16) as i64;
                    reader.require(from < at && at < to, "a time is split at an end")?;
                    waiting.extend([(parts, [at, to]), (parts, [from, at])]);
                }
                step @ 3..=8 => {
                    let [(bytes, bits), (offset_bytes, offset_bits)] = [[(2, 14), (4, 20)], [(7, 50), (7, 0)]][step / 6];
                    let normal = reader.axis(bytes)?;
                    reader.require(dot(normal, normal) <= 1 << (2 * bits), "a normal is longer than 1")?;
                    let normal = normal.map(|x| x << (FRACTION - bits));
                    let plane = Plane { normal, offset: reader.signed(offset_bytes)? << offset_bits };
                    if stretches.len() * statement.links.len() > MAX_PLACED {
                        return Err(Stop::Unverifiable("there are too many links and stretches of time"));
                    }
                    let (links, ways) = stretches.entry(times).or_insert_with(|| {
                        let middle = from + (to - from) / 2;
                        let [middle, half] = [middle, to - middle].map(|time| Number::exact([time]));
                        (Placed::all(&statement.links, middle, half), BTreeMap::new())
                    });
                    let seen_from = [0, numbers[0], numbers[1]][step % 3];
                    let way = |to| *ways.entry([seen_from, to]).or_insert_with(|| Way::new(links, seen_from, to));
                    let ways = numbers.map(way);
                    let is_apart = [plane.reversed(), plane]
                        .into_iter()
                        .enumerate()
                        .all(|(k, plane)| plane.keeps((bodies[k], parts[k]), &links[numbers[k]], &ways[k], margin / 2 + 1));
                    reader.require(is_apart, "a plane is not between its parts")?;
                }
                _ => return Err(reader.broken("there is no such step")),
            }
        }
    }
    reader.end()
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::vec::Vec;

    /// A chain whose links reach and travel as far as they may. At 0.95 the body at its end is where it was at the start without
    /// the chain: on the other body. But the sum of the travels is more than numbers hold.
    #[test]
    fn what_is_unknown_proves_nothing() {
        let length = 2048u32;
        let corners = [[0.0; 4], [1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0]];
        let mut mesh = [3u32, 1].map(u32::to_le_bytes).concat();
        mesh.extend(corners.iter().flatten().flat_map(|x: &f64| x.to_le_bytes()));
        mesh.extend([0u32, 1, 2].map(u32::to_le_bytes).concat());
        let digest = crate::sha256(&mesh);
        let certificate = [&b"CCDBODY1"[..], &digest, &[0; 4]].concat();
        let body = Body::new(&mesh, &certificate, 0).unwrap();
        let mut proof = b"CCDPROOF".to_vec();
        let numbers = |numbers: &[f64]| numbers.iter().flat_map(|x| x.to_le_bytes()).collect::<Vec<u8>>();
        proof.extend([0, 0, length, 2, 1].map(u32::to_le_bytes).concat());
        let far = f64::from_bits(0x4310_0000_0000_0000);
        let near = f64::from_bits(0x430e_6666_6666_6666);
        for parent in 0..length {
            proof.extend(parent.to_le_bytes());
            proof.push(0);
            proof.extend(numbers(&[near, near, near, 0.0, 0.0, 0.0, 1.0, -far, -far, -far]));
            proof.extend(numbers(&[0.0; 6]));
        }
        for link in [0, length] {
            proof.extend(digest);
            proof.extend(link.to_le_bytes());
        }
        proof.extend([0u32, 1].map(u32::to_le_bytes).concat());
        proof.extend(numbers(&[0.0, 1.0]));
        proof.extend([0, 3]);
        proof.extend([9459u16; 3].map(u16::to_le_bytes).concat());
        proof.extend(0u32.to_le_bytes());
        let apart = "a plane is not between its parts";
        let at = proof.len();
        assert_eq!(check(&[body], &proof), Err(Stop::Broken { reason: apart, at }));
    }
}
