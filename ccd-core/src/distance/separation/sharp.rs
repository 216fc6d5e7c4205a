//! Raises the lower bound of a checked claim: tries axes from the faces and edges at the nearest points.

use super::{CheckedClaim, support_gap};
use crate::body::piece::{ConvexCombination, Piece};
use crate::distance::oracle::PiecePair;
use crate::math::vector::{unit, vector_perpendicular_to_both};
use glam::{DMat3, DVec3};

/// Raises the lower bound of a checked claim, by axes that the features at its nearest points suggest.
///
/// The vector between nearest points is only as exact as their coordinates. Along it, two pieces that are near for
/// their size lose some of their distance. The normal of a face, or of two edges, is exact to its last bits.
pub(crate) fn improve_axis(
    pair: &PiecePair<'_>,
    checked: &CheckedClaim,
    rounding: f64,
) -> CheckedClaim {
    let radii = pair.a.radius + pair.b.radius;
    let mut best = *checked;
    for axis in axes(pair, checked).into_iter().filter_map(unit) {
        for axis in [axis, -axis] {
            let lower = support_gap(pair, axis, checked.witness_a) - radii - rounding;
            if lower > best.lower {
                best = CheckedClaim {
                    lower,
                    axis,
                    ..best
                };
            }
        }
    }
    best
}

/// Returns the candidate axes, of any length; a missing axis is zero. They are the vector between the nearest points,
/// the vector perpendicular to it and a single edge, the normals of faces, and the normal of two edges.
fn axes(pair: &PiecePair<'_>, checked: &CheckedClaim) -> [DVec3; 4] {
    let way = checked.witness_b - checked.witness_a;
    let axis_in_b = pair.b_to_a.inverse_transform_vector(checked.axis);
    let on_a = Feature::from_combination(&pair.a, &checked.claim.a, checked.axis);
    let on_b = Feature::from_combination(&pair.b, &checked.claim.b, axis_in_b)
        .rotated(pair.b_to_a.rotation);
    let edges = match (on_a.edge, on_b.edge) {
        (Some(e), Some(f)) => vector_perpendicular_to_both(e, f),
        (Some(e), None) | (None, Some(e)) => {
            vector_perpendicular_to_both(vector_perpendicular_to_both(e, way), e)
        }
        (None, None) => DVec3::ZERO,
    };
    [way, edges, on_a.face_normal, on_b.face_normal]
}

/// The vertex, edge or face that contains a nearest point.
struct Feature {
    edge: Option<DVec3>,
    /// The normal of the feature's face, or zero if there is none. For a triangle it is that of the piece. Otherwise it
    /// is that of the facet at the feature's corners which is most perpendicular to the claimed axis.
    face_normal: DVec3,
}

impl Feature {
    /// Returns the feature whose corners a combination names, in the piece's frame.
    fn from_combination(piece: &Piece<'_>, combination: &ConvexCombination, axis: DVec3) -> Self {
        let points = piece.points;
        let way = |from: u32, to: u32| points[to as usize] - points[from as usize];
        let support = combination.point_indices();
        let edge = match *support {
            [a, b, ..] => Some(way(a, b)),
            _ => None,
        };
        let normal = match (support, points.len()) {
            (&[a, b, c, ..], _) => vector_perpendicular_to_both(way(a, b), way(a, c)),
            (_, 3) => vector_perpendicular_to_both(way(0, 1), way(0, 2)),
            (support, _) => facet_normal(piece, support, axis).unwrap_or(DVec3::ZERO),
        };
        Feature {
            edge,
            face_normal: normal,
        }
    }

    fn rotated(self, turn: DMat3) -> Self {
        Feature {
            edge: self.edge.map(|e| turn * e),
            face_normal: turn * self.face_normal,
        }
    }
}

/// Returns the normal of the facet with the given corners whose plane is most perpendicular to an axis.
///
/// Two corners on opposite sides of a facet span no edge, and one corner of a facet may be nearest to a point on the
/// other piece. In both cases the facet keeps the pieces apart.
fn facet_normal(piece: &Piece<'_>, support: &[u32], axis: DVec3) -> Option<DVec3> {
    let holds = |corners: &&[u32]| support.iter().all(|corner| corners.contains(corner));
    let normal = |corners: &[u32]| {
        let third = corners.len() / 3;
        let [a, b, c] = [0, third, 2 * third].map(|k| piece.points[corners[k] as usize]);
        unit(vector_perpendicular_to_both(b - a, c - a))
    };
    let normals = piece.facets.iter().filter(holds).filter_map(normal);
    normals.reduce(|one, other| {
        let is_more_across = other.dot(axis).abs() > one.dot(axis).abs();
        if is_more_across { other } else { one }
    })
}
