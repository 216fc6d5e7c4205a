//! Reports on the kind of a body's pieces, and the reason for it.

use crate::mesh::repair::Repairs;
use crate::solid::error::DecomposeError;
use crate::solid::topology::TopologyDefects;
use ccd_core::Solidity;
use serde::{Deserialize, Serialize};
use std::fmt;

/// A report on the pieces of a body. It formats as one line of text.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Report {
    /// The kind of the body's pieces, such as triangles or convex patches.
    pub kind: PiecesKind,
    /// The reason why the pieces are of this kind, such as speed or the caller's request.
    pub reason: PieceReason,
    /// The number of triangles of the mesh; 0 for a body without a mesh.
    pub triangles: usize,
    /// The number of pieces of the body.
    pub pieces: usize,
    /// The number of the pieces' facets that are not part of the mesh.
    pub virtual_facets: usize,
    /// The number of nodes of the hierarchy over the pieces.
    pub tree_nodes: usize,
    /// A bound on how far the pieces extend beyond the solid or the open surface, in the mesh's unit of length. It is
    /// the [excess](ccd_core::Body::excess) of the body. Contacts may be early by it. 0 for exact kinds.
    pub excess: f64,
    /// Whether the body is solid. A closed mesh is solid unless it was made hollow.
    pub volume: Solidity,
    /// The topology of the mesh, which shows why it is solid or not; `None` for a body without a mesh.
    pub topology: Option<TopologyDefects>,
    /// The faults of the mesh that were repaired.
    pub repairs: Repairs,
}

/// The kind of a body's pieces.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum PiecesKind {
    /// The body is a box, sphere or capsule, which is exact, or a polytope around a cylinder or cone.
    Primitive,
    /// The pieces are the triangles of the mesh, which are exact.
    Triangles,
    /// The pieces are convex patches of the surface, whose hulls lie inside the solid. They are exact.
    Patches,
    /// The only piece is the convex solid itself, which is exact.
    Hull,
    /// The only piece is the convex hull of the mesh, which may extend beyond it.
    OuterHull,
}

/// The reason why a body's pieces are of their kind, such as triangles or patches.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub enum PieceReason {
    /// The caller requested the kind.
    Requested,
    /// The solid is convex, so that one piece is exact. Against bodies of many triangles its own triangles are used,
    /// which is faster.
    Convex,
    /// Only the triangles are exact pieces, for the reason that the error states.
    OnlyTrianglesExact(DecomposeError),
    /// Testing whether other pieces are exact exceeds the work budget. They can be requested.
    WorkBudgetExceeded,
    /// Queries are estimated to be faster over triangles than over patches.
    TrianglesFaster(EstimatedQueryTimes),
    /// Queries are estimated to be faster over patches than over triangles.
    PatchesFaster(EstimatedQueryTimes),
}

/// The estimated times of a query with two kinds of pieces, against a body of many triangles. They are in
/// microseconds on the machine that the estimate was measured on. Only the comparison of the two is meaningful.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct EstimatedQueryTimes {
    /// The estimated time of a query with triangles as pieces, in microseconds.
    pub triangles: f64,
    /// The estimated time of a query with patches as pieces, in microseconds.
    pub patches: f64,
}

impl Report {
    /// Creates the report of a body that was not made from a mesh, with one exact piece.
    pub(super) fn new(kind: PiecesKind, why: PieceReason, volume: Solidity) -> Self {
        Report {
            kind,
            reason: why,
            triangles: 0,
            pieces: 1,
            virtual_facets: 0,
            tree_nodes: 1,
            excess: 0.0,
            volume,
            topology: None,
            repairs: Repairs::default(),
        }
    }

    /// Returns whether the pieces cover the solid's surface exactly, without points outside the solid.
    pub fn is_exact(&self) -> bool {
        match self.kind {
            // A polytope around a cylinder or cone exceeds it.
            PiecesKind::Primitive | PiecesKind::OuterHull => self.excess == 0.0,
            PiecesKind::Triangles | PiecesKind::Patches | PiecesKind::Hull => true,
        }
    }

    /// Describes the faults of the mesh as text. The text is empty if there are none.
    pub fn remarks(&self) -> String {
        let plain = |t: &TopologyDefects| {
            t.is_manifold() && t.is_solid() && t.wrong_shells.is_empty() && t.signed_volume > 0.0
        };
        let topology = self.topology.as_ref().filter(|t| !plain(t));
        let repairs = Some(&self.repairs).filter(|r| !r.is_empty());
        let remarks = topology.map(TopologyDefects::to_string).into_iter();
        let remarks = remarks.chain(repairs.map(Repairs::to_string));
        remarks.collect::<Vec<_>>().join("; ")
    }
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [_, one, many] = self.kind.names();
        let noun = if self.pieces == 1 { one } else { many };
        write!(f, "{} {noun}, ", self.pieces)?;
        match self.volume {
            Solidity::Solid => write!(f, "solid")?,
            Solidity::Surface => write!(f, "surface only")?,
        }
        if !self.is_exact() {
            let by = self.excess;
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

impl PiecesKind {
    /// Returns three terms for messages: for the kind, for one piece, and for several pieces.
    fn names(self) -> [&'static str; 3] {
        match self {
            PiecesKind::Primitive => ["primitive", "primitive", "primitives"],
            PiecesKind::Triangles => ["triangles", "triangle", "triangles"],
            PiecesKind::Patches => ["patches", "convex patch", "convex patches"],
            PiecesKind::Hull => ["hull", "convex hull", "convex hulls"],
            PiecesKind::OuterHull => ["outer-hull", "outer hull", "outer hulls"],
        }
    }
}

impl fmt::Display for PiecesKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.names()[0])
    }
}

impl fmt::Display for PieceReason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let slower = |f: &mut fmt::Formatter<'_>, pieces, times: f64| {
            let takes = "a query is estimated to take";
            write!(f, "over {pieces} {takes} {times:.1} times as long")
        };
        match self {
            PieceReason::Requested => write!(f, "asked for"),
            PieceReason::Convex => write!(
                f,
                "the solid is convex: one piece, or its triangles against bodies of many"
            ),
            PieceReason::OnlyTrianglesExact(error) => {
                write!(f, "only triangles are exact: {error}")
            }
            PieceReason::WorkBudgetExceeded => {
                let why = DecomposeError::WorkBudgetExceeded;
                write!(
                    f,
                    "other pieces take longer to make than is spent unasked: {why}"
                )
            }
            PieceReason::TrianglesFaster(EstimatedQueryTimes { triangles, patches }) => {
                slower(f, "patches", patches / triangles)
            }
            PieceReason::PatchesFaster(EstimatedQueryTimes { triangles, patches }) => {
                slower(f, "triangles", triangles / patches)
            }
        }
    }
}
