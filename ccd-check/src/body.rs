//! A mesh, and a tree of volumes over ranges of its triangles.
//!
//! The certificate of a body says only in which order the triangles are, and along which axes each volume is measured. How far
//! a part extends along them is measured here, on the triangles themselves.

use crate::number::{Ball, Point, dot, product};
use crate::reader::Reader;
use crate::{Stop, sha256};
use alloc::vec::Vec;

/// Axes of volumes are multiples of 2⁻¹⁴.
const AXIS_BITS: u32 = 14;

/// A part of more triangles has a volume.
const FEW: usize = 16;

/// Triangles of a body, from one to before another. Both halves of a part are parts.
pub(crate) type Part = [usize; 2];

/// A mesh with its tree, in integer coordinates.
#[derive(Clone, Debug)]
pub struct Body {
    pub(crate) digest: [u8; 32],
    pub(crate) unit: i32,
    /// The corners of each triangle in the order of the tree. Each is off by less than 1 in each coordinate.
    pub(crate) triangles: Vec<[Point; 3]>,
    /// That of a part is where its halves meet: no other part is halved there.
    volumes: Vec<Volume>,
}

/// The ranges of the coordinates of a part, and of what its heights along directions are bounded by: the different corners of few
/// triangles, or of more the ranges of the heights along three axes.
#[derive(Clone, Debug, Default)]
struct Volume {
    bounds: [[i64; 2]; 3],
    corners: Vec<Point>,
    axes: [Point; 3],
    ranges: [[i64; 2]; 3],
}

impl Body {
    /// Reads a mesh and the certificate of its tree, in the unit of 2 to the power of `unit`.
    ///
    /// # Errors
    /// The verdict, if the certificate is broken or numbers are out of range.
    pub fn new(mesh: &[u8], certificate: &[u8], unit: i32) -> Result<Body, Stop> {
        let triangles = read_mesh(Reader::new(mesh), unit.into())?;
        let (count, digest) = (triangles.len(), sha256(mesh));
        let mut reader = Reader::new(certificate);
        reader.name(b"CCDBODY1")?;
        let is_of_mesh = reader.take(32)? == digest;
        reader.require(is_of_mesh, "this is the certificate of another mesh")?;
        let volumes = alloc::vec![Volume::default(); count];
        let mut body = Body { digest, unit, triangles: Vec::new(), volumes };
        let mut is_missing = alloc::vec![true; count];
        for _ in 0..count {
            let number = reader.index(count)?;
            reader.require(is_missing[number], "the tree has a triangle twice")?;
            is_missing[number] = false;
            body.triangles.push(triangles[number]);
        }
        let mut parts = alloc::vec![[0, count]];
        while let Some(part @ [from, to]) = parts.pop() {
            if to - from > 1 {
                let [first, second] = halves(part);
                let (volume, corners) = (&mut body.volumes[second[0]], body.triangles[from..to].as_flattened());
                volume.bounds = bounds(corners);
                if to - from > FEW {
                    volume.axes = [reader.axis(2)?, reader.axis(2)?, reader.axis(2)?];
                    volume.ranges = volume.axes.map(|axis| range(corners, |corner| (dot(axis, corner) >> AXIS_BITS) as i64));
                } else {
                    volume.corners = corners.to_vec();
                    volume.corners.sort_unstable();
                    volume.corners.dedup();
                }
                parts.extend([second, first]);
            }
        }
        reader.end()?;
        Ok(body)
    }

    /// Returns the largest distance of a part from a point, or more.
    pub(crate) fn reach(&self, part @ [from, to]: Part, point: Point) -> i64 {
        let bounds = if to - from > 1 { self.volume(part).bounds } else { bounds(&self.triangles[from]) };
        let farthest = [0, 1, 2].map(|k| (point[k] - bounds[k][0]).max(bounds[k][1] - point[k]));
        Ball::exact(farthest).length() as i64
    }

    /// Returns the least height of a part along a direction, from a point, or less.
    pub(crate) fn least_height(&self, part @ [from, to]: Part, direction: Point, point: Point) -> i128 {
        let corners = if to - from > 1 { &self.volume(part).corners[..] } else { &self.triangles[from] };
        let heights = corners.iter().map(|&corner| dot(direction, corner));
        let height =
            if to - from > FEW { self.volume(part).least_height(direction) } else { heights.min().unwrap_or(i128::MIN) };
        height - dot(direction, point)
    }

    fn volume(&self, part: Part) -> &Volume {
        &self.volumes[halves(part)[1][0]]
    }
}

pub(crate) fn halves([from, to]: Part) -> [Part; 2] {
    let middle = from + (to - from) / 2;
    [[from, middle], [middle, to]]
}

impl Volume {
    /// Returns a lower bound of the heights of the points along a direction.
    ///
    /// The direction is a sum of multiples of the axes and a rest, whatever the multiples. Each multiple has its least height at
    /// an end of the axis's range, and each coordinate of the rest at an end of that coordinate's.
    fn least_height(&self, direction: Point) -> i128 {
        // Multiples are in 2⁻³⁶, so that their products with the axes are exact.
        let coarse = direction.map(|x| x >> AXIS_BITS);
        let (mut rest, mut height) = (direction, 0);
        for (axis, [low, high]) in self.axes.iter().zip(self.ranges) {
            let multiple = (0..3).map(|k| axis[k] * coarse[k]).sum::<i64>() >> AXIS_BITS;
            // Heights were rounded down.
            height += least(multiple, [low, high + 1]) << AXIS_BITS;
            rest = [0, 1, 2].map(|k| rest[k] - multiple * axis[k]);
        }
        height + (0..3).map(|k| least(rest[k], self.bounds[k])).sum::<i128>()
    }
}

/// Returns the least multiple of the numbers in a range.
fn least(factor: i64, [least, most]: [i64; 2]) -> i128 {
    product(factor, if factor < 0 { most } else { least })
}

/// Returns the least and the greatest of what is measured at corners.
fn range(corners: &[Point], measure: impl Fn(Point) -> i64) -> [i64; 2] {
    let measures = corners.iter().map(|&corner| measure(corner));
    measures.fold([i64::MAX, i64::MIN], |[least, most], x| [least.min(x), most.max(x)])
}

fn bounds(corners: &[Point]) -> [[i64; 2]; 3] {
    [0, 1, 2].map(|k| range(corners, |corner| corner[k]))
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
    reader.require(!triangles.is_empty(), "a mesh is empty")?;
    reader.end()?;
    Ok(triangles)
}
