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

/// Makes a Python `Distance`. With a clearance, it tells whether the clearance is kept.
pub(crate) fn make_distance<'py>(
    py: Python<'py>,
    outcome: &Outcome,
    clearance: Option<f64>,
) -> PyResult<Bound<'py, PyAny>> {
    let nearest = outcome
        .nearest_contact()
        .map(|(_, contact)| contact.separation);
    let verdict = clearance.map(|_| Status::of(Question::Distance, outcome, clearance).name());
    static DISTANCE_CLASS: PyOnceLock<Py<PyType>> = PyOnceLock::new();
    DISTANCE_CLASS
        .import(py, "rigid_ccd._answers", "Distance")?
        .call1((
            outcome.lower(),
            outcome.upper(),
            outcome.time(),
            matches!(outcome, Outcome::Overlapping { .. }),
            nearest.map(|nearest| vec3_to_tuple(nearest.witness_a)),
            nearest.map(|nearest| vec3_to_tuple(nearest.witness_b)),
            verdict,
        ))
}

fn vec3_to_tuple(v: DVec3) -> (f64, f64, f64) {
    v.into()
}
