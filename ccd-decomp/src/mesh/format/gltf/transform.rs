//! Reads the transform of a glTF node relative to its parent.

use super::schema::Node;
use crate::mesh::affine::AffineMap;
use crate::mesh::error::MeshFault;
use ccd_core::Pose;
use ccd_core::glam::{DAffine3, DMat3, DMat4, DQuat, DVec3, DVec4};

/// Returns the affine map from a node's coordinates to those of its parent.
pub(super) fn node_transform(node: &Node) -> Result<AffineMap, MeshFault> {
    let Some(matrix) = node.matrix else {
        return affine_from_trs(node);
    };
    if node.translation.is_some() || node.rotation.is_some() || node.scale.is_some() {
        let problem = "has a matrix beside a translation, a rotation or a scale";
        return Err(MeshFault::malformed_content(problem));
    }
    let matrix = DMat4::from_cols_array(&matrix);
    if matrix.row(3) == DVec4::W && matrix.is_finite() {
        Ok(DAffine3::from_mat4(matrix).into())
    } else {
        let problem = "has a matrix that is not affine: its last row is not 0 0 0 1";
        Err(MeshFault::malformed_content(problem))
    }
}

/// Returns the affine map that applies a node's scale, then its rotation, then its translation.
fn affine_from_trs(node: &Node) -> Result<AffineMap, MeshFault> {
    let scale = node.scale.map_or(DVec3::ONE, DVec3::from_array);
    let rotation = node.rotation.unwrap_or(DQuat::IDENTITY.to_array());
    let translation = node.translation.unwrap_or([0.0; 3]);
    let pose = Pose::new(translation, rotation).map_err(|error| {
        MeshFault::malformed_content(format!(
            "has a rotation or translation that is none: {error}"
        ))
    })?;
    let matrix = DMat3::from_quat(pose.rotation()) * DMat3::from_diagonal(scale);
    Ok(DAffine3::from_mat3_translation(matrix, pose.translation()).into())
}
