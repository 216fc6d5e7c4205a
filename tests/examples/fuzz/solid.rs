//! Inside or outside of closed triangles, by rays in [`Double`].

use crate::double::Double;
use crate::nearest::{Triangle, distance, normal};
use crate::vector::{Number, Vector, smaller};
use std::collections::HashMap;

/// Where a point lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Where {
    Outside,
    /// By parity and by winding number.
    Inside,
    /// By one of them only: shells in shells of the same orientation.
    Doubtful,
    /// Every ray grazed.
    Unknown,
}

/// Where a point lies that is on no triangle.
pub fn locate(p: Vector<Double>, triangles: &[Triangle<Double>]) -> Where {
    let seen = DIRECTIONS
        .iter()
        .find_map(|&ray| crossings(p, Vector::of(ray), triangles));
    match seen {
        None => Where::Unknown,
        Some((0, crossed)) if crossed % 2 == 0 => Where::Outside,
        Some((winding, crossed)) if winding != 0 && crossed % 2 == 1 => Where::Inside,
        Some(_) => Where::Doubtful,
    }
}

const DIRECTIONS: [[f64; 3]; 8] = [
    [0.31, 0.87, 0.19],
    [-0.73, 0.22, 0.41],
    [0.11, -0.35, 0.93],
    [0.58, -0.61, -0.47],
    [-0.27, -0.83, -0.12],
    [-0.44, 0.53, -0.71],
    [0.91, 0.07, 0.33],
    [0.02, 0.41, -0.89],
];

/// The winding number and the number of crossings of a ray; none where it grazes.
fn crossings(
    p: Vector<Double>,
    ray: Vector<Double>,
    triangles: &[Triangle<Double>],
) -> Option<(i32, u32)> {
    let (mut winding, mut crossed) = (0, 0);
    for t in triangles {
        let size = t
            .iter()
            .fold(0.0, |m, &v| crate::vector::larger(m, (v - p).largest()));
        let grazing = 1e-18 * size * size;
        let sides = [0, 1, 2].map(|k| {
            let side = (t[k] - p).cross(t[(k + 1) % 3] - p).dot(ray).rounded();
            if side > grazing {
                1
            } else if side < -grazing {
                -1
            } else {
                0
            }
        });
        if sides.contains(&1) && sides.contains(&-1) {
            continue;
        }
        let n = (t[1] - t[0]).cross(t[2] - t[0]);
        if sides.contains(&0) {
            // Of a triangle that is seen edge-on, or whose rim the ray meets, nothing is known.
            return None;
        }
        let along = n.dot(t[0] - p) / n.dot(ray);
        if along > Double::new(0.0) {
            winding += sides[0];
            crossed += 1;
        }
    }
    Some((winding, crossed))
}

/// A triangle of every connected part.
pub fn shells(triangles: &[Triangle<Double>]) -> Vec<usize> {
    let mut group: Vec<usize> = (0..triangles.len()).collect();
    // The least of the groups that have a corner at a place.
    let mut at: HashMap<[u64; 3], usize> = HashMap::new();
    loop {
        let mut changed = false;
        for (k, t) in triangles.iter().enumerate() {
            for p in t {
                let first = at
                    .entry(p.0.map(|x| (x.rounded() + 0.0).to_bits()))
                    .or_insert(group[k]);
                changed |= *first != group[k];
                group[k] = group[k].min(*first);
                *first = group[k];
            }
        }
        if !changed {
            break;
        }
    }
    group
        .iter()
        .enumerate()
        .filter(|&(k, &g)| k == g)
        .map(|(k, _)| k)
        .collect()
}

/// How far a point is from a surface.
pub fn clearance(p: Vector<Double>, triangles: &[Triangle<Double>]) -> f64 {
    let apart = triangles.iter().map(|t| distance(&[p; 3], t).rounded());
    apart.fold(f64::INFINITY, smaller)
}

/// Points just off either side of every triangle, by a share of its size.
pub fn beside(triangles: &[Triangle<Double>]) -> Vec<Vector<Double>> {
    let mut points = Vec::new();
    for t in triangles {
        let Some(n) = normal(t) else { continue };
        let weights = [0.5, 0.3, 0.2].map(Double::new);
        let middle = t[0] * weights[0] + t[1] * weights[1] + t[2] * weights[2];
        let off = n * Double::new(1e-3 * (t[1] - t[0]).largest());
        points.extend([middle + off, middle - off]);
    }
    points
}
