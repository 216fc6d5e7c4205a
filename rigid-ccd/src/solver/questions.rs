//! The questions of a solver as pointers to functions, so that crates that ask them do not compile the engine anew.
//!
//! A generic function is compiled in each crate that calls it. Called by a pointer, the engine for [`Direct`] is compiled
//! once, in this crate: a program with three crates that ask questions would have three copies of it.
//!
//! [`Direct`]: crate::oracle::Direct

use ccd_core::schedule::{BestFirst, DepthFirst, Schedule};
use ccd_core::{Answer, DistanceOracle, InputError, Query};

type Ask<S, O> = fn(&mut S, &Query<'_>, &mut O) -> Result<Answer, InputError>;

pub(super) struct Questions<O: DistanceOracle> {
    pub(super) first_contact: Ask<BestFirst<O>, O>,
    pub(super) contact_interval: Ask<BestFirst<O>, O>,
    pub(super) any_contact: Ask<DepthFirst<O>, O>,
    pub(super) closest_approach: Ask<DepthFirst<O>, O>,
}

impl<O: DistanceOracle> Questions<O> {
    /// The engine compiled for a distance backend, in the crate that names the backend.
    pub(super) const COMPILED: Self = Questions {
        first_contact: Schedule::first_contact,
        contact_interval: BestFirst::contact_interval,
        any_contact: DepthFirst::any_contact,
        closest_approach: DepthFirst::closest_approach,
    };
}
