//! The extension module of the Python package `rigid_ccd`.

mod answers;
mod arrays;
mod body;
mod body_file;
mod cell;
mod cell_contents;
mod cell_remarks;
mod cell_solver;
mod cell_state;
mod configurations;
mod curve;
mod errors;
mod interruptible;
mod joint;
mod link_contacts;
mod link_motion;
mod motion;
mod movement;
mod numbers;
mod path;
mod path_answers;
mod path_array;
mod path_questions;
mod path_tables;
mod pickle;
mod progress;
mod proofs;
mod queries;
mod robot;
mod robot_base;
mod robot_file;
mod robot_links;
mod settings;
mod table;
mod table_queries;

use pyo3::prelude::*;

/// Certified continuous collision detection of rigid bodies.
#[pymodule]
fn _rigid_ccd(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<body::PyBody>()?;
    module.add_class::<motion::PyMotion>()?;
    module.add_class::<path::PyPath>()?;
    module.add_class::<joint::PyJoint>()?;
    module.add_class::<link_motion::PyLinkTrajectory>()?;
    module.add_class::<robot::PyRobot>()?;
    module.add_class::<cell::PyCell>()?;
    module.add_class::<table::PyTable>()?;
    module.add_function(wrap_pyfunction!(queries::first_contact, module)?)?;
    module.add_function(wrap_pyfunction!(queries::is_free, module)?)?;
    module.add_function(wrap_pyfunction!(queries::closest_approach, module)?)?;
    module.add_function(wrap_pyfunction!(queries::distance, module)?)?;
    module.add_function(wrap_pyfunction!(proofs::prove, module)?)?;
    module.add_function(wrap_pyfunction!(proofs::check_proof, module)?)?;
    module.add_function(wrap_pyfunction!(proofs::proof_statement, module)?)?;
    module.add_function(wrap_pyfunction!(proofs::read_proof, module)?)?;
    module.add_function(wrap_pyfunction!(table_queries::answer_table, module)?)?;
    Ok(())
}
