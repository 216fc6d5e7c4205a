//! Paths of a robot, which questions take as arguments.

use crate::arguments::{array, reference};
use crate::joint_curve::RccdJointCurve;
use crate::status::Failure;
use rigid_ccd_robot::Path;
use rigid_ccd_robot::evidence::RecordedPath;

/// A path of a robot: either a sequence of configurations or a curve. Between configurations all joints move at constant
/// rates. One configuration is a static robot, two are an edge.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct RccdPath {
    /// For each configuration, the positions of the robot's independent joints; null for a curve.
    pub configurations: *const f64,
    /// The number of configurations.
    pub configuration_count: usize,
    /// The curve, or null.
    pub curve: *const RccdJointCurve,
}

/// The largest number of configurations of a robot without independent joints. Such configurations take no memory, so the
/// caller's array does not bound their number.
const MAX_EMPTY_CONFIGURATIONS: usize = 1 << 16;

/// Memory for the configurations of a path. A solver reuses it between calls.
#[derive(Default)]
pub(crate) struct PathMemory(Vec<Configuration>);

/// A configuration in the caller's array, borrowed during one call.
struct Configuration {
    positions: *const f64,
    count: usize,
}

impl AsRef<[f64]> for Configuration {
    fn as_ref(&self) -> &[f64] {
        // SAFETY: the pointer and the count come from a slice. They are used only within the call that made them, and
        // are removed at its end.
        unsafe { std::slice::from_raw_parts(self.positions, self.count) }
    }
}

/// The content of an [`RccdPath`], with its pointers dereferenced.
enum Content<'a> {
    Curve(&'a RccdJointCurve),
    /// The positions of all configurations, and the number of configurations. There are no positions if the robot has no
    /// independent joint.
    Configurations(&'a [f64], usize),
}

impl RccdPath {
    /// Dereferences the pointers of a path. The robot has `joint_count` independent joints.
    ///
    /// # Safety
    /// `path` is null or points to a path. Each of its pointers is null or points to valid values, which nobody changes
    /// during the call.
    unsafe fn follow<'a>(
        path: *const RccdPath,
        joint_count: usize,
    ) -> Result<Content<'a>, Failure> {
        // SAFETY: the contract of this function.
        let path = unsafe { reference("path", path) }?;
        if !path.curve.is_null() {
            if !path.configurations.is_null() {
                return Err(Failure::argument(
                    "path has both configurations and a curve",
                ));
            }
            // SAFETY: the contract of this function.
            return Ok(Content::Curve(unsafe { reference("curve", path.curve) }?));
        }
        if joint_count == 0 && path.configuration_count > MAX_EMPTY_CONFIGURATIONS {
            return Err(Failure::argument(format!(
                "configurations is too long: {}, and at most {MAX_EMPTY_CONFIGURATIONS} for a robot without independent joints",
                path.configuration_count
            )));
        }
        let total = path.configuration_count.checked_mul(joint_count);
        let total = total.ok_or_else(|| {
            Failure::argument(format!(
                "configurations is too long: {} of {joint_count} positions",
                path.configuration_count
            ))
        })?;
        // SAFETY: the contract of this function.
        let positions = unsafe { array("configurations", path.configurations, total) }?;
        Ok(Content::Configurations(positions, path.configuration_count))
    }

    /// Copies a path, to write it to a file.
    ///
    /// # Safety
    /// As for [`RccdPath::follow`].
    pub(crate) unsafe fn record(
        path: *const RccdPath,
        joint_count: usize,
    ) -> Result<RecordedPath, Failure> {
        // SAFETY: the contract of this function.
        Ok(match unsafe { RccdPath::follow(path, joint_count) }? {
            Content::Curve(curve) => RecordedPath::Curve(curve.0.clone()),
            Content::Configurations(positions, count) => {
                let rows: Vec<&[f64]> = rows(positions, count, joint_count).collect();
                RecordedPath::configurations(&rows)
            }
        })
    }
}

impl PathMemory {
    /// Calls a function with the path. The robot has `joint_count` independent joints.
    ///
    /// # Safety
    /// As for [`RccdPath::follow`].
    pub(crate) unsafe fn with_path<R>(
        &mut self,
        path: *const RccdPath,
        joint_count: usize,
        call: impl FnOnce(&dyn Path) -> Result<R, Failure>,
    ) -> Result<R, Failure> {
        // SAFETY: the contract of this function.
        let (positions, count) = match unsafe { RccdPath::follow(path, joint_count) }? {
            Content::Curve(curve) => return call(&curve.0),
            Content::Configurations(positions, count) => (positions, count),
        };
        self.0.clear();
        let rows = rows(positions, count, joint_count);
        self.0.extend(rows.map(|positions| Configuration {
            positions: positions.as_ptr(),
            count: joint_count,
        }));
        let result = call(&self.0);
        self.0.clear();
        result
    }
}

/// Splits an array of positions into configurations.
fn rows(positions: &[f64], count: usize, length: usize) -> impl Iterator<Item = &[f64]> {
    (0..count).map(move |k| &positions[k * length..(k + 1) * length])
}
