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

/// All links in the middle of each stretch of time are kept, and all ways between them that are asked for: no more than so many,
/// which is 400 MB.
const MAX_KEPT: usize = 1 << 20;

/// Checks a certificate about meshes. Nothing is said of any other statement than the one in the certificate: the caller
/// compares it with the one that he wants.
///
/// # Errors
/// [`Stop`] if the certificate does not prove its statement, or the checker cannot tell.
pub fn check(meshes: &[Body], certificate: &[u8]) -> Result<(), Stop> {
    let mut reader = Reader::new(certificate);
    let statement = Statement::read(&mut reader, meshes)?;
    let (mut stretches, mut ways) = (BTreeMap::new(), BTreeMap::new());
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
                    if (stretches.len() + 1) * statement.links.len() + ways.len() > MAX_KEPT {
                        return Err(Stop::Unverifiable("there are too many links and stretches of time"));
                    }
                    let links = stretches.entry(times).or_insert_with(|| {
                        let middle = from + (to - from) / 2;
                        let [middle, half] = [middle, to - middle].map(|time| Number::exact([time]));
                        Placed::all(&statement.links, middle, half)
                    });
                    let seen_from = [0, numbers[0], numbers[1]][step % 3];
                    let way = |to| *ways.entry((times, [seen_from, to])).or_insert_with(|| Way::new(links, seen_from, to));
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

    const STILL: [f64; 10] = [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0];

    /// A triangle.
    fn triangle() -> Body {
        let corners = [[0.0; 4], [1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0]];
        let mut mesh = [3u32, 1].map(u32::to_le_bytes).concat();
        mesh.extend(numbers(corners.as_flattened()));
        mesh.extend([0u32, 1, 2].map(u32::to_le_bytes).concat());
        let certificate = [&b"CCDBODY1"[..], &crate::sha256(&mesh), &[0; 4]].concat();
        Body::new(&mesh, &certificate, 0).unwrap()
    }

    fn numbers(numbers: &[f64]) -> Vec<u8> {
        numbers.iter().flat_map(|x| x.to_le_bytes()).collect()
    }

    /// A proof without steps, of two triangles on two links of a chain, that they are apart until 1. Each link moves freely, from a
    /// pose at a velocity.
    fn proof(chain: &[[f64; 10]], triangles: ([u32; 2], &Body)) -> Vec<u8> {
        let mut proof = b"CCDPROOF".to_vec();
        proof.extend([0, 0, chain.len() as u32, 2, 1].map(u32::to_le_bytes).concat());
        for (parent, motion) in (0u32..).zip(chain) {
            proof.extend(parent.to_le_bytes());
            proof.push(0);
            proof.extend(numbers(motion));
            proof.extend(numbers(&[0.0; 6]));
        }
        for link in triangles.0 {
            proof.extend(triangles.1.digest);
            proof.extend(link.to_le_bytes());
        }
        proof.extend([0u32, 1].map(u32::to_le_bytes).concat());
        proof.extend(numbers(&[0.0, 1.0]));
        proof.push(0);
        proof
    }

    /// A plane that is 2²⁰ units from the origin.
    fn leaf(normal: [i16; 3]) -> Vec<u8> {
        [&[3], &normal.map(i16::to_le_bytes).concat()[..], &[1, 0, 0, 0]].concat()
    }

    /// A chain whose links reach and travel as far as they may. At 0.95 the body at its end is where it was at the start without
    /// the chain: on the other body. But the sum of the travels is more than numbers hold.
    #[test]
    fn what_is_unknown_proves_nothing() {
        let [far, near] = [0x4310_0000_0000_0000, 0x430e_6666_6666_6666].map(f64::from_bits);
        let body = triangle();
        let chain = [[near, near, near, 0.0, 0.0, 0.0, 1.0, -far, -far, -far]; 2048];
        let mut proof = proof(&chain, ([0, 2048], &body));
        proof.extend(leaf([9459; 3]));
        let apart = "a plane is not between its parts";
        let at = proof.len();
        assert_eq!(check(&[body], &proof), Err(Stop::Broken { reason: apart, at }));
    }

    /// Two triangles far apart on a long chain, over ever shorter stretches: each keeps all links.
    #[test]
    fn what_is_kept_is_limited() {
        let body = triangle();
        let mut chain = alloc::vec![STILL; 1 << 15];
        chain[0][2] = 4_194_304.0;
        let statement = proof(&chain, ([0, 1], &body));
        let verdict = |splits| {
            let mut proof = statement.clone();
            for _ in 0..splits {
                proof.extend([2, 0, 128]);
                proof.extend(leaf([0, 0, 1 << 14]));
            }
            proof.extend(leaf([0, 0, 1 << 14]));
            check(core::slice::from_ref(&body), &proof)
        };
        assert_eq!(verdict(20), Ok(()));
        let unverifiable = Stop::Unverifiable("there are too many links and stretches of time");
        assert_eq!(verdict(40), Err(unverifiable));
    }
}
