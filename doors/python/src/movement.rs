//! The movement of a body in a query: a motion, the motion of a robot's link, or a path.

use crate::body::extract_body;
use crate::errors::{input_error, wrong_type_error};
use crate::link_motion::PyLinkTrajectory;
use crate::motion::PyMotion;
use crate::path::PyPath;
use pyo3::prelude::*;
use rigid_ccd::trajectory::{LinkTrajectory, MovingBody, PosePath, Trajectory};
use rigid_ccd::{Body, Motion, Remark};

/// The movement of a body, as passed by Python.
pub(crate) enum GivenMovement<'c> {
    /// A motion. A motion between two poses has an end.
    Motion(Motion, Option<f64>),
    Link(LinkTrajectory<'c>, f64),
    Path(&'c PosePath),
}

impl<'c> GivenMovement<'c> {
    /// Extracts a movement from the argument `motion_a` or `motion_b`. None is a static body.
    pub(crate) fn extract(
        movement: Option<&'c Bound<'_, PyAny>>,
        argument_name: &str,
    ) -> PyResult<Self> {
        let Some(movement) = movement.filter(|movement| !movement.is_none()) else {
            return Ok(GivenMovement::Motion(Motion::STILL, None));
        };
        if let Ok(motion) = movement.cast::<PyMotion>() {
            let motion = motion.get();
            return Ok(GivenMovement::Motion(motion.motion, motion.end));
        }
        if let Ok(link) = movement.cast::<PyLinkTrajectory>() {
            return Ok(GivenMovement::Link(
                link.get().link()?,
                link.get().duration(),
            ));
        }
        if let Ok(path) = movement.cast::<PyPath>() {
            return Ok(GivenMovement::Path(&path.get().poses));
        }
        Err(wrong_type_error(
            argument_name,
            "a Motion, a PosePath or a LinkTrajectory",
            movement,
        ))
    }

    /// Returns the time at which the movement ends, or `None` for a motion at constant velocities, which has no end.
    fn end_time(&self) -> Option<f64> {
        match self {
            GivenMovement::Motion(_, end) => *end,
            GivenMovement::Link(_, duration) => Some(*duration),
            GivenMovement::Path(poses) => Some(poses.end_time()),
        }
    }

    fn trajectory(&self) -> &dyn Trajectory {
        match self {
            GivenMovement::Motion(motion, _) => motion,
            GivenMovement::Link(link, _) => link,
            GivenMovement::Path(poses) => *poses,
        }
    }
}

/// The two bodies of a query with their movements.
pub(crate) struct Pair<'c> {
    pub(crate) a: (&'c Body, GivenMovement<'c>),
    pub(crate) b: (&'c Body, GivenMovement<'c>),
}

/// A body and its motion, as passed by Python.
pub(crate) type GivenBodyAndMotion<'a, 'py> =
    (&'a Bound<'py, PyAny>, Option<&'a Bound<'py, PyAny>>);

impl<'c> Pair<'c> {
    /// Extracts the bodies and their movements from the arguments of a question.
    pub(crate) fn extract(
        [(a, motion_a), (b, motion_b)]: [GivenBodyAndMotion<'c, '_>; 2],
    ) -> PyResult<Self> {
        Ok(Pair {
            a: (
                extract_body(a, "a")?,
                GivenMovement::extract(motion_a, "motion_a")?,
            ),
            b: (
                extract_body(b, "b")?,
                GivenMovement::extract(motion_b, "motion_b")?,
            ),
        })
    }

    /// Returns the duration of a query: the requested one, or the default. The default is the end of links, paths and
    /// motions between two poses, or 1 if there is none. If both movements have an end, the ends must be equal.
    pub(crate) fn duration(&self, requested: Option<f64>) -> PyResult<f64> {
        let movements = [&self.a.1, &self.b.1];
        let ends = movements.iter().filter_map(|movement| movement.end_time());
        let duration = match requested {
            Some(duration) => duration,
            None => {
                let mut ends = ends;
                let first = ends.next().unwrap_or(1.0);
                if ends.all(|end| end == first) {
                    first
                } else {
                    return Err(input_error(
                        "duration: the motions of the two bodies end at different times; pass a duration",
                    ));
                }
            }
        };
        for movement in movements {
            if let GivenMovement::Link(_, end) = movement
                && duration > *end
            {
                return Err(input_error(format!(
                    "duration: {duration} is later than {end}, the end of the link's motion, after which joints could exceed their limits"
                )));
            }
        }
        Ok(duration)
    }

    /// Returns a remark for each motion whose angular velocity seems to be in degrees instead of radians.
    pub(crate) fn remarks(&self, duration: f64) -> impl Iterator<Item = Remark> {
        let movements = [&self.a.1, &self.b.1].into_iter();
        movements.filter_map(move |movement| match movement {
            GivenMovement::Motion(motion, _) => {
                Remark::remark_on_spin(motion.angular_velocity(), duration)
            }
            GivenMovement::Link(..) | GivenMovement::Path(_) => None,
        })
    }

    pub(crate) fn moving_bodies(&self) -> [MovingBody<'_>; 2] {
        [&self.a, &self.b].map(|(body, movement)| (*body, movement.trajectory()).into())
    }
}
