//! Queries: two moving bodies, a duration and settings.

use crate::answer::Contact;
use crate::body::Body;
use crate::body::excess::ExcessSum;
use crate::contacts::ContactsError;
use crate::error::{InputError, check};
use crate::limits::MAX_DURATION;
use crate::motion::Motion;
use crate::motion::pose::Pose;
use crate::motion::trajectory::{Stretch, Trajectory};
use crate::problem::Problem;
use crate::settings::{EngineOptions, QuerySettings, Settings};
use std::fmt;
use std::time::Duration;

/// A body and how it moves.
///
/// ```
/// use ccd_core::{Body, Motion, MovingBody};
/// let ball = Body::sphere(0.5)?;
/// let resting: MovingBody = (&ball, Motion::STILL).into();
/// # Ok::<(), ccd_core::InputError>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct MovingBody<'a> {
    /// The moving body, which several queries may share.
    pub body: &'a Body,
    /// The motion or the trajectory of the body during the query.
    pub movement: Movement<'a>,
}

/// How a body moves: with constant velocities, or along a trajectory.
#[derive(Clone, Copy)]
pub enum Movement<'a> {
    /// The body moves with constant velocities.
    Motion(Motion),
    /// The body moves along any other trajectory.
    Trajectory(&'a dyn Trajectory),
}

impl<'a, M: Into<Movement<'a>>> From<(&'a Body, M)> for MovingBody<'a> {
    fn from((body, movement): (&'a Body, M)) -> Self {
        MovingBody {
            body,
            movement: movement.into(),
        }
    }
}

impl From<Motion> for Movement<'_> {
    fn from(motion: Motion) -> Self {
        Movement::Motion(motion)
    }
}

impl From<Pose> for Movement<'_> {
    fn from(pose: Pose) -> Self {
        Motion::still(pose).into()
    }
}

impl<'a, T: Trajectory> From<&'a T> for Movement<'a> {
    fn from(trajectory: &'a T) -> Self {
        (trajectory as &dyn Trajectory).into()
    }
}

impl<'a> From<&'a dyn Trajectory> for Movement<'a> {
    fn from(trajectory: &'a dyn Trajectory) -> Self {
        match trajectory.as_motion() {
            Some(motion) => Movement::Motion(motion),
            None => Movement::Trajectory(trajectory),
        }
    }
}

impl Trajectory for Movement<'_> {
    fn stretch_between(&self, from: f64, to: f64) -> Result<Stretch, InputError> {
        match self {
            Movement::Motion(motion) => motion.stretch_between(from, to),
            Movement::Trajectory(trajectory) => trajectory.stretch_between(from, to),
        }
    }

    fn velocity_jump_time(&self, from: f64, to: f64) -> Option<f64> {
        match self {
            Movement::Motion(motion) => Trajectory::velocity_jump_time(motion, from, to),
            Movement::Trajectory(trajectory) => trajectory.velocity_jump_time(from, to),
        }
    }

    fn as_motion(&self) -> Option<Motion> {
        match self {
            Movement::Motion(motion) => Some(*motion),
            Movement::Trajectory(_) => None,
        }
    }

    fn pose(&self, time: f64) -> Result<Pose, InputError> {
        match self {
            Movement::Motion(motion) => Ok(motion.pose(time)),
            Movement::Trajectory(trajectory) => trajectory.pose(time),
        }
    }
}

impl fmt::Debug for Movement<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Movement::Motion(motion) => f.debug_tuple("Motion").field(motion).finish(),
            Movement::Trajectory(_) => f.debug_tuple("Trajectory").finish_non_exhaustive(),
        }
    }
}

/// A validated query about two moving bodies over `[0, duration]`.
///
/// One query serves every question: [schedules](crate::Schedule) find the first contact,
/// [`BestFirst`](crate::schedule::BestFirst) and [`DepthFirst`](crate::schedule::DepthFirst) answer the others.
///
/// A query about two [motions](Motion) is answered at once. Along other [trajectories](Trajectory) it is answered
/// stretch by stretch, and bodies in contact at the start are never [let go](crate::StartPolicy::Leave).
///
/// ```
/// use ccd_core::{glam::DVec3, Body, Motion, Pose, Query, Settings};
/// let cube = Body::cuboid([0.5, 0.5, 0.5])?;
/// let above = Pose::at(DVec3::new(0.0, 0.0, 1e9))?;
/// let falling = Motion::new(above, -1e9 * DVec3::Z, DVec3::X)?;
/// let query = Query::new((&cube, falling), (&cube, Motion::STILL), 1.0, &Settings::DEFAULT)?;
/// // At such coordinates no finer tolerance than this can be certified.
/// assert!(query.tolerance() > 1e-6);
/// # Ok::<(), ccd_core::InputError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Query<'a> {
    pub(crate) a: MovingBody<'a>,
    pub(crate) b: MovingBody<'a>,
    pub(crate) duration: f64,
    pub(crate) settings: QuerySettings<'a>,
    /// The normalised problem, if both bodies move at constant velocities.
    pub(crate) constant_velocity_problem: Option<Problem<'a>>,
}

impl<'a> Query<'a> {
    /// Creates a query about two bodies, each with its motion, its trajectory, or the pose at which it rests.
    ///
    /// # Errors
    /// [`InputError::OutOfRange`] for
    /// - a negative duration, margin or clearance, and a tolerance that is not positive;
    /// - a turn beyond [`MAX_ROTATION_ANGLE`](crate::limits::MAX_ROTATION_ANGLE), and lengths beyond
    ///   [`MAX_COORDINATE`](crate::limits::MAX_COORDINATE): the tolerance, the margin, and for motions each body's
    ///   position at the start, its center, and the distance from B's position to that center at all times;
    /// - along trajectories, a duration above [`MAX_DURATION`].
    pub fn new(
        a: impl Into<MovingBody<'a>>,
        b: impl Into<MovingBody<'a>>,
        duration: f64,
        settings: &'a Settings,
    ) -> Result<Self, InputError> {
        Query::with_query_settings(a.into(), b.into(), duration, settings.to_query_settings())
    }

    /// Returns the query about the bodies at rest, where they are at the start. Along trajectories the bodies are at
    /// [`Trajectory::pose`]; the deviation of that pose is not included.
    ///
    /// # Errors
    /// Those of trajectories, and those of [`Query::new`] for the poses at the start.
    pub fn at_start(&self) -> Result<Self, InputError> {
        let rest = |moving: &MovingBody<'a>| -> Result<MovingBody<'a>, InputError> {
            Ok((moving.body, moving.movement.pose(0.0)?).into())
        };
        Query::with_query_settings(rest(&self.a)?, rest(&self.b)?, 0.0, self.settings)
    }

    #[inline]
    fn with_query_settings(
        a: MovingBody<'a>,
        b: MovingBody<'a>,
        duration: f64,
        terms: QuerySettings<'a>,
    ) -> Result<Self, InputError> {
        // One expression for each case: a problem is large, and is not moved again.
        if let (Movement::Motion(of_a), Movement::Motion(of_b)) = (a.movement, b.movement) {
            let bodies = [(a.body, of_a), (b.body, of_b)];
            let problem = Problem::new(bodies, duration, &terms)?;
            return Ok(Query {
                a,
                b,
                duration,
                settings: terms,
                constant_velocity_problem: Some(problem),
            });
        }
        terms.check(duration)?;
        check(
            "duration",
            duration,
            duration <= MAX_DURATION,
            "at most 1e50 along trajectories",
        )?;
        Ok(Query {
            a,
            b,
            duration,
            settings: terms,
            constant_velocity_problem: None,
        })
    }

    /// Sets another deadline, for callers that divide the time among many queries.
    #[must_use]
    pub fn with_deadline(mut self, deadline: Option<Duration>) -> Self {
        self.settings.deadline = deadline;
        if let Some(problem) = &mut self.constant_velocity_problem {
            problem.deadline = deadline;
        }
        self
    }

    /// Sets how the engine computes the answer.
    #[must_use]
    pub fn with_engine_options(mut self, options: EngineOptions) -> Self {
        self.settings.engine_options = options;
        if let Some(problem) = &mut self.constant_velocity_problem {
            problem.simd_level = options.vector_instructions.simd_level();
            problem.shortcuts = options.shortcuts;
        }
        self
    }

    /// Returns the duration.
    pub fn duration(&self) -> f64 {
        self.duration
    }

    /// Returns the tolerance of the answer: the requested one, or the least that can be certified in f64 at the
    /// coordinates of the two motions. Along trajectories it may be larger.
    pub fn tolerance(&self) -> f64 {
        let problem = self.constant_velocity_problem.as_ref();
        problem.map_or(self.settings.tolerance, |problem| problem.tolerance)
    }

    /// Returns all pairs of features that are in contact at a time, the contact manifold `[FAST06 §5.2]`.
    ///
    /// There are two kinds of pairs. Each pair is listed once, nearest first:
    /// - a vertex and the nearest part of a face: usually the face's inside, at the vertex's foot,
    ///   otherwise an edge or a vertex of the face. An edge or vertex is left out if a larger part
    ///   with it on its boundary makes a pair with the same vertex at the same distance;
    /// - two edges whose nearest points are inside of both. Edges that are parallel up to rounding
    ///   do not cross: their ends make the pairs.
    ///
    /// The edge between two triangles that share its vertices and are in one plane, up to rounding,
    /// is not part of the shape. It crosses nothing. A point on it belongs to the face of smaller
    /// number, and is in a pair only if neither triangle comes nearer. A cube that lies flat on a
    /// slab therefore has four pairs, however the faces are cut into triangles.
    ///
    /// Features have the same names as in answers. A feature without a number has the name of its
    /// face or piece: all features of outer hulls, and corners where the mesh has no vertex.
    /// Such a pair of names may be listed more than once, for different places. The same mesh has
    /// the same names in triangles, patches and hulls. Virtual facets make no pairs on pieces that
    /// have faces of the mesh. A piece of more than three points without known facets has vertices
    /// only.
    ///
    /// Distances are unsigned: for bodies that overlap at that time, these are the features whose
    /// boundaries are near each other.
    ///
    /// # Guarantee
    /// No pair within margin + tolerance is missed, and
    /// [`Separation::lower`](crate::Separation::lower) of every pair is within that. Lower and
    /// upper bound are those of the two features, rounding included. The same call gives the same
    /// bits. Along trajectories the bodies are at [`Trajectory::pose`]; the deviation of that pose is not included.
    ///
    /// # Errors
    /// [`ContactsError`].
    ///
    /// # Complexity
    /// Near-linear in the pairs of pieces and of faces whose boxes are within margin + tolerance,
    /// and in all faces of these pieces. A descent over both bodies' trees finds the pieces.
    /// Another one finds the faces, which are sorted once. The budget limits each of them.
    ///
    /// ```
    /// use ccd_core::{glam::DVec3, Body, Pose, Query, Settings};
    /// let (cube, slab) = (Body::cuboid(DVec3::splat(0.5))?, Body::cuboid(DVec3::new(2.0, 2.0, 1.0))?);
    /// let place = Pose::at(DVec3::new(0.3, 0.2, 1.5005))?;
    /// let query = Query::new((&cube, place), (&slab, Pose::IDENTITY), 1.0, &Settings::DEFAULT)?;
    /// let contacts = query.contacts_at(0.0)?;
    /// let names = contacts.iter().map(|pair| format!("{} {}", pair.feature_a, pair.feature_b));
    /// let mut names: Vec<String> = names.collect();
    /// names.sort();
    /// assert_eq!(names, ["v0 f5", "v1 f5", "v2 f5", "v3 f5"]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn contacts_at(&self, time: f64) -> Result<Vec<Contact>, ContactsError> {
        // Written so that NaN is refused.
        if !(0.0..=self.duration).contains(&time) {
            let duration = self.duration;
            return Err(ContactsError::NotInDuration {
                requested_time: time,
                duration,
            });
        }
        if let Some(problem) = &self.constant_velocity_problem {
            return problem.contacts_at(problem.clock_of_time(time));
        }
        let still = |moving: &MovingBody<'a>| {
            let stretch = moving.movement.stretch_between(time, time)?;
            Ok::<_, InputError>((moving.body, Motion::still(stretch.motion.start())))
        };
        let bodies = [still(&self.a)?, still(&self.b)?];
        Problem::new(bodies, 0.0, &self.settings)?.contacts_at(0.0)
    }

    /// Returns the distance by which the two bodies may exceed their shapes.
    pub(crate) fn excess(&self) -> ExcessSum {
        ExcessSum::sum_of_bodies(self.a.body, self.b.body)
    }
}
