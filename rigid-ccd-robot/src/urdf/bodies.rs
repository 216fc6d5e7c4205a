//! Makes bodies of the shapes and meshes of a URDF.

use super::error::UrdfError;
use super::packages::SearchFolders;
use ccd_decomp::{Detail, MeshFile, Unit, body_from_mesh};
use rigid_ccd::Body;
use rigid_ccd::glam::{DAffine3, DVec3};
use std::cell::RefCell;
use std::collections::HashMap;
use std::path::PathBuf;
use std::sync::Arc;

/// How a mesh of a robot becomes a body: exactly, or as its convex hull.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum MeshConversion {
    /// The fewest convex pieces that represent the mesh exactly: [`Detail::Auto`].
    #[default]
    Exact,
    /// The convex hull, which encloses the mesh and exceeds it by a certified bound: [`Detail::OuterHull`]. It serves links
    /// that are convex but for the rounding of their file.
    OuterHull,
}

/// Makes bodies of shapes and meshes; a mesh that occurs several times becomes one shared body.
pub(super) struct BodyReader<'p> {
    search_folders: &'p SearchFolders,
    mesh_conversion: MeshConversion,
    bodies_by_mesh: RefCell<HashMap<MeshKey, Arc<Body>>>,
}

/// The key of a shared body: the file of the mesh, and the bits of its scale factors along x, y and z.
type MeshKey = (PathBuf, [u64; 3]);

impl<'p> BodyReader<'p> {
    pub(super) fn new(packages: &'p SearchFolders, model: MeshConversion) -> Self {
        BodyReader {
            search_folders: packages,
            mesh_conversion: model,
            bodies_by_mesh: RefCell::default(),
        }
    }

    /// Makes the body of a box, sphere, capsule, cylinder or mesh. A URDF gives full side lengths and full heights, not
    /// halves.
    pub(super) fn body(&self, geometry: &urdf_rs::Geometry) -> Result<Arc<Body>, UrdfError> {
        let body = match geometry {
            urdf_rs::Geometry::Box { size } => Body::cuboid(DVec3::from_array(size.0) / 2.0)?,
            urdf_rs::Geometry::Sphere { radius } => Body::sphere(*radius)?,
            urdf_rs::Geometry::Capsule { radius, length } => Body::capsule(*radius, length / 2.0)?,
            urdf_rs::Geometry::Cylinder { radius, length } => {
                Body::cylinder(*radius, length / 2.0)?
            }
            urdf_rs::Geometry::Mesh { filename, scale } => {
                let scale = scale.map_or(DVec3::ONE, |scale| DVec3::from_array(scale.0));
                return self.mesh_body(filename, scale);
            }
        };
        Ok(Arc::new(body))
    }

    /// Makes the body of a mesh that is scaled along its axes. Negative factors mirror it.
    fn mesh_body(&self, uri: &str, scale: DVec3) -> Result<Arc<Body>, UrdfError> {
        let file = self.search_folders.find_file(uri)?;
        let key = (file.clone(), scale.to_array().map(f64::to_bits));
        if let Some(body) = self.bodies_by_mesh.borrow().get(&key) {
            return Ok(Arc::clone(body));
        }
        // A file without a unit is in metres.
        let mesh = MeshFile::read(&file)?
            .converted_to_unit(Unit::Metre)
            .into_mesh()?;
        let mesh = mesh.transformed(DAffine3::from_scale(scale))?;
        let detail = match self.mesh_conversion {
            MeshConversion::Exact => Detail::Auto,
            MeshConversion::OuterHull => Detail::OuterHull,
        };
        let prepared =
            body_from_mesh(&mesh, detail).map_err(|error| UrdfError::Prepare { file, error })?;
        let body = Arc::new(prepared.body);
        self.bodies_by_mesh
            .borrow_mut()
            .insert(key, Arc::clone(&body));
        Ok(body)
    }
}
