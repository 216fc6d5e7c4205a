//! Converts answers to the Python classes that `_answers.py` defines.

use ccd_tables::results::Status;
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::PyType;
use rigid_ccd::Question;
use rigid_ccd::glam::DVec3;
use rigid_ccd::{Hit, Outcome};

/// Makes a Python `Contact` from a contact of the engine.
pub(crate) fn contact<'py>(py: Python<'py>, hit: &Hit) -> PyResult<Bound<'py, PyAny>> {
    static CONTACT_CLASS: PyOnceLock<Py<PyType>> = PyOnceLock::new();
    let contact = hit.contact();
    let separation = contact.map(|contact| contact.separation);
    CONTACT_CLASS
        .import(py, "rigid_ccd._answers", "Contact")?
        .call1((
            hit.time,
            Status::from(&hit.kind).name(),
            vec3_to_tuple(hit.witness_a()),
            vec3_to_tuple(hit.witness_b()),
            separation.map(|separation| vec3_to_tuple(separation.normal)),
            separation.map(|separation| (separation.lower, separation.upper)),
            contact.map(|contact| contact.feature_a.to_string()),
            contact.map(|contact| contact.feature_b.to_string()),
        ))
}

/// Makes a Python `Distance`, with its comparison to a clearance.
pub(crate) fn make_distance<'py>(
    py: Python<'py>,
    found: &Outcome,
    clearance: Option<f64>,
) -> PyResult<Bound<'py, PyAny>> {
    let nearest = found
        .nearest_contact()
        .map(|(_, contact)| contact.separation);
    let compared = clearance.map(|_| Status::of(Question::Distance, found, clearance).name());
    static DISTANCE_CLASS: PyOnceLock<Py<PyType>> = PyOnceLock::new();
    DISTANCE_CLASS
        .import(py, "rigid_ccd._answers", "Distance")?
        .call1((
            found.lower(),
            found.upper(),
            found.time(),
            matches!(found, Outcome::Overlapping { .. }),
            nearest.map(|nearest| vec3_to_tuple(nearest.witness_a)),
            nearest.map(|nearest| vec3_to_tuple(nearest.witness_b)),
            compared,
        ))
}

fn vec3_to_tuple(v: DVec3) -> (f64, f64, f64) {
    v.into()
}
