//! Finds the direction of least penetration of two overlapping convex pieces.

use crate::order::length;
use ccd_core::glam::DVec3;
use ccd_core::vector::unit;
use ccd_core::{Body, Outcome, Piece, Polytope, Pose};
use rigid_ccd::Solver;

/// The number of pairs of edges up to which their cross products are tried as directions.
const MAX_EDGE_CROSS_PRODUCTS: usize = 4096;

/// Returns the unit vector from the first piece to the second along which they overlap least.
///
/// For rounded pieces whose hulls before rounding are disjoint, it is the direction between these hulls. Otherwise it is
/// the best of the facet normals, the cross products of edges, and the direction between the mean points. If pieces have
/// too many edges, cross products are not tried, and the overlap may be slightly larger than the least one.
pub(super) fn least_overlap_direction(
    pieces: [Piece<'_>; 2],
    poses: [Pose; 2],
    solver: &mut Solver,
) -> Option<DVec3> {
    if let Some(direction) = direction_between_ungrown_hulls(pieces, poses, solver) {
        return Some(direction);
    }
    let [a, b] = [0, 1].map(|k| PlacedPiece::new(&pieces[k], &poses[k]));
    let mut best: Option<(f64, DVec3)> = None;
    let mut try_direction = |axis: DVec3| {
        let Some(axis) = unit(axis) else { return };
        for axis in [axis, -axis] {
            let depth = a.extent_along(axis) + b.extent_along(-axis);
            if depth.is_finite() && best.is_none_or(|(least, _)| depth < least) {
                best = Some((depth, axis));
            }
        }
    };
    try_direction(b.mean_point() - a.mean_point());
    a.face_normals
        .iter()
        .chain(&b.face_normals)
        .for_each(|normal| try_direction(*normal));
    if a.edges.len() * b.edges.len() <= MAX_EDGE_CROSS_PRODUCTS {
        for edge in &a.edges {
            b.edges
                .iter()
                .for_each(|other| try_direction(edge.cross(*other)));
        }
    }
    best.map(|(_, axis)| axis)
}

/// Returns the direction between the two hulls before they are grown by their radii; `None` if the hulls overlap.
fn direction_between_ungrown_hulls(
    pieces: [Piece<'_>; 2],
    poses: [Pose; 2],
    solver: &mut Solver,
) -> Option<DVec3> {
    if pieces.iter().all(|piece| piece.radius == 0.0) {
        return None;
    }
    let core = |piece: Piece<'_>| {
        let points = piece.points.to_vec();
        let core = Polytope {
            points,
            ..Polytope::default()
        };
        Body::polytope(core).ok()
    };
    let [a, b] = pieces.map(core);
    let (a, b) = (a?, b?);
    let answer = solver.distance((&a, poses[0]), (&b, poses[1])).ok()?;
    match answer.outcome {
        Outcome::LeastDistance { lower, contact, .. } if lower > 0.0 => {
            Some(contact.separation.normal)
        }
        _ => None,
    }
}

/// A piece with its points in the world frame.
struct PlacedPiece {
    points: Vec<DVec3>,
    rounding_radius: f64,
    face_normals: Vec<DVec3>,
    edges: Vec<DVec3>,
}

impl PlacedPiece {
    fn new(piece: &Piece<'_>, pose: &Pose) -> Self {
        let points: Vec<DVec3> = piece
            .points
            .iter()
            .map(|p| pose.transform_point(*p))
            .collect();
        let point = |corner: u32| points[corner as usize];
        // Without known facets, all corners are treated as one loop.
        let whole: Vec<u32> = (0..points.len() as u32).collect();
        let loops: Vec<&[u32]> = if piece.facets.is_empty() {
            vec![&whole]
        } else {
            piece.facets.iter().collect()
        };
        let (mut normals, mut edges) = (Vec::new(), Vec::new());
        for corners in loops {
            let sides = (0..corners.len())
                .map(|k| point(corners[(k + 1) % corners.len()]) - point(corners[k]));
            edges.extend(sides.filter(|side| length(*side) > 0.0));
            if let [first, middle @ .., last] = corners
                && let [second, ..] = middle
            {
                normals.push((point(*second) - point(*first)).cross(point(*last) - point(*first)));
            }
        }
        PlacedPiece {
            points,
            rounding_radius: piece.radius,
            face_normals: normals,
            edges,
        }
    }

    /// Returns the extent of the piece along a unit vector, measured from the origin.
    fn extent_along(&self, axis: DVec3) -> f64 {
        let coordinates = self.points.iter().map(|p| axis.dot(*p));
        coordinates.fold(f64::NEG_INFINITY, crate::order::greater) + self.rounding_radius
    }

    fn mean_point(&self) -> DVec3 {
        self.points.iter().sum::<DVec3>() / self.points.len() as f64
    }
}
