//! The fields that are read from the JSON of a glTF: they define shapes and the places of shapes. Others that glTF has are
//! listed, because one that it does not have may be misspelt. `camelCase` drops the underscore before the names of those.

use super::whole;
use crate::mesh::error::MeshFault;
use serde::Deserialize;
use serde::de::IgnoredAny;
use std::collections::BTreeMap;

/// The top-level JSON object of a glTF.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub(super) struct Root {
    asset: Asset,
    #[serde(default)]
    pub(super) extensions_required: Vec<String>,
    #[serde(default, deserialize_with = "whole::optional_whole_number")]
    pub(super) scene: Option<usize>,
    #[serde(default)]
    pub(super) scenes: Vec<SceneNodes>,
    #[serde(default)]
    pub(super) nodes: Vec<Node>,
    #[serde(default)]
    pub(super) meshes: Vec<Mesh>,
    #[serde(default)]
    pub(super) accessors: Vec<Accessor>,
    #[serde(default)]
    pub(super) buffer_views: Vec<BufferView>,
    #[serde(default)]
    pub(super) buffers: Vec<Buffer>,
    _extensions: Option<IgnoredAny>,
    _extensions_used: Option<IgnoredAny>,
    _extras: Option<IgnoredAny>,
    _animations: Option<IgnoredAny>,
    _cameras: Option<IgnoredAny>,
    _images: Option<IgnoredAny>,
    _materials: Option<IgnoredAny>,
    _samplers: Option<IgnoredAny>,
    _skins: Option<IgnoredAny>,
    _textures: Option<IgnoredAny>,
}

#[derive(Deserialize)]
struct Asset {
    version: String,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub(super) struct SceneNodes {
    #[serde(default, deserialize_with = "whole::whole_number_list")]
    pub(super) nodes: Vec<usize>,
    _name: Option<IgnoredAny>,
    _extensions: Option<IgnoredAny>,
    _extras: Option<IgnoredAny>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub(super) struct Node {
    pub(super) name: Option<String>,
    #[serde(default, deserialize_with = "whole::whole_number_list")]
    pub(super) children: Vec<usize>,
    #[serde(default, deserialize_with = "whole::optional_whole_number")]
    pub(super) mesh: Option<usize>,
    pub(super) skin: Option<IgnoredAny>,
    pub(super) matrix: Option<[f64; 16]>,
    pub(super) translation: Option<[f64; 3]>,
    pub(super) rotation: Option<[f64; 4]>,
    pub(super) scale: Option<[f64; 3]>,
    #[serde(default)]
    pub(super) extensions: Extensions,
    _camera: Option<IgnoredAny>,
    _weights: Option<IgnoredAny>,
    _extras: Option<IgnoredAny>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub(super) struct Mesh {
    pub(super) name: Option<String>,
    #[serde(default)]
    pub(super) primitives: Vec<Primitive>,
    _weights: Option<IgnoredAny>,
    _extensions: Option<IgnoredAny>,
    _extras: Option<IgnoredAny>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub(super) struct Primitive {
    pub(super) attributes: Attributes,
    #[serde(default, deserialize_with = "whole::optional_whole_number")]
    pub(super) indices: Option<usize>,
    #[serde(default, deserialize_with = "whole::optional_whole_number")]
    pub(super) mode: Option<u32>,
    #[serde(default)]
    pub(super) targets: Vec<IgnoredAny>,
    #[serde(default)]
    pub(super) extensions: Extensions,
    _material: Option<IgnoredAny>,
    _extras: Option<IgnoredAny>,
}

#[derive(Deserialize)]
pub(super) struct Attributes {
    #[serde(rename = "POSITION")]
    #[serde(default, deserialize_with = "whole::optional_whole_number")]
    pub(super) position: Option<usize>,
    #[serde(flatten)]
    others: BTreeMap<String, IgnoredAny>,
}

/// The names of attributes beside positions. Those of the second list have a number after them.
const OTHER_ATTRIBUTES: [&str; 2] = ["NORMAL", "TANGENT"];
const NUMBERED_ATTRIBUTES: [&str; 4] = ["COLOR_", "JOINTS_", "TEXCOORD_", "WEIGHTS_"];

impl Attributes {
    /// Returns the name of an attribute that glTF does not have. Those of programs begin with `_`, those of extensions have a `:`.
    pub(super) fn unknown_name(&self) -> Option<&str> {
        let is_number = |text: &str| text.parse::<u32>().is_ok();
        let is_numbered = |name: &str| {
            let mut numbers = NUMBERED_ATTRIBUTES
                .iter()
                .filter_map(|own| name.strip_prefix(own));
            numbers.any(is_number)
        };
        let is_of_others = |name: &str| name.starts_with('_') || name.contains(':');
        let is_known = |name: &str| {
            OTHER_ATTRIBUTES.contains(&name) || is_numbered(name) || is_of_others(name)
        };
        let mut names = self.others.keys().map(String::as_str);
        names.find(|name| !is_known(name))
    }
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub(super) struct Accessor {
    #[serde(default, deserialize_with = "whole::optional_whole_number")]
    pub(super) buffer_view: Option<usize>,
    #[serde(default, deserialize_with = "whole::required_whole_number")]
    pub(super) byte_offset: u64,
    #[serde(deserialize_with = "whole::required_whole_number")]
    pub(super) component_type: u32,
    #[serde(default)]
    pub(super) normalized: bool,
    #[serde(deserialize_with = "whole::required_whole_number")]
    pub(super) count: u64,
    #[serde(rename = "type")]
    pub(super) kind: String,
    pub(super) sparse: Option<Sparse>,
    _name: Option<IgnoredAny>,
    _min: Option<IgnoredAny>,
    _max: Option<IgnoredAny>,
    _extensions: Option<IgnoredAny>,
    _extras: Option<IgnoredAny>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub(super) struct Sparse {
    #[serde(deserialize_with = "whole::required_whole_number")]
    pub(super) count: u64,
    pub(super) indices: SparseIndices,
    pub(super) values: SparseValues,
    _extensions: Option<IgnoredAny>,
    _extras: Option<IgnoredAny>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub(super) struct SparseIndices {
    #[serde(deserialize_with = "whole::required_whole_number")]
    pub(super) buffer_view: usize,
    #[serde(default, deserialize_with = "whole::required_whole_number")]
    pub(super) byte_offset: u64,
    #[serde(deserialize_with = "whole::required_whole_number")]
    pub(super) component_type: u32,
    _extensions: Option<IgnoredAny>,
    _extras: Option<IgnoredAny>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub(super) struct SparseValues {
    #[serde(deserialize_with = "whole::required_whole_number")]
    pub(super) buffer_view: usize,
    #[serde(default, deserialize_with = "whole::required_whole_number")]
    pub(super) byte_offset: u64,
    _extensions: Option<IgnoredAny>,
    _extras: Option<IgnoredAny>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub(super) struct BufferView {
    #[serde(deserialize_with = "whole::required_whole_number")]
    pub(super) buffer: usize,
    #[serde(default, deserialize_with = "whole::required_whole_number")]
    pub(super) byte_offset: u64,
    #[serde(deserialize_with = "whole::required_whole_number")]
    pub(super) byte_length: u64,
    #[serde(default, deserialize_with = "whole::optional_whole_number")]
    pub(super) byte_stride: Option<u64>,
    #[serde(default)]
    pub(super) extensions: Extensions,
    _target: Option<IgnoredAny>,
    _name: Option<IgnoredAny>,
    _extras: Option<IgnoredAny>,
}

/// The extensions of an element that change its shape, or hold its data.
#[derive(Default, Deserialize)]
pub(super) struct Extensions {
    #[serde(rename = "EXT_mesh_gpu_instancing")]
    pub(super) instancing: Option<IgnoredAny>,
    #[serde(rename = "KHR_draco_mesh_compression")]
    pub(super) draco: Option<IgnoredAny>,
    #[serde(rename = "EXT_meshopt_compression", alias = "KHR_meshopt_compression")]
    pub(super) meshopt: Option<IgnoredAny>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub(super) struct Buffer {
    pub(super) uri: Option<String>,
    #[serde(deserialize_with = "whole::required_whole_number")]
    pub(super) byte_length: u64,
    _name: Option<IgnoredAny>,
    _extras: Option<IgnoredAny>,
    _extensions: Option<IgnoredAny>,
}

impl Primitive {
    /// Returns whether the primitive consists of points or lines, not of triangles.
    pub(super) fn is_points_or_lines(&self) -> bool {
        matches!(self.mode, Some(0..=3))
    }
}

impl Root {
    pub(super) fn read(json: &[u8]) -> Result<Self, MeshFault> {
        let root: Result<Root, _> = serde_json::from_slice(json);
        let root = root.map_err(|error| {
            if error.is_eof() {
                MeshFault::truncated_file("its JSON")
            } else {
                MeshFault::malformed_content(format!("its JSON is not that of a glTF: {error}"))
            }
        })?;
        match root.asset.version.split('.').next() {
            Some("2") => Ok(root),
            _ => Err(MeshFault::unsupported_content(
                format!("glTF of version {:?}", root.asset.version),
                "glTF 2.0",
            )),
        }
    }
}
