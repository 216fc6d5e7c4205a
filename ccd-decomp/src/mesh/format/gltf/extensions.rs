//! Checks the extensions that a glTF requires of its readers. Only those that do not change shapes are accepted.

use super::schema::Root;
use crate::mesh::error::{MeshFault, quoted};

/// The name prefixes of extensions that do not change shapes, such as those about appearance, lights, audio, animation
/// and metadata.
const HARMLESS_PREFIXES: [&str; 14] = [
    "KHR_materials_",
    "KHR_texture_",
    "EXT_texture_",
    "MSFT_texture_",
    "MSFT_packing_",
    "EXT_lights_",
    "KHR_lights_",
    "KHR_audio",
    "KHR_animation_pointer",
    "KHR_xmp",
    "KHR_node_",
    "EXT_mesh_features",
    "EXT_structural_metadata",
    "EXT_instance_features",
];

/// The name of the extension for positions as integers, which is supported.
const QUANTIZATION_EXTENSION: &str = "KHR_mesh_quantization";

const DRACO_EXTENSION: &str = "KHR_draco_mesh_compression";

/// Returns an error if a file requires an unsupported extension, as the glTF specification demands.
pub(super) fn check_required_extensions(root: &Root) -> Result<(), MeshFault> {
    let known = |name: &str| {
        name == QUANTIZATION_EXTENSION
            || HARMLESS_PREFIXES
                .iter()
                .any(|prefix| name.starts_with(prefix))
    };
    let mut required = root.extensions_required.iter();
    match required.find(|name| !known(name)).map(String::as_str) {
        None => Ok(()),
        Some(DRACO_EXTENSION) => Err(draco_fault()),
        Some(name) if name.ends_with("_meshopt_compression") => Err(meshopt_fault()),
        Some(name) => Err(MeshFault::unsupported_content(
            format!("what the extension {} says", quoted(name)),
            "glTF without this extension",
        )),
    }
}

pub(super) fn draco_fault() -> MeshFault {
    MeshFault::unsupported_content(
        format!("meshes compressed by Draco ({DRACO_EXTENSION})"),
        "glTF without compression",
    )
}

pub(super) fn meshopt_fault() -> MeshFault {
    MeshFault::unsupported_content(
        "buffers compressed by meshopt (EXT_meshopt_compression)",
        "glTF without compression",
    )
}
