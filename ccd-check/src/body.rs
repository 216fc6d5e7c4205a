//! A mesh, and a tree of volumes over ranges of its triangles.
//!
//! The certificate of a body says only how the tree groups the triangles, and along which axes each node is measured. How far a
//! node extends along them is measured here, on the triangles themselves.

use crate::number::length;
use crate::reader::Reader;
use crate::{Fault, Stop, sha256};
use alloc::vec::Vec;
use core::ops::Range;

/// Axes of nodes are multiples of 2⁻¹⁴.
pub(crate) const AXIS_BITS: u32 = 14;

/// The largest number of levels of a tree.
const MAX_DEPTH: usize = 64;

/// A mesh with its tree, in integer coordinates.
#[derive(Clone, Debug)]
pub struct Body {
    pub(crate) digest: [u8; 32],
    pub(crate) unit: i32,
    /// The corners of each triangle in the order of the tree, each off by less than 1 in each coordinate.
    triangles: Vec<[[i128; 3]; 3]>,
    /// Each node is followed by those below it.
    nodes: Vec<Node>,
}

/// A volume: the points whose heights along three axes are in ranges, and that are within a ball.
#[derive(Clone, Debug)]
struct Node {
    axes: [[i128; 3]; 3],
    ranges: [(i128, i128); 3],
    centre: [i128; 3],
    radius: i128,
    /// Its triangles.
    triangles: Range<usize>,
    /// The number of the node after the last one below this one.
    end: usize,
}

/// A node or a triangle of a body.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Part {
    Node(usize),
    Triangle(usize),
}

/// What is known of a part's points, as seen from a point: their heights along a direction, and their distance.
pub(crate) struct Seen {
    pub(crate) least_height: i128,
    pub(crate) reach: i128,
}

impl Body {
    /// Reads a mesh and the certificate of its tree, in the unit of 2 to the power of `unit`.
    ///
    /// # Errors
    /// The verdict, if the certificate is broken or numbers are out of range.
    pub fn new(mesh: &[u8], certificate: &[u8], unit: i32) -> Result<Body, Stop> {
        let triangles = read_mesh(mesh, unit)?;
        let mut reader = Reader::new(certificate);
        reader.require(b"CCDBODY1")?;
        let digest = sha256(mesh);
        if reader.array()? != digest {
            return reader.broken(Fault::OtherMesh);
        }
        let mut in_order = Vec::with_capacity(triangles.len());
        let mut is_missing = alloc::vec![true; triangles.len()];
        for _ in 0..triangles.len() {
            let number = reader.u32()? as usize;
            if !is_missing.get(number).is_some_and(|&is_missing| is_missing) {
                return reader.broken(Fault::Triangles);
            }
            is_missing[number] = false;
            in_order.push(triangles[number]);
        }
        let mut body = Body {
            digest,
            unit,
            triangles: in_order,
            nodes: Vec::new(),
        };
        let end = body.read_node(&mut reader, 0, 0)?;
        if end != body.triangles.len() {
            return reader.broken(Fault::Triangles);
        }
        if reader.is_at_end() {
            Ok(body)
        } else {
            reader.broken(Fault::Format)
        }
    }

    /// Reads a node that begins with a triangle, and all below it. Returns the triangle after its last one.
    fn read_node(
        &mut self,
        reader: &mut Reader<'_>,
        first: usize,
        depth: usize,
    ) -> Result<usize, Stop> {
        let (children, own) = (reader.u8()?, usize::from(reader.u8()?));
        let axes = [reader.axis()?, reader.axis()?, reader.axis()?];
        if depth >= MAX_DEPTH || (children == 0) == (own == 0) {
            return reader.broken(Fault::Tree);
        }
        let number = self.nodes.len();
        self.nodes.push(Node {
            axes,
            ranges: [(0, 0); 3],
            centre: [0; 3],
            radius: 0,
            triangles: first..first,
            end: 0,
        });
        let mut end = first + own;
        for _ in 0..children {
            end = self.read_node(reader, end, depth + 1)?;
        }
        if end > self.triangles.len() {
            return reader.broken(Fault::Triangles);
        }
        let below = self.nodes.len();
        let node = &mut self.nodes[number];
        (node.triangles, node.end) = (first..end, below);
        node.measure(&self.triangles[first..end]);
        Ok(end)
    }

    pub(crate) fn root(&self) -> Part {
        Part::Node(0)
    }

    /// Calls `each` with the children of a node, the last one first. A triangle has none.
    pub(crate) fn for_each_child(
        &self,
        part: Part,
        mut each: impl FnMut(Part),
    ) -> Result<(), Fault> {
        let Part::Node(number) = part else {
            return Err(Fault::Split);
        };
        let node = &self.nodes[number];
        let mut children = Vec::new();
        let mut next = number + 1;
        while next < node.end {
            children.push(Part::Node(next));
            next = self.nodes[next].end;
        }
        if children.is_empty() {
            children.extend(node.triangles.clone().map(Part::Triangle));
        }
        children.into_iter().rev().for_each(&mut each);
        Ok(())
    }

    /// Returns a triangle of the mesh by its place in the order of the tree.
    pub(crate) fn triangle(&self, place: usize) -> Option<&[[i128; 3]; 3]> {
        self.triangles.get(place)
    }

    /// Measures a part as seen from a point: the least height along a direction of fractions, in units times fractions, and the
    /// largest distance.
    pub(crate) fn seen_from(&self, part: Part, point: [i128; 3], direction: [i128; 3]) -> Seen {
        let from_point = |p: [i128; 3]| [0, 1, 2].map(|k| p[k] - point[k]);
        match part {
            Part::Triangle(number) => {
                let corners = self.triangles[number].map(from_point);
                let [a, b, c] = corners.map(|corner| dot(direction, corner));
                let [x, y, z] = corners.map(length);
                Seen {
                    least_height: a.min(b).min(c),
                    reach: x.max(y).max(z),
                }
            }
            Part::Node(number) => {
                let node = &self.nodes[number];
                Seen {
                    least_height: node.least_height(direction) - dot(direction, point),
                    reach: length(from_point(node.centre)) + node.radius,
                }
            }
        }
    }
}

impl Node {
    /// Measures how far triangles extend along the axes, and a ball around them.
    fn measure(&mut self, triangles: &[[[i128; 3]; 3]]) {
        let corners = || triangles.iter().flatten().copied();
        for (range, &axis) in self.ranges.iter_mut().zip(&self.axes) {
            *range = extent(corners().map(|corner| dot(axis, corner)));
        }
        self.centre = [0, 1, 2].map(|k| {
            let (least, greatest) = extent(corners().map(|corner| corner[k]));
            (least + greatest) / 2
        });
        let from_centre = |p: [i128; 3]| [0, 1, 2].map(|k| p[k] - self.centre[k]);
        self.radius = extent(corners().map(|corner| length(from_centre(corner)))).1;
    }

    /// Returns a lower bound of the heights of the points along a direction.
    ///
    /// The direction is a sum of multiples of the axes and a rest, whatever the multiples. Each multiple has its least height at
    /// an end of the axis's range, and the rest has it within the ball.
    fn least_height(&self, direction: [i128; 3]) -> i128 {
        let (mut rest, mut height) = (direction, 0);
        for (axis, &(least, greatest)) in self.axes.iter().zip(&self.ranges) {
            let multiple = dot(*axis, direction) >> (2 * AXIS_BITS);
            height += (multiple * least).min(multiple * greatest);
            rest = [0, 1, 2].map(|k| rest[k] - multiple * axis[k]);
        }
        height + dot(rest, self.centre) - length(rest) * self.radius
    }
}

/// Returns the least and the greatest of numbers.
fn extent(mut numbers: impl Iterator<Item = i128>) -> (i128, i128) {
    let first = numbers.next().unwrap_or(0);
    numbers.fold((first, first), |(least, greatest), number| {
        (least.min(number), greatest.max(number))
    })
}

fn dot(a: [i128; 3], b: [i128; 3]) -> i128 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Reads a mesh: the numbers of vertices and triangles, the coordinates, and the corners.
fn read_mesh(mesh: &[u8], unit: i32) -> Result<Vec<[[i128; 3]; 3]>, Stop> {
    let mut reader = Reader::new(mesh);
    let (vertex_count, triangle_count) = (reader.u32()?, reader.u32()?);
    let mut vertices = Vec::new();
    for _ in 0..vertex_count {
        let mut vertex = [0; 3];
        for (place, number) in vertex.iter_mut().zip(reader.vector()?) {
            *place = number.length(unit)?.mid;
        }
        vertices.push(vertex);
    }
    let mut triangles = Vec::new();
    for _ in 0..triangle_count {
        let mut triangle = [[0; 3]; 3];
        for corner in &mut triangle {
            match vertices.get(reader.u32()? as usize) {
                Some(vertex) => *corner = *vertex,
                None => return reader.broken(Fault::NoVertex),
            }
        }
        triangles.push(triangle);
    }
    if triangles.is_empty() || !reader.is_at_end() {
        return reader.broken(Fault::Format);
    }
    Ok(triangles)
}

/// A corner and the point from which it is seen are off by less than 1 each, in each coordinate.
pub(crate) const CORNER_ERROR: i128 = 2;
