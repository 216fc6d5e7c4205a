//! The contents of a cell as Python passed them, for pickling.

use crate::body::PyBody;
use crate::motion::GivenPose;
use pyo3::prelude::*;

/// The arguments of the calls that produce the present state of a cell. Pickle stores them as a dict.
#[derive(Default, FromPyObject, IntoPyObjectRef)]
#[pyo3(from_item_all)]
pub(crate) struct CellContents {
    /// The name, the body and the pose of each obstacle. A plane has no body.
    pub(crate) obstacles: Vec<(String, Option<Py<PyBody>>, GivenPose)>,
    pub(crate) attached: Vec<AttachedBody>,
    pub(crate) paddings: Vec<(String, f64)>,
    pub(crate) clearances: Vec<(String, String, f64)>,
    /// For each pair, whether the last call allowed or forbade its contact.
    pub(crate) contacts: Vec<(String, String, bool)>,
}

/// Whether a contact is allowed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Contact {
    Allowed,
    Forbidden,
}

/// The arguments of `Cell.attach`.
pub(crate) type AttachedBody = (String, Py<PyBody>, String, GivenPose, Vec<String>);

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
}

/// Returns whether two pairs of names are the same, in either order.
fn is_same([one, other]: [&str; 2], [a, b]: [&str; 2]) -> bool {
    [(one, other), (other, one)].contains(&(a, b))
}
