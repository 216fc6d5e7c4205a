//! The meshes and height fields of an MJCF.

use super::attributes::Attributes;
use super::classes::Classes;
use super::document::{Element, children_of_sections};
use super::names::Names;
use crate::robot_file::mjcf_error::MjcfError;
use rigid_ccd::Pose;
use rigid_ccd::glam::{DAffine3, DQuat, DVec3};
use std::collections::HashMap;
use std::path::Path;

/// The meshes and height fields, by name.
pub(super) struct Assets {
    pub(super) meshes: HashMap<String, MeshAsset>,
    /// The elements `hfield`.
    pub(super) height_fields: HashMap<String, Attributes>,
}

/// A mesh.
pub(super) struct MeshAsset {
    pub(super) source: MeshSource,
    /// Maps vertices as MuJoCo does: from the reference pose to the origin, then by the scale.
    pub(super) map: DAffine3,
}

/// The source of a mesh's triangles.
pub(super) enum MeshSource {
    File(String),
    /// The model contains the vertices and triangles. Without triangles, the mesh is the hull of the vertices.
    InModel {
        vertices: Vec<DVec3>,
        faces: Vec<[u32; 3]>,
    },
    /// MuJoCo generates the mesh.
    Builtin,
}

/// Reads the meshes and height fields of a model. An asset without a name is named after its file.
pub(super) fn read_assets(root: &Element, classes: &Classes) -> Result<Assets, MjcfError> {
    let mut names = Names::default();
    let mut assets = Assets {
        meshes: HashMap::new(),
        height_fields: HashMap::new(),
    };
    for element in children_of_sections(root, "asset") {
        // Other assets are images, decorations, and models for `attach`, which is not supported.
        if !["mesh", "hfield"].contains(&element.name.as_str()) {
            continue;
        }
        let attributes = classes.merged(element, None)?;
        let file = attributes.name("file");
        let file_stem = file.and_then(|file| Path::new(file).file_stem());
        let file_stem = file_stem.and_then(|stem| stem.to_str());
        let Some(name) = attributes.name("name").or(file_stem) else {
            return Err(attributes.invalid("name"));
        };
        names.add(&element.name, Some(name))?;
        if element.name == "hfield" {
            assets.height_fields.insert(name.to_owned(), attributes);
            continue;
        }
        let scale = attributes
            .array("scale")?
            .map_or(DVec3::ONE, DVec3::from_array);
        let position = attributes
            .array("refpos")?
            .map_or(DVec3::ZERO, DVec3::from_array);
        let rotation = attributes.quaternion("refquat")?.unwrap_or(DQuat::IDENTITY);
        let reference_pose = Pose::new(position, rotation);
        let to_origin = reference_pose
            .map_err(|_| attributes.invalid("refpos"))?
            .inverse();
        let to_origin =
            DAffine3::from_rotation_translation(to_origin.rotation(), to_origin.translation());
        let asset = MeshAsset {
            source: mesh_source(&attributes)?,
            map: DAffine3::from_scale(scale) * to_origin,
        };
        assets.meshes.insert(name.to_owned(), asset);
    }
    Ok(assets)
}

fn mesh_source(attributes: &Attributes) -> Result<MeshSource, MjcfError> {
    let vertices = attributes.numbers("vertex")?;
    Ok(match (attributes.name("file"), vertices) {
        (Some(file), None) => MeshSource::File(file.to_owned()),
        (None, Some(coordinates)) => {
            let (points, rest) = coordinates.as_chunks::<3>();
            if !rest.is_empty() {
                return Err(attributes.invalid("vertex"));
            }
            MeshSource::InModel {
                vertices: points.iter().copied().map(DVec3::from_array).collect(),
                faces: faces(attributes)?,
            }
        }
        (None, None) if attributes.get("builtin").is_some() => MeshSource::Builtin,
        (None, None) => return Err(attributes.invalid("file")),
        (Some(_), Some(_)) => return Err(attributes.invalid("vertex")),
    })
}

fn faces(attributes: &Attributes) -> Result<Vec<[u32; 3]>, MjcfError> {
    let text = attributes.get("face").unwrap_or("");
    let corners = text
        .split_ascii_whitespace()
        .map(|corner| corner.parse().ok());
    let corners: Option<Vec<u32>> = corners.collect();
    let corners = corners.ok_or_else(|| attributes.invalid("face"))?;
    match corners.as_chunks::<3>() {
        (faces, []) => Ok(faces.to_vec()),
        _ => Err(attributes.invalid("face")),
    }
}
