//! Reads the poses of MJCF elements.

use super::attributes::{Attributes, ORIENTATIONS};
use super::settings::Settings;
use crate::robot_file::mjcf_error::MjcfError;
use ccd_core::vector::unit;
use rigid_ccd::Pose;
use rigid_ccd::glam::{DMat3, DQuat, DVec3};

/// Reads the pose of an element from its position and one of the rotation attributes.
pub(super) fn read_pose(attributes: &Attributes, settings: &Settings) -> Result<Pose, MjcfError> {
    let position = attributes.array("pos")?.unwrap_or([0.0; 3]);
    Pose::new(position, read_rotation(attributes, settings)?).map_err(|_| attributes.invalid("pos"))
}

fn read_rotation(attributes: &Attributes, settings: &Settings) -> Result<DQuat, MjcfError> {
    let mut specified = ORIENTATIONS
        .iter()
        .filter(|name| attributes.get(name).is_some());
    let Some(name) = specified.next() else {
        return Ok(DQuat::IDENTITY);
    };
    let invalid = || attributes.invalid(name);
    if specified.next().is_some() {
        return Err(invalid());
    }
    let direction = |v: [f64; 3]| attributes.direction(name, DVec3::from_array(v));
    let numbers = attributes.numbers(name)?.unwrap_or_default();
    match (*name, &numbers[..]) {
        ("quat", _) => attributes.quaternion(name)?.ok_or_else(invalid),
        ("axisangle", &[x, y, z, angle]) => {
            let axis = direction([x, y, z])?;
            Ok(DQuat::from_axis_angle(axis, settings.radians(angle)))
        }
        ("xyaxes", &[a, b, c, d, e, f]) => {
            let x = direction([a, b, c])?;
            let y = DVec3::new(d, e, f);
            let y = direction((y - x * x.dot(y)).to_array())?;
            Ok(DQuat::from_mat3(&DMat3::from_cols(x, y, x.cross(y))))
        }
        ("zaxis", &[x, y, z]) => Ok(rotation_of_z_to(direction([x, y, z])?)),
        ("euler", &[a, b, c]) => Ok(euler_rotation([a, b, c], settings)),
        _ => Err(invalid()),
    }
}

/// Returns the rotation by three Euler angles, about the axes that the settings specify.
pub(super) fn euler_rotation(angles: [f64; 3], settings: &Settings) -> DQuat {
    let mut rotation = DQuat::IDENTITY;
    for (axis, angle) in settings.euler_axes.into_iter().zip(angles) {
        let axis_direction = match axis.to_ascii_lowercase() {
            'x' => DVec3::X,
            'y' => DVec3::Y,
            _ => DVec3::Z,
        };
        let axis_rotation = DQuat::from_axis_angle(axis_direction, settings.radians(angle));
        rotation = if axis.is_ascii_lowercase() {
            rotation * axis_rotation
        } else {
            axis_rotation * rotation
        };
    }
    rotation
}

/// Returns the smallest rotation that maps the z axis to a unit vector. As in MuJoCo, the rotation axis is x if the
/// vector is nearly parallel to z.
pub(super) fn rotation_of_z_to(axis: DVec3) -> DQuat {
    let cross_product = DVec3::Z.cross(axis);
    let is_parallel = cross_product.length() < 1e-10;
    let rotation_axis = unit(cross_product)
        .filter(|_| !is_parallel)
        .unwrap_or(DVec3::X);
    DQuat::from_axis_angle(rotation_axis, cross_product.length().atan2(axis.z))
}
