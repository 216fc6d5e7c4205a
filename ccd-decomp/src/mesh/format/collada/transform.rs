//! The transform of a node.

use super::{fault_at, numbers};
use crate::mesh::affine::AffineMap;
use crate::mesh::error::MeshFault;
use ccd_core::glam::{DAffine3, DMat4, DQuat, DVec3};
use ccd_core::vector::unit;
use roxmltree::Node;

/// Reads the transforms of a node, the first of which is applied last.
pub(super) fn node_transform(node: Node<'_, '_>) -> Result<AffineMap, MeshFault> {
    let mut all = AffineMap::IDENTITY;
    for element in node.children().filter(Node::is_element) {
        let one = match element.tag_name().name() {
            "matrix" => matrix(element)?,
            "translate" => {
                let [x, y, z] = exactly(element)?;
                DAffine3::from_translation(DVec3::new(x, y, z))
            }
            "scale" => {
                let [x, y, z] = exactly(element)?;
                DAffine3::from_scale(DVec3::new(x, y, z))
            }
            "rotate" => {
                let [x, y, z, degrees] = exactly(element)?;
                match unit(DVec3::new(x, y, z)) {
                    Some(axis) => {
                        DAffine3::from_quat(DQuat::from_axis_angle(axis, degrees.to_radians()))
                    }
                    // A rotation by 0 may leave out its axis.
                    None if degrees == 0.0 => DAffine3::IDENTITY,
                    None => return Err(fault_at(element, "has an axis without a length")),
                }
            }
            name @ ("lookat" | "skew") => {
                return Err(MeshFault::unsupported_content(
                    format!("<{name}>"),
                    "a <matrix>",
                ));
            }
            _ => continue,
        };
        all = all.compose_after(&AffineMap::from(one));
    }
    Ok(all)
}

/// Reads a matrix of four rows, the last of which is 0 0 0 1.
pub(super) fn matrix(element: Node<'_, '_>) -> Result<DAffine3, MeshFault> {
    let rows: [f64; 16] = exactly(element)?;
    if rows[12..] != [0.0, 0.0, 0.0, 1.0] {
        return Err(fault_at(element, "does not end with 0 0 0 1"));
    }
    Ok(DAffine3::from_mat4(
        DMat4::from_cols_array(&rows).transpose(),
    ))
}

/// Reads exactly `N` numbers.
fn exactly<const N: usize>(element: Node<'_, '_>) -> Result<[f64; N], MeshFault> {
    let all: Vec<f64> = numbers(element)?;
    let count = all.len();
    <[f64; N]>::try_from(all)
        .map_err(|_| fault_at(element, format!("has {count} numbers instead of {N}")))
}
