//! Converts the meshes that a robot's file refers to into bodies.

use super::error::RobotFileError;
use super::mjcf_error::MjcfError;
use crate::remark::CellRemark;
use ccd_core::fan_triangles;
use ccd_decomp::{
    DIVIDED_VERTICES, MeshFile, PieceChoice, PiecesKind, PreparedBody, Remarks, TriangleMesh, Unit,
    body_from_mesh, convex_hull,
};
use rigid_ccd::Body;
use rigid_ccd::glam::{DAffine3, DVec3};
use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// How a mesh becomes a body.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum MeshConversion {
    /// The fewest convex pieces that represent the mesh exactly, see [`PieceChoice::Auto`].
    #[default]
    Exact,
    /// The convex hull, which encloses the mesh with a certified excess, see [`PieceChoice::OuterHull`]. Suitable for
    /// meshes that are convex except for rounding.
    OuterHull,
}

/// The kind of file that refers to meshes, which determines how mesh files are interpreted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum MeshRules {
    /// The rules of Coal: a fourth number of a vertex divides the others, and vertices without a face are ignored.
    Urdf,
    /// The rules of MuJoCo: a fourth number of a vertex is an error unless it is 1, and hulls contain vertices without
    /// a face.
    Mjcf,
}

/// Converts meshes into bodies. A mesh that occurs several times becomes one shared body.
pub(super) struct MeshBodies {
    conversion: MeshConversion,
    rules: MeshRules,
    bodies_by_mesh: RefCell<HashMap<MeshKey, Arc<Body>>>,
    /// For each file that was read, the remarks on what its reader ignored or changed.
    contents: RefCell<BTreeMap<PathBuf, Remarks>>,
    /// Meshes that are used exactly although MuJoCo would use their hulls.
    exact_meshes: RefCell<BTreeSet<PathBuf>>,
}

/// The key of a shared body: the mesh file, and the bits of the map applied to its vertices.
type MeshKey = (PathBuf, [u64; 12]);

impl MeshBodies {
    pub(super) fn new(conversion: MeshConversion, rules: MeshRules) -> Self {
        MeshBodies {
            conversion,
            rules,
            bodies_by_mesh: RefCell::default(),
            contents: RefCell::default(),
            exact_meshes: RefCell::default(),
        }
    }

    /// Returns the remarks on all meshes.
    pub(super) fn into_remarks(self) -> Vec<CellRemark> {
        let name = |path: &PathBuf| path.display().to_string();
        let contents = self.contents.into_inner().into_iter();
        let mut remarks: Vec<CellRemark> = contents
            .map(|(file, content)| CellRemark::MeshContent {
                mesh: name(&file),
                content,
            })
            .collect();
        let meshes: Vec<String> = self.exact_meshes.into_inner().iter().map(name).collect();
        if !meshes.is_empty() {
            remarks.push(CellRemark::ExactMeshes { meshes });
        }
        remarks
    }

    /// Converts a mesh file into a body, with a map applied to its vertices. A reflection also reverses the triangles.
    pub(super) fn body(&self, file: PathBuf, map: DAffine3) -> Result<Arc<Body>, RobotFileError> {
        let key = (file.clone(), map.to_cols_array().map(f64::to_bits));
        if let Some(body) = self.bodies_by_mesh.borrow().get(&key) {
            return Ok(Arc::clone(body));
        }
        // A file without a unit is in metres.
        let mesh = MeshFile::read(&file)?
            .converted_to_unit(Unit::Metre)
            .into_mesh()?;
        let content = &mesh.repairs().remarks;
        let is_divided = content.iter().any(|remark| remark.what == DIVIDED_VERTICES);
        if self.rules == MeshRules::Mjcf && is_divided {
            let shape = "a mesh whose vertices have a fourth number other than 1";
            return Err(MjcfError::UnsupportedShape { shape }.into());
        }
        if !content.is_empty() {
            let mut contents = self.contents.borrow_mut();
            contents.insert(file.clone(), content.clone());
        }
        let body = self.body_of_mesh(&mesh, map, file)?;
        self.bodies_by_mesh
            .borrow_mut()
            .insert(key, Arc::clone(&body));
        Ok(body)
    }

    /// Converts a mesh into a body, with a map applied to its vertices. `file` names the mesh in errors.
    pub(super) fn body_of_mesh(
        &self,
        mesh: &TriangleMesh,
        map: DAffine3,
        file: PathBuf,
    ) -> Result<Arc<Body>, RobotFileError> {
        let prepared = self.prepared(mesh, map, &file)?;
        let is_hull = matches!(
            prepared.report.kind,
            PiecesKind::Hull | PiecesKind::OuterHull
        );
        if self.rules == MeshRules::Mjcf && !is_hull {
            self.exact_meshes.borrow_mut().insert(file);
        }
        Ok(Arc::new(prepared.body))
    }

    /// Converts a height field into a body. MuJoCo does not use the hull of a height field.
    pub(super) fn body_of_height_field(
        &self,
        mesh: &TriangleMesh,
        name: &str,
    ) -> Result<Arc<Body>, RobotFileError> {
        let prepared = self.prepared(mesh, DAffine3::IDENTITY, Path::new(name))?;
        Ok(Arc::new(prepared.body))
    }

    fn prepared(
        &self,
        mesh: &TriangleMesh,
        map: DAffine3,
        file: &Path,
    ) -> Result<PreparedBody, RobotFileError> {
        let choice = match self.conversion {
            MeshConversion::Exact => PieceChoice::Auto,
            MeshConversion::OuterHull => PieceChoice::OuterHull,
        };
        let has_loose_vertices = !mesh.repairs().unreferenced_vertices.is_empty();
        let is_hull_of_all =
            self.rules == MeshRules::Mjcf && choice == PieceChoice::OuterHull && has_loose_vertices;
        let mesh = if is_hull_of_all {
            &hull_mesh(mesh.vertices())?
        } else {
            mesh
        };
        body_from_mesh(&mesh.transformed(map)?, choice).map_err(|error| RobotFileError::Prepare {
            file: file.to_owned(),
            error,
        })
    }
}

/// Returns the convex hull of points as a mesh.
pub(super) fn hull_mesh(points: &[DVec3]) -> Result<TriangleMesh, RobotFileError> {
    let shape = "a mesh without a hull";
    let hull = convex_hull(points).map_err(|_| MjcfError::UnsupportedShape { shape })?;
    let faces: Vec<[u32; 3]> = hull.facets.iter().flat_map(fan_triangles).collect();
    Ok(TriangleMesh::new(hull.points, &faces)?)
}
