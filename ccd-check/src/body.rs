//! A mesh, and a tree of volumes over ranges of its triangles.
//!
//! The certificate of a body says only how the tree groups the triangles, and along which axes each node is measured. How far a
//! node extends along them is measured here, on the triangles themselves.

use crate::number::length;
use crate::reader::Reader;
use crate::{Fault, Stop, sha256};
use alloc::vec::Vec;
use core::ops::Range;

type Point = [i128; 3];

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
    /// Each node is followed by those below it.
    nodes: Vec<Node>,
}

/// A volume: the points whose heights along three axes are in ranges, and that are within a ball.
#[derive(Clone, Debug)]
struct Node {
    axes: [Point; 3],
    ranges: [(i128, i128); 3],
    centre: Point,
    radius: i128,
    triangles: Range<usize>,
    /// The number of the node after the last one below this one.
    end: usize,
}

/// A node of a body by its number, or a triangle by its number beyond those of the nodes.
pub(crate) type Part = usize;

impl Body {
    /// Reads a mesh and the certificate of its tree, in the unit of 2 to the power of `unit`.
    ///
    /// # Errors
    /// The verdict, if the certificate is broken or numbers are out of range.
    pub fn new(mesh: &[u8], certificate: &[u8], unit: i32) -> Result<Body, Stop> {
        let triangles = read_mesh(Reader { bytes: mesh, at: 0 }, unit)?;
        let digest = sha256(mesh);
        let mut reader = Reader {
            bytes: certificate,
            at: 0,
        };
        reader.require(b"CCDBODY1", Fault::Format)?;
        reader.require(&digest, Fault::OtherMesh)?;
        let mut body = Body {
            digest,
            unit,
            triangles: Vec::new(),
            nodes: Vec::new(),
        };
        let mut is_missing = alloc::vec![true; triangles.len()];
        for _ in 0..triangles.len() {
            let number = reader.unsigned(4)? as usize;
            match is_missing.get_mut(number) {
                Some(is_missing) if *is_missing => *is_missing = false,
                _ => return reader.broken(Fault::Triangles),
            }
            body.triangles.push(triangles[number]);
        }
        if body.read_node(&mut reader, 0, 0)? != triangles.len() {
            return reader.broken(Fault::Triangles);
        }
        reader.require_end().map(|()| body)
    }

    /// Reads a node that begins with a triangle, and all below it. Returns the triangle after its last one.
    fn read_node(
        &mut self,
        reader: &mut Reader<'_>,
        first: usize,
        depth: usize,
    ) -> Result<usize, Stop> {
        let (children, own) = (reader.unsigned(1)?, reader.unsigned(1)? as usize);
        let axes = [reader.axis(2)?, reader.axis(2)?, reader.axis(2)?];
        if depth >= MAX_DEPTH || (children == 0) == (own == 0) {
            return reader.broken(Fault::Tree);
        }
        let number = self.nodes.len();
        let (ranges, centre) = ([(0, 0); 3], [0; 3]);
        self.nodes.push(Node {
            axes,
            ranges,
            centre,
            radius: 0,
            triangles: 0..0,
            end: 0,
        });
        let mut end = first + own;
        for _ in 0..children {
            end = self.read_node(reader, end, depth + 1)?;
        }
        let Some(triangles) = self.triangles.get(first..end) else {
            return reader.broken(Fault::Triangles);
        };
        let below = self.nodes.len();
        let node = &mut self.nodes[number];
        (node.triangles, node.end) = (first..end, below);
        node.measure(triangles);
        Ok(end)
    }

    /// Returns the children of a part, the last one first. A triangle has none.
    pub(crate) fn children(&self, part: Part) -> Vec<Part> {
        let Some(node) = self.nodes.get(part) else {
            return Vec::new();
        };
        let mut children = Vec::new();
        let mut next = part + 1;
        while next < node.end {
            children.push(next);
            next = self.nodes[next].end;
        }
        if children.is_empty() {
            children.extend(
                node.triangles
                    .clone()
                    .map(|triangle| self.nodes.len() + triangle),
            );
        }
        children.reverse();
        children
    }

    /// Returns the least height of a part along a direction, and its largest distance, both from a point.
    pub(crate) fn height_and_reach(
        &self,
        part: Part,
        from: Point,
        direction: Point,
    ) -> (i128, i128) {
        if let Some(node) = self.nodes.get(part) {
            let height = node.least_height(direction) - dot(direction, from);
            return (height, length(minus(node.centre, from)) + node.radius);
        }
        let corners = self.triangles[part - self.nodes.len()].map(|corner| minus(corner, from));
        let (height, _) = extent(corners.iter().map(|&corner| dot(direction, corner)));
        (
            height,
            extent(corners.iter().map(|&corner| length(corner))).1,
        )
    }
}

impl Node {
    /// Measures how far triangles extend along the axes, and a ball around them.
    fn measure(&mut self, triangles: &[[Point; 3]]) {
        let corners = || triangles.iter().flatten().copied();
        self.ranges = self
            .axes
            .map(|axis| extent(corners().map(|corner| dot(axis, corner))));
        self.centre = [0, 1, 2].map(|k| {
            let (least, greatest) = extent(corners().map(|corner| corner[k]));
            (least + greatest) / 2
        });
        self.radius = extent(corners().map(|corner| length(minus(corner, self.centre)))).1;
    }

    /// Returns a lower bound of the heights of the points along a direction.
    ///
    /// The direction is a sum of multiples of the axes and a rest, whatever the multiples. Each multiple has its least height at
    /// an end of the axis's range, and the rest has it within the ball.
    fn least_height(&self, direction: Point) -> i128 {
        let (mut rest, mut height) = (direction, 0);
        for (axis, (least, greatest)) in self.axes.iter().zip(self.ranges) {
            let multiple = dot(*axis, direction) >> (2 * AXIS_BITS);
            height += (multiple * least).min(multiple * greatest);
            rest = minus(rest, axis.map(|x| multiple * x));
        }
        height + dot(rest, self.centre) - length(rest) * self.radius
    }
}

/// Returns the least and the greatest of numbers.
fn extent(mut numbers: impl Iterator<Item = i128>) -> (i128, i128) {
    let first = numbers.next().unwrap_or(0);
    numbers.fold((first, first), |(least, greatest), x| {
        (least.min(x), greatest.max(x))
    })
}

fn dot(a: Point, b: Point) -> i128 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn minus(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// Reads a mesh: the numbers of vertices and triangles, the coordinates, and the corners.
fn read_mesh(mut reader: Reader<'_>, unit: i32) -> Result<Vec<[Point; 3]>, Stop> {
    let (vertex_count, triangle_count) = (reader.unsigned(4)?, reader.unsigned(4)?);
    let mut vertices = Vec::new();
    for _ in 0..vertex_count {
        vertices.push(reader.vector(unit.into(), 50, Fault::Number)?.mid);
    }
    let mut triangles = Vec::new();
    for _ in 0..triangle_count {
        let mut triangle = [[0; 3]; 3];
        for corner in &mut triangle {
            match vertices.get(reader.unsigned(4)? as usize) {
                Some(vertex) => *corner = *vertex,
                None => return reader.broken(Fault::NoVertex),
            }
        }
        triangles.push(triangle);
    }
    if triangles.is_empty() {
        return reader.broken(Fault::Format);
    }
    reader.require_end().map(|()| triangles)
}
