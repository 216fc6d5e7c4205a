//! The check of a certificate: a tree of splits, whose leaves cover all pairs of triangles at all times.

use crate::{Body, Checked, Stop, body::Part, motion::Links, number::*, reader::Reader, verifiable};
use alloc::{collections::BTreeMap, vec::Vec};
use core::cell::Cell;

/// Links are kept as they are in the middle of stretches of time, until these are so many, which is some 200 MB.
const MAX_KEPT: usize = 1 << 19;

/// No check looks at more links and parts.
const MAX_WORK: u64 = 1 << 32;

/// Weights of corners are multiples of 2⁻⁵⁵.
const WEIGHT: u32 = 55;

/// Both bodies, and the margin.
type Pair<'b> = ([Part<'b>; 2], i64);

/// Checks a certificate about meshes. Nothing is said of any other statement than the one in the certificate: the caller
/// compares it with the one that he wants.
///
/// A leaf takes time in proportion to the links and to its parts: so a hostile file would take it in proportion to the square of its
/// length. A check that looks at more than 2³² of both stops as unverifiable.
///
/// # Errors
/// [`Stop`] if the certificate does not prove its statement, or the checker cannot tell.
pub fn check(meshes: &[Body], certificate: &[u8]) -> Result<(), Stop> {
    let mut reader = Reader::new(b"CCDPROF1", certificate)?;
    let (work, mut kept) = (Cell::new(0), BTreeMap::new());
    let (links, pairs, until) = read_claim(&mut reader, meshes, &work)?;
    for (bodies, margin) in pairs {
        // What is to be proven: first both whole bodies over the whole time. Each step splits the last entry, or proves it.
        let mut waiting = alloc::vec![(bodies, [0, until])];
        while let Some((parts @ [a, b], times @ [from, to])) = waiting.pop() {
            let (middle, step) = (from + (to - from) / 2, reader.unsigned(1)? as usize);
            if step < 2 {
                let [first, second] = parts[step].halves().ok_or(reader.broken("a triangle is split"))?;
                let with = |half| if step == 0 { [half, b] } else { [a, half] };
                waiting.extend([(with(second), times), (with(first), times)]);
            } else if step == 2 {
                reader.require(to - from > 1, "a time is too short to be split")?;
                waiting.extend([(parts, [middle, to]), (parts, [from, middle])]);
            } else {
                if kept.len() * links.all.len() > MAX_KEPT {
                    kept.clear();
                }
                // The stretch, and the ways from and to two bodies.
                work.set(work.get() + 3 * links.all.len() as u64);
                verifiable(work.get() <= MAX_WORK, "the check takes too long")?;
                let stretch = kept.entry(times).or_insert_with(|| links.stretch(middle, to - middle));
                let is_apart = match step {
                    3..=5 => {
                        let plane = reader.all(|reader| reader.signed(7))?;
                        let keeps =
                            |part, plane| stretch.keeps_above(part, (plane, [0, a.link, b.link][step - 3]), margin / 2 + 1);
                        keeps(a, plane.map(|x| -x)).zip(keeps(b, plane)).map(|(a, b)| a && b)
                    }
                    6 => stretch.keeps_beyond_ball(b, a, margin),
                    7 => stretch.keeps_beyond_ball(a, b, margin),
                    _ => return Err(reader.broken("there is no such step")),
                };
                reader.require(is_apart.unwrap_or(false), "a leaf does not prove that its parts are apart")?;
            }
        }
    }
    reader.end()
}

/// Reads what is stated, and checks the witness. Returns links, pairs, and until when these stay apart, in multiples of 2⁻⁶⁰ of the
/// unit of time.
fn read_claim<'b>(reader: &mut Reader<'_>, meshes: &'b [Body], work: &'b Cell<u64>) -> Checked<(Links, Vec<Pair<'b>>, i64)> {
    let units @ [length, time] = reader.all(|reader| reader.signed(4))?;
    let [link_count, body_count, pair_count] = reader.all(|reader| reader.unsigned(4))?;
    let links = Links::read(reader, link_count, units)?;
    let (mut bodies, mut pairs) = (Vec::new(), Vec::new());
    for _ in 0..body_count {
        let digest = reader.take(32)?;
        let mesh = meshes.iter().find(|mesh| mesh.digest == digest && mesh.unit == length);
        let mesh = mesh.ok_or(reader.broken("a mesh is none of those that are given, in this unit"))?;
        bodies.push(Part { body: mesh, node: &mesh.nodes[0], link: reader.index(links.all.len())?, work });
    }
    for _ in 0..pair_count {
        let pair: [usize; 2] = reader.all(|reader| reader.index(bodies.len()))?;
        pairs.push((pair.map(|body| bodies[body]), reader.size(length, [LENGTH, 0])?));
    }
    let until = reader.size(time, [0, FRACTION])?;
    for _ in 0..reader.index(2)? {
        check_witness(reader, units, &links, &pairs)?;
    }
    Ok((links, pairs, until))
}

/// Reads the claim that two points of a pair are near each other at a time, and checks it.
fn check_witness(reader: &mut Reader<'_>, [unit, time]: [i64; 2], links: &Links, pairs: &[Pair<'_>]) -> Checked<()> {
    let (bodies, margin) = pairs[reader.index(pairs.len())?];
    // The time may be rounded up by one: what moves then is less than what is lost.
    let placed = links.stretch(reader.size(time, [0, FRACTION])?, 0).placed;
    // Margin, radii and tolerance are rounded up: by at most 1 each.
    let (mut apart, mut limit) = (ZERO, margin + reader.size(unit, [LENGTH, 0])? - 4);
    for Part { body, link, .. } in bodies {
        let corners = body.triangles[reader.index(body.triangles.len())?];
        let weights = reader.all(|reader| Ok(reader.unsigned(7)? as i64))?;
        reader.require(weights.iter().sum::<i64>() == 1 << WEIGHT, "the weights of a witness do not add up to 1")?;
        let [x, y, z, radius] = [0, 1, 2, 3].map(|k| (dot(weights, corners.map(|corner| corner[k])) >> WEIGHT) as i64);
        let arm = sub([x, y, z], links.all[link].centre);
        apart = sub(add(placed[link].place, turned(placed[link].rotation, arm)), apart);
        limit += radius - 3 * links.loss(length(arm)) as i64;
    }
    reader.require(limit >= 0 && dot(apart, apart) <= product(limit, limit), "the witnesses are too far from each other")
}

#[cfg(test)]
mod tests {
    use super::*;

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

    /// A proof without steps, of two triangles on two links of a chain, that they are apart until 1. Each link rests at a height above
    /// the one before.
    fn proof(heights: &[f64], triangles: ([u32; 2], &Body)) -> Vec<u8> {
        let rest: Vec<[f64; 9]> = heights.iter().map(|&height| [height, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]).collect();
        proof_of_moving(&rest, triangles)
    }

    /// Such a proof about links of which the height is given, and v, a, α and β.
    fn proof_of_moving(chain: &[[f64; 9]], triangles: ([u32; 2], &Body)) -> Vec<u8> {
        let mut proof = b"CCDPROF1".to_vec();
        proof.extend([0, 0, chain.len() as u32, 2, 1].map(u32::to_le_bytes).concat());
        for (parent, [height, moves @ ..]) in (0u32..).zip(chain) {
            proof.extend(parent.to_le_bytes());
            proof.extend(numbers(&[0.0, 0.0, *height, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0]));
            proof.extend([0; 4]);
            proof.extend(numbers(moves));
        }
        for link in triangles.0 {
            proof.extend(triangles.1.digest);
            proof.extend(link.to_le_bytes());
        }
        proof.extend([0u32, 1].map(u32::to_le_bytes).concat());
        proof.extend(numbers(&[0.0, 1.0]));
        proof.extend([0; 4]);
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
        let far = (1u64 << LENGTH) as f64;
        let verdict = |count: usize| {
            let mut proof = proof(&alloc::vec![far; count], ([0, count as u32], &body));
            proof.extend(leaf(1 << 54));
            check(core::slice::from_ref(&body), &proof)
        };
        assert_eq!(verdict(63), Ok(()));
        assert_eq!(verdict(64), Err(Stop::Unverifiable("links turn or reach too far in all")));
    }

    /// A link that reaches so far that the sum of its lengths has more bits than a number: one that wraps around would leave nothing
    /// to be lost, and two triangles at one place would be apart.
    #[test]
    fn lengths_beyond_all_numbers_are_unverifiable() {
        let body = triangle();
        let far = (1u64 << LENGTH) as f64;
        for [start, rate] in [[256.0, 256.0], [256.0, -256.0], [-256.0, 0.0], [0.0, 256.0]] {
            let strange = [0.0, far, far, far, 0.0, 0.0, 0.0, start, rate];
            for links in [[0, 0], [1, 1], [0, 1]] {
                let mut proof = proof_of_moving(&[strange], (links, &body));
                proof.extend(leaf(0));
                let verdict = check(core::slice::from_ref(&body), &proof);
                assert_eq!(verdict, Err(Stop::Unverifiable("links turn or reach too far in all")));
            }
        }
    }

    /// Two triangles far apart on a long chain, over ever shorter stretches, so that not all links are kept.
    #[test]
    fn what_is_not_kept_is_placed_again() {
        let body = triangle();
        let mut chain = alloc::vec![0.0; 1 << 15];
        chain[0] = 67_108_864.0;
        let mut proof = proof(&chain, ([0, 1], &body));
        // Another pair of the same bodies asks for the same stretches.
        let pairs = proof.len() - 4 - 16 - 8;
        proof.splice(pairs..pairs, proof[pairs..pairs + 16].to_vec());
        proof[16 + 8..16 + 12].copy_from_slice(&2u32.to_le_bytes());
        let splits = 40;
        assert!(splits * chain.len() > MAX_KEPT);
        for _ in 0..2 {
            for _ in 0..splits {
                proof.push(2);
                proof.extend(leaf(1 << 25));
            }
            proof.extend(leaf(1 << 25));
        }
        assert_eq!(check(core::slice::from_ref(&body), &proof), Ok(()));
    }

    /// Leaves of many pairs on a long chain, as many as a check looks at and one more: a longer file would take hours.
    #[test]
    fn a_check_has_an_end() {
        let body = triangle();
        let mut chain = alloc::vec![0.0; 1 << 15];
        chain[0] = 67_108_864.0;
        let proof = proof(&chain, ([0, 1], &body));
        let (before, rest) = proof.split_at(proof.len() - 4 - 8 - 16);
        let (pair, end) = rest.split_at(16);
        let verdict = |count: usize| {
            let leaves = leaf(1 << 25).repeat(count);
            let mut proof = [before, &pair.repeat(count), end, &leaves].concat();
            proof[24..28].copy_from_slice(&(count as u32).to_le_bytes());
            check(core::slice::from_ref(&body), &proof)
        };
        // Of each leaf three times all links, and both triangles, each at both ends or once.
        let most = MAX_WORK as usize / (3 * (chain.len() + 1) + 4);
        assert_eq!(verdict(most), Ok(()));
        assert_eq!(verdict(most + 10), Err(Stop::Unverifiable("the check takes too long")));
    }
}
