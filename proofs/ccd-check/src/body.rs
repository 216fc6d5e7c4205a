//! A mesh of rounded triangles, and a tree over them.
//!
//! The certificate of a body says only what is in each part of the tree. How large parts are is measured here.

use crate::{Checked, Stop, number::*, reader::Reader, sha256, verifiable};
use alloc::vec::Vec;

/// A point, and the radius of the ball around it.
type Corner = [i64; 4];

type Triangle = [Corner; 3];

/// No part is more than so many splits deep.
const MAX_DEPTH: usize = 100;

/// A mesh with its tree, in integer coordinates.
#[derive(Clone, Debug)]
pub struct Body {
    pub(crate) digest: [u8; 32],
    pub(crate) unit: i64,
    /// The corners of each triangle in the order of the tree. Each is off by less than 1 in each coordinate.
    pub(crate) triangles: Vec<Triangle>,
    /// Each before the nodes of its first part, and these before those of the second one.
    pub(crate) nodes: Vec<Node>,
}

#[derive(Clone, Debug)]
pub(crate) struct Node {
    /// The number of its first triangle, and the nodes of both of its parts, if it has more than one triangle.
    triangle: usize,
    parts: Option<[usize; 2]>,
    /// The least and the greatest of each coordinate, and of the radii.
    ranges: [[i64; 2]; 4],
    /// The middle of the ranges, and the radius of a ball around it that has all in it.
    pub(crate) ball: (Vector, i64),
}

/// A part of a body, and the number of the link that carries it.
#[derive(Clone, Copy)]
pub(crate) struct Part<'a> {
    pub(crate) body: &'a Body,
    pub(crate) node: &'a Node,
    pub(crate) link: usize,
    /// How much the check has looked at so far.
    pub(crate) work: &'a core::cell::Cell<u64>,
}

impl Body {
    /// Reads a mesh and the certificate of its tree, in the unit of a proof.
    ///
    /// # Errors
    /// The verdict, if the certificate is broken or numbers are out of range.
    pub fn new(mesh: &[u8], certificate: &[u8], proof: &[u8]) -> Result<Body, Stop> {
        let unit = Reader::new(b"CCDPROF1", proof)?.signed(4)?;
        let (mut all, mut triangles, mut nodes) = (read_mesh(mesh, unit)?, Vec::new(), Vec::new());
        let (digest, mut reader) = (sha256(mesh), Reader::new(b"CCDBODY1", certificate)?);
        let is_of_mesh = reader.take(32)? == digest;
        reader.require(is_of_mesh, "this is the certificate of another mesh")?;
        // How many triangles the parts have that are read next, and how deep these are.
        let mut waiting = alloc::vec![(all.len(), 0)];
        while let Some((count, depth)) = waiting.pop() {
            let (from, node, mut parts) = (triangles.len(), nodes.len(), None);
            if count > 1 {
                let first = reader.index(count)?;
                reader.require(first > 0, "a part is empty")?;
                verifiable(depth < MAX_DEPTH, "a tree is too deep")?;
                waiting.extend([(count - first, depth + 1), (first, depth + 1)]);
                // A part of n triangles has 2 n − 1 nodes.
                parts = Some([node + 1, node + 2 * first]);
            } else {
                let number = reader.index(all.len())?;
                triangles.push(all[number].take().ok_or(reader.broken("a tree has a triangle twice"))?);
            }
            nodes.push((from..from + count, parts));
        }
        reader.end()?;
        let nodes = nodes.into_iter().map(|(range, parts)| Node::new(range.start, parts, &triangles[range])).collect();
        Ok(Body { digest, unit, triangles, nodes })
    }
}

impl Node {
    fn new(triangle: usize, parts: Option<[usize; 2]>, triangles: &[Triangle]) -> Node {
        let corners = triangles.as_flattened().iter();
        let range = |k| corners.clone().fold([i64::MAX, i64::MIN], |[least, most], c| [least.min(c[k]), most.max(c[k])]);
        let ranges @ [x, y, z, radius] = [0, 1, 2, 3].map(range);
        let middle = [x, y, z].map(|[least, most]| (least + most) >> 1);
        let squares = corners.clone().map(|&[x, y, z, _]| sub([x, y, z], middle)).map(|v| dot(v, v));
        Node { triangle, parts, ranges, ball: (middle, squares.max().unwrap_or(0).isqrt() as i64 + 1 + radius[1]) }
    }
}

impl<'a> Part<'a> {
    /// Returns both parts of a part; `None` if it is a triangle.
    pub(crate) fn halves(self) -> Option<[Part<'a>; 2]> {
        Some(self.node.parts?.map(|node| Part { node: &self.body.nodes[node], ..self }))
    }

    /// Returns whether all points of the part are farther than a limit from a point.
    pub(crate) fn is_beyond(self, point: Vector, limit: i64) -> bool {
        self.all(&|node| {
            let [x, y, z, [_, radius]] = node.ranges;
            let away = [0, 1, 2].map(|k| ([x, y, z][k][0] - point[k]).max(point[k] - [x, y, z][k][1]).max(0));
            dot(away, away) > product(limit + radius, limit + radius)
        })
    }

    /// Returns whether no point of the part is lower along a direction than a limit. A ball sinks below its centre by its radius, as
    /// the plane's normal is no longer than 1.
    pub(crate) fn is_above(self, direction: Vector, limit: i128) -> bool {
        let [i, j, k] = direction.map(|x| usize::from(x < 0));
        let is_high = |&[x, y, z, radius]: &Corner| dot(direction, [x, y, z]) - product(ONE, radius) >= limit;
        self.all(&|Node { triangle, parts, ranges: [x, y, z, radius], .. }| {
            is_high(&[x[i], y[j], z[k], radius[1]]) || parts.is_none() && self.body.triangles[*triangle].iter().all(is_high)
        })
    }

    /// Returns whether something is so of the part, or of all parts that it is split into.
    fn all(self, is_so: &impl Fn(&Node) -> bool) -> bool {
        self.work.set(self.work.get() + 1);
        is_so(self.node) || self.halves().is_some_and(|[first, second]| first.all(is_so) && second.all(is_so))
    }
}

/// Reads a mesh: the numbers of vertices and triangles, the vertices with their radii, and the corners.
fn read_mesh(mesh: &[u8], unit: i64) -> Checked<Vec<Option<Triangle>>> {
    let (mut reader, mut vertices, mut triangles) = (Reader::new(b"", mesh)?, Vec::new(), Vec::new());
    let [vertex_count, triangle_count] = reader.all(|reader| reader.unsigned(4))?;
    for _ in 0..vertex_count {
        let [x, y, z] = reader.all(|reader| reader.number(unit, [LENGTH, 0]))?;
        vertices.push([x, y, z, reader.size(unit, [LENGTH, 0])?]);
    }
    for _ in 0..triangle_count {
        let [a, b, c] = reader.all(|reader| reader.index(vertices.len()))?;
        triangles.push(Some([vertices[a], vertices[b], vertices[c]]));
    }
    reader.end()?;
    Ok(triangles)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The beginning of a proof whose unit of length is 1.
    const UNIT: &[u8] = b"CCDPROF1\0\0\0\0";

    /// Numbers from −n/2 to n/2.
    struct Random(u64);

    impl Random {
        fn below(&mut self, n: i64) -> i64 {
            self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (self.0 >> 40) as i64 % n - n / 2
        }
    }

    /// A mesh of triangles that share no corner.
    fn mesh(triangles: &[Triangle]) -> Vec<u8> {
        let count = triangles.len() as u32;
        let mut mesh = [3 * count, count].map(u32::to_le_bytes).concat();
        mesh.extend(triangles.as_flattened().as_flattened().iter().flat_map(|&x| (x as f64).to_le_bytes()));
        mesh.extend((0..3 * count).flat_map(u32::to_le_bytes));
        mesh
    }

    fn certificate(mesh: &[u8], parts: &[u32]) -> Vec<u8> {
        let parts: Vec<u8> = parts.iter().flat_map(|x| x.to_le_bytes()).collect();
        [&b"CCDBODY1"[..], &sha256(mesh), &parts].concat()
    }

    /// Writes any tree of triangles.
    fn write_part(random: &mut Random, order: &[u32], parts: &mut Vec<u32>) {
        if let [number] = *order {
            return parts.push(number);
        }
        let first = 1 + random.below(100).unsigned_abs() as usize % (order.len() - 1);
        parts.push(first as u32);
        write_part(random, &order[..first], parts);
        write_part(random, &order[first..], parts);
    }

    /// What is above a limit, what is beyond a distance, and what is in a ball, against all corners, for all parts
    /// of bodies of one to twelve triangles.
    #[test]
    fn heights_and_distances_are_those_of_the_corners() {
        let mut random = Random(1);
        let one = i128::from(ONE);
        let ([mut above, mut below], mut beyond) = ([0, 0], 0);
        for count in 1..=12 {
            let corner = |random: &mut Random| [random.below(1000), random.below(30), random.below(7), random.below(9).abs()];
            let triangles: Vec<Triangle> = (0..count).map(|_| [(); 3].map(|()| corner(&mut random))).collect();
            let (mesh, mut parts) = (mesh(&triangles), Vec::new());
            let order: Vec<u32> = (0..count).rev().collect();
            write_part(&mut random, &order, &mut parts);
            let body = Body::new(&mesh, &certificate(&mesh, &parts), UNIT).unwrap();
            let work = &core::cell::Cell::new(0);
            let mut waiting = alloc::vec![(Part { body: &body, node: &body.nodes[0], link: 0, work }, 0, count as usize)];
            while let Some((part, from, to)) = waiting.pop() {
                let corners = body.triangles[from..to].as_flattened();
                let direction = [(); 3].map(|()| random.below(8) << FRACTION);
                let point = [random.below(2000), 3, 5];
                let height = |[x, y, z, radius]: &Corner| dot(direction, [*x, *y, *z]) - one * i128::from(*radius);
                let height = corners.iter().map(height).min().unwrap();
                for limit in [i128::MIN, height - 1, height, height + 1, one * i128::from(random.below(100_000))] {
                    let is_above = part.is_above(direction, limit);
                    assert_eq!(is_above, height >= limit);
                    if is_above { above += 1 } else { below += 1 }
                }
                let square = |v: Vector| dot(v, v);
                let (middle, ball) = part.node.ball;
                for &[x, y, z, radius] in corners {
                    let room = ball - radius;
                    assert!(room >= 0 && product(room, room) >= square(sub([x, y, z], middle)));
                }
                for limit in [0, 10, 300, 1000] {
                    // Convex combinations of the corners of each triangle, in sixths.
                    let weights = (0..=6).flat_map(|a| (0..=6 - a).map(move |b| [a, b, 6 - a - b]));
                    let is_near = |weights: [i64; 3], [a, b, c]: &Triangle| {
                        let [x, y, z, radius] = [0, 1, 2, 3].map(|k| weights[0] * a[k] + weights[1] * b[k] + weights[2] * c[k]);
                        let farthest = 6 * limit + radius;
                        square(sub([x, y, z], point.map(|x| 6 * x))) <= product(farthest, farthest)
                    };
                    let is_any_near = weights.clone().any(|w| body.triangles[from..to].iter().any(|t| is_near(w, t)));
                    let is_beyond = part.is_beyond(point, limit);
                    assert!(!(is_beyond && is_any_near), "{point:?} {limit}");
                    beyond += usize::from(is_beyond);
                }
                if let Some([first, second]) = part.halves() {
                    let middle = second.node.triangle;
                    waiting.extend([(first, from, middle), (second, middle, to)]);
                }
            }
        }
        assert!(above > 100 && below > 100 && beyond > 100, "{above} above, {below} below, {beyond} beyond");
    }

    /// Trees that are none.
    #[test]
    fn trees_that_leave_out_a_triangle_are_broken() {
        let triangles = [0, 1, 2].map(|x| [[x, 0, 0, 0], [x, 1, 0, 0], [x, 0, 1, 0]]);
        let mesh = mesh(&triangles);
        let verdict = |parts: &[u32]| Body::new(&mesh, &certificate(&mesh, parts), UNIT).map(|body| body.triangles.len());
        assert_eq!(verdict(&[1, 2, 1, 0, 1]), Ok(3));
        let reason = |parts: &[u32]| match verdict(parts) {
            Err(Stop::Broken(reason, _)) => reason,
            other => panic!("{other:?}"),
        };
        assert_eq!(reason(&[1, 2, 1, 0, 2]), "a tree has a triangle twice");
        assert_eq!(reason(&[1, 2, 1, 0, 3]), "there is nothing of this number");
        assert_eq!(reason(&[0, 2, 1, 0, 1]), "a part is empty");
        assert_eq!(reason(&[3, 2, 1, 0, 1]), "there is nothing of this number");
        assert_eq!(reason(&[1, 2, 1, 0]), "the file ends too early");
        assert_eq!(reason(&[1, 2, 1, 0, 1, 0]), "the file goes on after its end");
    }

    /// A tree of which each part has one triangle and the rest.
    #[test]
    fn trees_have_a_largest_depth() {
        let verdict = |count: u32| {
            let mesh = mesh(&alloc::vec![[[0; 4]; 3]; count as usize]);
            let parts: Vec<u32> = (0..count - 1).flat_map(|number| [1, number]).chain([count - 1]).collect();
            Body::new(&mesh, &certificate(&mesh, &parts), UNIT).map(|body| body.triangles.len())
        };
        assert_eq!(verdict(101), Ok(101));
        assert_eq!(verdict(102), Err(Stop::Unverifiable("a tree is too deep")));
    }
}
