//! A mesh of rounded triangles, and a tree of bounding boxes over them.
//!
//! The certificate of a body only gives the tree. The checker computes all bounding boxes itself.

use crate::{Checked, Stop, number::*, reader::Reader, sha256, verifiable};
use alloc::vec::Vec;

/// The coordinates of a vertex, and the radius of the ball around it.
type Corner = [i64; 4];

type Triangle = [Corner; 3];

/// The maximum number of splits between the root of a tree and any part.
const MAX_DEPTH: usize = 100;

/// A mesh with its tree, in integer coordinates.
#[derive(Clone, Debug)]
pub struct Body {
    pub(crate) digest: [u8; 32],
    pub(crate) unit: i64,
    /// The triangles in the order of the tree. Each coordinate has an error of less than 1.
    pub(crate) triangles: Vec<Triangle>,
    /// The nodes in preorder: each before all nodes of its first part, and these before all nodes of its second part.
    pub(crate) nodes: Vec<Node>,
}

#[derive(Clone, Debug)]
pub(crate) struct Node {
    /// The index of its first triangle.
    triangle: usize,
    /// The indices of the nodes of both of its parts. `None` for a single triangle.
    parts: Option<[usize; 2]>,
    /// The least and the greatest x, y, z and radius of all corners.
    ranges: [[i64; 2]; 4],
    /// The bounding ball of the part: its center, which is the middle of the ranges, and its radius.
    pub(crate) ball: (Vector, i64),
}

/// A part of a body, and the index of the link that carries it.
#[derive(Clone, Copy)]
pub(crate) struct Part<'a> {
    pub(crate) body: &'a Body,
    pub(crate) node: &'a Node,
    pub(crate) link: usize,
    /// The number of links and parts that the check has visited so far.
    pub(crate) work: &'a core::cell::Cell<u64>,
}

impl Body {
    /// Reads a mesh and the certificate of its tree, in the unit of length of a proof.
    ///
    /// # Errors
    /// [`Stop`] if a file is broken, or if a number is outside the range of the checker.
    pub fn new(mesh: &[u8], certificate: &[u8], proof: &[u8]) -> Result<Body, Stop> {
        let unit = Reader::new(b"CCDPROF1", proof)?.signed(4)?;
        let (mut unused, mut triangles, mut nodes) = (read_mesh(mesh, unit)?, Vec::new(), Vec::new());
        let (digest, mut reader) = (sha256(mesh), Reader::new(b"CCDBODY1", certificate)?);
        let is_of_mesh = reader.take(32)? == digest;
        reader.require(is_of_mesh, "the certificate belongs to another mesh")?;
        // The number of triangles, and the depth, of each part that is not read yet.
        let mut stack = alloc::vec![(unused.len(), 0)];
        while let Some((count, depth)) = stack.pop() {
            let (from, node, mut parts) = (triangles.len(), nodes.len(), None);
            if count > 1 {
                let first = reader.index(count)?;
                reader.require(first > 0, "a part is empty")?;
                verifiable(depth < MAX_DEPTH, "a tree is too deep")?;
                stack.extend([(count - first, depth + 1), (first, depth + 1)]);
                // A part of n triangles has 2 n − 1 nodes.
                parts = Some([node + 1, node + 2 * first]);
            } else {
                let index = reader.index(unused.len())?;
                triangles.push(unused[index].take().ok_or(reader.broken("a tree contains a triangle twice"))?);
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
    /// Returns the first and the second part of this part. Returns `None` for a single triangle.
    pub(crate) fn halves(self) -> Option<[Part<'a>; 2]> {
        Some(self.node.parts?.map(|node| Part { node: &self.body.nodes[node], ..self }))
    }

    /// Checks that the bounding boxes of the part are all farther than `limit` from `point`.
    pub(crate) fn is_beyond(self, point: Vector, limit: i64) -> bool {
        self.satisfies(&|node| {
            let [x, y, z, [_, radius]] = node.ranges;
            let distance = [0, 1, 2].map(|k| ([x, y, z][k][0] - point[k]).max(point[k] - [x, y, z][k][1]).max(0));
            dot(distance, distance) > product(limit + radius, limit + radius)
        })
    }

    /// Checks that the part has a height of at least `limit` along `direction`. A ball reaches at most its radius below its center,
    /// as the normal of the plane is at most 1 long.
    pub(crate) fn is_above(self, direction: Vector, limit: i128) -> bool {
        let [i, j, k] = direction.map(|x| usize::from(x < 0));
        let is_high = |&[x, y, z, radius]: &Corner| dot(direction, [x, y, z]) - product(ONE, radius) >= limit;
        self.satisfies(&|Node { triangle, parts, ranges: [x, y, z, radius], .. }| {
            is_high(&[x[i], y[j], z[k], radius[1]]) || parts.is_none() && self.body.triangles[*triangle].iter().all(is_high)
        })
    }

    /// Checks a condition for the part as a whole, and where that fails for both of its parts in turn.
    fn satisfies(self, holds: &impl Fn(&Node) -> bool) -> bool {
        self.work.set(self.work.get() + 1);
        holds(self.node) || self.halves().is_some_and(|[first, second]| first.satisfies(holds) && second.satisfies(holds))
    }
}

/// Reads the triangles of a mesh.
fn read_mesh(mesh: &[u8], unit: i64) -> Checked<Vec<Option<Triangle>>> {
    let (mut reader, mut vertices, mut triangles) = (Reader::new(b"", mesh)?, Vec::new(), Vec::new());
    let [vertex_count, triangle_count] = reader.array(|reader| reader.unsigned(4))?;
    for _ in 0..vertex_count {
        let [x, y, z] = reader.array(|reader| reader.number(unit, [LENGTH, 0]))?;
        vertices.push([x, y, z, reader.magnitude(unit, [LENGTH, 0])?]);
    }
    for _ in 0..triangle_count {
        let [a, b, c] = reader.array(|reader| reader.index(vertices.len()))?;
        triangles.push(Some([vertices[a], vertices[b], vertices[c]]));
    }
    reader.end()?;
    Ok(triangles)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The first bytes of a proof with the unit of length 1.
    const UNIT: &[u8] = b"CCDPROF1\0\0\0\0";

    /// A generator of random numbers.
    struct Random(u64);

    impl Random {
        /// Returns a number from −n/2 to n/2.
        fn centered(&mut self, n: i64) -> i64 {
            self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (self.0 >> 40) as i64 % n - n / 2
        }
    }

    /// Returns the bytes of a mesh of triangles that share no vertex.
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

    /// Writes a random tree of triangles.
    fn write_part(random: &mut Random, order: &[u32], parts: &mut Vec<u32>) {
        if let [number] = *order {
            return parts.push(number);
        }
        let first = 1 + random.centered(100).unsigned_abs() as usize % (order.len() - 1);
        parts.push(first as u32);
        write_part(random, &order[..first], parts);
        write_part(random, &order[first..], parts);
    }

    /// Compares the checks of heights, distances and bounding balls with all corners, for all parts of bodies of 1 to 12 triangles.
    #[test]
    fn heights_and_distances_agree_with_the_corners() {
        let mut random = Random(1);
        let one = i128::from(ONE);
        let ([mut above, mut below], mut beyond) = ([0, 0], 0);
        for count in 1..=12 {
            let corner = |random: &mut Random| {
                [random.centered(1000), random.centered(30), random.centered(7), random.centered(9).abs()]
            };
            let triangles: Vec<Triangle> = (0..count).map(|_| [(); 3].map(|()| corner(&mut random))).collect();
            let (mesh, mut parts) = (mesh(&triangles), Vec::new());
            let order: Vec<u32> = (0..count).rev().collect();
            write_part(&mut random, &order, &mut parts);
            let body = Body::new(&mesh, &certificate(&mesh, &parts), UNIT).unwrap();
            let work = &core::cell::Cell::new(0);
            let mut waiting = alloc::vec![(Part { body: &body, node: &body.nodes[0], link: 0, work }, 0, count as usize)];
            while let Some((part, from, to)) = waiting.pop() {
                let corners = body.triangles[from..to].as_flattened();
                let direction = [(); 3].map(|()| random.centered(8) << FRACTION);
                let point = [random.centered(2000), 3, 5];
                let height = |[x, y, z, radius]: &Corner| dot(direction, [*x, *y, *z]) - one * i128::from(*radius);
                let height = corners.iter().map(height).min().unwrap();
                for limit in [i128::MIN, height - 1, height, height + 1, one * i128::from(random.centered(100_000))] {
                    let is_above = part.is_above(direction, limit);
                    assert_eq!(is_above, height >= limit);
                    if is_above { above += 1 } else { below += 1 }
                }
                let square = |v: Vector| dot(v, v);
                let (middle, ball) = part.node.ball;
                for &[x, y, z, radius] in corners {
                    let distance = ball - radius;
                    assert!(distance >= 0 && product(distance, distance) >= square(sub([x, y, z], middle)));
                }
                for limit in [0, 10, 300, 1000] {
                    // Compares with convex combinations of the corners of each triangle, in sixths.
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

    /// Tests lists of numbers that are not a tree over all triangles.
    #[test]
    fn trees_that_omit_a_triangle_are_broken() {
        let triangles = [0, 1, 2].map(|x| [[x, 0, 0, 0], [x, 1, 0, 0], [x, 0, 1, 0]]);
        let mesh = mesh(&triangles);
        let verdict = |parts: &[u32]| Body::new(&mesh, &certificate(&mesh, parts), UNIT).map(|body| body.triangles.len());
        assert_eq!(verdict(&[1, 2, 1, 0, 1]), Ok(3));
        let reason = |parts: &[u32]| match verdict(parts) {
            Err(Stop::Broken(reason, _)) => reason,
            other => panic!("{other:?}"),
        };
        assert_eq!(reason(&[1, 2, 1, 0, 2]), "a tree contains a triangle twice");
        assert_eq!(reason(&[1, 2, 1, 0, 3]), "an index is out of range");
        assert_eq!(reason(&[0, 2, 1, 0, 1]), "a part is empty");
        assert_eq!(reason(&[3, 2, 1, 0, 1]), "an index is out of range");
        assert_eq!(reason(&[1, 2, 1, 0]), "the file ends too early");
        assert_eq!(reason(&[1, 2, 1, 0, 1, 0]), "the file has bytes after its end");
    }

    /// Tests a tree in which each first part is a single triangle.
    #[test]
    fn the_depth_of_a_tree_is_bounded() {
        let verdict = |count: u32| {
            let mesh = mesh(&alloc::vec![[[0; 4]; 3]; count as usize]);
            let parts: Vec<u32> = (0..count - 1).flat_map(|number| [1, number]).chain([count - 1]).collect();
            Body::new(&mesh, &certificate(&mesh, &parts), UNIT).map(|body| body.triangles.len())
        };
        assert_eq!(verdict(101), Ok(101));
        assert_eq!(verdict(102), Err(Stop::Unverifiable("a tree is too deep")));
    }
}
