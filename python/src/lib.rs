//! The extension module of the Python package `rigid_ccd`.

mod answers;
mod arrays;
mod body;
mod errors;
mod motion;
mod queries;

use pyo3::prelude::*;

/// Certified continuous collision detection.
#[pymodule]
fn _rigid_ccd(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<body::PyBody>()?;
    module.add_class::<motion::PyMotion>()?;
    module.add_class::<answers::PyContact>()?;
    module.add_class::<answers::PyDistance>()?;
    module.add("InputError", module.py().get_type::<errors::InputError>())?;
    module.add("Unresolved", module.py().get_type::<errors::Unresolved>())?;
    module.add_function(wrap_pyfunction!(queries::first_contact, module)?)?;
    module.add_function(wrap_pyfunction!(queries::is_free, module)?)?;
    module.add_function(wrap_pyfunction!(queries::closest_approach, module)?)?;
    module.add_function(wrap_pyfunction!(queries::distance, module)?)?;
    Ok(())
}
