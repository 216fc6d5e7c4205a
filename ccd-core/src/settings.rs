//! The settings of queries: contact distance, accuracy, and limits of the work.

mod engine_options;
mod named;

pub use engine_options::{EngineOptions, Shortcut, Shortcuts, VectorInstructions};
pub use named::{Setting, SettingField};

use crate::error::{InputError, check};
use crate::limits::{self, LEAST_TOLERANCE, MAX_COORDINATE};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

/// The settings of a query: contact distance, accuracy, and limits of the work.
///
/// ```
/// use ccd_core::Settings;
/// // A contact is where the bodies come within a hundredth, to within a millionth.
/// let settings = Settings { margin: 0.01, tolerance: 1e-6, ..Settings::DEFAULT };
/// assert_eq!(Settings::DEFAULT.tolerance, 1e-3);
/// # assert_eq!(settings.deadline, None);
/// ```
#[derive(Clone, Debug)]
pub struct Settings {
    /// The accuracy of contacts: a contact is reported at a distance of at most margin + tolerance. In the scene's unit
    /// of length, at least [`LEAST_TOLERANCE`](limits::LEAST_TOLERANCE).
    pub tolerance: f64,
    /// The distance at which bodies count as touching, in the scene's unit of length; 0 reports actual contact.
    pub margin: f64,
    /// The distance that the bodies are required to keep, in the scene's unit of length; the closest approach is
    /// compared with it. The search ends as soon as the distance is proven to be kept, or violated, by the shapes that
    /// the bodies may [exceed](crate::Body::with_excess). With `None` the closest approach is measured. Other questions
    /// use the margin.
    pub clearance: Option<f64>,
    /// The policy for bodies that are in contact at the start: report the contact, or ignore it until they approach.
    pub start_policy: StartPolicy,
    /// The largest amount of [work](crate::Stats::budgeted_work) before the query is left unresolved. It counts iterations over
    /// pairs of nodes, and other steps of the same cost. Each takes about a microsecond or less, and up to about 150
    /// bytes.
    ///
    /// Along [trajectories](crate::Trajectory) it is for each part between two [corners](crate::Trajectory::velocity_jump_time),
    /// such as two poses of a path, and so grows with the path: a path of `n` poses takes at most `2 n` budgets, of
    /// which those for many poses at once are hardly used. The closest approach takes up to half as much again for
    /// early bounds. No path takes more than 65,536. The search for the [last
    /// contact](crate::schedule::BestFirst::contact_interval) has as much again.
    pub budget: u64,
    /// The time after which the query ends as unresolved; `None` for no limit of time.
    ///
    /// The deadline is checked every few visits, and is therefore exceeded by a few microseconds if pieces are small. A
    /// call of an oracle is never interrupted, nor is the search for a [refined normal](ContactNormals::Refined).
    /// Whether the deadline is reached depends on the machine: answers that it ends differ from one call to the next.
    pub deadline: Option<Duration>,
    /// How the normals of contacts are found.
    pub contact_normals: ContactNormals,
    /// A flag that another thread sets to stop the query; `None` if nothing stops it. Soon after it is set, a query
    /// ends as [`Limit::Stopped`](crate::Limit::Stopped), with a certified time. It is read as often as the clock is
    /// for a deadline.
    ///
    /// ```
    /// use ccd_core::Settings;
    /// use std::sync::{Arc, atomic::AtomicBool};
    /// let stop = Arc::new(AtomicBool::new(false));
    /// let settings = Settings::DEFAULT.stopped_by(&stop);
    /// ```
    pub stop: Option<Arc<AtomicBool>>,
}

impl Settings {
    /// The default settings: tolerance 0.001, margin 0, contacts at the start reported, no deadline.
    pub const DEFAULT: Settings = Settings {
        tolerance: limits::DEFAULT_TOLERANCE,
        margin: 0.0,
        clearance: None,
        start_policy: StartPolicy::Report,
        budget: limits::DEFAULT_BUDGET,
        deadline: None,
        contact_normals: ContactNormals::Refined,
        stop: None,
    };

    /// Returns the settings with `stop` as the flag that stops queries.
    #[must_use]
    pub fn stopped_by(self, stop: &Arc<AtomicBool>) -> Self {
        Settings {
            stop: Some(Arc::clone(stop)),
            ..self
        }
    }

    /// Checks that the tolerance, the margin and the clearance are in the ranges that queries accept.
    ///
    /// # Errors
    /// [`InputError::OutOfRange`].
    ///
    /// ```
    /// use ccd_core::Settings;
    /// let negative = Settings { margin: -0.1, ..Settings::DEFAULT };
    /// assert!(negative.check().is_err() && Settings::DEFAULT.check().is_ok());
    /// ```
    pub fn check(&self) -> Result<(), InputError> {
        self.to_query_settings().check(0.0)
    }

    /// Returns the settings in the form that a query stores, with the stop flag borrowed.
    pub(crate) fn to_query_settings(&self) -> QuerySettings<'_> {
        QuerySettings {
            tolerance: self.tolerance,
            margin: self.margin,
            clearance: self.clearance,
            start: self.start_policy,
            budget: self.budget,
            deadline: self.deadline,
            contact_normals: self.contact_normals,
            engine_options: EngineOptions::DEFAULT,
            stop: self.stop.as_deref(),
        }
    }
}

impl Default for Settings {
    fn default() -> Self {
        Settings::DEFAULT
    }
}

/// The settings in the form that a query stores. The flag is borrowed, so that a query counts no references.
#[derive(Clone, Copy, Debug)]
pub(crate) struct QuerySettings<'a> {
    pub(crate) tolerance: f64,
    pub(crate) margin: f64,
    pub(crate) clearance: Option<f64>,
    pub(crate) start: StartPolicy,
    pub(crate) budget: u64,
    pub(crate) deadline: Option<Duration>,
    pub(crate) contact_normals: ContactNormals,
    pub(crate) engine_options: EngineOptions,
    pub(crate) stop: Option<&'a AtomicBool>,
}

impl QuerySettings<'_> {
    /// Returns an error if a duration, tolerance, margin or clearance is out of range.
    pub(crate) fn check(&self, duration: f64) -> Result<(), InputError> {
        let finite = 0.0..=f64::MAX;
        check(
            "duration",
            duration,
            finite.contains(&duration),
            "at least 0 and finite",
        )?;
        let tolerance = self.tolerance;
        let allowed = (LEAST_TOLERANCE..=MAX_COORDINATE).contains(&tolerance);
        check("tolerance", tolerance, allowed, "from 1e-100 to 1e12")?;
        let clearance = self.clearance.unwrap_or(0.0);
        for (what, length) in [("margin", self.margin), ("clearance", clearance)] {
            let allowed = (0.0..=MAX_COORDINATE).contains(&length);
            check(what, length, allowed, "at least 0 and at most 1e12")?;
        }
        Ok(())
    }
}

/// How the normals of contacts are found.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ContactNormals {
    /// Where pieces touch up to rounding, the normal is one of the surfaces around them. To find it may take some hundred
    /// microseconds, and the first contact on a piece of a solid allocates.
    #[default]
    Refined,
    /// The normal is that of the two pieces, which is mostly rounding error where they touch.
    OfPieces,
}

/// The policy for bodies that are in contact at the start.
///
/// ```
/// use ccd_core::{glam::DVec3, schedule::BestFirst, *};
/// # struct Balls;
/// # impl DistanceOracle for Balls {
/// #     type Cache = ();
/// #     fn separation(&mut self, pair: &PiecePair<'_>, _: &mut ()) -> Result<Claim, GiveUpReason> {
/// #         let axis = pair.b_to_a.transform_point(pair.b.points[0]) - pair.a.points[0];
/// #         Ok(Claim { axis, a: ConvexCombination::from_single_point(0), b: ConvexCombination::from_single_point(0) })
/// #     }
/// # }
/// let ball = Body::sphere(0.5)?;
/// // Two balls touch, and fly apart.
/// let leaving = Motion::new(Pose::at(DVec3::X)?, DVec3::X, DVec3::ZERO)?;
/// let outcome = |start_policy| -> Result<Outcome, InputError> {
///     let settings = Settings { start_policy, ..Settings::DEFAULT };
///     let query = Query::new((&ball, Motion::STILL), (&ball, leaving), 1.0, &settings)?;
///     Ok(BestFirst::default().first_contact(&query, &mut Balls)?.outcome)
/// };
/// assert!(matches!(outcome(StartPolicy::Report)?, Outcome::Touching { .. }));
/// assert!(matches!(outcome(StartPolicy::Leave)?, Outcome::Free { .. }));
/// # Ok::<(), InputError>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum StartPolicy {
    /// The query ends with the answer [`Touching`](crate::Outcome::Touching).
    #[default]
    Report,
    /// The contact at the start is ignored as long as the bodies do not approach. The answer is the time at which they
    /// come within half the gap that they began with; that half is the tolerance from then on.
    ///
    /// If that gap is no more than rounding, or the bodies begin inside the margin, pieces that rest on each other
    /// are let go until they approach. This takes one visit for every pair of pieces that begins inside the margin: a
    /// margin as large as the bodies may cost the whole budget.
    ///
    /// Pieces that touch only later are let go as well, as long as the plane in which the bodies began to touch is
    /// between them and they do not approach it. A body thus slides on flat ground from one triangle onto the next,
    /// and onto another flat top of the same height. The plane stays with either body. Every other later touch is a
    /// contact. So is that of two open surfaces that slide within the plane: their sides are unknown.
    Leave,
}
