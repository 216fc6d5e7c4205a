//! Reads paths from NumPy arrays.

use crate::arrays::float64_array;
use crate::cell_solver::Paths;
use crate::errors::input_error;
use numpy::{PyArrayDyn, PyArrayMethods, PyUntypedArrayMethods};
use pyo3::prelude::*;

/// Configurations from an array, one after another.
pub(crate) struct PathArray {
    positions: Vec<f64>,
    shape: Vec<usize>,
}

impl PathArray {
    /// Reads an array of float64.
    pub(crate) fn read(values: &Bound<'_, PyAny>, what: &str) -> PyResult<Self> {
        let array = float64_array(values, what)?;
        let array = array.cast::<PyArrayDyn<f64>>()?;
        let shape = array.shape().to_vec();
        let positions = match array.try_readonly()?.as_slice() {
            Ok(positions) => positions.to_vec(),
            Err(_) => array.to_owned_array().iter().copied().collect(),
        };
        // There may be no paths, but each has configurations.
        let is_too_short = |shape: &[usize]| shape[shape.len().saturating_sub(2)..].contains(&0);
        if shape.is_empty() || shape.len() > 3 || is_too_short(&shape) {
            return Err(input_error(format!(
                "{what}: configurations are needed, not an array of shape {shape:?}"
            )));
        }
        Ok(PathArray { positions, shape })
    }

    /// Returns the configurations of one path; an array of one dimension is one configuration.
    pub(crate) fn configurations(&self) -> Vec<&[f64]> {
        self.positions.chunks_exact(self.joint_count()).collect()
    }

    /// Refuses an array of another shape than (paths, configurations, `joints`).
    pub(crate) fn check_shape_of_paths(&self, joints: usize) -> PyResult<()> {
        if self.shape.len() == 3 && self.joint_count() == joints {
            return Ok(());
        }
        Err(input_error(format!(
            "paths: an array of shape (paths, configurations, {joints}) is needed, not {:?}",
            self.shape
        )))
    }

    /// Returns all paths of an array of three dimensions.
    pub(crate) fn paths(&self) -> Paths<'_> {
        Paths {
            positions: &self.positions,
            configuration_count: self.shape[1],
            joint_count: self.joint_count(),
        }
    }

    fn joint_count(&self) -> usize {
        self.shape[self.shape.len() - 1]
    }
}
