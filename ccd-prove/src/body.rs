//! A mesh with the tree that its certificate describes.

use ccd_core::glam::DVec3;
use ccd_core::order::{greater, lesser};
use nalgebra::{Matrix3, SymmetricEigen};
use sha2::{Digest, Sha256};
use std::cmp::Ordering;

/// A part of more triangles has a volume.
const FEW: usize = 16;

/// Axes of volumes are multiples of 2⁻¹⁴.
const AXIS_UNIT: f64 = 16_384.0;

/// A mesh, with a tree of volumes around its triangles, and both as bytes.
#[derive(Clone, Debug)]
pub struct Body {
    /// In the order of the tree.
    pub(crate) triangles: Vec<[DVec3; 3]>,
    /// That of a part is where its halves meet.
    volumes: Vec<Option<Volume>>,
    mesh: Vec<u8>,
    /// The SHA-256 digest of the mesh.
    pub(crate) digest: [u8; 32],
    certificate: Vec<u8>,
}

/// Triangles of a body, from one to before another.
pub(crate) type Part = [usize; 2];

#[derive(Clone, Debug)]
struct Volume {
    /// The axes as they are stored, divided by their unit: nearly orthogonal, and nearly of length 1.
    axes: [DVec3; 3],
    ranges: [[f64; 2]; 3],
    /// The least and the greatest coordinates.
    bounds: [DVec3; 2],
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
        let digest: [u8; 32] = Sha256::digest(&mesh).into();
        let mut volumes = vec![None; triangles.len()];
        let mut order: Vec<u32> = (0..triangles.len() as u32).collect();
        let mut axes = Vec::new();
        sort(&triangles, &mut order, 0, &mut |middle, volume: Volume| {
            let numbers = volume.axes.iter().flat_map(|axis| axis.to_array());
            axes.extend(numbers.flat_map(|x| ((x * AXIS_UNIT) as i16).to_le_bytes()));
            volumes[middle] = Some(volume);
        });
        let triangles = order.iter().map(|&k| triangles[k as usize]).collect();
        let order = order.iter().flat_map(|k| k.to_le_bytes());
        let mut certificate = b"CCDBODY1".to_vec();
        certificate.extend(digest.into_iter().chain(order).chain(axes));
        Body {
            triangles,
            volumes,
            mesh,
            digest,
            certificate,
        }
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

    /// Returns the part that has all triangles.
    pub(crate) fn whole(&self) -> Part {
        [0, self.triangles.len()]
    }

    /// Returns the least height of a part along a direction, from a point.
    pub(crate) fn least_height(&self, part: Part, direction: DVec3, point: DVec3) -> f64 {
        let height = match self.volume(part) {
            Some(volume) => volume.least_height(direction),
            None => {
                let heights = self.corners(part).map(|corner| direction.dot(*corner));
                heights.fold(f64::INFINITY, lesser)
            }
        };
        height - direction.dot(point)
    }

    /// Returns the greatest distance of a part from a point, or more.
    pub(crate) fn reach(&self, part: Part, point: DVec3) -> f64 {
        let [least, greatest] = self.bounds(part);
        let farthest = [point - least, greatest - point].map(|v| v.to_array());
        DVec3::from_array([0, 1, 2].map(|k| greater(farthest[0][k], farthest[1][k]))).length()
    }

    /// Returns half of the size of a part, and 0 for a triangle.
    pub(crate) fn radius(&self, part: Part) -> f64 {
        let [least, greatest] = self.bounds(part);
        if part[1] - part[0] > 1 {
            0.5 * (greatest - least).length()
        } else {
            0.0
        }
    }

    /// Returns the corner of a part that is lowest along a direction.
    pub(crate) fn lowest_corner(&self, part: Part, direction: DVec3) -> (u32, DVec3) {
        let (mut index, mut corner) = (0, DVec3::ZERO);
        match self.volume(part) {
            Some(volume) => {
                for (k, (axis, range)) in volume.axes.iter().zip(volume.ranges).enumerate() {
                    let end = usize::from(direction.dot(*axis) < 0.0);
                    index |= (end as u32) << k;
                    corner += *axis * (range[end] / axis.length_squared());
                }
            }
            None => {
                let mut least = f64::INFINITY;
                for (k, point) in self.corners(part).enumerate() {
                    let height = direction.dot(*point);
                    if height < least {
                        (index, corner, least) = (k as u32, *point, height);
                    }
                }
            }
        }
        (index, corner)
    }

    fn volume(&self, part: Part) -> Option<&Volume> {
        self.volumes
            .get(middle(part))?
            .as_ref()
            .filter(|_| part[1] - part[0] > FEW)
    }

    fn bounds(&self, part: Part) -> [DVec3; 2] {
        match self.volume(part) {
            Some(volume) => volume.bounds,
            None => bounds(&self.corners(part)),
        }
    }

    fn corners(&self, [from, to]: Part) -> impl Iterator<Item = &DVec3> + Clone {
        self.triangles[from..to].iter().flatten()
    }
}

/// Returns the halves of a part; `None` if it is a triangle.
pub(crate) fn halves(part @ [from, to]: Part) -> Option<[Part; 2]> {
    (to - from > 1).then_some([[from, middle(part)], [middle(part), to]])
}

fn middle([from, to]: Part) -> usize {
    from + (to - from) / 2
}

/// Sorts triangles from a place on into the order of a tree: halves along their longest axis, and so on. Tells the volumes of
/// parts, the first part's before its halves', and where the halves meet.
fn sort(
    triangles: &[[DVec3; 3]],
    order: &mut [u32],
    from: usize,
    add: &mut impl FnMut(usize, Volume),
) {
    let count = order.len();
    if count == 1 {
        return;
    }
    let axes = axes(triangles, order);
    let place = |k: &u32| triangles[*k as usize].iter().sum::<DVec3>().dot(axes[0]);
    let middle = count / 2;
    order.select_nth_unstable_by(middle, |a, b| place(a).total_cmp(&place(b)));
    if count > FEW {
        let corners = order.iter().flat_map(|&k| &triangles[k as usize]);
        let volume = Volume::around(&corners, axes);
        add(from + middle, volume);
    }
    let (first, second) = order.split_at_mut(middle);
    sort(triangles, first, from, add);
    sort(triangles, second, from + middle, add);
}

impl Volume {
    /// Measures corners along axes, which are in multiples of their unit.
    fn around<'a>(corners: &(impl Iterator<Item = &'a DVec3> + Clone), axes: [DVec3; 3]) -> Self {
        let axes = axes.map(|axis| axis / AXIS_UNIT);
        Volume {
            axes,
            ranges: axes.map(|axis| range(corners.clone(), axis)),
            bounds: bounds(corners),
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
        let [least, greatest] = self.bounds;
        let lost = 4e-10 * (greatest - least).length();
        height
            + [0, 1, 2]
                .map(|k| lesser(rest[k] * least[k], rest[k] * greatest[k]))
                .iter()
                .sum::<f64>()
            - lost
    }
}

/// Returns the least and the greatest height of corners along an axis.
fn range<'a>(corners: impl Iterator<Item = &'a DVec3>, axis: DVec3) -> [f64; 2] {
    let heights = corners.map(|corner| axis.dot(*corner));
    heights.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], height| {
        [lesser(low, height), greater(high, height)]
    })
}

fn bounds<'a>(corners: &(impl Iterator<Item = &'a DVec3> + Clone)) -> [DVec3; 2] {
    let [x, y, z] = DVec3::AXES.map(|axis| range(corners.clone(), axis));
    [0, 1].map(|end| DVec3::new(x[end], y[end], z[end]))
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
