//! A mesh of rounded triangles, and a tree of boxes over ranges of them.
//!
//! The certificate of a body says only in which order the triangles are. The boxes are measured here.

use crate::number::{Ball, ONE, Point, dot, product};
use crate::reader::Reader;
use crate::{Stop, sha256};
use alloc::vec::Vec;

/// Triangles of a body, from one to before another.
pub(crate) type Part = [usize; 2];

/// A point, and the radius of the ball around it.
type Corner = [i64; 4];

/// The least and the greatest of each coordinate, and of the radius.
type Bounds = [[i64; 2]; 4];

/// A mesh with its tree, in integer coordinates.
#[derive(Clone, Debug)]
pub struct Body {
    pub(crate) digest: [u8; 32],
    pub(crate) unit: i32,
    /// The corners of each triangle in the order of the tree. Each is off by less than 1 in each coordinate.
    pub(crate) triangles: Vec<[Corner; 3]>,
    /// Those of a part are where its halves meet, as no other part is halved there; those of the triangles follow.
    bounds: Vec<Bounds>,
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
        let bounds = alloc::vec![Bounds::default(); 2 * count];
        let mut body = Body { digest, unit, triangles: Vec::new(), bounds };
        let mut is_missing = alloc::vec![true; count];
        for _ in 0..count {
            let number = reader.index(count)?;
            reader.require(is_missing[number], "the order has a triangle twice")?;
            is_missing[number] = false;
            body.triangles.push(triangles[number]);
        }
        reader.end()?;
        body.measure([0, count]);
        Ok(body)
    }

    /// Measures a part and all parts of it.
    fn measure(&mut self, part @ [from, to]: Part) -> Bounds {
        let bounds = if to - from > 1 {
            let [a, b] = halves(part).map(|half| self.measure(half));
            [0, 1, 2, 3].map(|k| [a[k][0].min(b[k][0]), a[k][1].max(b[k][1])])
        } else {
            let [a, b, c] = self.triangles[from];
            [0, 1, 2, 3].map(|k| [a[k].min(b[k]).min(c[k]), a[k].max(b[k]).max(c[k])])
        };
        let place = self.place(part);
        self.bounds[place] = bounds;
        bounds
    }

    fn place(&self, part @ [from, to]: Part) -> usize {
        if to - from > 1 { halves(part)[1][0] } else { self.triangles.len() + from }
    }

    /// Returns the largest distance of a corner of a part from a point, or more.
    pub(crate) fn reach(&self, part: Part, point: Point) -> i64 {
        let bounds = self.bounds[self.place(part)];
        let farthest = [0, 1, 2].map(|k| (point[k] - bounds[k][0]).max(bounds[k][1] - point[k]));
        Ball::exact(farthest).length() as i64
    }

    /// Returns whether no point of a part is lower along a direction than a limit. A ball sinks below its centre by its radius, as
    /// the plane's normal is no longer than 1.
    pub(crate) fn is_above(&self, part: Part, [x, y, z]: Point, limit: i128) -> bool {
        self.is_above_in(&[x, y, z, -ONE.mid[0]], part, limit)
    }

    fn is_above_in(&self, direction: &[i64; 4], part @ [from, to]: Part, limit: i128) -> bool {
        let [x, y, z, radius] = &self.bounds[self.place(part)];
        let least = |k: usize, range: &[i64; 2]| product(direction[k], range[usize::from(direction[k] < 0)]);
        if least(0, x) + least(1, y) + least(2, z) + least(3, radius) >= limit {
            return true;
        }
        if to - from > 1 {
            halves(part).into_iter().all(|half| self.is_above_in(direction, half, limit))
        } else {
            self.triangles[from].iter().all(|&corner| dot(*direction, corner) >= limit)
        }
    }
}

pub(crate) fn halves([from, to]: Part) -> [Part; 2] {
    let middle = from + (to - from) / 2;
    [[from, middle], [middle, to]]
}

/// Reads a mesh: the numbers of vertices and triangles, the vertices with their radii, and the corners.
fn read_mesh(mut reader: Reader<'_>, unit: i64) -> Result<Vec<[Corner; 3]>, Stop> {
    let [vertex_count, triangle_count] = [reader.unsigned(4)?, reader.unsigned(4)?];
    let (mut vertices, mut triangles) = (Vec::new(), Vec::new());
    for _ in 0..vertex_count {
        let [x, y, z] = reader.vector(unit, 50)?.mid;
        vertices.push([x, y, z, reader.size(unit, 50)?]);
    }
    for _ in 0..triangle_count {
        let [a, b, c] = [(); 3].map(|()| reader.index(vertices.len()));
        triangles.push([vertices[a?], vertices[b?], vertices[c?]]);
    }
    reader.require(!triangles.is_empty(), "a mesh is empty")?;
    reader.end()?;
    Ok(triangles)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::FRACTION;

    /// What is above a limit and how far parts reach, against all corners, for all parts of bodies of one to twelve triangles.
    #[test]
    fn heights_and_distances_are_those_of_the_corners() {
        let mut state = 1u64;
        let mut random = |range: i64| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 40) as i64 % range - range / 2
        };
        let one = i128::from(ONE.mid[0]);
        let (mut above, mut below) = (0, 0);
        for count in 1..=12 {
            let triangles = (0..count).map(|_| [(); 3].map(|()| [random(1000), random(30), random(7), random(9).abs()]));
            let (triangles, bounds) = (triangles.collect(), alloc::vec![Bounds::default(); 2 * count]);
            let mut body = Body { digest: [0; 32], unit: 0, triangles, bounds };
            body.measure([0, count]);
            let mut parts = alloc::vec![[0, count]];
            while let Some(part @ [from, to]) = parts.pop() {
                let corners = body.triangles[from..to].as_flattened();
                let (direction, point) = ([(); 3].map(|()| random(100) << FRACTION), [random(2000), 3, 5]);
                let height = |[x, y, z, radius]: &[i64; 4]| dot(direction, [*x, *y, *z]) - one * i128::from(*radius);
                let height = corners.iter().map(height).min().unwrap();
                for limit in [i128::MIN, height - 1, height, height + 1, one * i128::from(random(100_000))] {
                    let is_above = body.is_above(part, direction, limit);
                    assert_eq!(is_above, height >= limit);
                    if is_above { above += 1 } else { below += 1 }
                }
                let reach = body.reach(part, point);
                for corner in corners {
                    let squares: i64 = (0..3).map(|k| (corner[k] - point[k]) * (corner[k] - point[k])).sum();
                    assert!(reach * reach >= squares);
                }
                if to - from > 1 {
                    parts.extend(halves(part));
                }
            }
        }
        assert!(above > 100 && below > 100, "{above} above, {below} below");
    }
}
