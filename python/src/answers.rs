//! Answers, as what the package makes of them: `_answers.py` has their classes.

use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::PyType;
use rigid_ccd::glam::DVec3;
use rigid_ccd::schedule::ClosestApproach;
use rigid_ccd::{Contact, Hit, HitKind};

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

/// Makes a `Distance`.
pub(crate) fn distance<'py>(
    py: Python<'py>,
    found: &ClosestApproach,
) -> PyResult<Bound<'py, PyAny>> {
    static CLASS: PyOnceLock<Py<PyType>> = PyOnceLock::new();
    let nearest: Option<(f64, &Contact)> = match found {
        ClosestApproach::Nearest { time, contact, .. } => Some((*time, contact)),
        ClosestApproach::Unresolved { nearest, .. } => {
            nearest.as_ref().map(|(time, contact)| (*time, contact))
        }
        ClosestApproach::Overlapping { .. } => None,
    };
    let points = nearest.map(|(_, contact)| contact.separation);
    CLASS.import(py, "rigid_ccd._answers", "Distance")?.call1((
        found.lower(),
        found.upper(),
        nearest.map_or(0.0, |(time, _)| time),
        matches!(found, ClosestApproach::Overlapping { .. }),
        points.map(|points| tuple(points.witness_a)),
        points.map(|points| tuple(points.witness_b)),
    ))
}

fn tuple(v: DVec3) -> (f64, f64, f64) {
    v.into()
}
