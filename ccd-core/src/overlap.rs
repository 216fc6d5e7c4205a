//! Whether two pieces truly intersect: a penetration is confirmed before it is believed.

use crate::oracle::PiecePair;
use crate::piece::Piece;
use crate::separation::{Checked, support_gap};
use glam::DVec3;

/// Whether the pieces intersect by more than rounding: their witnesses coincide, and none of the
/// axes that could tell touching pieces apart separates them.
///
/// The axes are those of the separating-axis theorem: the normals of both, and the cross products
/// of their edges (for flat pieces also the normals of their edges within their planes). A piece of
/// more than three points whose facets are not known is taken at the claim's word.
pub(crate) fn intersects(pair: &PiecePair<'_>, checked: &Checked, rounding: f64) -> bool {
    let radii = pair.a.radius + pair.b.radius;
    if radii > 0.0 {
        // Witnesses of the cores that are nearer than the radii are proof enough.
        return checked.core_distance + rounding < radii;
    }
    if checked.core_distance > rounding || checked.lower >= -2.0 * rounding {
        return false;
    }
    let separated = |n: DVec3| !(support_gap(pair, n, checked.witness_a) < -rounding);
    let (edges_a, normals_a) = directions(&pair.a, |v| v);
    let (edges_b, normals_b) = directions(&pair.b, |v| pair.b_to_a.rotation * v);
    let crosses = edges_a
        .iter()
        .flat_map(|e| edges_b.iter().map(move |f| e.cross(*f)));
    let in_plane = |normals: &[DVec3], edges: &[DVec3]| -> Vec<DVec3> {
        let pairs = normals
            .iter()
            .flat_map(|n| edges.iter().map(move |e| n.cross(*e)));
        pairs.collect()
    };
    let mut axes: Vec<DVec3> = crosses.collect();
    if pair.a.points.len() <= 3 && pair.b.points.len() <= 3 {
        axes.extend(in_plane(&normals_a, &edges_a));
        axes.extend(in_plane(&normals_b, &edges_b));
        // Lines and points among them: everything across the other's plane and edges.
        axes.extend(in_plane(&normals_a, &edges_b));
        axes.extend(in_plane(&normals_b, &edges_a));
    }
    axes.extend(normals_a);
    axes.extend(normals_b);
    !axes
        .into_iter()
        .filter_map(DVec3::try_normalize)
        .any(|n| separated(n) || separated(-n))
}

/// The directions of a piece's edges and the normals of its facets, after `turn`.
fn directions(piece: &Piece<'_>, turn: impl Fn(DVec3) -> DVec3) -> (Vec<DVec3>, Vec<DVec3>) {
    let points: Vec<DVec3> = piece.points.iter().map(|&p| turn(p)).collect();
    let all: Vec<u32> = (0..points.len().min(3) as u32).collect();
    let loops: Vec<&[u32]> = match piece.facets.is_empty() {
        true => vec![&all],
        false => piece.facets.iter().collect(),
    };
    let (mut edges, mut normals) = (Vec::new(), Vec::new());
    for corners in loops {
        let at = |k: usize| points[corners[k % corners.len()] as usize];
        edges.extend((0..corners.len()).map(|k| at(k + 1) - at(k)));
        // Newell's sum is robust where three corners alone may be collinear.
        normals.push((1..corners.len()).fold(DVec3::ZERO, |sum, k| {
            sum + (at(k) - at(0)).cross(at(k + 1) - at(0))
        }));
    }
    (edges, normals)
}

#[cfg(test)]
mod tests;
