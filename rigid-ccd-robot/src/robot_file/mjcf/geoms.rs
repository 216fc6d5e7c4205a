//! Converts the geoms of an MJCF into bodies and planes.

use super::assets::MeshSource;
use super::bodies::{MjcfBody, MjcfGeom};
use super::height_fields::height_field_mesh;
use super::model::MjcfModel;
use super::orientation::rotation_of_z_to;
use crate::robot::{Link, LinkBody};
use crate::robot_file::body_elements::BodyElements;
use crate::robot_file::error::RobotFileError;
use crate::robot_file::meshes::{MeshBodies, hull_mesh};
use crate::robot_file::mjcf_error::MjcfError;
use ccd_decomp::TriangleMesh;
use rigid_ccd::glam::DVec3;
use rigid_ccd::{Body, Pose};
use std::path::PathBuf;
use std::sync::Arc;

/// The first geom group that MuJoCo does not draw by default.
const FIRST_HIDDEN_GROUP: i32 = 3;

/// The geom types that accept `fromto`.
const TYPES_WITH_FROMTO: [&str; 4] = ["capsule", "cylinder", "box", "ellipsoid"];

/// Converts the geoms of a model into bodies and planes.
pub(super) struct GeomReader<'r> {
    pub(super) mjcf: &'r MjcfModel,
    pub(super) elements: BodyElements,
    pub(super) meshes: &'r MeshBodies,
}

impl GeomReader<'_> {
    /// Adds the geoms of a body to its link.
    pub(super) fn add_to(&self, link: &mut Link, body: &MjcfBody) -> Result<(), RobotFileError> {
        for (index, geom) in body.geoms.iter().enumerate() {
            self.add_geom(link, geom).map_err(|error| {
                let name = geom.name().map_or_else(|| index.to_string(), str::to_owned);
                error.within("geom", &name)
            })?;
        }
        Ok(())
    }

    /// Adds a geom to its link, if it is of the selected kind.
    fn add_geom(&self, link: &mut Link, geom: &MjcfGeom) -> Result<(), RobotFileError> {
        let attributes = &geom.attributes;
        let is_body = match self.elements {
            BodyElements::Collision => self.mjcf.is_solid(geom),
            BodyElements::Visual => attributes.integer_or("group", 0)? < FIRST_HIDDEN_GROUP,
        };
        if !is_body {
            return Ok(());
        }
        let kind = attributes.get("type").unwrap_or("sphere");
        if attributes.get("fromto").is_some() && !TYPES_WITH_FROMTO.contains(&kind) {
            return Err(attributes.invalid("fromto").into());
        }
        let body = match kind {
            "plane" => {
                link.planes.push(geom.pose);
                return Ok(());
            }
            "mesh" => self.mesh(attributes.required_name("mesh")?)?,
            "hfield" => self.height_field(attributes.required_name("hfield")?)?,
            _ if attributes.name("mesh").is_some() => {
                return Err(unsupported("a shape that is fitted to a mesh"));
            }
            _ => {
                let (body, pose) = primitive(geom, kind)?;
                let body = Arc::new(body);
                link.bodies.push(LinkBody { body, pose });
                return Ok(());
            }
        };
        let pose = geom.pose;
        link.bodies.push(LinkBody { body, pose });
        Ok(())
    }

    fn mesh(&self, name: &str) -> Result<Arc<Body>, RobotFileError> {
        let Some(asset) = self.mjcf.assets.meshes.get(name) else {
            return Err(MjcfError::unknown_name("mesh", name).into());
        };
        match &asset.source {
            MeshSource::File(uri) => self.meshes.body(self.file(uri)?, asset.map),
            MeshSource::Builtin => Err(unsupported("a mesh that MuJoCo makes")),
            MeshSource::InModel { vertices, faces } => {
                let mesh = match &faces[..] {
                    [] => hull_mesh(vertices)?,
                    faces => TriangleMesh::new(vertices.clone(), faces)?,
                };
                self.meshes.body_of_mesh(&mesh, asset.map, name.into())
            }
        }
    }

    fn height_field(&self, name: &str) -> Result<Arc<Body>, RobotFileError> {
        let Some(attributes) = self.mjcf.assets.height_fields.get(name) else {
            return Err(MjcfError::unknown_name("hfield", name).into());
        };
        let file = attributes
            .name("file")
            .map(|uri| self.file(uri))
            .transpose()?;
        let mesh = height_field_mesh(attributes, file.as_deref())?;
        self.meshes.body_of_height_field(&mesh, name)
    }

    /// Returns the path of a mesh file.
    fn file(&self, uri: &str) -> Result<PathBuf, RobotFileError> {
        let file = self.mjcf.settings.mesh_file(uri);
        if file.is_file() {
            return Ok(file);
        }
        Err(RobotFileError::MeshNotFound {
            uri: uri.to_owned(),
            searched_paths: vec![file],
        })
    }
}

/// Creates the body of a primitive geom. Returns it with its pose.
fn primitive(geom: &MjcfGeom, kind: &str) -> Result<(Body, Pose), RobotFileError> {
    let attributes = &geom.attributes;
    let (pose, sizes) = pose_and_sizes(geom, kind)?;
    let body = match (kind, &sizes[..]) {
        ("sphere", &[radius, ..]) => Body::sphere(radius)?,
        ("capsule", &[radius, half_height, ..]) => Body::capsule(radius, half_height)?,
        ("cylinder", &[radius, half_height, ..]) => Body::cylinder(radius, half_height)?,
        ("box", &[x, y, z]) => Body::cuboid([x, y, z])?,
        ("ellipsoid", &[x, y, z]) => ccd_decomp::ellipsoid([x, y, z])?,
        ("sdf", _) => return Err(unsupported("a signed distance field")),
        ("sphere" | "capsule" | "cylinder" | "box" | "ellipsoid", _) => {
            return Err(attributes.invalid("size").into());
        }
        _ => return Err(attributes.invalid("type").into()),
    };
    Ok((body, pose))
}

/// Returns the pose and the sizes of a geom. Sizes are half lengths. `fromto` may specify the pose and a size.
fn pose_and_sizes(geom: &MjcfGeom, kind: &str) -> Result<(Pose, Vec<f64>), RobotFileError> {
    let attributes = &geom.attributes;
    let sizes = attributes.numbers("size")?.unwrap_or_default();
    let (pose, sizes) = match attributes.array("fromto")? {
        None => (geom.pose, sizes),
        Some([x, y, z, to_x, to_y, to_z]) => {
            let (from, to) = (DVec3::new(x, y, z), DVec3::new(to_x, to_y, to_z));
            let axis = attributes.direction("fromto", from - to)?;
            if attributes.array("pos")?.is_some_and(|at| at != [0.0; 3]) {
                return Err(attributes.invalid("pos").into());
            }
            let pose = Pose::new(0.5 * (from + to), rotation_of_z_to(axis))?;
            let half_length = 0.5 * from.distance(to);
            let radius = sizes.first().copied().unwrap_or(0.0);
            let sizes = match kind {
                "capsule" | "cylinder" => vec![radius, half_length],
                _ => vec![radius, radius, half_length],
            };
            (geom.frame.compose(&pose), sizes)
        }
    };
    let is_shape = kind == "sphere" || TYPES_WITH_FROMTO.contains(&kind);
    let size_count = match kind {
        "sphere" => 1,
        "capsule" | "cylinder" => 2,
        _ => 3,
    };
    let is_positive = sizes.iter().take(size_count).all(|&size| size > 0.0);
    if sizes.len() > 3 || is_shape && !(is_positive && sizes.len() >= size_count) {
        return Err(attributes.invalid("size").into());
    }
    Ok((pose, sizes))
}

fn unsupported(shape: &'static str) -> RobotFileError {
    MjcfError::UnsupportedShape { shape }.into()
}

#[cfg(test)]
mod tests;
