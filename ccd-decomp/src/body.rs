//! Meshes made into bodies.

use crate::hierarchy::build_hierarchy;
use crate::mesh::TriangleMesh;
use crate::repair::Repairs;
use crate::topology::Topology;
use ccd_core::{Body, InputError, Pieces, Volume};
use std::fmt;

/// Of what pieces a body is to be made.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Detail {
    /// The fewest pieces that are exactly the mesh; today its triangles.
    #[default]
    Auto,
    /// One piece per triangle: exact for any mesh or soup.
    Triangles,
}

/// A body, and what it was made of.
#[derive(Clone, Debug)]
pub struct Prepared {
    /// Ready for queries.
    pub body: Body,
    /// What it was made of.
    pub report: Report,
}

/// What a body was made of. Prints as one line for people.
#[derive(Clone, Debug, PartialEq)]
pub struct Report {
    /// How many pieces it has.
    pub pieces: usize,
    /// Whether being inside of it counts as touching it: when its mesh is closed.
    pub volume: Volume,
    /// How the faces meet, which says why it is solid or not; none for a box, sphere or capsule.
    pub topology: Option<Topology>,
    /// What was amiss with the mesh, and what became of it.
    pub repairs: Repairs,
}

/// Makes a body of a mesh.
///
/// # Guarantee
/// The pieces cover the mesh. The body is solid exactly when the mesh is closed and consistently
/// oriented; one that is inside out counts as solid, too, and its report says so.
///
/// # Errors
/// [`InputError::TooManyPieces`].
pub fn body_from_mesh(mesh: &TriangleMesh, detail: Detail) -> Result<Prepared, InputError> {
    let pieces = match detail {
        Detail::Auto | Detail::Triangles => {
            Pieces::triangles(mesh.vertices(), mesh.faces(), mesh.face_ids())?
        }
    };
    let topology = Topology::of(mesh);
    let volume = if topology.is_closed() {
        Volume::Solid
    } else {
        Volume::Surface
    };
    let hierarchy = build_hierarchy(&pieces)?;
    Ok(Prepared {
        body: Body::with_hierarchy(&pieces, &hierarchy, volume)?,
        report: Report {
            pieces: pieces.len(),
            volume,
            topology: Some(topology),
            repairs: mesh.repairs().clone(),
        },
    })
}

impl Prepared {
    /// A body that was not made of a mesh.
    pub(crate) fn primitive(body: Body) -> Self {
        Prepared {
            report: Report {
                pieces: body.pieces().len(),
                volume: body.volume(),
                topology: None,
                repairs: Repairs::default(),
            },
            body,
        }
    }
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let plural = if self.pieces == 1 { "" } else { "s" };
        write!(f, "{} piece{plural}, ", self.pieces)?;
        match self.volume {
            Volume::Solid => write!(f, "solid")?,
            Volume::Surface => write!(f, "surface only")?,
        }
        let plain = |t: &Topology| t.is_manifold() && t.signed_volume > 0.0;
        if let Some(topology) = self.topology.as_ref().filter(|t| !plain(t)) {
            write!(f, " ({topology})")?;
        }
        if !self.repairs.is_empty() {
            write!(f, "; {}", self.repairs)?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests;
