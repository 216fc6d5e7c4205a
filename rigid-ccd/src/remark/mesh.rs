//! Remarks on meshes that bodies are made of.

use super::Remark;
use ccd_core::Solidity;
use ccd_decomp::{PieceChoice, PiecesKind, Report, TriangleMesh, Unit};

impl Remark {
    /// Returns a remark if a body that was made of a mesh is a surface although none was asked for, has shells that were turned,
    /// or is a single point. A flat one has no inside, and a hull is found wherever it is touched.
    ///
    /// ```
    /// use rigid_ccd::mesh::{PieceChoice, TriangleMesh, body_from_mesh};
    /// use rigid_ccd::Remark;
    /// let corners = vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    /// let mesh = TriangleMesh::new(corners, &[[0, 2, 1], [0, 1, 3], [1, 2, 3]])?;
    /// let made = body_from_mesh(&mesh, PieceChoice::Auto)?;
    /// let remark = Remark::remark_on_mesh(PieceChoice::Auto, &mesh, &made.report);
    /// assert_eq!(remark, Some(Remark::SurfaceOnly { open_edges: 3 }));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn remark_on_mesh(
        asked: PieceChoice,
        mesh: &TriangleMesh,
        report: &Report,
    ) -> Option<Self> {
        let topology = report.topology.as_ref()?;
        let [low, high] = mesh.bounding_box();
        let sides = (high - low).to_array();
        if sides == [0.0; 3] {
            return Some(Remark::PointMesh);
        }
        let is_meant = asked == PieceChoice::Surface || report.kind == PiecesKind::OuterHull;
        if is_meant || sides.contains(&0.0) {
            return None;
        }
        if report.volume == Solidity::Solid {
            let turned_shells = topology.wrong_shells.count();
            return (turned_shells > 0).then_some(Remark::TurnedShells { turned_shells });
        }
        Some(match topology.joining_distance {
            Some(joining_distance) => Remark::OpenSeam { joining_distance },
            None => Remark::SurfaceOnly {
                open_edges: topology.boundary_edges.count(),
            },
        })
    }

    /// Returns a remark if a mesh file [states](ccd_decomp::MeshFile::unit) a unit that is not the metre. It is for callers that
    /// ask for no unit, so that the numbers of the file are kept.
    pub fn remark_on_unit(stated: Option<Unit>) -> Option<Self> {
        let other = stated.filter(|unit| *unit != Unit::Metre)?;
        Some(Remark::UnitOfFile {
            unit: other.symbol(),
        })
    }
}
