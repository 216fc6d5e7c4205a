//! Makes bodies of the geoms of an MJCF.

use super::{MjcfModel, convert_pose};
use crate::robot::LinkBody;
use crate::robot_file::BodyElements;
use crate::robot_file::bodies::MeshBodies;
use crate::robot_file::error::RobotFileError;
use mjcf_rs::body::{Geom, GeomType};
use rigid_ccd::glam::{DAffine3, DQuat, DVec3};
use rigid_ccd::{Body, Pose};
use std::sync::Arc;

/// The first group of geoms that MuJoCo does not draw.
const FIRST_HIDDEN_GROUP: i32 = 3;

/// Makes bodies of the geoms of a model.
pub(super) struct GeomReader<'r> {
    pub(super) mjcf: &'r MjcfModel,
    pub(super) elements: BodyElements,
    pub(super) meshes: &'r MeshBodies,
}

impl MjcfModel {
    /// Returns whether a geom becomes a body.
    pub(super) fn is_body(&self, geom: &Geom, elements: BodyElements) -> bool {
        match elements {
            BodyElements::Collision => {
                let named = |name: &String| geom.name.as_ref() == Some(name);
                let mut pairs = self.model.contact.pairs.iter();
                geom.contype != 0
                    || geom.conaffinity != 0
                    || pairs.any(|pair| named(&pair.geom1) || named(&pair.geom2))
            }
            BodyElements::Visual => geom.group < FIRST_HIDDEN_GROUP,
        }
    }
}

impl GeomReader<'_> {
    /// Makes the bodies of the geoms of the body with a number.
    pub(super) fn bodies(&self, number: usize) -> Result<Vec<LinkBody>, RobotFileError> {
        let geoms = self.mjcf.model.bodies[number].body.geoms.iter();
        geoms
            .enumerate()
            .filter(|(_, geom)| self.mjcf.is_body(geom, self.elements))
            .map(|(k, geom)| {
                let name = || geom.name.clone().unwrap_or_else(|| k.to_string());
                self.body(geom)
                    .map_err(|error| error.with_geom_name(&name()))
            })
            .collect()
    }

    fn body(&self, geom: &Geom) -> Result<LinkBody, RobotFileError> {
        if geom.mesh.is_some() && geom.type_ != GeomType::Mesh {
            return Err(unsupported("a shape that is fitted to a mesh"));
        }
        let (pose, [x, y, z]) = pose_and_size(geom)?;
        let body = match geom.type_ {
            GeomType::Sphere => Body::sphere(x)?,
            GeomType::Capsule => Body::capsule(x, y)?,
            GeomType::Cylinder => Body::cylinder(x, y)?,
            GeomType::Box => Body::cuboid([x, y, z])?,
            GeomType::Mesh => {
                let body = self.mesh(geom.mesh.as_deref().unwrap_or(""))?;
                return Ok(LinkBody { body, pose });
            }
            GeomType::Plane => return Err(unsupported("a plane")),
            GeomType::Hfield => return Err(unsupported("a height field")),
            GeomType::Ellipsoid => return Err(unsupported("an ellipsoid")),
            GeomType::Sdf => return Err(unsupported("a signed distance field")),
        };
        Ok(LinkBody {
            body: Arc::new(body),
            pose,
        })
    }

    fn mesh(&self, name: &str) -> Result<Arc<Body>, RobotFileError> {
        let missing = || RobotFileError::MeshNotFound {
            uri: name.to_owned(),
            searched_paths: Vec::new(),
        };
        let model = &self.mjcf.model;
        let asset = model.assets.mesh(name).ok_or_else(missing)?;
        let Some(file) = model.resolve_mesh_file(asset, &self.mjcf.folder) else {
            return Err(unsupported("a mesh without a file"));
        };
        if !file.is_file() {
            return Err(RobotFileError::MeshNotFound {
                uri: asset.file.clone().unwrap_or_default(),
                searched_paths: vec![file],
            });
        }
        // MuJoCo moves the vertices to the reference pose, and then scales them.
        let reference = convert_pose(asset.refpose)?.inverse();
        let scale = DAffine3::from_scale(DVec3::from_array(asset.scale));
        let moved =
            DAffine3::from_rotation_translation(reference.rotation(), reference.translation());
        self.meshes.body(file, scale * moved)
    }
}

/// Returns the pose of a geom and its sizes, which are halves of lengths. A geom may be given by the points between which it is.
fn pose_and_size(geom: &Geom) -> Result<(Pose, [f64; 3]), RobotFileError> {
    let Some([x, y, z, to_x, to_y, to_z]) = geom.fromto else {
        return Ok((convert_pose(geom.pose)?, geom.size));
    };
    let (from, to) = (DVec3::new(x, y, z), DVec3::new(to_x, to_y, to_z));
    let along = from - to;
    let rotation = match ccd_core::vector::unit(along) {
        Some(axis) => DQuat::from_rotation_arc(DVec3::Z, axis),
        None => DQuat::IDENTITY,
    };
    let pose = Pose::new(0.5 * (from + to), rotation)?;
    let [width, half] = [geom.size[0], 0.5 * along.length()];
    Ok(match geom.type_ {
        GeomType::Capsule | GeomType::Cylinder => (pose, [width, half, 0.0]),
        _ => (pose, [width, width, half]),
    })
}

fn unsupported(shape: &'static str) -> RobotFileError {
    RobotFileError::UnsupportedShape { shape }
}
