//! Converts the motions or paths of a row to the motions that a page shows.

use ccd_core::{InputError, Trajectory};
use ccd_tables::movements::Movements;
use ccd_view::{Keyframe, ShownMotion};

/// Returns the motions of both bodies in the form for a page: a path becomes keyframes, one for each pose.
///
/// # Errors
/// If a path has no pose at one of its times.
pub fn shown_motions(movements: &Movements) -> Result<[ShownMotion; 2], InputError> {
    let path = match movements {
        Movements::Motions(query) => {
            return Ok([ShownMotion::from(&query.a), ShownMotion::from(&query.b)]);
        }
        Movements::Path(path) => path,
    };
    let [a, b] = [&path.a, &path.b].map(|poses| {
        let center = poses.center();
        let keys = poses
            .times()
            .zip(poses.rotation_vectors())
            .map(|(time, rotation_vector)| {
                let (pose, rotation_vector) = (poses.pose(time)?, rotation_vector?);
                let center_position = pose.transform_point(center);
                Ok(Keyframe::new(time, &pose, center_position, rotation_vector))
            });
        Ok(ShownMotion::Keyframes {
            center: center.to_array(),
            keys: keys.collect::<Result<_, InputError>>()?,
        })
    });
    Ok([a?, b?])
}
