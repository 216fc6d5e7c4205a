//! Answers as frozen objects.

use pyo3::prelude::*;
use rigid_ccd::glam::DVec3;
use rigid_ccd::schedule::ClosestApproach;
use rigid_ccd::{Contact, Hit, HitKind};

/// The first contact of two bodies. Nothing touches before its time: that is proven, in floating point.
#[pyclass(name = "Contact", module = "rigid_ccd", frozen, get_all)]
pub(crate) struct PyContact {
    /// The time; no contact happens before it.
    time: f64,
    /// "contact", "touching" (at the start) or "overlapping" (at the start).
    kind: &'static str,
    /// The point of body A nearest to B, in the world at that time.
    witness_a: (f64, f64, f64),
    /// The point of body B nearest to A.
    witness_b: (f64, f64, f64),
    /// The unit vector from A to B; None where one body is inside the other.
    normal: Option<(f64, f64, f64)>,
    /// Bounds of the distance at that time; negative for pieces that intersect.
    distance: Option<(f64, f64)>,
    /// The feature of A in contact: "v7", "e3-7", "f12" or "p0".
    feature_a: Option<String>,
    /// The feature of B in contact.
    feature_b: Option<String>,
}

/// The least distance of two bodies, to within the tolerance.
#[pyclass(name = "Distance", module = "rigid_ccd", frozen, get_all)]
pub(crate) struct PyDistance {
    /// The bodies are never nearer than this.
    lower: f64,
    /// At `time` they are at most this far apart.
    upper: f64,
    /// When they are nearest; 0 where they overlap at the start.
    time: f64,
    /// Whether they overlap at the start.
    is_overlapping: bool,
    /// The nearest point of body A, in the world at that time; None where they overlap at the start.
    witness_a: Option<(f64, f64, f64)>,
    /// The nearest point of body B.
    witness_b: Option<(f64, f64, f64)>,
}

#[pymethods]
impl PyContact {
    fn __repr__(&self) -> String {
        format!(
            "Contact(time={:?}, kind='{}', witness_b={:?})",
            self.time, self.kind, self.witness_b
        )
    }
}

#[pymethods]
impl PyDistance {
    fn __repr__(&self) -> String {
        format!(
            "Distance(lower={:?}, upper={:?}, time={:?}{})",
            self.lower,
            self.upper,
            self.time,
            if self.is_overlapping {
                ", is_overlapping=True"
            } else {
                ""
            }
        )
    }
}

impl PyContact {
    pub(crate) fn of(hit: &Hit) -> Self {
        let contact = hit.contact.as_ref();
        PyContact {
            time: hit.time,
            kind: match hit.kind {
                HitKind::Contact => "contact",
                HitKind::Touching => "touching",
                HitKind::Overlapping(_) => "overlapping",
            },
            witness_a: tuple(hit.witness_a),
            witness_b: tuple(hit.witness_b),
            normal: contact.map(|contact| tuple(contact.separation.normal)),
            distance: contact.map(|contact| (contact.separation.lower, contact.separation.upper)),
            feature_a: contact.map(|contact| contact.feature_a.to_string()),
            feature_b: contact.map(|contact| contact.feature_b.to_string()),
        }
    }
}

impl PyDistance {
    pub(crate) fn of(found: &ClosestApproach) -> Self {
        let nearest: Option<(f64, &Contact)> = match found {
            ClosestApproach::Nearest { time, contact, .. } => Some((*time, contact)),
            ClosestApproach::Unresolved { nearest, .. } => {
                nearest.as_ref().map(|(time, contact)| (*time, contact))
            }
            ClosestApproach::Overlapping { .. } => None,
        };
        let points = nearest.map(|(_, contact)| contact.separation);
        PyDistance {
            lower: found.lower(),
            upper: found.upper(),
            time: nearest.map_or(0.0, |(time, _)| time),
            is_overlapping: matches!(found, ClosestApproach::Overlapping { .. }),
            witness_a: points.map(|points| tuple(points.witness_a)),
            witness_b: points.map(|points| tuple(points.witness_b)),
        }
    }
}

fn tuple(v: DVec3) -> (f64, f64, f64) {
    v.into()
}
