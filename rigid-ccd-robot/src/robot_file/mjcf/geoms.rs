//! Makes bodies of the geoms of an MJCF.

use super::bodies::{MjcfBody, MjcfGeom};
use super::model::MjcfModel;
use super::orientation::rotation_of_z_to;
use crate::robot::LinkBody;
use crate::robot_file::body_elements::BodyElements;
use crate::robot_file::error::RobotFileError;
use crate::robot_file::meshes::MeshBodies;
use crate::robot_file::mjcf_error::MjcfError;
use ccd_core::vector::unit;
use rigid_ccd::glam::DVec3;
use rigid_ccd::{Body, Pose};
use std::sync::Arc;

/// The first group of geoms that MuJoCo does not draw.
const FIRST_HIDDEN_GROUP: i64 = 3;

/// Makes bodies of the geoms of a model.
pub(super) struct GeomReader<'r> {
    pub(super) mjcf: &'r MjcfModel,
    pub(super) elements: BodyElements,
    pub(super) meshes: &'r MeshBodies,
}

impl GeomReader<'_> {
    /// Makes the bodies of the geoms of a body.
    pub(super) fn bodies(&self, body: &MjcfBody) -> Result<Vec<LinkBody>, RobotFileError> {
        let mut bodies = Vec::new();
        for (number, geom) in body.geoms.iter().enumerate() {
            let own = self.body(geom);
            bodies.extend(own.map_err(|error| {
                let name = geom
                    .name()
                    .map_or_else(|| number.to_string(), str::to_owned);
                error.with_geom_name(&name)
            })?);
        }
        Ok(bodies)
    }

    /// Makes the body of a geom; `None` if it is not one of the elements that become bodies.
    fn body(&self, geom: &MjcfGeom) -> Result<Option<LinkBody>, RobotFileError> {
        let own = &geom.attributes;
        let is_body = match self.elements {
            BodyElements::Collision => {
                geom.contype != 0 || geom.conaffinity != 0 || self.mjcf.is_in_pair(geom)
            }
            BodyElements::Visual => own.integer_or("group", 0)? < FIRST_HIDDEN_GROUP,
        };
        if !is_body {
            return Ok(None);
        }
        let kind = own.get("type").unwrap_or("sphere");
        if kind == "mesh" {
            let body = self.mesh(own.required("mesh")?)?;
            let pose = geom.pose;
            return Ok(Some(LinkBody { body, pose }));
        }
        if own.get("mesh").is_some() {
            return Err(unsupported("a shape that is fitted to a mesh"));
        }
        let (pose, sizes) = pose_and_sizes(geom, kind)?;
        let body = match (kind, &sizes[..]) {
            ("sphere", &[radius, ..]) => Body::sphere(radius)?,
            ("capsule", &[radius, half_height, ..]) => Body::capsule(radius, half_height)?,
            ("cylinder", &[radius, half_height, ..]) => Body::cylinder(radius, half_height)?,
            ("box", &[x, y, z]) => Body::cuboid([x, y, z])?,
            ("plane", _) => return Err(unsupported("a plane")),
            ("hfield", _) => return Err(unsupported("a height field")),
            ("ellipsoid", _) => return Err(unsupported("an ellipsoid")),
            ("sdf", _) => return Err(unsupported("a signed distance field")),
            ("sphere" | "capsule" | "cylinder" | "box", _) => {
                return Err(own.invalid("size").into());
            }
            _ => return Err(own.invalid("type").into()),
        };
        Ok(Some(LinkBody {
            body: Arc::new(body),
            pose,
        }))
    }

    fn mesh(&self, name: &str) -> Result<Arc<Body>, RobotFileError> {
        let Some(asset) = self.mjcf.meshes.get(name) else {
            return Err(MjcfError::unknown_name("mesh", name).into());
        };
        let Some(uri) = &asset.file else {
            return Err(unsupported("a mesh without a file"));
        };
        let file = self.mjcf.settings.mesh_file(uri);
        if !file.is_file() {
            return Err(RobotFileError::MeshNotFound {
                uri: uri.clone(),
                searched_paths: vec![file],
            });
        }
        self.meshes.body(file, asset.map)
    }
}

/// Returns the pose of a geom and its sizes, which are halves of lengths. A geom may be given by the points between which it is.
fn pose_and_sizes(geom: &MjcfGeom, kind: &str) -> Result<(Pose, Vec<f64>), RobotFileError> {
    let own = &geom.attributes;
    let sizes = own.numbers("size")?.unwrap_or_default();
    let is_shape = ["sphere", "capsule", "cylinder", "box"].contains(&kind);
    let points = if is_shape { own.array("fromto")? } else { None };
    let (pose, sizes) = match points {
        None => (geom.pose, sizes),
        Some([x, y, z, to_x, to_y, to_z]) => {
            let (from, to) = (DVec3::new(x, y, z), DVec3::new(to_x, to_y, to_z));
            let axis = unit(from - to).ok_or_else(|| own.invalid("fromto"))?;
            let pose = Pose::new(0.5 * (from + to), rotation_of_z_to(axis))?;
            let half = 0.5 * from.distance(to);
            let width = sizes.first().copied().unwrap_or(0.0);
            let sizes = match kind {
                "capsule" | "cylinder" => vec![width, half],
                "box" => vec![width, width, half],
                _ => return Err(own.invalid("fromto").into()),
            };
            (geom.frame.compose(&pose), sizes)
        }
    };
    let used = match kind {
        "sphere" => 1,
        "capsule" | "cylinder" => 2,
        _ => 3,
    };
    let is_positive = sizes.iter().take(used).all(|&size| size > 0.0);
    if sizes.len() > 3 || is_shape && !(is_positive && sizes.len() >= used) {
        return Err(own.invalid("size").into());
    }
    Ok((pose, sizes))
}

fn unsupported(shape: &'static str) -> RobotFileError {
    MjcfError::UnsupportedShape { shape }.into()
}
