//! Decides whether a mesh bounds a solid, by its edges and by pairs of nearby triangles.
//!
//! ```text
//! TriangleMesh ─► topology.rs ─► manifold.rs ─┬─ star_shaped.rs ───────────┬─► bounds a solid
//!                 (nesting.rs)                └─ crossings.rs ─ shells.rs ─┘
//!                                                (flats.rs)
//! ```

pub(crate) mod crossings;
pub(crate) mod error;
pub(crate) mod flats;
pub(crate) mod manifold;
mod nesting;
pub(crate) mod shells;
pub(crate) mod star_shaped;
pub(crate) mod topology;

use crate::mesh::TriangleMesh;
use crate::tally::CountWithExamples;
use crate::work::WorkBudget;
use crossings::crossings;
use error::{Crossing, DecomposeError};
use manifold::Manifold;
use shells::check_orientation;
use star_shaped::star_center;
use topology::TopologyDefects;

/// Returns the surface of the solid that a mesh bounds. Checks every edge, and every pair of nearby triangles.
///
/// A mesh that is entirely inside out is reversed.
///
/// # Errors
/// [`DecomposeError`] if the mesh bounds no solid.
pub(crate) fn solid_surface(mesh: &TriangleMesh) -> Result<Manifold<'_>, DecomposeError> {
    let manifold = Manifold::without_intersection_check(mesh, &TopologyDefects::of(mesh))?;
    check_solid(&manifold, &WorkBudget::unbounded())?;
    Ok(manifold)
}

/// Checks that faces intersect only in shared vertices and edges, and that the solid is behind all faces. Edges alone
/// do not decide this.
///
/// # Errors
/// [`DecomposeError`]; [`WorkBudgetExceeded`](DecomposeError::WorkBudgetExceeded) if the work does not suffice.
pub(crate) fn check_solid(
    manifold: &Manifold<'_>,
    work: &WorkBudget,
) -> Result<(), DecomposeError> {
    if star_center(manifold).is_some() {
        return Ok(());
    }
    let mut pairs = CountWithExamples::default();
    for (face, other) in crossings(manifold, work)? {
        let [face, other] = [face, other].map(|f| manifold.mesh().face_ids()[f as usize]);
        pairs.add(Crossing { face, other });
    }
    if !pairs.is_empty() {
        return Err(DecomposeError::SelfIntersecting { pairs });
    }
    check_orientation(manifold, work)
}
