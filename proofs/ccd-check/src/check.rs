//! Checks a certificate: its leaves prove pairs of nodes apart, and cover all pairs of triangles at all times.

use crate::{Body, Checked, Stop, body::Node, motion::Links, number::*, reader::Reader, verifiable};
use alloc::{collections::BTreeMap, vec::Vec};
use core::cell::Cell;

/// The maximum number of link states in the cache, which take about 200 MB. A full cache is emptied.
const MAX_CACHED_STATES: usize = 1 << 19;

/// The maximum number of visits to links and nodes in one check.
const MAX_VISITS: u64 = 1 << 32;

/// The number of bits of a barycentric weight after the binary point.
const WEIGHT_BITS: u32 = 55;

/// The root nodes of both bodies, and the margin.
type Pair<'b> = ([Node<'b>; 2], i64);

/// The links, the pairs, and the time until which the pairs stay apart, in multiples of 2⁻⁶⁰ of the unit of time.
type Statement<'b> = (Links, Vec<Pair<'b>>, i64);

/// Checks that a certificate proves the statement that it contains. The caller has to compare that statement with the expected one.
///
/// The time for a leaf grows with the number of links and visited nodes. To bound the time for a hostile file, a check that visits more
/// than 2³² links and nodes stops as unverifiable.
///
/// # Errors
/// [`Stop`] if the certificate does not prove its statement, or if a number is outside the range of the checker.
pub fn check(meshes: &[Body], certificate: &[u8]) -> Result<(), Stop> {
    let mut reader = Reader::new(b"CCDPROF1", certificate)?;
    let (visits, mut cache) = (Cell::new(0), BTreeMap::new());
    let (links, pairs, until) = read_statement(&mut reader, meshes, &visits)?;
    for (bodies, margin) in pairs {
        // The entries that are not proven yet. The first one is both root nodes over the whole time. A step splits or proves the last.
        let mut stack = alloc::vec![(bodies, [0, until])];
        while let Some((nodes @ [a, b], times @ [from, to])) = stack.pop() {
            let (middle, step) = (from + (to - from) / 2, reader.unsigned(1)? as usize);
            if step < 2 {
                let [first, second] = nodes[step].children().ok_or(reader.broken("a triangle is split"))?;
                let with_child = |child| if step == 0 { [child, b] } else { [a, child] };
                stack.extend([(with_child(second), times), (with_child(first), times)]);
            } else if step == 2 {
                reader.require(to - from > 1, "an interval of time is too short to be split")?;
                stack.extend([(nodes, [middle, to]), (nodes, [from, middle])]);
            } else {
                if cache.len() * links.all.len() > MAX_CACHED_STATES {
                    cache.clear();
                }
                // A leaf visits all links up to three times: once for their states, and once for the motion of each body.
                visits.set(visits.get() + 3 * links.all.len() as u64);
                verifiable(visits.get() <= MAX_VISITS, "the check visits too many links and nodes")?;
                let interval = cache.entry(times).or_insert_with(|| links.over_interval(middle, to - middle));
                let is_apart = match step {
                    3..=5 => {
                        let (plane, frame) = (reader.array(|reader| reader.signed(7))?, [0, a.link, b.link][step - 3]);
                        let is_above = |node, plane| interval.stays_above_plane(node, (plane, frame), margin / 2 + 1);
                        is_above(a, plane.map(|x| -x)).zip(is_above(b, plane)).map(|(a, b)| a && b)
                    }
                    6 => interval.stays_beyond_ball(b, a, margin),
                    7 => interval.stays_beyond_ball(a, b, margin),
                    _ => return Err(reader.broken("there is no such step")),
                };
                reader.require(is_apart.unwrap_or(false), "a leaf does not prove its nodes apart")?;
            }
        }
    }
    reader.end()
}

/// Reads a statement, and checks its witness.
fn read_statement<'b>(reader: &mut Reader<'_>, meshes: &'b [Body], visits: &'b Cell<u64>) -> Checked<Statement<'b>> {
    let units @ [length, time] = reader.array(|reader| reader.signed(4))?;
    let [link_count, body_count, pair_count] = reader.array(|reader| reader.unsigned(4))?;
    let links = Links::read(reader, link_count, units)?;
    let (mut bodies, mut pairs) = (Vec::new(), Vec::new());
    for _ in 0..body_count {
        let digest = reader.take(32)?;
        let mesh = meshes.iter().find(|mesh| mesh.mesh_digest == digest && mesh.unit == length);
        let mesh = mesh.ok_or(reader.broken("a mesh of the statement is missing, or was read in another unit"))?;
        bodies.push(Node { body: mesh, data: &mesh.nodes[0], link: reader.index(links.all.len())?, visits });
    }
    for _ in 0..pair_count {
        let pair: [usize; 2] = reader.array(|reader| reader.index(bodies.len()))?;
        pairs.push((pair.map(|body| bodies[body]), reader.magnitude(length, [LENGTH_BITS, 0])?));
    }
    let until = reader.magnitude(time, [0, FRACTION_BITS])?;
    for _ in 0..reader.index(2)? {
        check_witness(reader, units, &links, &pairs)?;
    }
    Ok((links, pairs, until))
}

/// Reads a witness, and checks that the distance of its two points is at most the margin plus the tolerance.
fn check_witness(reader: &mut Reader<'_>, [unit, time]: [i64; 2], links: &Links, pairs: &[Pair<'_>]) -> Checked<()> {
    let (bodies, margin) = pairs[reader.index(pairs.len())?];
    // The time is rounded up by at most 1. The error bound covers the motion during this rounding.
    let states = links.over_interval(reader.magnitude(time, [0, FRACTION_BITS])?, 0).states;
    // The margin, both radii and the tolerance are rounded up by at most 1 each.
    let (mut offset, mut limit) = (ZERO, margin + reader.magnitude(unit, [LENGTH_BITS, 0])? - 4);
    for Node { body, link, .. } in bodies {
        let corners = body.triangles[reader.index(body.triangles.len())?];
        let weights = reader.array(|reader| Ok(reader.unsigned(7)? as i64))?;
        reader.require(weights.iter().sum::<i64>() == 1 << WEIGHT_BITS, "the weights of a witness do not add up to 1")?;
        let [x, y, z, radius] = [0, 1, 2, 3].map(|k| (dot(weights, corners.map(|corner| corner[k])) >> WEIGHT_BITS) as i64);
        let from_center = sub([x, y, z], links.all[link].center);
        offset = sub(add(states[link].position, rotated(states[link].rotation, from_center)), offset);
        limit += radius - 3 * links.error_bound(length_bound(from_center)) as i64;
    }
    reader.require(limit >= 0 && dot(offset, offset) <= product(limit, limit), "the points of the witness are too far apart")
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns a body of one triangle.
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

    /// Returns a certificate without steps, with the statement that two triangles stay apart until time 1. Both are on links of a chain.
    /// Each link is fixed at a height above the previous link.
    fn proof(heights: &[f64], triangles: ([u32; 2], &Body)) -> Vec<u8> {
        let fixed: Vec<[f64; 9]> = heights.iter().map(|&height| [height, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]).collect();
        proof_of_moving(&fixed, triangles)
    }

    /// Returns a certificate without steps for moving links. A link is given as its height, v, a, α and β.
    fn proof_of_moving(chain: &[[f64; 9]], triangles: ([u32; 2], &Body)) -> Vec<u8> {
        let mut proof = b"CCDPROF1".to_vec();
        proof.extend([0, 0, chain.len() as u32, 2, 1].map(u32::to_le_bytes).concat());
        for (parent, [height, motion @ ..]) in (0u32..).zip(chain) {
            proof.extend(parent.to_le_bytes());
            proof.extend(numbers(&[0.0, 0.0, *height, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0]));
            proof.extend([0; 4]);
            proof.extend(numbers(motion));
        }
        for link in triangles.0 {
            proof.extend(triangles.1.mesh_digest);
            proof.extend(link.to_le_bytes());
        }
        proof.extend([0u32, 1].map(u32::to_le_bytes).concat());
        proof.extend(numbers(&[0.0, 1.0]));
        proof.extend([0; 4]);
        proof
    }

    /// Returns a leaf with the plane at a height along z.
    fn leaf(height: i64) -> Vec<u8> {
        let numbers = [0, 0, 1 << 50, height].map(|x: i64| x.to_le_bytes());
        [&[3], numbers.map(|bytes| [0, 1, 2, 3, 4, 5, 6].map(|k| bytes[k])).as_flattened()].concat()
    }

    /// Tests the longest chain of links with the largest offsets, and a chain with one more link.
    #[test]
    fn chains_that_are_too_long_are_unverifiable() {
        let body = triangle();
        let max_length = (1u64 << LENGTH_BITS) as f64;
        let verdict = |count: usize| {
            let mut proof = proof(&alloc::vec![max_length; count], ([0, count as u32], &body));
            proof.extend(leaf(1 << 54));
            check(core::slice::from_ref(&body), &proof)
        };
        assert_eq!(verdict(63), Ok(()));
        assert_eq!(verdict(64), Err(Stop::Unverifiable("the link angles or link offsets are too large")));
    }

    /// Tests a link for which S overflows 64 bits. With a sum that wraps around, the error bound would be small, and the checker would
    /// accept that two triangles at the same position are apart.
    #[test]
    fn sums_of_lengths_that_overflow_are_unverifiable() {
        let body = triangle();
        let max_length = (1u64 << LENGTH_BITS) as f64;
        for [start, rate] in [[256.0, 256.0], [256.0, -256.0], [-256.0, 0.0], [0.0, 256.0]] {
            let long_link = [0.0, max_length, max_length, max_length, 0.0, 0.0, 0.0, start, rate];
            for links in [[0, 0], [1, 1], [0, 1]] {
                let mut proof = proof_of_moving(&[long_link], (links, &body));
                proof.extend(leaf(0));
                let verdict = check(core::slice::from_ref(&body), &proof);
                assert_eq!(verdict, Err(Stop::Unverifiable("the link angles or link offsets are too large")));
            }
        }
    }

    /// Tests two triangles on a long chain. The number of intervals is so large that the cache is emptied.
    #[test]
    fn states_are_recomputed_after_the_cache_is_emptied() {
        let body = triangle();
        let mut chain = alloc::vec![0.0; 1 << 15];
        chain[0] = 67_108_864.0;
        let mut proof = proof(&chain, ([0, 1], &body));
        // A second pair of the same bodies has the same intervals.
        let pairs = proof.len() - 4 - 16 - 8;
        proof.splice(pairs..pairs, proof[pairs..pairs + 16].to_vec());
        proof[16 + 8..16 + 12].copy_from_slice(&2u32.to_le_bytes());
        let splits = 40;
        assert!(splits * chain.len() > MAX_CACHED_STATES);
        for _ in 0..2 {
            for _ in 0..splits {
                proof.push(2);
                proof.extend(leaf(1 << 25));
            }
            proof.extend(leaf(1 << 25));
        }
        assert_eq!(check(core::slice::from_ref(&body), &proof), Ok(()));
    }

    /// Tests that a check stops after the maximum number of visits. Otherwise a longer file would take hours.
    #[test]
    fn the_visits_of_a_check_are_bounded() {
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
        // A leaf visits all links three times, and each of the two triangles for one or two ends of the interval.
        let max_leaves = MAX_VISITS as usize / (3 * (chain.len() + 1) + 4);
        assert_eq!(verdict(max_leaves), Ok(()));
        assert_eq!(verdict(max_leaves + 10), Err(Stop::Unverifiable("the check visits too many links and nodes")));
    }
}
