//! Whether two pieces truly intersect: a penetration is confirmed before it is believed.

use crate::oracle::PiecePair;
use crate::order::lesser;
use crate::piece::Piece;
use crate::separation::{Checked, support_gap};
use crate::tolerance::MAX_AXES;
use crate::vector::{across, normal, unit};
use glam::DVec3;

/// Whether the pieces intersect by more than rounding: an edge of one passes through the other, or
/// their witnesses coincide and none of the axes that could tell touching pieces apart separates
/// them.
///
/// The axes are those of the separating-axis theorem: the normals of both, and the cross products
/// of their edges (for flat pieces also the normals of their edges within their planes). Polytopes
/// whose facets are not known, or that have too many edges, are taken at the claim's word.
pub(crate) fn intersects(pair: &PiecePair<'_>, checked: &Checked, rounding: f64) -> bool {
    let radii = pair.a.radius + pair.b.radius;
    if radii > 0.0 {
        // Witnesses of the cores that are nearer than the radii are proof enough.
        return checked.core_distance + rounding < radii;
    }
    if checked.lower >= -2.0 * rounding {
        return false;
    }
    if checked.core_distance > rounding {
        // Needles that cross are not always claimed to: an edge through a face is proof enough.
        return pierced(pair, rounding);
    }
    let a = Directions::of(&pair.a, |v| v);
    let b = Directions::of(&pair.b, |v| pair.b_to_a.rotation * v);
    let known = |piece: &Piece<'_>| piece.points.len() <= 3 || !piece.facets.is_empty();
    if !(known(&pair.a) && known(&pair.b)) || a.edges.len() * b.edges.len() > MAX_AXES {
        return true;
    }
    let separates = |n: DVec3| {
        let gap = |n| support_gap(pair, n, checked.witness_a);
        unit(n).is_some_and(|n| !(gap(n) < -rounding && gap(-n) < -rounding))
    };
    let crosses = |p: &[DVec3], q: &[DVec3]| {
        p.iter()
            .any(|&e| q.iter().any(|&f| separates(across(e, f))))
    };
    let flat = pair.a.is_flat() && pair.b.is_flat();
    let normals = a.normals.iter().chain(&b.normals);
    let separated = normals.copied().any(separates)
        || crosses(&a.edges, &b.edges)
        // Polygons, lines and points: everything across a plane and an edge.
        || flat && crosses(&a.normals, &a.edges)
        || flat && crosses(&b.normals, &b.edges)
        || flat && crosses(&a.normals, &b.edges)
        || flat && crosses(&b.normals, &a.edges);
    !separated
}

/// Whether an edge of one triangle certainly passes through the other.
fn pierced(pair: &PiecePair<'_>, rounding: f64) -> bool {
    let (&[a, b, c], &[p, q, r]) = (pair.a.points, pair.b.points) else {
        return false;
    };
    let (one, other) = ([a, b, c], [p, q, r].map(|y| pair.b_to_a.point(y)));
    let edges = |t: [DVec3; 3]| [[t[0], t[1]], [t[1], t[2]], [t[2], t[0]]];
    edges(one)
        .iter()
        .any(|&edge| pierces(edge, other, rounding))
        || edges(other)
            .iter()
            .any(|&edge| pierces(edge, one, rounding))
}

/// Whether an edge certainly passes through a triangle, coordinates being right to `rounding`.
fn pierces([p, q]: [DVec3; 2], triangle: [DVec3; 3], rounding: f64) -> bool {
    let a = triangle[0];
    let Some(normal) = normal(triangle) else {
        return false;
    };
    let (above, below) = (normal.dot(p - a), normal.dot(q - a));
    if !(above * below < 0.0 && lesser(above.abs(), below.abs()) > rounding) {
        return false;
    }
    let share = above / (above - below);
    let crossing = p + (q - p) * share;
    // The flatter the edge meets the plane, the less is known of where.
    let spread = rounding * (1.0 + 2.0 * p.distance(q) / (above - below).abs());
    (0..3).all(|k| {
        let (from, to) = (triangle[k], triangle[(k + 1) % 3]);
        let inward = unit(normal.cross(to - from));
        inward.is_some_and(|inward| inward.dot(crossing - from) > spread)
    })
}

/// The directions of a piece's edges, each once, and the normals of its facets.
struct Directions {
    edges: Vec<DVec3>,
    normals: Vec<DVec3>,
}

impl Directions {
    fn of(piece: &Piece<'_>, turn: impl Fn(DVec3) -> DVec3) -> Self {
        let points: Vec<DVec3> = piece.points.iter().map(|&p| turn(p)).collect();
        let all: Vec<u32> = (0..points.len().min(3) as u32).collect();
        let loops: Vec<&[u32]> = match piece.facets.is_empty() {
            true => vec![&all],
            false => piece.facets.iter().collect(),
        };
        let (mut edges, mut normals) = (Vec::new(), Vec::new());
        for corners in loops {
            let at = |k: usize| points[corners[k % corners.len()] as usize];
            for k in 0..corners.len() {
                // Two facets share an edge, the other way round.
                let once = piece.facets.is_empty() || corners[k] < corners[(k + 1) % corners.len()];
                edges.extend(once.then(|| at(k + 1) - at(k)));
            }
            // Newell's sum is robust where three corners alone may be collinear.
            normals.push((1..corners.len()).fold(DVec3::ZERO, |sum, k| {
                sum + (at(k) - at(0)).cross(at(k + 1) - at(0))
            }));
        }
        Directions { edges, normals }
    }
}

#[cfg(test)]
mod tests;
