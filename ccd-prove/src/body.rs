//! A mesh with the tree that its certificate describes.

use ccd_core::glam::DVec3;
use ccd_core::order::{greater, lesser};
use nalgebra::{Matrix3, SymmetricEigen};
use sha2::{Digest, Sha256};
use std::cmp::Ordering;
use std::ops::Range;

/// The number of triangles of a node that has no children, at most.
const LEAF_TRIANGLES: usize = 4;

/// The number of nodes below a node.
const WIDTH: usize = 2;

/// Axes of nodes are multiples of 2⁻¹⁴.
const AXIS_UNIT: f64 = 16_384.0;

/// A mesh, with a tree of volumes around its triangles, and both as bytes.
#[derive(Clone, Debug)]
pub struct Body {
    pub(crate) triangles: Vec<[DVec3; 3]>,
    /// Level by level; the first one is the root.
    pub(crate) nodes: Vec<Node>,
    mesh: Vec<u8>,
    /// The SHA-256 digest of the mesh.
    pub(crate) digest: [u8; 32],
    certificate: Vec<u8>,
}

#[derive(Clone, Debug)]
pub(crate) struct Node {
    /// The axes as they are stored, divided by their unit: nearly orthogonal, and nearly of length 1.
    pub(crate) axes: [DVec3; 3],
    pub(crate) ranges: [[f64; 2]; 3],
    pub(crate) centre: DVec3,
    pub(crate) radius: f64,
    pub(crate) children: Children,
}

/// What a node consists of.
#[derive(Clone, Debug)]
pub(crate) enum Children {
    Nodes(Range<usize>),
    Triangles(Range<usize>),
}

/// A node or a triangle of a body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Part {
    Node(usize),
    Triangle(usize),
}

impl Body {
    /// Makes a body of a mesh. Its digest is that of the mesh as bytes: the numbers of vertices and triangles, the coordinates,
    /// the numbers of the corners, all in little endian.
    ///
    /// # Panics
    /// If a triangle has a corner that is no vertex, or if there is no triangle.
    pub fn new(vertices: &[[f64; 3]], faces: &[[u32; 3]]) -> Self {
        let corner = |v: u32| DVec3::from_array(vertices[v as usize]);
        let triangles: Vec<[DVec3; 3]> = faces.iter().map(|face| face.map(corner)).collect();
        assert!(!triangles.is_empty(), "a body has triangles");
        let mesh = mesh_bytes(vertices, faces);
        let mut body = Body {
            triangles: Vec::new(),
            nodes: Vec::new(),
            digest: Sha256::digest(&mesh).into(),
            mesh,
            certificate: Vec::new(),
        };
        let order = body.add_nodes(&triangles);
        body.triangles = order.iter().map(|&k| triangles[k as usize]).collect();
        body.certificate.extend(b"CCDBODY1");
        body.certificate.extend(body.digest);
        body.certificate
            .extend(order.iter().flat_map(|k| k.to_le_bytes()));
        for node in &body.nodes {
            let (nodes, own) = match &node.children {
                Children::Nodes(range) => (range.len(), 0),
                Children::Triangles(range) => (0, range.len()),
            };
            body.certificate.extend([nodes as u8, own as u8]);
            let numbers = node.axes.iter().flat_map(|axis| axis.to_array());
            body.certificate
                .extend(numbers.flat_map(|x| ((x * AXIS_UNIT) as i16).to_le_bytes()));
        }
        body
    }

    /// Makes a body of the triangles of one of the engine's, and the radius by which it is rounded. A ball is a triangle whose
    /// corners are its centre, a capsule one that is its axis.
    ///
    /// Vertices and triangles are sorted, so that the bytes of the mesh do not depend on the tree that the engine has built.
    /// `None` if pieces are rounded by different radii, or one of more than three points has no triangles of a mesh.
    pub fn of(body: &ccd_core::Body) -> Option<(Self, f64)> {
        let radius = body.pieces().get(0).radius;
        let mut triangles: Vec<[DVec3; 3]> = Vec::new();
        for piece in body.pieces().iter() {
            match piece.points {
                _ if piece.radius != radius => return None,
                [point] => triangles.push([*point; 3]),
                [from, to] => triangles.push([*from, *to, *to]),
                [a, b, c] if piece.mesh_triangles().next().is_none() => {
                    triangles.push([*a, *b, *c]);
                }
                _ => {
                    let before = triangles.len();
                    triangles.extend(piece.mesh_triangles().map(|(_, corners)| corners));
                    if triangles.len() == before {
                        return None;
                    }
                }
            }
        }
        let (vertices, faces) = canonical(&triangles);
        Some((Body::new(&vertices, &faces), radius))
    }

    /// Returns the mesh as the bytes whose digest a certificate states.
    pub fn mesh(&self) -> &[u8] {
        &self.mesh
    }

    /// Returns the SHA-256 digest of the mesh.
    pub fn digest(&self) -> [u8; 32] {
        self.digest
    }

    /// Returns the certificate of the body's tree.
    pub fn certificate(&self) -> &[u8] {
        &self.certificate
    }

    /// Adds all nodes around triangles, level by level. Returns the triangles in the order of the tree.
    fn add_nodes(&mut self, triangles: &[[DVec3; 3]]) -> Vec<u32> {
        let mut groups = std::collections::VecDeque::new();
        groups.push_back((0..triangles.len() as u32).collect::<Vec<u32>>());
        let (mut order, mut count) = (Vec::new(), 1);
        while let Some(group) = groups.pop_front() {
            let mut node = Node::around(triangles, &group);
            if group.len() <= LEAF_TRIANGLES {
                node.children = Children::Triangles(order.len()..order.len() + group.len());
                order.extend(group);
            } else {
                let parts = split(triangles, group);
                node.children = Children::Nodes(count..count + parts.len());
                count += parts.len();
                groups.extend(parts);
            }
            self.nodes.push(node);
        }
        order
    }

    pub(crate) fn children(&self, part: Part) -> Vec<Part> {
        match part {
            Part::Triangle(_) => Vec::new(),
            Part::Node(number) => match self.nodes[number].children.clone() {
                Children::Nodes(range) => range.map(Part::Node).collect(),
                Children::Triangles(range) => range.map(Part::Triangle).collect(),
            },
        }
    }

    /// Returns the least height of a part along a direction, from a point.
    pub(crate) fn least_height(&self, part: Part, direction: DVec3, point: DVec3) -> f64 {
        match part {
            Part::Triangle(number) => {
                let [a, b, c] = self.triangles[number].map(|corner| direction.dot(corner - point));
                lesser(a, lesser(b, c))
            }
            Part::Node(number) => self.nodes[number].least_height(direction) - direction.dot(point),
        }
    }

    /// Returns the greatest distance of a part from a point, or more.
    pub(crate) fn reach(&self, part: Part, point: DVec3) -> f64 {
        match part {
            Part::Triangle(number) => {
                let [a, b, c] = self.triangles[number].map(|corner| length(corner - point));
                greater(a, greater(b, c))
            }
            Part::Node(number) => {
                let node = &self.nodes[number];
                length(node.centre - point) + node.radius
            }
        }
    }

    /// Returns half of the size of a part.
    pub(crate) fn radius(&self, part: Part) -> f64 {
        match part {
            Part::Triangle(_) => 0.0,
            Part::Node(number) => self.nodes[number].radius,
        }
    }

    /// Returns the corner of a part that is lowest along a direction.
    pub(crate) fn lowest_corner(&self, part: Part, direction: DVec3) -> (u32, DVec3) {
        match part {
            Part::Triangle(number) => {
                let corners = self.triangles[number];
                let height = |k: &usize| direction.dot(corners[*k]);
                let lowest = (0..3)
                    .min_by(|a, b| height(a).total_cmp(&height(b)))
                    .unwrap_or(0);
                (lowest as u32, corners[lowest])
            }
            Part::Node(number) => {
                let node = &self.nodes[number];
                let (mut index, mut corner) = (0, DVec3::ZERO);
                for (k, (axis, range)) in node.axes.iter().zip(node.ranges).enumerate() {
                    let end = usize::from(direction.dot(*axis) < 0.0);
                    index |= (end as u32) << k;
                    corner += *axis * (range[end] / axis.length_squared());
                }
                (index, corner)
            }
        }
    }
}

impl Node {
    fn around(triangles: &[[DVec3; 3]], order: &[u32]) -> Self {
        let axes = axes(triangles, order).map(|axis| axis / AXIS_UNIT);
        let corners = || order.iter().flat_map(|&k| triangles[k as usize]);
        let extent = |axis: DVec3| {
            corners().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], corner| {
                let height = axis.dot(corner);
                [lesser(low, height), greater(high, height)]
            })
        };
        let middle = |axis| extent(axis).iter().sum::<f64>() / 2.0;
        let centre = DVec3::new(middle(DVec3::X), middle(DVec3::Y), middle(DVec3::Z));
        let radius = corners().fold(0.0, |radius: f64, corner| {
            greater(radius, length(corner - centre))
        });
        Node {
            axes,
            ranges: axes.map(extent),
            centre,
            radius,
            children: Children::Nodes(0..0),
        }
    }

    fn least_height(&self, direction: DVec3) -> f64 {
        let (mut rest, mut height) = (direction, 0.0);
        for (axis, [low, high]) in self.axes.iter().zip(self.ranges) {
            let multiple = axis.dot(direction);
            height += lesser(multiple * low, multiple * high);
            rest -= multiple * *axis;
        }
        // The checker rounds multiples to 2⁻³⁶, so what is left of the direction is larger there.
        height + rest.dot(self.centre) - (rest.abs().element_sum() + 4e-10) * self.radius
    }
}

/// Returns the vertices of triangles in the order of their coordinates, and the triangles in the order of their corners, the
/// least of which comes first.
fn canonical(triangles: &[[DVec3; 3]]) -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
    let compare = |a: &[f64; 3], b: &[f64; 3]| {
        let coordinates = a.iter().zip(b).map(|(a, b)| a.total_cmp(b));
        coordinates.fold(Ordering::Equal, Ordering::then)
    };
    let mut vertices: Vec<[f64; 3]> = triangles.iter().flatten().map(|v| v.to_array()).collect();
    vertices.sort_by(compare);
    vertices.dedup_by(|a, b| compare(a, b).is_eq());
    let number = |corner: DVec3| {
        let corner = corner.to_array();
        vertices.partition_point(|v| compare(v, &corner).is_lt()) as u32
    };
    let mut faces: Vec<[u32; 3]> = triangles
        .iter()
        .map(|corners| corners.map(number))
        .collect();
    for face in &mut faces {
        let least = (0..3).min_by_key(|&k| face[k]).unwrap_or(0);
        face.rotate_left(least);
    }
    faces.sort_unstable();
    (vertices, faces)
}

/// Splits triangles in halves along their longest axis, until there are as many parts as a node has children.
fn split(triangles: &[[DVec3; 3]], group: Vec<u32>) -> Vec<Vec<u32>> {
    let mut parts = vec![group];
    while parts.len() < WIDTH && parts.iter().any(|part| part.len() > LEAF_TRIANGLES) {
        let halves = parts.into_iter().flat_map(|mut part| {
            if part.len() <= LEAF_TRIANGLES {
                return vec![part];
            }
            let axis = axes(triangles, &part)[0];
            let place = |k: &u32| triangles[*k as usize].iter().sum::<DVec3>().dot(axis);
            let middle = part.len() / 2;
            part.select_nth_unstable_by(middle, |a, b| place(a).total_cmp(&place(b)));
            let high = part.split_off(middle);
            vec![part, high]
        });
        parts = halves.collect();
    }
    parts
}

/// Returns the upper bound of a length that the checker uses.
pub(crate) fn length(v: DVec3) -> f64 {
    let v = v.abs();
    v.max_element() + 0.5 * (v.element_sum() - v.max_element())
}

/// Returns the principal axes of triangles, the longest first, in units of 2⁻¹⁴.
fn axes(triangles: &[[DVec3; 3]], order: &[u32]) -> [DVec3; 3] {
    let corners = || order.iter().flat_map(|&k| triangles[k as usize]);
    let mean = corners().sum::<DVec3>() / (3 * order.len()) as f64;
    let mut covariance = Matrix3::zeros();
    for corner in corners() {
        let from_mean = nalgebra::Vector3::from((corner - mean).to_array());
        covariance += from_mean * from_mean.transpose();
    }
    let eigen = SymmetricEigen::new(covariance);
    let mut columns = [0, 1, 2];
    columns.sort_by(|&a, &b| eigen.eigenvalues[b].total_cmp(&eigen.eigenvalues[a]));
    let axes = columns.map(|k| {
        let column = eigen.eigenvectors.column(k);
        DVec3::new(column[0], column[1], column[2])
    });
    let axes = if axes.iter().all(|axis| axis.is_finite()) {
        axes
    } else {
        [DVec3::X, DVec3::Y, DVec3::Z]
    };
    axes.map(|axis| (axis * AXIS_UNIT).round())
}

fn mesh_bytes(vertices: &[[f64; 3]], faces: &[[u32; 3]]) -> Vec<u8> {
    let mut bytes = Vec::new();
    bytes.extend((vertices.len() as u32).to_le_bytes());
    bytes.extend((faces.len() as u32).to_le_bytes());
    bytes.extend(vertices.iter().flatten().flat_map(|x| x.to_le_bytes()));
    bytes.extend(faces.iter().flatten().flat_map(|k| k.to_le_bytes()));
    bytes
}
