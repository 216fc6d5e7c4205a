//! Finds the shells of a closed surface, and checks their orientation.

use super::error::DecomposeError;
use super::manifold::Manifold;
use crate::disjoint_sets::{DisjointSets, members_by_set};
use crate::exact::rays::{probe_segment, segment_crossing_sign};
use crate::exact::volume::SignedVolume;
use crate::search::region::Region;
use crate::tolerance::MAX_NESTING_RAYS;
use crate::work::WorkBudget;

/// Checks that the solid is behind every face. The solid is where the winding number is not 0.
///
/// Faces meet only where they share an edge or vertex. One point of every shell is therefore enough: the other
/// points of the shell have the same winding number in the rest.
///
/// # Errors
/// [`DecomposeError`]; [`WorkBudgetExceeded`](DecomposeError::WorkBudgetExceeded) if the work does not suffice.
pub(crate) fn check_orientation(
    manifold: &Manifold<'_>,
    work: &WorkBudget,
) -> Result<(), DecomposeError> {
    let shell_of = shell_numbers(manifold);
    let near = manifold.triangle(0)[0];
    let faces_of = members_by_set(&shell_of);
    for faces in &faces_of {
        let triangles = faces.iter().map(|&face| manifold.triangle(face));
        let volume = SignedVolume::from_triangles(triangles, near);
        let face = manifold.mesh().face_ids()[faces[0] as usize];
        let Some(outward) = volume.is_positive() else {
            return Err(DecomposeError::NoVolume { face });
        };
        let around = match faces_of[..] {
            [_] => Some(0),
            _ => winding_number_of_other_shells(manifold, &shell_of, faces, work),
        };
        work.check()?;
        let Some(around) = around else {
            return Err(DecomposeError::UnknownNesting { face });
        };
        // An outward shell adds 1 inside; behind the faces of an inward shell is its outside.
        let behind = if outward { around + 1 } else { around };
        if behind == 0 {
            return Err(DecomposeError::InsideOut { face });
        }
    }
    Ok(())
}

/// Returns for each face the number of the shell that the face belongs to. Shells are connected over edges.
pub(crate) fn shell_numbers(manifold: &Manifold<'_>) -> Vec<u32> {
    let faces = manifold.faces().len();
    let mut shells = DisjointSets::new(faces);
    for half_edge in 0..3 * faces as u32 {
        shells.join(half_edge / 3, manifold.twin(half_edge) / 3);
    }
    shells.set_index_by_element()
}

/// Returns the winding number of all other shells about one shell; `None` if every ray meets an edge or vertex.
fn winding_number_of_other_shells(
    manifold: &Manifold<'_>,
    shell_of: &[u32],
    faces: &[u32],
    work: &WorkBudget,
) -> Option<i32> {
    let shell = shell_of[faces[0] as usize];
    let near = manifold.triangle(faces[0])[0];
    let size = manifold.boxes().farthest_distance_bound(near);
    (0..MAX_NESTING_RAYS).find_map(|k| {
        // Shells may touch at a corner: every attempt uses another one.
        let from = manifold.triangle(faces[k % faces.len()])[k % 3];
        let ray = probe_segment(from, size, k);
        let mut windings = Some(0);
        manifold
            .boxes()
            .all_near_faces_satisfy(&Region::segment(ray), work, |f| {
                if shell_of[f as usize] != shell {
                    let crossing = segment_crossing_sign(ray, manifold.triangle(f));
                    windings = windings.zip(crossing).map(|(sum, one)| sum + one);
                }
                windings.is_some()
            });
        windings
    })
}

#[cfg(test)]
mod tests;
