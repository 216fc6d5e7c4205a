//! Ignores the overlap of pieces at the start of a linear cast if they begin to separate, as parry does.
//!
//! Two convex pieces that move in straight lines overlap for one interval of time. After they separate they never meet
//! again. So a pair that begins to separate is ignored, and all other pairs are examined. parry also examines each pair
//! separately.

mod direction;

use crate::geometry::ShapeGeometry;
use crate::order::{greater, length, lesser};
use crate::scene::{CastHit, CastStatus, Scene};
use crate::tolerance::{MAX_SLIDING_APPROACH_RATIO, ROUNDING_ENLARGEMENT};
use crate::{BodyOfShape, CastError};
use ccd_core::Piece;
use ccd_core::glam::DVec3;
use direction::least_overlap_direction;
use rigid_ccd::Solver;

/// The maximum number of pairs of pieces that are ignored because they separate or slide. Beyond it the bodies are in
/// contact at the start.
const MAX_SEPARATING_PAIRS: usize = 256;

/// Returns the first contact of all pairs of pieces that do not begin to separate. If one of these pairs overlaps at the
/// start, returns `overlap`, the hit at the start.
pub(crate) fn first_contact_unless_separating(
    scene: &Scene<'_>,
    overlap: CastHit,
    solver: &mut Solver,
) -> Result<Option<CastHit>, CastError> {
    // Each task is two sets of pieces, one of each body, all pairs of which are to be examined.
    let mut tasks = vec![[0, 1].map(|k| piece_indices_near_other(scene, k))];
    let (mut first, mut ignored_count): (Option<CastHit>, _) = (None, 0);
    while let Some(task) = tasks.pop() {
        if task.iter().any(Vec::is_empty) {
            continue;
        }
        let Some(hit) = first_contact_of_pieces(scene, &task, solver)? else {
            continue;
        };
        match hit.status {
            CastStatus::Overlap => {
                ignored_count += 1;
                let [a, b] = hit.sub_shape_indices;
                if ignored_count > MAX_SEPARATING_PAIRS
                    || !pieces_separate_or_slide(scene, [a, b], solver)
                {
                    return Ok(Some(overlap));
                }
                let [mut pieces_a, pieces_b] = task;
                let others_of_b = pieces_b.iter().copied().filter(|piece| *piece != b);
                tasks.push([vec![a], others_of_b.collect()]);
                pieces_a.retain(|piece| *piece != a);
                tasks.push([pieces_a, pieces_b]);
            }
            CastStatus::Inside => return Ok(Some(overlap)),
            CastStatus::WithinTargetAtStart | CastStatus::Contact | CastStatus::Limit => {
                if first.is_none_or(|first| hit.time < first.time) {
                    let sub_shape_indices =
                        [0, 1].map(|k| scene.bodies[k].sub_shape_index(hit.sub_shape_indices[k]));
                    first = Some(CastHit {
                        sub_shape_indices,
                        ..hit
                    });
                }
            }
        }
    }
    Ok(first)
}

/// Finds the first contact of all pairs of two sets of pieces. The sub-shapes of the hit are the pieces.
fn first_contact_of_pieces(
    scene: &Scene<'_>,
    pieces: &[Vec<u32>; 2],
    solver: &mut Solver,
) -> Result<Option<CastHit>, CastError> {
    let bodies = [0, 1].map(|k| body_of_pieces(scene.bodies[k], &pieces[k]));
    let [a, b] = CastError::shapes_or_error(bodies)?;
    let part = Scene {
        bodies: [&a, &b],
        ..scene.clone()
    };
    part.first_contact(solver)
}

/// Returns a body of the given pieces, with the pieces' indices as sub-shape indices.
fn body_of_pieces(body: &BodyOfShape, pieces: &[u32]) -> Result<BodyOfShape, crate::ShapeError> {
    let mut geometry = ShapeGeometry::EMPTY;
    for &number in pieces {
        let piece = body.body().pieces().get(number as usize);
        geometry.push_hull(
            piece.points.to_vec(),
            piece.radius,
            piece.facets.iter(),
            number,
        );
    }
    BodyOfShape::new(&geometry)
}

/// Returns the indices of the pieces of body `k` that the other body may reach during the cast.
fn piece_indices_near_other(scene: &Scene<'_>, k: usize) -> Vec<u32> {
    let [this, other] = [k, 1 - k].map(|k| (scene.bodies[k], &scene.motions[k]));
    let velocity = other.1.velocity() - this.1.velocity();
    let displacement = velocity * scene.horizon.duration();
    let (center, radius) = other.0.enclosing_ball;
    // The position at the start, in the world.
    let from = other.1.start().transform_point(center);
    let within = scene.settings.margin + scene.settings.tolerance + radius;
    let comes_near = |piece: &Piece<'_>| {
        let (center, radius) = bounding_ball(piece);
        let position = this.1.start().transform_point(center);
        let rounding =
            (ROUNDING_ENLARGEMENT - 1.0) * (length(position) + length(from) + length(displacement));
        let distance = distance_to_segment(position - from, displacement);
        // The comparison treats NaN as near.
        !(distance > (within + radius) * ROUNDING_ENLARGEMENT + rounding)
    };
    let pieces = (0..).zip(this.0.body().pieces().iter());
    pieces
        .filter(|(_, piece)| comes_near(piece))
        .map(|(number, _)| number)
        .collect()
}

/// Returns the distance of `point` from the segment between the origin and `displacement`.
fn distance_to_segment(point: DVec3, displacement: DVec3) -> f64 {
    let square = displacement.dot(displacement);
    let fraction = if square > 0.0 {
        lesser(greater(0.0, point.dot(displacement) / square), 1.0)
    } else {
        0.0
    };
    length(point - fraction * displacement)
}

/// Returns a ball around a piece: its center and its radius.
fn bounding_ball(piece: &Piece<'_>) -> (DVec3, f64) {
    let first = piece.points[0];
    let distances = piece.points.iter().map(|p| length(*p - first));
    (first, distances.fold(0.0, greater) + piece.radius)
}

/// Returns whether two pieces that overlap at the start begin to move apart, or slide along each other.
fn pieces_separate_or_slide(scene: &Scene<'_>, numbers: [u32; 2], solver: &mut Solver) -> bool {
    let pieces = [0, 1].map(|k| scene.bodies[k].body().pieces().get(numbers[k] as usize));
    let poses = scene.motions.map(|motion| motion.start());
    let velocity = scene.motions[1].velocity() - scene.motions[0].velocity();
    // The comparison is false for NaN, which does not separate.
    let least = -MAX_SLIDING_APPROACH_RATIO * length(velocity);
    least_overlap_direction(pieces, poses, solver)
        .is_some_and(|normal| normal.dot(velocity) >= least)
}

#[cfg(test)]
mod tests;
