//! A mesh, and a tree of volumes over ranges of its triangles.
//!
//! The certificate of a body says only how the tree groups the triangles, and along which axes each node is measured. How far a
//! node extends along them is measured here, on the triangles themselves.

use crate::number::{Point, dot, minus, product};
use crate::reader::Reader;
use crate::{Stop, sha256};
use alloc::vec::Vec;
use core::ops::Range;

/// Axes of nodes are multiples of 2⁻¹⁴.
const AXIS_BITS: u32 = 14;

/// A tree has at most so many levels.
const MAX_DEPTH: usize = 64;

/// A mesh with its tree, in integer coordinates.
#[derive(Clone, Debug)]
pub struct Body {
    pub(crate) digest: [u8; 32],
    pub(crate) unit: i32,
    /// The corners of each triangle in the order of the tree. Each is off by less than 1 in each coordinate.
    pub(crate) triangles: Vec<[Point; 3]>,
    nodes: Vec<Node>,
}

/// A volume: the points whose heights along three axes are in ranges, and that are within a ball.
#[derive(Clone, Debug)]
struct Node {
    axes: [Point; 3],
    ranges: [[i64; 2]; 3],
    centre: Point,
    radius: i64,
    children: Range<Part>,
}

/// A triangle of a body by its number, or a node by its number beyond those of the triangles.
pub(crate) type Part = usize;

impl Body {
    /// Reads a mesh and the certificate of its tree, in the unit of 2 to the power of `unit`.
    ///
    /// # Errors
    /// The verdict, if the certificate is broken or numbers are out of range.
    pub fn new(mesh: &[u8], certificate: &[u8], unit: i32) -> Result<Body, Stop> {
        let triangles = read_mesh(Reader::new(mesh), unit.into())?;
        let digest = sha256(mesh);
        let mut reader = Reader::new(certificate);
        let is_body = reader.take(8)? == b"CCDBODY1";
        reader.require(is_body, "this is no certificate of a body")?;
        let is_of_mesh = reader.take(32)? == digest;
        reader.require(is_of_mesh, "this is the certificate of another mesh")?;
        let mut body = Body {
            digest,
            unit,
            triangles: Vec::new(),
            nodes: Vec::new(),
        };
        let mut is_missing = alloc::vec![true; triangles.len()];
        for _ in 0..triangles.len() {
            let number = reader.index(triangles.len())?;
            reader.require(is_missing[number], "the tree has a triangle twice")?;
            is_missing[number] = false;
            body.triangles.push(triangles[number]);
        }
        body.read_nodes(&mut reader)?;
        reader.require(reader.is_at_end(), "the file goes on after its end")?;
        for k in 0..body.nodes.len() {
            let mut corners = Vec::new();
            body.add_corners(triangles.len() + k, &mut corners);
            body.nodes[k].measure(&corners);
        }
        Ok(body)
    }

    /// Reads the nodes level by level: the children of a node are the next nodes or the next triangles that are no one's yet.
    fn read_nodes(&mut self, reader: &mut Reader<'_>) -> Result<(), Stop> {
        let count = self.triangles.len();
        let (mut next_triangle, mut next_node, mut level_end, mut depth) =
            (0, count + 1, count + 1, 1);
        for number in count.. {
            if number == next_node {
                break;
            }
            if number == level_end {
                (level_end, depth) = (next_node, depth + 1);
                reader.require(depth <= MAX_DEPTH, "a tree has too many levels")?;
            }
            let [nodes, triangles] = [reader.unsigned(1)? as usize, reader.unsigned(1)? as usize];
            reader.require(
                (nodes == 0) != (triangles == 0),
                "a node has no children, or both kinds",
            )?;
            let next = if nodes == 0 {
                &mut next_triangle
            } else {
                &mut next_node
            };
            let first = *next;
            *next += nodes + triangles;
            self.nodes.push(Node {
                axes: [reader.axis(2)?, reader.axis(2)?, reader.axis(2)?],
                ranges: [[0; 2]; 3],
                centre: [0; 3],
                radius: 0,
                children: first..*next,
            });
        }
        reader.require(
            next_triangle == count,
            "a tree has more or fewer triangles than the mesh",
        )
    }

    pub(crate) fn root(&self) -> Part {
        self.triangles.len()
    }

    /// Returns the parts that a node consists of. A triangle has none.
    pub(crate) fn children(&self, part: Part) -> Range<Part> {
        match part.checked_sub(self.root()) {
            Some(node) => self.nodes[node].children.clone(),
            None => 0..0,
        }
    }

    /// Adds the corners of all triangles of a part.
    fn add_corners(&self, part: Part, corners: &mut Vec<Point>) {
        match self.triangles.get(part) {
            Some(triangle) => corners.extend(triangle),
            None => self
                .children(part)
                .for_each(|child| self.add_corners(child, corners)),
        }
    }

    /// Returns the largest distance of a part from a point, or more.
    pub(crate) fn reach(&self, part: Part, from: Point) -> i128 {
        match self.triangles.get(part) {
            Some(triangle) => extent(triangle.iter().map(|&corner| length(minus(corner, from))))[1],
            None => {
                let node = &self.nodes[part - self.root()];
                length(minus(node.centre, from)) + i128::from(node.radius)
            }
        }
    }

    /// Returns the least height of a part along a direction, from a point, or less.
    pub(crate) fn least_height(&self, part: Part, direction: Point, from: Point) -> i128 {
        match self.triangles.get(part) {
            Some(triangle) => extent(
                triangle
                    .iter()
                    .map(|&corner| dot(direction, minus(corner, from))),
            )[0],
            None => self.nodes[part - self.root()].least_height(direction, from),
        }
    }
}

impl Node {
    /// Measures how far corners extend along the axes, and a ball around them.
    fn measure(&mut self, corners: &[Point]) {
        self.ranges = self.axes.map(|axis| {
            let [least, greatest] = extent(corners.iter().map(|&corner| dot(axis, corner)));
            [least >> AXIS_BITS, (greatest >> AXIS_BITS) + 1].map(|height| height as i64)
        });
        self.centre = [0, 1, 2].map(|k| {
            let [least, greatest] = extent(corners.iter().map(|corner| corner[k].into()));
            ((least + greatest) / 2) as i64
        });
        let distances = corners
            .iter()
            .map(|&corner| length(minus(corner, self.centre)));
        self.radius = extent(distances)[1] as i64;
    }

    /// Returns a lower bound of the heights of the points along a direction, from a point.
    ///
    /// The direction is a sum of multiples of the axes and a rest, whatever the multiples. Each multiple has its least height at
    /// an end of the axis's range, and the rest has it within the ball.
    fn least_height(&self, direction: Point, from: Point) -> i128 {
        // A multiple of an axis is one of 2⁻³⁶ of its length, so both are exact.
        let coarse = direction.map(|x| x >> AXIS_BITS);
        let (mut rest, mut height) = (direction, 0);
        for (axis, [least, greatest]) in self.axes.iter().zip(self.ranges) {
            let multiple =
                (axis[0] * coarse[0] + axis[1] * coarse[1] + axis[2] * coarse[2]) >> AXIS_BITS;
            height += product(multiple, if multiple < 0 { greatest } else { least });
            rest = minus(rest, axis.map(|x| multiple * x));
        }
        let [x, y, z] = rest.map(|x| i128::from(x.abs()));
        (height << AXIS_BITS) + dot(rest, self.centre)
            - dot(direction, from)
            - (x + y + z) * i128::from(self.radius)
    }
}

/// Returns the least and the greatest of numbers.
fn extent(mut numbers: impl Iterator<Item = i128>) -> [i128; 2] {
    let first = numbers.next().unwrap_or(0);
    numbers.fold([first; 2], |[least, greatest], x| {
        [least.min(x), greatest.max(x)]
    })
}

/// Returns an upper bound of the length of a vector: the largest coordinate and half of the others.
///
/// With a ≥ b ≥ c ≥ 0, (a + (b + c)/2)² ≥ a² + a(b + c) ≥ a² + b² + c².
fn length(v: Point) -> i128 {
    let [a, b, c] = v.map(|x| i128::from(x.abs()));
    let largest = a.max(b).max(c);
    largest + (a + b + c - largest) / 2 + 1
}

/// Reads a mesh: the numbers of vertices and triangles, the coordinates, and the corners.
fn read_mesh(mut reader: Reader<'_>, unit: i64) -> Result<Vec<[Point; 3]>, Stop> {
    let [vertex_count, triangle_count] = [reader.unsigned(4)?, reader.unsigned(4)?];
    let (mut vertices, mut triangles) = (Vec::new(), Vec::new());
    for _ in 0..vertex_count {
        vertices.push(reader.vector(unit, 50)?.mid);
    }
    for _ in 0..triangle_count {
        let [a, b, c] = [(); 3].map(|()| reader.index(vertices.len()));
        triangles.push([vertices[a?], vertices[b?], vertices[c?]]);
    }
    reader.require(
        !triangles.is_empty() && reader.is_at_end(),
        "a mesh is empty, or goes on after its end",
    )?;
    Ok(triangles)
}
