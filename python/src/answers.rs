//! Answers, as what the package makes of them: `_answers.py` has their classes.

use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::PyType;
use rigid_ccd::glam::DVec3;
use rigid_ccd::schedule::{Clearance, ClosestApproach, GreatestDistance};
use rigid_ccd::{Hit, HitKind};

/// Makes a `Contact`.
pub(crate) fn contact<'py>(py: Python<'py>, hit: &Hit) -> PyResult<Bound<'py, PyAny>> {
    static CLASS: PyOnceLock<Py<PyType>> = PyOnceLock::new();
    let contact = hit.contact.as_ref();
    let separation = contact.map(|contact| &contact.separation);
    CLASS.import(py, "rigid_ccd._answers", "Contact")?.call1((
        hit.time,
        match hit.kind {
            HitKind::Contact => "contact",
            HitKind::Touching => "touching",
            HitKind::Overlapping(_) => "overlapping",
        },
        tuple(hit.witness_a),
        tuple(hit.witness_b),
        separation.map(|separation| tuple(separation.normal)),
        separation.map(|separation| (separation.lower, separation.upper)),
        contact.map(|contact| contact.feature_a.to_string()),
        contact.map(|contact| contact.feature_b.to_string()),
    ))
}

/// Makes a `Distance`, which says how it compares to a clearance.
pub(crate) fn distance<'py>(
    py: Python<'py>,
    found: &ClosestApproach,
    clearance: Option<f64>,
) -> PyResult<Bound<'py, PyAny>> {
    let nearest = found.nearest().map(|(_, contact)| contact.separation);
    let compared = clearance.map(|required| match found.clearance(required) {
        Clearance::Kept => "kept",
        Clearance::Violated => "violated",
        Clearance::Unverified => "unverified",
    });
    class_of_distance(py)?.call1((
        found.lower(),
        found.upper(),
        found.time(),
        matches!(found, ClosestApproach::Overlapping { .. }),
        nearest.map(|nearest| tuple(nearest.witness_a)),
        nearest.map(|nearest| tuple(nearest.witness_b)),
        compared,
    ))
}

/// Makes a `Distance` of the greatest one.
pub(crate) fn greatest<'py>(
    py: Python<'py>,
    found: &GreatestDistance,
) -> PyResult<Bound<'py, PyAny>> {
    let nearest = found.farthest().map(|(_, contact)| contact.separation);
    class_of_distance(py)?.call1((
        found.lower(),
        found.upper(),
        found.time(),
        false,
        nearest.map(|nearest| tuple(nearest.witness_a)),
        nearest.map(|nearest| tuple(nearest.witness_b)),
        py.None(),
    ))
}

fn class_of_distance<'py>(py: Python<'py>) -> PyResult<&'py Bound<'py, PyType>> {
    static CLASS: PyOnceLock<Py<PyType>> = PyOnceLock::new();
    CLASS.import(py, "rigid_ccd._answers", "Distance")
}

fn tuple(v: DVec3) -> (f64, f64, f64) {
    v.into()
}
