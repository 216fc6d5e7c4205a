//! Finds all pairs of features that are in contact at a time `[FAST06 §5.2]`.

mod boxes;
mod candidate;
mod closest;
mod manifold;
mod measure;
mod near;
mod skin;
mod surface;

use crate::answer::Contact;
use crate::error::InputError;
use crate::motion::pose::Frame;
use crate::problem::Problem;
use manifold::ContactManifold;
use near::near_face_pairs;
use skin::NearSurface;
use std::fmt;

/// The reason why the contacts at a time cannot be listed.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum ContactsError {
    /// A trajectory has no pose at the time, or a pose out of range.
    Input(InputError),
    /// The time is NaN, or outside of the duration.
    NotInDuration {
        /// The requested time, in the motions' unit.
        requested_time: f64,
        /// The duration of the query, in the motions' unit.
        duration: f64,
    },
    /// More pairs are near than the [budget](crate::Settings::budget) allows. Either the bodies are small for the
    /// margin and the tolerance, or one is deep in the other.
    TooManyPairs {
        /// The budget of the query, which limits the number of near pairs.
        budget: u64,
    },
}

impl Problem<'_> {
    /// Returns all pairs of features in contact at `clock`, which is 0 at the start of the query and 1 at its end; see
    /// [`Query::contacts_at`](crate::Query::contacts_at).
    pub(crate) fn contacts_at(&self, clock: f64) -> Result<Vec<Contact>, ContactsError> {
        let frames = [self.a.path.frame(clock), self.b.path.frame(clock)];
        let b_to_a = frames[0].transform_from(&frames[1]);
        let mut skins = [
            NearSurface::new(self.a.body, Frame::IDENTITY),
            NearSurface::new(self.b.body, b_to_a),
        ];
        let budget = self.budget;
        let too_many = || ContactsError::TooManyPairs { budget };
        // Two measured distances may be off in either direction: that of the boxes, and that of the features.
        let reach = self.margin + self.tolerance + 2.0 * self.rounding;
        let near = near_face_pairs(self, &mut skins, &b_to_a, reach).ok_or_else(too_many)?;
        for skin in &mut skins {
            skin.find_internal_features(self.rounding);
        }
        let [a, b] = &skins;
        let mut manifold = ContactManifold::new(self, [a, b]);
        for faces in near {
            manifold.add_face_contacts(faces);
            if manifold.len() as u64 > budget {
                return Err(too_many());
            }
        }
        Ok(manifold.pairs(&frames[0]))
    }
}

impl fmt::Display for ContactsError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Input(error) => error.fmt(f),
            Self::NotInDuration {
                requested_time: time,
                duration,
            } => {
                write!(f, "time is {time}, but must be from 0 to {duration}")
            }
            Self::TooManyPairs { budget } => write!(
                f,
                "more pairs of features are near than a budget of {budget} allows"
            ),
        }
    }
}

impl std::error::Error for ContactsError {}

impl From<InputError> for ContactsError {
    fn from(error: InputError) -> Self {
        ContactsError::Input(error)
    }
}

#[cfg(test)]
mod tests;
