//! Finds the self-intersections of a mesh.

mod fanned_polygons;

use super::manifold::Manifold;
use crate::exact::triangles::meet_outside_shared_corners;
use crate::search::region::Region;
use crate::tolerance::MAX_CROSSINGS;
use crate::work::{WorkBudget, WorkBudgetExhausted};
use fanned_polygons::FannedPolygons;

/// Returns the pairs of faces that meet outside shared vertices and edges. The list ends at [a thousand](MAX_CROSSINGS)
/// pairs.
///
/// # Errors
/// [`WorkBudgetExhausted`] if the work does not suffice.
pub(crate) fn crossings(
    manifold: &Manifold<'_>,
    work: &WorkBudget,
) -> Result<Vec<(u32, u32)>, WorkBudgetExhausted> {
    let mut found = Vec::new();
    let fanned = FannedPolygons::from_manifold(manifold);
    if fanned.is_none() {
        // The two faces at each edge are a pair that is tested. Building the search trees takes longer than many tests.
        work.check_exceeds(manifold.faces().len() / 2 * 3 * STEPS_PER_PAIR)?;
    }
    for face in 0..manifold.faces().len() as u32 {
        let near = Region::from_triangle(manifold.triangle(face));
        let mut pair = |other: u32| {
            if faces_cross(manifold, face, other) {
                found.push((face.min(other), face.max(other)));
            }
            found.len() < MAX_CROSSINGS && work.spend(STEPS_PER_PAIR)
        };
        let goes_on = match &fanned {
            Some(fanned) => fanned.all_near_faces_satisfy(face, &near, work, pair),
            None => manifold
                .boxes()
                .all_near_faces_satisfy(&near, work, |other| other <= face || pair(other)),
        };
        if !goes_on {
            work.check()?;
            break;
        }
    }
    found.sort_unstable();
    Ok(found)
}

/// The approximate number of exact predicates that the test of one pair costs.
const STEPS_PER_PAIR: usize = 4;

/// Returns whether two faces meet outside their shared corners.
fn faces_cross(manifold: &Manifold<'_>, one: u32, other: u32) -> bool {
    let corners = [one, other].map(|f| manifold.faces()[f as usize]);
    meet_outside_shared_corners(corners, [one, other].map(|f| manifold.triangle(f)))
}

#[cfg(test)]
mod tests;
