//! The motions of a row as a page has them.

use crate::table::courses::Course;
use ccd_core::InputError;
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
    for time in path.times() {
        let poses = path.poses(time)?;
        for (keys, pose) in keys.iter_mut().zip(&poses) {
            keys.push(Key::new(time, pose));
        }
    }
    Ok(keys.map(|keys| Shown::Keys { keys }))
}
