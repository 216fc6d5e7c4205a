//! The check of a certificate: a tree of splits, whose leaves cover all pairs of triangles at all times.

use crate::body::WHOLE;
use crate::leaf::{Side, is_between, is_beyond_ball, read_plane};
use crate::reader::Reader;
use crate::statement::Statement;
use crate::way::Way;
use crate::{Body, Stop, verifiable};
use alloc::collections::BTreeMap;

/// All links in the middle of each stretch of time are kept, and the ways to all from those that are asked for: no more than so many
/// in all, which is 200 MB.
const MAX_KEPT: usize = 1 << 20;

/// Checks a certificate about meshes. Nothing is said of any other statement than the one in the certificate: the caller
/// compares it with the one that he wants.
///
/// # Errors
/// [`Stop`] if the certificate does not prove its statement, or the checker cannot tell.
pub fn check(meshes: &[Body], certificate: &[u8]) -> Result<(), Stop> {
    let mut reader = Reader::after(b"CCDPROF1", certificate)?;
    let statement = Statement::read(&mut reader, meshes)?;
    let links = &statement.links;
    let (mut stretches, mut ways) = (BTreeMap::new(), BTreeMap::new());
    for &(bodies, margin) in &statement.pairs {
        let bodies = bodies.map(|body| statement.bodies[body]);
        // What is to be proven: first both whole bodies over the whole time. Each step splits the last entry, or proves it.
        let mut waiting = alloc::vec![([WHOLE; 2], [0, statement.until])];
        while let Some((parts, times @ [from, to])) = waiting.pop() {
            let middle = from + (to - from) / 2;
            match reader.unsigned(1)? as usize {
                side @ 0..=1 => {
                    let halves = bodies[side].0.halves(parts[side]).ok_or(reader.broken("a triangle is split"))?;
                    waiting.extend(halves.into_iter().rev().map(|half| {
                        let mut parts = parts;
                        parts[side] = half;
                        (parts, times)
                    }));
                }
                2 => {
                    reader.require(to - from > 1, "a time is too short to be split")?;
                    waiting.extend([(parts, [middle, to]), (parts, [from, middle])]);
                }
                step @ 3..=7 => {
                    let is_kept = (stretches.len() + ways.len() + 2) * links.all.len() <= MAX_KEPT;
                    verifiable(is_kept, "there are too many links and stretches of time")?;
                    let placed = stretches.entry(times).or_insert_with(|| links.placed(middle, to - middle));
                    let numbers = bodies.map(|body| body.1);
                    let seen_from = [0, numbers[0], numbers[1], numbers[1], numbers[0]][step - 3];
                    let ways = ways.entry((times, seen_from)).or_insert_with(|| Way::all(links, placed, seen_from));
                    let [a, b] = [0, 1].map(|k| {
                        let (mesh, link) = bodies[k];
                        Side { mesh, part: parts[k], centre: links.all[link].centre, link: &placed[link], way: &ways[link] }
                    });
                    let is_apart = match step {
                        6 => is_beyond_ball(&b, &a, links, margin),
                        7 => is_beyond_ball(&a, &b, links, margin),
                        _ => is_between(read_plane(&mut reader)?, [&a, &b], links, margin / 2 + 1),
                    };
                    reader.require(is_apart, "a leaf does not prove that its parts are apart")?;
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
        Body::new(&mesh, &certificate, b"CCDPROF1\0\0\0\0").unwrap()
    }

    fn numbers(numbers: &[f64]) -> Vec<u8> {
        numbers.iter().flat_map(|x| x.to_le_bytes()).collect()
    }

    /// A proof without steps, of two triangles on two links of a chain, that they are apart until 1. Each link moves freely, from a
    /// pose at a velocity.
    fn proof(chain: &[[f64; 10]], triangles: ([u32; 2], &Body)) -> Vec<u8> {
        let mut proof = b"CCDPROF1".to_vec();
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

    /// A plane across z at a height.
    fn leaf(height: i64) -> Vec<u8> {
        let numbers = [0, 0, 1 << 50, height].map(|x: i64| x.to_le_bytes());
        [&[3], numbers.map(|bytes| [0, 1, 2, 3, 4, 5, 6].map(|k| bytes[k])).as_flattened()].concat()
    }

    /// A chain whose links reach as far as they may, each by itself and in all, and one more.
    #[test]
    fn what_reaches_too_far_is_unverifiable() {
        let body = triangle();
        let far = f64::from_bits(0x4310_0000_0000_0000);
        let verdict = |count: usize| {
            let link = [0.0, 0.0, far, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0];
            let mut proof = proof(&alloc::vec![link; count], ([0, count as u32], &body));
            proof.extend(leaf(1 << 54));
            check(core::slice::from_ref(&body), &proof)
        };
        assert_eq!(verdict(64), Ok(()));
        let unverifiable = Stop::Unverifiable("there are too many links, or they turn or reach too far");
        assert_eq!(verdict(65), Err(unverifiable));
    }

    /// Two triangles far apart on a long chain, over ever shorter stretches: each keeps all links.
    #[test]
    fn what_is_kept_is_limited() {
        let body = triangle();
        let mut chain = alloc::vec![STILL; 1 << 15];
        chain[0][2] = 67_108_864.0;
        let statement = proof(&chain, ([0, 1], &body));
        let verdict = |splits| {
            let mut proof = statement.clone();
            for _ in 0..splits {
                proof.push(2);
                proof.extend(leaf(1 << 25));
            }
            proof.extend(leaf(1 << 25));
            check(core::slice::from_ref(&body), &proof)
        };
        assert_eq!(verdict(10), Ok(()));
        let unverifiable = Stop::Unverifiable("there are too many links and stretches of time");
        assert_eq!(verdict(20), Err(unverifiable));
    }
}
