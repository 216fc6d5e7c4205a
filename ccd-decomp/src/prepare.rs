//! Prepares meshes for queries: makes convex pieces of them, and bodies of the pieces.

mod choose;
pub(crate) mod error;
pub(crate) mod model;
mod parts;
pub(crate) mod report;

use crate::mesh::TriangleMesh;
use crate::pieces::convex::convex_polytope;
use crate::pieces::outer_hull::outer_hull;
use crate::pieces::patches::{PatchOrder, decompose};
use crate::solid::solid_surface;
use crate::solid::topology::TopologyDefects;
use crate::tolerance::AUTO_WORK_BUDGET;
use crate::work::WorkBudget;
use ccd_core::Solidity;
use error::PrepareError;
use model::{PreparedBody, StoredBodyContent};
use parts::{ChosenPieces, PiecesOfOneKind, triangle_tree};
use report::PieceReason;

/// The kind of pieces that a body is made of.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum PieceChoice {
    /// Chooses the fewest exact pieces: one hull for a convex solid, else patches or triangles, whichever is
    /// estimated to be faster for queries.
    #[default]
    Auto,
    /// Makes one piece of every triangle, which is exact for any mesh or triangle soup.
    Triangles,
    /// Makes one piece of every triangle, without volume: a closed mesh is a hollow surface.
    Surface,
    /// Makes convex patches of the surface, which are exact for meshes that bound a solid.
    Patches(PatchOrder),
    /// Makes one piece of the whole solid, which is exact for convex solids.
    Hull,
    /// Makes one piece, the convex hull of the mesh. It encloses any mesh, and exceeds it by a certified bound, which
    /// [`Report::excess`](crate::Report::excess) states.
    OuterHull,
}

/// Creates a body from a mesh: calls [`prepare`], then [`StoredBodyContent::into_prepared_body`].
///
/// ```
/// use ccd_core::glam::dvec3;
/// use ccd_decomp::{PieceChoice, TriangleMesh, body_from_mesh};
/// // An L of two boxes, extruded along z: six corners below and six above.
/// let outline = [(0.0, 0.0), (2.0, 0.0), (2.0, 1.0), (1.0, 1.0), (1.0, 2.0), (0.0, 2.0)];
/// let ring = |z| outline.map(|(x, y)| dvec3(x, y, z));
/// let vertices = [ring(0.0), ring(1.0)].concat();
/// let mut faces = Vec::new();
/// for [a, b, c] in [[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5]] {
///     faces.extend([[a, c, b], [6 + a, 6 + b, 6 + c]]);
/// }
/// for k in 0..6 {
///     let next = (k + 1) % 6;
///     faces.extend([[k, next, 6 + next], [k, 6 + next, 6 + k]]);
/// }
/// let mesh = TriangleMesh::new(vertices, &faces)?;
///
/// let prepared = body_from_mesh(&mesh, PieceChoice::Triangles)?;
/// assert_eq!(prepared.report.to_string(), "20 triangles, solid");
/// // An L is not its own hull: the error names the edge at the inner corner.
/// let error = body_from_mesh(&mesh, PieceChoice::Hull).unwrap_err();
/// assert_eq!(error.to_string(), "not convex at e3-9; use patches or triangles");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Guarantee
/// The pieces cover the mesh, and the body is solid if the mesh bounds a solid: see [`prepare`].
///
/// # Errors
/// [`PrepareError::Decompose`] if the mesh does not bound the requested kind of solid, [`PrepareError::Hull`] if its
/// hull cannot be computed, [`PrepareError::Input`] if there are too many pieces.
pub fn body_from_mesh(
    mesh: &TriangleMesh,
    choice: PieceChoice,
) -> Result<PreparedBody, PrepareError> {
    prepare(mesh, choice)?.into_prepared_body()
}

/// Makes the convex pieces of a mesh and a hierarchy over them. The result is a model, which can be stored.
///
/// # Guarantee
/// The pieces cover the mesh. Except with [`PieceChoice::OuterHull`], they touch nothing outside the solid that it bounds.
/// Except with [`PieceChoice::Surface`], the body is solid exactly when the mesh is closed, neighbouring faces are oriented
/// alike, and it is [clear](TopologyDefects::unclear_shells) which shells bound material and which a cavity. Shells that are inside
/// out are reversed, and the report says so. [`PieceChoice::Auto`] and [`PieceChoice::Triangles`] take any mesh.
///
/// # Errors
/// [`PrepareError::Decompose`] if the mesh does not bound the requested kind of solid, [`PrepareError::Hull`] if its
/// hull cannot be computed, [`PrepareError::Input`] if there are too many pieces.
pub fn prepare(
    mesh: &TriangleMesh,
    choice: PieceChoice,
) -> Result<StoredBodyContent, PrepareError> {
    let may_need_triangles = !matches!(choice, PieceChoice::Patches(_) | PieceChoice::OuterHull);
    // Both take equally long, and the triangles are nearly always needed.
    let (choice, triangles) = rayon::join(
        || ChosenPieces::new(mesh, choice),
        || may_need_triangles.then(|| triangle_tree(mesh)),
    );
    choice?.into_model(mesh, triangles.transpose()?)
}

impl ChosenPieces {
    fn new(mesh: &TriangleMesh, choice: PieceChoice) -> Result<Self, PrepareError> {
        let (topology, turned) = TopologyDefects::with_reoriented_mesh(mesh);
        let mesh = turned.as_ref().unwrap_or(mesh);
        let requested = |pieces| (pieces, PieceReason::Requested);
        let (pieces, reason) = match choice {
            PieceChoice::Auto => {
                choose::choose_pieces(mesh, &topology, &WorkBudget::with_steps(AUTO_WORK_BUDGET))
            }
            PieceChoice::Triangles | PieceChoice::Surface => requested(PiecesOfOneKind::Triangles),
            PieceChoice::Patches(order) => {
                requested(PiecesOfOneKind::Patches(decompose(mesh, order)?))
            }
            PieceChoice::Hull => {
                let polytope = convex_polytope(&solid_surface(mesh)?)?;
                requested(PiecesOfOneKind::Hull(Box::new(polytope)))
            }
            PieceChoice::OuterHull => {
                let hull = outer_hull(mesh, &topology)?;
                requested(PiecesOfOneKind::OuterHull(Box::new(hull)))
            }
        };
        let volume = if topology.is_solid() && choice != PieceChoice::Surface {
            Solidity::Solid
        } else {
            Solidity::Surface
        };
        Ok(ChosenPieces {
            solidity: volume,
            pieces,
            choice_reason: reason,
            topology,
            reoriented_mesh: turned,
        })
    }
}

#[cfg(test)]
mod tests;
