//! The meshes that an MJCF file names.

use super::classes::Classes;
use super::document::{Element, children_of_sections};
use crate::robot_file::mjcf_error::MjcfError;
use rigid_ccd::Pose;
use rigid_ccd::glam::{DAffine3, DQuat, DVec3};
use std::collections::HashMap;
use std::path::Path;

/// A mesh that geoms name.
pub(super) struct MeshAsset {
    /// The file; `None` for a mesh that the model holds itself.
    pub(super) file: Option<String>,
    /// MuJoCo moves the vertices from the reference pose to the origin, and then scales them.
    pub(super) map: DAffine3,
}

/// Reads the meshes of a model by their names. One without a name has that of its file.
pub(super) fn read_mesh_assets(
    root: &Element,
    classes: &Classes,
) -> Result<HashMap<String, MeshAsset>, MjcfError> {
    let mut assets = HashMap::new();
    for element in children_of_sections(root, "asset") {
        match element.name.as_str() {
            "mesh" => {}
            // Pictures; a geom that is a height field or a skin is refused by itself.
            "hfield" | "material" | "skin" | "texture" => continue,
            // A model that may be attached, which is refused where it is.
            "model" => continue,
            _ => return Err(element.unknown_in("asset")),
        }
        let own = classes.merged(element, None)?;
        let file = own.get("file");
        let stem = file.and_then(|file| Path::new(file).file_stem());
        let stem = stem.and_then(|stem| stem.to_str());
        let Some(name) = own.get("name").or(stem) else {
            return Err(own.invalid("name"));
        };
        let scale = own.array("scale")?.map_or(DVec3::ONE, DVec3::from_array);
        let at = own.array("refpos")?.map_or(DVec3::ZERO, DVec3::from_array);
        let [w, x, y, z] = own.array("refquat")?.unwrap_or([1.0, 0.0, 0.0, 0.0]);
        if [w, x, y, z] == [0.0; 4] {
            return Err(own.invalid("refquat"));
        }
        let reference = Pose::new(at, DQuat::from_xyzw(x, y, z, w));
        let back = reference.map_err(|_| own.invalid("refpos"))?.inverse();
        let back = DAffine3::from_rotation_translation(back.rotation(), back.translation());
        let asset = MeshAsset {
            file: file.map(str::to_owned),
            map: DAffine3::from_scale(scale) * back,
        };
        assets.insert(name.to_owned(), asset);
    }
    Ok(assets)
}
