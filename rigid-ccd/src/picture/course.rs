//! The motions of a row as a page has them.

use crate::table::courses::Course;
use ccd_core::glam::DVec3;
use ccd_core::{InputError, Pose};
use ccd_view::{Course as Shown, Key};

/// Returns the motions of both bodies.
///
/// # Errors
/// If a path has no pose at one of its times.
pub fn course(course: &Course) -> Result<[Shown; 2], InputError> {
    let path = match course {
        Course::Motions(query) => return Ok([Shown::from(&query.a), Shown::from(&query.b)]),
        Course::Path(path) => path,
    };
    let mut keys = [Vec::new(), Vec::new()];
    let times: Vec<f64> = path.times().collect();
    for (k, &time) in times.iter().enumerate() {
        let poses = path.poses(time)?;
        // Half the way is a quarter of a turn at most, which is the shortest way alone.
        let next = times.get(k + 1).copied().unwrap_or(time);
        let half = path.poses(0.5 * time + 0.5 * next)?;
        for ((keys, pose), half) in keys.iter_mut().zip(&poses).zip(&half) {
            keys.push(Key::new(time, pose, 2.0 * turn(pose, half)));
        }
    }
    Ok(keys.map(|keys| Shown::Keys { keys }))
}

/// Returns the rotation vector of the shortest rotation from one pose to another.
fn turn(from: &Pose, to: &Pose) -> DVec3 {
    let way = to.rotation() * from.rotation().conjugate();
    let way = if way.w < 0.0 { -way } else { way };
    way.to_scaled_axis()
}
