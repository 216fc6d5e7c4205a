//! Nonlinear casts: `query::cast_shapes_nonlinear` of one `TriMesh` against another.
//!
//! This is the library's own method for two composites. It walks the nodes of A's hierarchy and
//! casts bounding balls against the bounding ball of all of B, the node hit earliest first. It
//! casts each triangle of A that is reached against B in the same way. Two triangles advance along
//! the axis between their nearest points, by bisection of its gap over *all* the remaining time.
//!
//! # Tolerance
//! None can be set. The advance stops at ten units of rounding (`gjk::eps_tol`, 2.2e-15, or 1.2e-6
//! in single precision), compared with a gap as a length and with a step as a time. Neither the
//! call, nor its dispatcher, nor the shapes give access to it.
//!
//! # Guarantee
//! None. The bisection of a gap that is not monotone (a turn of more than about half a circle) may
//! skip the first root and so be late, as the library's documentation says. The casts of balls have
//! the same flaw and prune by it, so that contacts may be missed. The status `Failed` carries a
//! time, which is taken: the documentation advises it, and flat contacts end that way.

use super::library::math::Real;
use super::library::query::cast_shapes_nonlinear;
use super::library::shape::TriMesh;
use super::shapes::{to_rigid_motion, to_tri_mesh};
use crate::method::peer::contact_claim_at;
use crate::method::solver::{ContactClaim, Reply, Solver};
use anyhow::Result;
use ccd_decomp::TriangleMesh;
use ccd_tables::motions::Motions;

/// Two meshes as parry's shapes, to be cast against each other. It does not report steps.
#[derive(Clone, Debug)]
pub struct CastMeshPair {
    a: TriMesh,
    b: TriMesh,
}

impl CastMeshPair {
    /// Converts two meshes to parry's shapes.
    ///
    /// # Errors
    /// If the library refuses a mesh.
    pub fn new(a: &TriangleMesh, b: &TriangleMesh) -> Result<Self> {
        Ok(CastMeshPair {
            a: to_tri_mesh(a)?,
            b: to_tri_mesh(b)?,
        })
    }
}

impl Solver for CastMeshPair {
    fn answer(&mut self, query: &Motions, _: f64) -> Reply {
        // `true`: bodies that penetrate at the start are reported at once.
        let hit = cast_shapes_nonlinear(
            &to_rigid_motion(&query.a),
            &self.a,
            &to_rigid_motion(&query.b),
            &self.b,
            0.0,
            query.duration as Real,
            true,
        );
        let claim = match hit {
            Ok(Some(hit)) => contact_claim_at(f64::from(hit.time_of_impact), query.duration),
            Ok(None) => ContactClaim::NoContact,
            Err(_) => ContactClaim::Unresolved { safe_until: 0.0 },
        };
        Reply::new(claim, 0)
    }
}
