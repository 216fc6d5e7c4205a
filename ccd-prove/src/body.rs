//! A mesh with the tree that its certificate describes.

use ccd_core::glam::DVec3;
use ccd_core::order::{greater, lesser};
use nalgebra::{Matrix3, SymmetricEigen};
use sha2::{Digest, Sha256};

/// The number of triangles of a node that has no children, at most.
const LEAF_TRIANGLES: usize = 4;

/// Axes of nodes are multiples of 2⁻¹⁴.
const AXIS_UNIT: f64 = 16_384.0;

/// A mesh, with a tree of volumes around its triangles, and both as bytes.
#[derive(Clone, Debug)]
pub struct Body {
    pub(crate) triangles: Vec<[DVec3; 3]>,
    /// Each node is followed by those below it.
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
    pub(crate) triangles: std::ops::Range<usize>,
    /// The numbers of its children; empty if they are its triangles.
    pub(crate) children: Vec<usize>,
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
        let mut order: Vec<u32> = (0..faces.len() as u32).collect();
        let mesh = mesh_bytes(vertices, faces);
        let mut body = Body {
            triangles: Vec::new(),
            nodes: Vec::new(),
            digest: Sha256::digest(&mesh).into(),
            mesh,
            certificate: Vec::new(),
        };
        let mut records = Vec::new();
        body.add_node(&triangles, &mut order, 0, &mut records);
        body.triangles = order.iter().map(|&k| triangles[k as usize]).collect();
        body.certificate.extend(b"CCDBODY1");
        body.certificate.extend(body.digest);
        body.certificate
            .extend(order.iter().flat_map(|k| k.to_le_bytes()));
        body.certificate.extend(records);
        body
    }

    /// Returns the mesh as the bytes whose digest a certificate states.
    pub fn mesh(&self) -> &[u8] {
        &self.mesh
    }

    /// Returns the certificate of the body's tree.
    pub fn certificate(&self) -> &[u8] {
        &self.certificate
    }

    /// Adds a node around triangles, and all below it; writes their records.
    fn add_node(
        &mut self,
        triangles: &[[DVec3; 3]],
        order: &mut [u32],
        first: usize,
        records: &mut Vec<u8>,
    ) -> usize {
        let axes = axes(triangles, order);
        let is_leaf = order.len() <= LEAF_TRIANGLES;
        records.extend(if is_leaf {
            [0, order.len() as u8]
        } else {
            [2, 0]
        });
        for axis in axes {
            records.extend(
                axis.to_array()
                    .iter()
                    .flat_map(|&x| (x as i16).to_le_bytes()),
            );
        }
        let number = self.nodes.len();
        let axes = axes.map(|axis| axis / AXIS_UNIT);
        self.nodes.push(Node::around(triangles, order, first, axes));
        if !is_leaf {
            let middle = order.len() / 2;
            let place = |k: &u32| triangles[*k as usize].iter().sum::<DVec3>().dot(axes[0]);
            order.select_nth_unstable_by(middle, |a, b| place(a).total_cmp(&place(b)));
            let (low, high) = order.split_at_mut(middle);
            let low = self.add_node(triangles, low, first, records);
            let high = self.add_node(triangles, high, first + middle, records);
            self.nodes[number].children = vec![low, high];
        }
        number
    }

    pub(crate) fn children(&self, part: Part) -> Vec<Part> {
        match part {
            Part::Triangle(_) => Vec::new(),
            Part::Node(number) => {
                let node = &self.nodes[number];
                if node.children.is_empty() {
                    node.triangles.clone().map(Part::Triangle).collect()
                } else {
                    node.children
                        .iter()
                        .map(|&child| Part::Node(child))
                        .collect()
                }
            }
        }
    }

    /// Returns the least height of a part along a direction, from a point.
    pub(crate) fn least_height(&self, part: Part, point: DVec3, direction: DVec3) -> f64 {
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
    fn around(triangles: &[[DVec3; 3]], order: &[u32], first: usize, axes: [DVec3; 3]) -> Self {
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
            triangles: first..first + order.len(),
            children: Vec::new(),
        }
    }

    fn least_height(&self, direction: DVec3) -> f64 {
        let (mut rest, mut height) = (direction, 0.0);
        for (axis, [low, high]) in self.axes.iter().zip(self.ranges) {
            let multiple = axis.dot(direction);
            height += lesser(multiple * low, multiple * high);
            rest -= multiple * *axis;
        }
        height + rest.dot(self.centre) - length(rest) * self.radius
    }
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
