//! Meshes made into bodies.

mod choose;
pub(crate) mod error;
pub(crate) mod model;
mod parts;
pub(crate) mod report;

use crate::mesh::TriangleMesh;
use crate::pieces::convex::as_polytope;
use crate::pieces::patches::{Order, decompose};
use crate::pieces::vhacd::approximate;
use crate::solid::bounding_solid;
use crate::solid::topology::Topology;
use error::PrepareError;
use model::{Model, Prepared};
use parts::Parts;
use report::Why;

/// Of what pieces a body is to be made.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Detail {
    /// The least that is exact: one hull for a convex solid, else patches or triangles, whichever is
    /// estimated to be faster for queries.
    #[default]
    Auto,
    /// One piece per triangle: exact for any mesh or soup.
    Triangles,
    /// Convex patches of the surface: exact, for meshes that bound a solid.
    Patches(Order),
    /// The solid itself: exact, for convex ones.
    Hull,
    /// Hulls about its parts: covers any mesh, and sticks out of it.
    Vhacd {
        /// How many hulls at most.
        hulls: u32,
    },
}

/// Makes a body of a mesh: [`prepare`], and [`Model::body`].
///
/// # Guarantee
/// As [`prepare`].
///
/// # Errors
/// As [`prepare`].
pub fn body_from_mesh(mesh: &TriangleMesh, detail: Detail) -> Result<Prepared, PrepareError> {
    prepare(mesh, detail)?.into_prepared()
}

/// Makes the pieces of a mesh, and a hierarchy over them.
///
/// # Guarantee
/// The pieces cover the mesh; but for [`Detail::Vhacd`] they touch nothing outside of the solid that it
/// bounds. The body is solid exactly when the mesh is closed, neighbours run the same way, and of shells
/// that are within others it is [clear](Topology::unclear) what they bound; shells that are inside out are
/// turned round, and the report says so. [`Detail::Auto`] and [`Detail::Triangles`] take any mesh.
///
/// # Errors
/// [`PrepareError::Decompose`] when the mesh does not bound the kind of solid that was asked for,
/// [`PrepareError::Vhacd`], [`PrepareError::Input`] when there are too many pieces.
pub fn prepare(mesh: &TriangleMesh, detail: Detail) -> Result<Model, PrepareError> {
    let (topology, turned) = Topology::and_turned(mesh);
    let mesh = turned.as_ref().unwrap_or(mesh);
    let (parts, why) = match detail {
        Detail::Auto => choose::choose(mesh, &topology),
        Detail::Triangles => (Parts::Triangles, Why::Asked),
        Detail::Patches(order) => (Parts::Patches(decompose(mesh, order)?), Why::Asked),
        Detail::Hull => {
            let polytope = as_polytope(&bounding_solid(mesh)?)?;
            (Parts::Hull(Box::new(polytope)), Why::Asked)
        }
        Detail::Vhacd { hulls } => {
            let approximation = approximate(mesh, &topology, hulls)?;
            (Parts::Vhacd(approximation), Why::Asked)
        }
    };
    parts.into_model(mesh, topology, why)
}

#[cfg(test)]
mod tests;
