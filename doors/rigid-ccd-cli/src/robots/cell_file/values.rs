//! Keys with a fixed number of values, and the poses that they make.

use anyhow::{Result, anyhow, bail};
use rigid_ccd::Pose;
use rigid_ccd::glam::{DQuat, EulerRot};

/// Returns a pose whose rotation is roll, pitch and yaw as in a URDF, a quaternion (x, y, z, w), or none.
pub(super) fn pose(
    position: &Option<Vec<f64>>,
    rpy: &Option<Vec<f64>>,
    quaternion: &Option<Vec<f64>>,
) -> Result<Pose> {
    let position = match position {
        Some(position) => *values("position", position)?,
        None => [0.0; 3],
    };
    let rotation = match (rpy, quaternion) {
        (Some(_), Some(_)) => bail!("give either rpy or quaternion_xyzw"),
        (Some(rpy), None) => {
            let &[roll, pitch, yaw] = values("rpy", rpy)?;
            DQuat::from_euler(EulerRot::ZYX, yaw, pitch, roll)
        }
        (None, Some(quaternion)) => DQuat::from_array(*values("quaternion_xyzw", quaternion)?),
        (None, None) => DQuat::IDENTITY,
    };
    Ok(Pose::new(position, rotation)?)
}

/// Returns the values of a key that has a fixed number of them.
pub(super) fn values<'v, T, const COUNT: usize>(
    key: &str,
    given: &'v [T],
) -> Result<&'v [T; COUNT]> {
    let count = given.len();
    given
        .try_into()
        .map_err(|_| anyhow!("{key} has {count} values, not {COUNT}"))
}
