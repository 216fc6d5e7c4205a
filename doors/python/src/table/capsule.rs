//! Reads Arrow arrays from Python capsules.

use crate::errors::input_error;
use arrow_array::RecordBatch;
use arrow_array::ffi::FFI_ArrowArray;
use pyo3::prelude::*;
use pyo3::types::PyCapsule;
use pyo3_arrow::PyRecordBatch;

/// Reads a batch from the Arrow capsules of a Python object.
///
/// Refuses an object that passes the same capsules twice: after the first time their array is released, and its memory
/// may be reused.
pub(super) fn batch(of: &Bound<'_, PyAny>) -> PyResult<RecordBatch> {
    let capsules = of.call_method0("__arrow_c_array__")?;
    let (schema, array): (Bound<'_, PyCapsule>, Bound<'_, PyCapsule>) = capsules.extract()?;
    if is_released(&array)? {
        return Err(input_error("the Arrow array is already released"));
    }
    let batch = PyRecordBatch::from_arrow_pycapsule(&schema, &array)?;
    Ok(batch.into_inner())
}

#[allow(unsafe_code, reason = "pyo3-arrow takes an array without this look")]
fn is_released(array: &Bound<'_, PyCapsule>) -> PyResult<bool> {
    let array = array.pointer_checked(Some(c"arrow_array"))?;
    // SAFETY: by the protocol, a capsule of this name holds an `ArrowArray`, which lives as long as the capsule does.
    Ok(unsafe { array.cast::<FFI_ArrowArray>().as_ref() }.is_released())
}
