//! The contents of a cell as Python passed them, for pickling.

use crate::body::PyBody;
use crate::motion::GivenPose;
use pyo3::prelude::*;

/// The arguments of the calls that produce the present state of a cell.
#[derive(Default)]
pub(crate) struct CellContents {
    /// A plane has no body.
    obstacles: Vec<(String, Option<Py<PyBody>>, GivenPose)>,
    attached: Vec<AttachedBody>,
    paddings: Vec<(String, f64)>,
    clearances: Vec<(String, String, f64)>,
    /// For each pair, whether the last call allowed or forbade its contact.
    contacts: Vec<(String, String, bool)>,
}

/// Whether a contact is allowed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Contact {
    Allowed,
    Forbidden,
}

/// The arguments of `Cell.attach`.
pub(crate) type AttachedBody = (String, Py<PyBody>, String, GivenPose, Vec<String>);

/// The contents as pickle stores them.
pub(crate) type PickledContents = (
    Vec<(String, Option<Py<PyBody>>, GivenPose)>,
    Vec<AttachedBody>,
    Vec<(String, f64)>,
    Vec<(String, String, f64)>,
    Vec<(String, String, bool)>,
);

/// The contents of a cell as pickle returns them.
pub(crate) type UnpickledContents<'py> = (
    Vec<(String, Option<Bound<'py, PyAny>>, Bound<'py, PyAny>)>,
    Vec<(
        String,
        Bound<'py, PyAny>,
        String,
        Bound<'py, PyAny>,
        Vec<String>,
    )>,
    Vec<(String, f64)>,
    Vec<(String, String, f64)>,
    Vec<(String, String, bool)>,
);

impl CellContents {
    pub(crate) fn add(&mut self, name: &str, body: Option<Py<PyBody>>, pose: GivenPose) {
        self.obstacles.push((name.to_owned(), body, pose));
    }

    pub(crate) fn move_obstacle(&mut self, name: &str, pose: GivenPose) {
        let moved = self.obstacles.iter_mut().find(|(other, ..)| other == name);
        if let Some((_, _, old)) = moved {
            *old = pose;
        }
    }

    pub(crate) fn attach(&mut self, attached: AttachedBody) {
        self.attached.push(attached);
    }

    /// Removes an obstacle or an attached body, with its clearances.
    pub(crate) fn remove(&mut self, name: &str) {
        self.obstacles.retain(|(other, ..)| other != name);
        self.attached.retain(|(other, ..)| other != name);
        self.clearances.retain(|(a, b, _)| a != name && b != name);
        self.contacts.retain(|(a, b, _)| a != name && b != name);
        for (.., may_touch) in &mut self.attached {
            may_touch.retain(|other| other != name);
        }
    }

    pub(crate) fn set_padding(&mut self, link: &str, distance: f64) {
        self.paddings.retain(|(other, _)| other != link);
        self.paddings.push((link.to_owned(), distance));
    }

    pub(crate) fn set_clearance(&mut self, a: &str, b: &str, distance: f64) {
        self.clearances
            .retain(|(one, other, _)| !is_same([one, other], [a, b]));
        self.clearances.push((a.to_owned(), b.to_owned(), distance));
        // Setting a clearance forbids contact.
        self.set_contact(a, b, Contact::Forbidden);
    }

    pub(crate) fn set_contact(&mut self, a: &str, b: &str, contact: Contact) {
        self.contacts
            .retain(|(one, other, _)| !is_same([one, other], [a, b]));
        let is_allowed = contact == Contact::Allowed;
        self.contacts.push((a.to_owned(), b.to_owned(), is_allowed));
    }

    /// Returns the contents for pickle.
    pub(crate) fn pickled(&self, py: Python<'_>) -> PickledContents {
        let obstacles = self.obstacles.iter();
        let attached = self.attached.iter();
        (
            obstacles
                .map(|(name, body, pose)| {
                    let body = body.as_ref().map(|body| body.clone_ref(py));
                    (name.clone(), body, *pose)
                })
                .collect(),
            attached
                .map(|(name, body, link, pose, may_touch)| {
                    (
                        name.clone(),
                        body.clone_ref(py),
                        link.clone(),
                        *pose,
                        may_touch.clone(),
                    )
                })
                .collect(),
            self.paddings.clone(),
            self.clearances.clone(),
            self.contacts.clone(),
        )
    }
}

/// Returns whether two pairs of names are the same, in either order.
fn is_same([one, other]: [&str; 2], [a, b]: [&str; 2]) -> bool {
    [(one, other), (other, one)].contains(&(a, b))
}
