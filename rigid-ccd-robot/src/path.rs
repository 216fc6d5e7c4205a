//! The paths that questions are asked about: sequences of configurations, and curves.

pub(crate) mod interval;
pub(crate) mod joint_path;
pub(crate) mod lanes;

use crate::cell::Cell;
use crate::error::PathError;
use crate::joint_curve::JointCurve;
use crate::path_point::PathPoint;
use joint_path::JointPath;

/// A path of a robot: a slice, array or vector of configurations, or a [`JointCurve`]. Between two configurations all
/// joints move at constant rates.
///
/// A path of one configuration is a robot at rest. A path of two configurations is an edge.
pub trait Path: PathSource {
    /// Returns the number of segments.
    fn segment_count(&self) -> usize;

    /// Returns the time of a point. On a path of configurations, each segment takes one unit of time.
    fn time(&self, point: PathPoint) -> f64 {
        point.time()
    }
}

/// Sealed. Writes a path's polynomials into the solver's buffer.
pub trait PathSource {
    /// Replaces the contents of `path` by this path, if it fits the robot.
    fn write_to(&self, cell: &Cell, path: &mut JointPath) -> Result<(), PathError>;
}

impl<Q: AsRef<[f64]>> Path for [Q] {
    fn segment_count(&self) -> usize {
        self.len().saturating_sub(1)
    }
}

impl<Q: AsRef<[f64]>> PathSource for [Q] {
    fn write_to(&self, cell: &Cell, path: &mut JointPath) -> Result<(), PathError> {
        if self.is_empty() {
            return Err(PathError::EmptyPath);
        }
        for (configuration_index, configuration) in self.iter().enumerate() {
            let result = cell.robot().check_configuration(configuration.as_ref());
            result.map_err(|error| PathError::InvalidConfiguration {
                configuration_index,
                error,
            })?;
        }
        path.set_configurations(cell.kinematics(), self);
        Ok(())
    }
}

impl Path for JointCurve {
    fn segment_count(&self) -> usize {
        JointCurve::segment_count(self)
    }

    fn time(&self, point: PathPoint) -> f64 {
        JointCurve::time(self, point)
    }
}

impl PathSource for JointCurve {
    fn write_to(&self, cell: &Cell, path: &mut JointPath) -> Result<(), PathError> {
        self.check_for_robot(cell.robot())?;
        path.set_curve(cell.kinematics(), self);
        Ok(())
    }
}

impl<Q: AsRef<[f64]>> Path for Vec<Q> {
    fn segment_count(&self) -> usize {
        self.as_slice().segment_count()
    }
}

impl<Q: AsRef<[f64]>> PathSource for Vec<Q> {
    fn write_to(&self, cell: &Cell, path: &mut JointPath) -> Result<(), PathError> {
        self.as_slice().write_to(cell, path)
    }
}

impl<Q: AsRef<[f64]>, const COUNT: usize> Path for [Q; COUNT] {
    fn segment_count(&self) -> usize {
        self.as_slice().segment_count()
    }
}

impl<Q: AsRef<[f64]>, const COUNT: usize> PathSource for [Q; COUNT] {
    fn write_to(&self, cell: &Cell, path: &mut JointPath) -> Result<(), PathError> {
        self.as_slice().write_to(cell, path)
    }
}
