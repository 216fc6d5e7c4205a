//! Nonlinear casts: `query::cast_shapes_nonlinear` of one `TriMesh` against another.
//!
//! The library's own path for two composites: over the nodes of A's hierarchy, bounding balls are cast
//! against B's whole bounding ball, the node hit earliest first; each triangle of A that is reached is
//! cast against B the same way, and two triangles advance along the axis between their nearest points,
//! by bisection of its gap over *all* the time that is left.
//!
//! # Tolerance
//! None is taken. What stops the advance is ten units of rounding (`gjk::eps_tol`, 2.2e-15, or 1.2e-6 in
//! single precision), held against a gap as a length and against a step as a time; neither the call, nor
//! its dispatcher, nor the shapes lead to it.
//!
//! # Guarantee
//! None: the bisection of a gap that is not monotone (a turn of more than about half a circle) may skip
//! its first root and so be late; the library says so itself. The casts of balls have the same flaw and
//! prune by it, so that contacts may be missed. What it calls `Failed` carries a time, which is taken:
//! its documents advise so, and flat contacts end that way.

use super::library::math::Real;
use super::library::query::cast_shapes_nonlinear;
use super::library::shape::TriMesh;
use super::shapes::{rigid_motion, tri_mesh};
use crate::method::peer::{PeerError, contact_at};
use crate::method::solver::{Claim, Reply, Solver};
use ccd_decomp::TriangleMesh;
use rigid_ccd::table::motions::Query;

/// Two meshes to cast; it tells no steps.
#[derive(Clone, Debug)]
pub struct Cast {
    a: TriMesh,
    b: TriMesh,
}

impl Cast {
    /// Of two meshes.
    ///
    /// # Errors
    /// When the library takes one for no mesh.
    pub fn new(a: &TriangleMesh, b: &TriangleMesh) -> Result<Self, PeerError> {
        Ok(Cast {
            a: tri_mesh(a)?,
            b: tri_mesh(b)?,
        })
    }
}

impl Solver for Cast {
    fn answer(&mut self, query: &Query) -> Reply {
        // True: bodies that penetrate at the start are reported at once.
        let hit = cast_shapes_nonlinear(
            &rigid_motion(&query.a),
            &self.a,
            &rigid_motion(&query.b),
            &self.b,
            0.0,
            query.duration as Real,
            true,
        );
        let claim = match hit {
            Ok(Some(hit)) => contact_at(f64::from(hit.time_of_impact), query.duration),
            Ok(None) => Claim::Free,
            Err(_) => Claim::Unresolved { safe_until: 0.0 },
        };
        Reply { claim, steps: 0 }
    }
}
