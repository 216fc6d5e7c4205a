//! Tests whether points are inside closed surfaces, by rays in [`DoubleDouble`].

use crate::double::DoubleDouble;
use crate::nearest::{Triangle, distance, normal};
use crate::vector::{Number, Vector, larger, smaller};
use std::collections::HashMap;

/// The location of a point relative to a closed surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PointLocation {
    Outside,
    Inside,
    /// The point is inside several parts that touch or cross, or inside a part that crosses itself.
    InSeveralParts,
    /// The location is unknown, because every ray touched an edge or vertex.
    Unknown,
}

/// Closed surfaces, split into connected parts.
pub struct Solid {
    pub triangles: Vec<Triangle<DoubleDouble>>,
    /// For each triangle, the index of the first triangle of its connected part.
    parts: Vec<usize>,
    /// Whether two parts touch or cross each other. Points in several crossing parts are doubtful.
    has_crossing_parts: bool,
}

impl Solid {
    pub fn new(triangles: Vec<Triangle<DoubleDouble>>) -> Self {
        let parts = parts(&triangles);
        let pairs = (0..parts.len()).flat_map(|i| (0..i).map(move |j| (i, j)));
        let meet = |i: usize, j: usize| !(distance(&triangles[i], &triangles[j]).to_f64() > 0.0);
        let crossing = pairs
            .into_iter()
            .any(|(i, j)| parts[i] != parts[j] && meet(i, j));
        Solid {
            triangles,
            parts,
            has_crossing_parts: crossing,
        }
    }

    /// Returns one corner of every connected part.
    pub fn corner_per_part(&self) -> impl Iterator<Item = Vector<DoubleDouble>> {
        let firsts = self
            .parts
            .iter()
            .enumerate()
            .filter(|&(k, &part)| k == part);
        firsts.map(|(k, _)| self.triangles[k][0])
    }

    /// Returns the location of a point relative to the solid. The point is on no triangle. Nested parts are solid and
    /// cavity in turn.
    pub fn locate(&self, p: Vector<DoubleDouble>) -> PointLocation {
        let seen = RAY_DIRECTIONS
            .iter()
            .find_map(|&ray| self.crossings(p, Vector::from_array(ray)));
        let Some(seen) = seen else {
            return PointLocation::Unknown;
        };
        let around = seen
            .values()
            .filter(|(_, crossed)| crossed % 2 == 1)
            .count();
        let repeated = seen
            .values()
            .any(|&(winding, crossed)| winding != 0 && crossed % 2 == 0);
        match around {
            _ if repeated || self.has_crossing_parts && around > 1 => PointLocation::InSeveralParts,
            around if around % 2 == 1 => PointLocation::Inside,
            _ => PointLocation::Outside,
        }
    }

    /// Returns the winding number and the number of crossings of a ray, for every part that it crosses. Returns
    /// `None` if it touches an edge or vertex.
    fn crossings(
        &self,
        p: Vector<DoubleDouble>,
        ray: Vector<DoubleDouble>,
    ) -> Option<HashMap<usize, (i32, u32)>> {
        let mut seen = HashMap::new();
        for (t, &part) in self.triangles.iter().zip(&self.parts) {
            let turn = ray_crossing_sign(p, ray, t)?;
            if turn != 0 {
                let (winding, crossed) = seen.entry(part).or_insert((0, 0));
                *winding += turn;
                *crossed += 1;
            }
        }
        Some(seen)
    }
}

const RAY_DIRECTIONS: [[f64; 3]; 8] = [
    [0.31, 0.87, 0.19],
    [-0.73, 0.22, 0.41],
    [0.11, -0.35, 0.93],
    [0.58, -0.61, -0.47],
    [-0.27, -0.83, -0.12],
    [-0.44, 0.53, -0.71],
    [0.91, 0.07, 0.33],
    [0.02, 0.41, -0.89],
];

/// Returns 1 if a ray crosses a triangle along its normal, −1 if against it, and 0 if it misses the triangle. Returns
/// `None` if the ray touches an edge or vertex.
fn ray_crossing_sign(
    p: Vector<DoubleDouble>,
    ray: Vector<DoubleDouble>,
    t: &Triangle<DoubleDouble>,
) -> Option<i32> {
    let size = t
        .iter()
        .fold(0.0, |m, &v| larger(m, (v - p).max_absolute_component()));
    let grazing = 1e-18 * size * size;
    let sides = [0, 1, 2].map(|k| {
        let side = (t[k] - p).cross(t[(k + 1) % 3] - p).dot(ray).to_f64();
        i32::from(side > grazing) - i32::from(side < -grazing)
    });
    if sides.contains(&1) && sides.contains(&-1) {
        return Some(0);
    }
    if sides.contains(&0) {
        // A triangle seen edge-on, or whose rim the ray meets, decides nothing.
        return None;
    }
    let n = (t[1] - t[0]).cross(t[2] - t[0]);
    let along = n.dot(t[0] - p) / n.dot(ray);
    Some(if along > DoubleDouble::new(0.0) {
        sides[0]
    } else {
        0
    })
}

/// Returns, for every triangle, the index of the first triangle of its connected part.
fn parts(triangles: &[Triangle<DoubleDouble>]) -> Vec<usize> {
    let mut group: Vec<usize> = (0..triangles.len()).collect();
    // The least index of the groups with a corner at the position.
    let mut at: HashMap<[u64; 3], usize> = HashMap::new();
    loop {
        let mut changed = false;
        for (k, t) in triangles.iter().enumerate() {
            for p in t {
                let position = p.0.map(|x| (x.to_f64() + 0.0).to_bits());
                let first = at.entry(position).or_insert(group[k]);
                changed |= *first != group[k];
                group[k] = group[k].min(*first);
                *first = group[k];
            }
        }
        if !changed {
            return group;
        }
    }
}

/// Returns the distance from a point to a surface.
pub fn distance_to_surface(p: Vector<DoubleDouble>, triangles: &[Triangle<DoubleDouble>]) -> f64 {
    let apart = triangles.iter().map(|t| distance(&[p; 3], t).to_f64());
    apart.fold(f64::INFINITY, smaller)
}

/// Returns two points for every triangle that has an area, close to it on either side. Their distance is a fraction of
/// the triangle's size.
pub fn points_beside_triangles(triangles: &[Triangle<DoubleDouble>]) -> Vec<Vector<DoubleDouble>> {
    let mut points = Vec::new();
    for t in triangles {
        let Some(n) = normal(t) else { continue };
        let weights = [0.5, 0.3, 0.2].map(DoubleDouble::new);
        let middle = t[0] * weights[0] + t[1] * weights[1] + t[2] * weights[2];
        let off = n * DoubleDouble::new(1e-3 * (t[1] - t[0]).max_absolute_component());
        points.extend([middle + off, middle - off]);
    }
    points
}
