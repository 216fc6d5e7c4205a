//! What moves a body: a motion, a link of an arm, a path.

use crate::chain::PyLink;
use crate::errors::wrong_type;
use crate::motion::PyMotion;
use crate::path::PyPath;
use pyo3::prelude::*;
use rigid_ccd::trajectory::{Link, Poses, Trajectory};
use rigid_ccd::{Body, Motion, Moving, Travelling};

/// How a body moves.
pub(crate) enum Course<'c> {
    Motion(Motion),
    Link(Link<'c>),
    Path(&'c Poses),
}

impl<'c> Course<'c> {
    /// Takes what Python passes as `motion_a` or `motion_b`; None is at rest.
    pub(crate) fn of(given: Option<&'c Bound<'_, PyAny>>, what: &str) -> PyResult<Self> {
        let Some(given) = given.filter(|given| !given.is_none()) else {
            return Ok(Course::Motion(Motion::STILL));
        };
        if let Ok(motion) = given.cast::<PyMotion>() {
            return Ok(Course::Motion(motion.get().motion));
        }
        if let Ok(link) = given.cast::<PyLink>() {
            return Ok(Course::Link(link.get().link()?));
        }
        if let Ok(path) = given.cast::<PyPath>() {
            return Ok(Course::Path(&path.get().poses));
        }
        Err(wrong_type(
            what,
            "a Motion, a Path or a link of a Chain",
            given,
        ))
    }

    fn trajectory(&self) -> &dyn Trajectory {
        match self {
            Course::Motion(motion) => motion,
            Course::Link(link) => link,
            Course::Path(poses) => *poses,
        }
    }
}

/// Two bodies with their courses.
pub(crate) struct Pair<'c> {
    pub(crate) a: (&'c Body, Course<'c>),
    pub(crate) b: (&'c Body, Course<'c>),
}

/// Two bodies as the solver takes them.
pub(crate) enum Moved<'c> {
    /// At constant velocities: the faster way.
    Steadily(Moving<'c>, Moving<'c>),
    Along(Travelling<'c>, Travelling<'c>),
}

impl Pair<'_> {
    pub(crate) fn moved(&self) -> Moved<'_> {
        let (a, b) = (&self.a, &self.b);
        if let (Course::Motion(motion_a), Course::Motion(motion_b)) = (&a.1, &b.1) {
            return Moved::Steadily((a.0, *motion_a).into(), (b.0, *motion_b).into());
        }
        let along = |body, trajectory| Travelling { body, trajectory };
        Moved::Along(along(a.0, a.1.trajectory()), along(b.0, b.1.trajectory()))
    }
}
