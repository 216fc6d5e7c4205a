//! A mesh with the tree that its certificate describes.

use ccd_core::glam::{DVec3, DVec4};
use ccd_core::order::{greater, lesser};
use nalgebra::{Matrix3, SymmetricEigen};
use sha2::{Digest, Sha256};
use std::cmp::Ordering;

/// A mesh of rounded triangles, with a tree of boxes around them, and both as bytes.
///
/// Around each vertex is a ball, and a triangle is the convex hull of the balls of its corners. If their radii are 0 it is flat.
#[derive(Clone, Debug)]
pub struct Body {
    /// In the order of the tree. Each corner has its radius after its coordinates.
    pub(crate) triangles: Vec<[DVec4; 3]>,
    /// The least and the greatest coordinates and radius of each part: those of a part are where its halves meet, those of the
    /// triangles follow.
    bounds: Vec<[DVec4; 2]>,
    mesh: Vec<u8>,
    /// The SHA-256 digest of the mesh.
    pub(crate) digest: [u8; 32],
    certificate: Vec<u8>,
}

/// Triangles of a body, from one to before another.
pub(crate) type Part = [usize; 2];

impl Body {
    /// Makes a body of a mesh. Its digest is that of the mesh as bytes: the numbers of vertices and triangles, the coordinates and
    /// radii, the numbers of the corners, all in little endian.
    ///
    /// # Panics
    /// If a triangle has a corner that is no vertex, or if there is no triangle.
    pub fn new(vertices: &[[f64; 3]], faces: &[[u32; 3]]) -> Self {
        let flat: Vec<[f64; 4]> = vertices.iter().map(|&[x, y, z]| [x, y, z, 0.0]).collect();
        Body::rounded(&flat, faces)
    }

    /// Makes a body of a mesh with balls around its vertices: each has its radius after its coordinates.
    ///
    /// # Panics
    /// As [`new`](Self::new).
    pub fn rounded(vertices: &[[f64; 4]], faces: &[[u32; 3]]) -> Self {
        let corner = |v: u32| DVec4::from_array(vertices[v as usize]);
        let triangles: Vec<[DVec4; 3]> = faces.iter().map(|face| face.map(corner)).collect();
        assert!(!triangles.is_empty(), "a body has triangles");
        let mesh = mesh_bytes(vertices, faces);
        let digest: [u8; 32] = Sha256::digest(&mesh).into();
        let mut order: Vec<u32> = (0..triangles.len() as u32).collect();
        sort(&triangles, &mut order);
        let mut body = Body {
            triangles: order.iter().map(|&k| triangles[k as usize]).collect(),
            bounds: vec![[DVec4::ZERO; 2]; 2 * triangles.len()],
            mesh,
            digest,
            certificate: b"CCDBODY1".to_vec(),
        };
        let order = order.iter().flat_map(|k| k.to_le_bytes());
        body.certificate.extend(digest.into_iter().chain(order));
        body.measure(body.whole());
        body
    }

    /// Makes a body of the triangles of one of the engine's; `None` if a piece of more than three points has none.
    ///
    /// A ball is a triangle whose corners are its centre, a capsule one that is its axis. Vertices and triangles are sorted, so that
    /// the bytes of the mesh do not depend on the tree that the engine has built.
    pub fn of(body: &ccd_core::Body) -> Option<Self> {
        Some(Body::of_triangles(&triangles_of(body)?))
    }

    pub(crate) fn of_triangles(triangles: &[[DVec4; 3]]) -> Self {
        let (vertices, faces) = canonical(triangles);
        Body::rounded(&vertices, &faces)
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

    /// Returns the part that has all triangles.
    pub(crate) fn whole(&self) -> Part {
        [0, self.triangles.len()]
    }

    /// Measures a part and all parts of it.
    fn measure(&mut self, part: Part) -> [DVec4; 2] {
        let bounds = match halves(part) {
            Some(halves) => {
                let [[least_a, greatest_a], [least_b, greatest_b]] =
                    halves.map(|half| self.measure(half));
                [
                    of_each(least_a, least_b, lesser),
                    of_each(greatest_a, greatest_b, greater),
                ]
            }
            None => {
                let [a, b, c] = self.triangles[part[0]];
                [lesser, greater].map(|of: fn(f64, f64) -> f64| of_each(of_each(a, b, of), c, of))
            }
        };
        let place = self.place(part);
        self.bounds[place] = bounds;
        bounds
    }

    fn place(&self, part: Part) -> usize {
        match halves(part) {
            Some([_, [middle, _]]) => middle,
            None => self.triangles.len() + part[0],
        }
    }

    /// Returns the least height of a part along a direction, where a ball sinks below its centre by its radius.
    pub(crate) fn least_height(&self, part: Part, direction: DVec3) -> f64 {
        let none = (f64::INFINITY, 0);
        self.lowest(part, direction.extend(-1.0), none).0
    }

    /// Returns the corner of a part whose centre is lowest along a direction.
    pub(crate) fn lowest_corner(&self, part: Part, direction: DVec3) -> (u32, DVec3) {
        let none = (f64::INFINITY, 3 * part[0]);
        let (_, number) = self.lowest(part, direction.extend(0.0), none);
        let corner = self.triangles[number / 3][number % 3];
        (number as u32, corner.truncate())
    }

    /// Returns the height of the corner of a part that is lowest along a direction, and its number; what is given if none is lower.
    fn lowest(&self, part: Part, direction: DVec4, found: (f64, usize)) -> (f64, usize) {
        let Some(halves) = halves(part) else {
            let corners = self.triangles[part[0]].iter().enumerate();
            return corners.fold(found, |found, (k, corner)| {
                let height = direction.dot(*corner);
                if height < found.0 {
                    (height, 3 * part[0] + k)
                } else {
                    found
                }
            });
        };
        let mut halves = halves.map(|half| (self.lower_bound(half, direction), half));
        if halves[1].0 < halves[0].0 {
            halves.swap(0, 1);
        }
        halves.into_iter().fold(found, |found, (bound, half)| {
            if bound < found.0 {
                self.lowest(half, direction, found)
            } else {
                found
            }
        })
    }

    /// Returns how many boxes and triangles of a part have to be looked at to see that none is lower along a direction than a limit.
    pub(crate) fn looks(&self, part: Part, direction: DVec3, limit: f64) -> usize {
        let halves =
            halves(part).filter(|_| self.lower_bound(part, direction.extend(-1.0)) < limit);
        let of_halves = |halves: [Part; 2]| halves.map(|half| self.looks(half, direction, limit));
        1 + halves.map_or(0, |halves| of_halves(halves).iter().sum())
    }

    /// Returns the least height of the box of a part.
    fn lower_bound(&self, part: Part, direction: DVec4) -> f64 {
        let [least, greatest] = self.bounds[self.place(part)];
        of_each(direction * least, direction * greatest, lesser).element_sum()
    }

    /// Returns the greatest distance of a corner of a part from a point, or more.
    pub(crate) fn reach(&self, part: Part, point: DVec3) -> f64 {
        let [least, greatest] = self.bounds[self.place(part)];
        let point = point.extend(0.0);
        let farthest = of_each(point - least, greatest - point, greater);
        farthest.truncate().length()
    }

    /// Returns the largest radius of a corner.
    pub(crate) fn largest_radius(&self) -> f64 {
        self.bounds[self.place(self.whole())][1].w
    }

    /// Returns half of the size of a part, and 0 for a triangle.
    pub(crate) fn radius(&self, part: Part) -> f64 {
        let [least, greatest] = self.bounds[self.place(part)];
        if part[1] - part[0] > 1 {
            0.5 * (greatest - least).truncate().length()
        } else {
            0.0
        }
    }
}

/// Returns the triangles of one of the engine's bodies.
pub(crate) fn triangles_of(body: &ccd_core::Body) -> Option<Vec<[DVec4; 3]>> {
    let mut triangles: Vec<[DVec4; 3]> = Vec::new();
    for piece in body.pieces().iter() {
        let rounded = |corners: [DVec3; 3]| corners.map(|corner| corner.extend(piece.radius));
        match piece.points {
            [point] => triangles.push(rounded([*point; 3])),
            [from, to] => triangles.push(rounded([*from, *to, *to])),
            [a, b, c] if piece.mesh_triangles().next().is_none() => {
                triangles.push(rounded([*a, *b, *c]));
            }
            _ => {
                let before = triangles.len();
                let corners = piece.mesh_triangles().map(|(_, corners)| corners);
                triangles.extend(corners.map(rounded));
                if triangles.len() == before {
                    return None;
                }
            }
        }
    }
    Some(triangles)
}

/// Returns the halves of a part; `None` if it is a triangle.
pub(crate) fn halves([from, to]: Part) -> Option<[Part; 2]> {
    let middle = from + (to - from) / 2;
    (to - from > 1).then_some([[from, middle], [middle, to]])
}

fn of_each(a: DVec4, b: DVec4, of: fn(f64, f64) -> f64) -> DVec4 {
    let [a, b] = [a, b].map(|v| v.to_array());
    DVec4::from_array([0, 1, 2, 3].map(|k| of(a[k], b[k])))
}

/// Sorts triangles into the order of a tree: in halves along their longest axis, and so on.
fn sort(triangles: &[[DVec4; 3]], order: &mut [u32]) {
    if order.len() > 1 {
        let axis = longest_axis(triangles, order).extend(0.0);
        let place = |k: &u32| triangles[*k as usize].iter().sum::<DVec4>().dot(axis);
        let middle = order.len() / 2;
        order.select_nth_unstable_by(middle, |a, b| place(a).total_cmp(&place(b)));
        let (first, second) = order.split_at_mut(middle);
        sort(triangles, first);
        sort(triangles, second);
    }
}

/// Returns the vertices of triangles in the order of their coordinates, and the triangles in the order of their corners, the
/// least of which comes first.
fn canonical(triangles: &[[DVec4; 3]]) -> (Vec<[f64; 4]>, Vec<[u32; 3]>) {
    let compare = |a: &[f64; 4], b: &[f64; 4]| {
        let coordinates = a.iter().zip(b).map(|(a, b)| a.total_cmp(b));
        coordinates.fold(Ordering::Equal, Ordering::then)
    };
    let mut vertices: Vec<[f64; 4]> = triangles.iter().flatten().map(|v| v.to_array()).collect();
    vertices.sort_by(compare);
    vertices.dedup_by(|a, b| compare(a, b).is_eq());
    let number = |corner: DVec4| {
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

/// Returns the axis along which triangles extend most: the first principal one.
fn longest_axis(triangles: &[[DVec4; 3]], order: &[u32]) -> DVec3 {
    let corners = || {
        let corners = order.iter().flat_map(|&k| triangles[k as usize]);
        corners.map(DVec4::truncate)
    };
    let mean = corners().sum::<DVec3>() / (3 * order.len()) as f64;
    let mut covariance = Matrix3::zeros();
    for corner in corners() {
        let from_mean = nalgebra::Vector3::from((corner - mean).to_array());
        covariance += from_mean * from_mean.transpose();
    }
    let eigen = SymmetricEigen::new(covariance);
    let column = eigen.eigenvectors.column(eigen.eigenvalues.imax());
    let axis = DVec3::new(column[0], column[1], column[2]);
    if axis.is_finite() { axis } else { DVec3::X }
}

fn mesh_bytes(vertices: &[[f64; 4]], faces: &[[u32; 3]]) -> Vec<u8> {
    let mut bytes = Vec::new();
    bytes.extend((vertices.len() as u32).to_le_bytes());
    bytes.extend((faces.len() as u32).to_le_bytes());
    bytes.extend(vertices.iter().flatten().flat_map(|x| x.to_le_bytes()));
    bytes.extend(faces.iter().flatten().flat_map(|k| k.to_le_bytes()));
    bytes
}
