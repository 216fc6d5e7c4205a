//! What a mesh was made into, and why.

use crate::mesh::repair::Repairs;
use crate::solid::error::DecomposeError;
use crate::solid::topology::Topology;
use ccd_core::Volume;
use serde::{Deserialize, Serialize};
use std::fmt;

/// What a body was made of. Prints as one line for people.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Report {
    /// What its pieces are.
    pub kind: PiecesKind,
    /// Why they are that.
    pub why: Why,
    /// How many triangles its mesh has; 0 for a box, sphere or capsule.
    pub triangles: usize,
    /// How many pieces it has.
    pub pieces: usize,
    /// How many facets of the pieces are no part of the mesh.
    pub virtual_faces: usize,
    /// How many nodes the hierarchy over the pieces has.
    pub tree_nodes: usize,
    /// By how much the pieces were grown so that they certainly cover the mesh, in its unit of length; 0
    /// for all exact kinds.
    pub inflated_by: f64,
    /// How far the pieces reach beyond the solid at most, or beyond the surface of an open mesh, in the
    /// mesh's unit of length: contacts may be reported early by as much. 0 for all exact kinds.
    pub sticks_out: f64,
    /// How many hulls of approximate pieces the library got wrong, so that they were computed exactly: 0 for
    /// all other kinds, whose hulls are exact from the start.
    pub rebuilt_hulls: usize,
    /// Whether being inside of it counts as touching it: when its mesh is closed.
    pub volume: Volume,
    /// How the faces meet, which says why it is solid or not; none for a box, sphere or capsule.
    pub topology: Option<Topology>,
    /// What was amiss with the mesh, and what became of it.
    pub repairs: Repairs,
}

/// What the pieces of a body are.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum PiecesKind {
    /// A box, sphere or capsule: exact.
    Primitive,
    /// The triangles of the mesh: exact.
    Triangles,
    /// Convex patches of the surface, whose hulls lie inside the solid: exact.
    Patches,
    /// The solid itself, which is convex: exact.
    Hull,
    /// Hulls that cover the solid: approximate.
    Vhacd,
}

/// Why a body is made of what it is made of.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub enum Why {
    /// It was asked for.
    Asked,
    /// The solid is convex: one piece is exact, and nothing is less. Against a body of many triangles its
    /// own triangles are taken: pairs of pieces as large as a solid are measured too often there.
    Convex,
    /// Only triangles are exact.
    NothingElse(DecomposeError),
    /// Whether anything else is exact takes longer to tell than it is worth; it may be asked for.
    TooLong,
    /// Queries are estimated to be faster over triangles than over patches.
    TrianglesFaster(Estimate),
    /// Queries are estimated to be faster over patches.
    PatchesFaster(Estimate),
}

/// What a query against a body of many triangles is estimated to take over one kind of pieces or
/// another, in microseconds on the machine that the estimate was measured on: for comparing the two.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Estimate {
    /// Over triangles.
    pub triangles: f64,
    /// Over patches.
    pub patches: f64,
}

impl Report {
    /// Whether the pieces are the solid's surface and nothing outside of it.
    pub fn is_exact(&self) -> bool {
        match self.kind {
            PiecesKind::Primitive
            | PiecesKind::Triangles
            | PiecesKind::Patches
            | PiecesKind::Hull => true,
            PiecesKind::Vhacd => false,
        }
    }

    /// What was amiss with the mesh, for people; empty when nothing was.
    pub fn remarks(&self) -> String {
        let plain = |t: &Topology| {
            t.is_manifold() && t.is_solid() && t.wrong_way.is_empty() && t.signed_volume > 0.0
        };
        let topology = self.topology.as_ref().filter(|t| !plain(t));
        let repairs = Some(&self.repairs).filter(|r| !r.is_empty());
        match (topology, repairs) {
            (Some(topology), Some(repairs)) => format!("{topology}; {repairs}"),
            (Some(topology), None) => topology.to_string(),
            (None, Some(repairs)) => repairs.to_string(),
            (None, None) => String::new(),
        }
    }
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (one, many) = match self.kind {
            PiecesKind::Primitive => ("primitive", "primitives"),
            PiecesKind::Triangles => ("triangle", "triangles"),
            PiecesKind::Patches => ("convex patch", "convex patches"),
            PiecesKind::Hull => ("convex hull", "convex hulls"),
            PiecesKind::Vhacd => ("approximate hull", "approximate hulls"),
        };
        let noun = if self.pieces == 1 { one } else { many };
        write!(f, "{} {noun}, ", self.pieces)?;
        match self.volume {
            Volume::Solid => write!(f, "solid")?,
            Volume::Surface => write!(f, "surface only")?,
        }
        if !self.is_exact() {
            let by = self.sticks_out;
            write!(
                f,
                ", sticking out by up to {by:.3e}: contacts may be early by that"
            )?;
        }
        match self.remarks() {
            remarks if remarks.is_empty() => Ok(()),
            remarks => write!(f, " ({remarks})"),
        }
    }
}

impl fmt::Display for PiecesKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            PiecesKind::Primitive => "primitive",
            PiecesKind::Triangles => "triangles",
            PiecesKind::Patches => "patches",
            PiecesKind::Hull => "hull",
            PiecesKind::Vhacd => "vhacd",
        })
    }
}

impl fmt::Display for Why {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Why::Asked => write!(f, "asked for"),
            Why::Convex => write!(
                f,
                "the solid is convex: one piece, or its triangles against bodies of many"
            ),
            Why::NothingElse(error) => write!(f, "only triangles are exact: {error}"),
            Why::TooLong => {
                let why = DecomposeError::TooLong;
                write!(
                    f,
                    "other pieces take longer to make than is spent unasked: {why}"
                )
            }
            Why::TrianglesFaster(Estimate { triangles, patches }) => {
                let times = patches / triangles;
                write!(
                    f,
                    "over patches a query is estimated to take {times:.1} times as long"
                )
            }
            Why::PatchesFaster(Estimate { triangles, patches }) => {
                let times = triangles / patches;
                write!(
                    f,
                    "over triangles a query is estimated to take {times:.1} times as long"
                )
            }
        }
    }
}
