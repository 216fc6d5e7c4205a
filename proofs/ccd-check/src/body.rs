//! A mesh of rounded triangles, and a bounding volume hierarchy over them.
//!
//! The certificate of a body only gives the tree. The checker computes all bounding boxes itself.

use crate::{Checked, Stop, number::*, reader::Reader, sha256, verifiable};
use alloc::vec::Vec;

/// The coordinates of a vertex, and the radius of its ball.
type Corner = [i64; 4];

type Triangle = [Corner; 3];

/// The maximum depth of a node. The root has depth 0.
const MAX_DEPTH: usize = 100;

/// A mesh with its bounding volume hierarchy, in integer coordinates.
#[derive(Clone, Debug)]
pub struct Body {
    /// The SHA-256 digest of the bytes of the mesh.
    pub(crate) mesh_digest: [u8; 32],
    /// The exponent of the unit of length, which is a power of two.
    pub(crate) unit: i64,
    /// The triangles in the order of the tree. Each coordinate has an error of less than 1.
    pub(crate) triangles: Vec<Triangle>,
    /// The nodes in preorder: a node, then its first child with all descendants, then its second child with all descendants.
    pub(crate) nodes: Vec<NodeData>,
}

#[derive(Clone, Debug)]
pub(crate) struct NodeData {
    /// The index of its first triangle.
    first_triangle: usize,
    /// The indices of both children. `None` for a single triangle.
    children: Option<[usize; 2]>,
    /// The least and the greatest value of x, y, z and the radius of all corners.
    ranges: [[i64; 2]; 4],
    /// The bounding ball: its center, which is the center of the bounding box, and its radius.
    pub(crate) ball: (Vector, i64),
}

/// A node of a body on a link. It stands for the set of its triangles.
#[derive(Clone, Copy)]
pub(crate) struct Node<'a> {
    pub(crate) body: &'a Body,
    pub(crate) data: &'a NodeData,
    /// The index of the body's link.
    pub(crate) link: usize,
    /// The number of links and nodes that the check has visited so far.
    pub(crate) visits: &'a core::cell::Cell<u64>,
}

impl Body {
    /// Reads a mesh and the certificate of its tree. The unit of length is the unit of `proof`.
    ///
    /// # Errors
    /// [`Stop`] if a file is broken, or if a number is outside the range of the checker.
    pub fn new(mesh: &[u8], certificate: &[u8], proof: &[u8]) -> Result<Body, Stop> {
        let unit = Reader::new(b"CCDPROF1", proof)?.signed(4)?;
        let (mut unused, mut triangles, mut nodes) = (read_mesh(mesh, unit)?, Vec::new(), Vec::new());
        let (mesh_digest, mut reader) = (sha256(mesh), Reader::new(b"CCDBODY1", certificate)?);
        let is_of_mesh = reader.take(32)? == mesh_digest;
        reader.require(is_of_mesh, "the certificate belongs to another mesh")?;
        // For each node that is not read yet: the number of its triangles, and its depth.
        let mut stack = alloc::vec![(unused.len(), 0)];
        while let Some((count, depth)) = stack.pop() {
            let (from, node, mut children) = (triangles.len(), nodes.len(), None);
            if count > 1 {
                let first = reader.index(count)?;
                reader.require(first > 0, "a node has no triangles")?;
                verifiable(depth < MAX_DEPTH, "a tree is too deep")?;
                stack.extend([(count - first, depth + 1), (first, depth + 1)]);
                // A node of n triangles and all nodes below it are 2 n − 1 nodes.
                children = Some([node + 1, node + 2 * first]);
            } else {
                let index = reader.index(unused.len())?;
                triangles.push(unused[index].take().ok_or(reader.broken("a tree contains a triangle twice"))?);
            }
            nodes.push((from..from + count, children));
        }
        reader.end()?;
        let nodes = nodes.into_iter().map(|(range, children)| NodeData::new(range, children, &triangles)).collect();
        Ok(Body { mesh_digest, unit, triangles, nodes })
    }
}

impl NodeData {
    fn new(range: core::ops::Range<usize>, children: Option<[usize; 2]>, triangles: &[Triangle]) -> NodeData {
        let corners = triangles[range.clone()].as_flattened().iter();
        let interval = |k| corners.clone().fold([i64::MAX, i64::MIN], |[least, most], c| [least.min(c[k]), most.max(c[k])]);
        let ranges @ [x, y, z, radius] = [0, 1, 2, 3].map(interval);
        let middle = [x, y, z].map(|[least, most]| (least + most) >> 1);
        let squares = corners.clone().map(|&[x, y, z, _]| sub([x, y, z], middle)).map(|v| dot(v, v));
        let ball_radius = squares.max().unwrap_or(0).isqrt() as i64 + 1 + radius[1];
        NodeData { first_triangle: range.start, children, ranges, ball: (middle, ball_radius) }
    }
}

impl<'a> Node<'a> {
    /// Returns both children. Returns `None` for a single triangle.
    pub(crate) fn children(self) -> Option<[Node<'a>; 2]> {
        Some(self.data.children?.map(|child| Node { data: &self.body.nodes[child], ..self }))
    }

    /// Checks that all triangles are farther than `limit` from `point`. Uses only bounding boxes.
    pub(crate) fn is_beyond(self, point: Vector, limit: i64) -> bool {
        self.satisfies(&|data| {
            let [x, y, z, [_, radius]] = data.ranges;
            let distance = [0, 1, 2].map(|k| ([x, y, z][k][0] - point[k]).max(point[k] - [x, y, z][k][1]).max(0));
            dot(distance, distance) > product(limit + radius, limit + radius)
        })
    }

    /// Checks that the projections of all triangles onto `direction` are at least `limit`. The projection of a ball is bounded below by
    /// its center's projection minus its radius, because the length of a plane's normal is at most 1.
    pub(crate) fn projects_above(self, direction: Vector, limit: i128) -> bool {
        let [i, j, k] = direction.map(|x| usize::from(x < 0));
        let is_above = |&[x, y, z, radius]: &Corner| dot(direction, [x, y, z]) - product(ONE, radius) >= limit;
        self.satisfies(&|NodeData { first_triangle, children, ranges: [x, y, z, radius], .. }| {
            is_above(&[x[i], y[j], z[k], radius[1]])
                || children.is_none() && self.body.triangles[*first_triangle].iter().all(is_above)
        })
    }

    /// Checks that a condition holds for this node, or that both children satisfy it in the same way.
    fn satisfies(self, holds: &impl Fn(&NodeData) -> bool) -> bool {
        self.visits.set(self.visits.get() + 1);
        holds(self.data) || self.children().is_some_and(|[first, second]| first.satisfies(holds) && second.satisfies(holds))
    }
}

/// Reads the triangles of a mesh.
fn read_mesh(mesh: &[u8], unit: i64) -> Checked<Vec<Option<Triangle>>> {
    let (mut reader, mut vertices, mut triangles) = (Reader::new(b"", mesh)?, Vec::new(), Vec::new());
    let [vertex_count, triangle_count] = reader.array(|reader| reader.unsigned(4))?;
    for _ in 0..vertex_count {
        let [x, y, z] = reader.array(|reader| reader.number(unit, [LENGTH_BITS, 0]))?;
        vertices.push([x, y, z, reader.magnitude(unit, [LENGTH_BITS, 0])?]);
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

    fn certificate(mesh: &[u8], numbers: &[u32]) -> Vec<u8> {
        let numbers: Vec<u8> = numbers.iter().flat_map(|x| x.to_le_bytes()).collect();
        [&b"CCDBODY1"[..], &sha256(mesh), &numbers].concat()
    }

    /// Writes the numbers of a random tree, whose triangles are in this order.
    fn write_node(random: &mut Random, order: &[u32], numbers: &mut Vec<u32>) {
        if let [number] = *order {
            return numbers.push(number);
        }
        let first = 1 + random.centered(100).unsigned_abs() as usize % (order.len() - 1);
        numbers.push(first as u32);
        write_node(random, &order[..first], numbers);
        write_node(random, &order[first..], numbers);
    }

    /// Compares the checks of projections, distances and bounding balls with all corners, for all nodes of bodies of 1 to 12 triangles.
    #[test]
    fn projections_and_distances_agree_with_the_corners() {
        let mut random = Random(1);
        let one = i128::from(ONE);
        let ([mut above, mut below], mut beyond) = ([0, 0], 0);
        for count in 1..=12 {
            let corner = |random: &mut Random| {
                [random.centered(1000), random.centered(30), random.centered(7), random.centered(9).abs()]
            };
            let triangles: Vec<Triangle> = (0..count).map(|_| [(); 3].map(|()| corner(&mut random))).collect();
            let (mesh, mut numbers) = (mesh(&triangles), Vec::new());
            let order: Vec<u32> = (0..count).rev().collect();
            write_node(&mut random, &order, &mut numbers);
            let body = Body::new(&mesh, &certificate(&mesh, &numbers), UNIT).unwrap();
            let visits = &core::cell::Cell::new(0);
            let mut stack = alloc::vec![(Node { body: &body, data: &body.nodes[0], link: 0, visits }, 0, count as usize)];
            while let Some((node, from, to)) = stack.pop() {
                let corners = body.triangles[from..to].as_flattened();
                let direction = [(); 3].map(|()| random.centered(8) << FRACTION_BITS);
                let point = [random.centered(2000), 3, 5];
                let projection = |[x, y, z, radius]: &Corner| dot(direction, [*x, *y, *z]) - one * i128::from(*radius);
                let least = corners.iter().map(projection).min().unwrap();
                for limit in [i128::MIN, least - 1, least, least + 1, one * i128::from(random.centered(100_000))] {
                    let is_above = node.projects_above(direction, limit);
                    assert_eq!(is_above, least >= limit);
                    if is_above { above += 1 } else { below += 1 }
                }
                let square = |v: Vector| dot(v, v);
                let (center, ball_radius) = node.data.ball;
                for &[x, y, z, radius] in corners {
                    let distance = ball_radius - radius;
                    assert!(distance >= 0 && product(distance, distance) >= square(sub([x, y, z], center)));
                }
                for limit in [0, 10, 300, 1000] {
                    // Compares with convex combinations of the corners of each triangle, in sixths.
                    let weights = (0..=6).flat_map(|a| (0..=6 - a).map(move |b| [a, b, 6 - a - b]));
                    let is_near = |weights: [i64; 3], [a, b, c]: &Triangle| {
                        let [x, y, z, radius] = [0, 1, 2, 3].map(|k| weights[0] * a[k] + weights[1] * b[k] + weights[2] * c[k]);
                        let scaled_max_distance = 6 * limit + radius;
                        square(sub([x, y, z], point.map(|x| 6 * x))) <= product(scaled_max_distance, scaled_max_distance)
                    };
                    let is_any_near = weights.clone().any(|w| body.triangles[from..to].iter().any(|t| is_near(w, t)));
                    let is_beyond = node.is_beyond(point, limit);
                    assert!(!(is_beyond && is_any_near), "{point:?} {limit}");
                    beyond += usize::from(is_beyond);
                }
                if let Some([first, second]) = node.children() {
                    let middle = second.data.first_triangle;
                    stack.extend([(first, from, middle), (second, middle, to)]);
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
        let verdict = |numbers: &[u32]| Body::new(&mesh, &certificate(&mesh, numbers), UNIT).map(|body| body.triangles.len());
        assert_eq!(verdict(&[1, 2, 1, 0, 1]), Ok(3));
        let reason = |numbers: &[u32]| match verdict(numbers) {
            Err(Stop::Broken(reason, _)) => reason,
            other => panic!("{other:?}"),
        };
        assert_eq!(reason(&[1, 2, 1, 0, 2]), "a tree contains a triangle twice");
        assert_eq!(reason(&[1, 2, 1, 0, 3]), "an index is out of range");
        assert_eq!(reason(&[0, 2, 1, 0, 1]), "a node has no triangles");
        assert_eq!(reason(&[3, 2, 1, 0, 1]), "an index is out of range");
        assert_eq!(reason(&[1, 2, 1, 0]), "the file ends too early");
        assert_eq!(reason(&[1, 2, 1, 0, 1, 0]), "the file has bytes after its end");
    }

    /// Tests a tree in which each first child is a single triangle.
    #[test]
    fn the_depth_of_a_tree_is_bounded() {
        let verdict = |count: u32| {
            let mesh = mesh(&alloc::vec![[[0; 4]; 3]; count as usize]);
            let numbers: Vec<u32> = (0..count - 1).flat_map(|number| [1, number]).chain([count - 1]).collect();
            Body::new(&mesh, &certificate(&mesh, &numbers), UNIT).map(|body| body.triangles.len())
        };
        assert_eq!(verdict(101), Ok(101));
        assert_eq!(verdict(102), Err(Stop::Unverifiable("a tree is too deep")));
    }
}
