//! The answer to a query.

use crate::body::feature::Feature;
use crate::distance::oracle::Effort;
use crate::math::order::lesser;
use crate::tolerance::LOOKS_PER_VISIT;
use glam::DVec3;
use std::fmt;

/// The answer to "when do they first touch?".
///
/// # Guarantee
/// Nothing touched before the time in it, in floating point as well. Contacts and their distances are those of the bodies,
/// also of bodies that [exceed](crate::Body::with_excess) their shapes: the shapes touch no earlier, and may be farther
/// apart by the excess of both.
///
/// ```
/// use ccd_core::Outcome;
/// /// The part of a motion that is safe to make.
/// fn safe_share(outcome: &Outcome, duration: f64) -> f64 {
///     match *outcome {
///         Outcome::Free { .. } => 1.0,
///         Outcome::Contact { time, .. } => time / duration,
///         Outcome::Unresolved { safe_until, .. } => safe_until / duration,
///         Outcome::Touching { .. } | Outcome::Overlapping { .. } => 0.0,
///     }
/// }
/// assert_eq!(safe_share(&Outcome::Free { proven_gap: 0.1 }, 2.0), 1.0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Outcome {
    /// The bodies come within margin + tolerance at `time`, and never touched before.
    Contact {
        /// The time, in the motions' unit.
        time: f64,
        /// The separation at that time: `lower` and `upper` bound the distance of the bodies.
        contact: Contact,
    },
    /// The bodies stay apart over the whole duration.
    Free {
        /// A lower bound of the distance at all times: half the tolerance beyond the margin, however far apart the
        /// bodies are; less, down to 0, where a contact at the start was [let go](crate::StartPolicy::Leave). The
        /// least distance is another question:
        /// [`closest_approach`](crate::schedule::DepthFirst::closest_approach).
        proven_gap: f64,
    },
    /// The bodies are within margin + tolerance at the start, without overlapping.
    Touching {
        /// The separation at the start: `lower` and `upper` bound the distance of the bodies.
        contact: Contact,
    },
    /// The bodies overlap at the start.
    Overlapping {
        /// The proof.
        overlap: Overlap,
    },
    /// A limit was reached before an answer.
    Unresolved {
        /// The bodies do not touch before this time, certified.
        safe_until: f64,
        /// The limit.
        reason: Limit,
    },
}

/// The proof of an overlap at the start.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Overlap {
    /// Two pieces intersect, and no axis separates them; the contact's witnesses are in both.
    Pieces(Contact),
    /// This point of body A, in world coordinates, is inside the solid body B.
    AInsideB(DVec3),
    /// This point of body B, in world coordinates, is inside the solid body A.
    BInsideA(DVec3),
}

/// The limit that ended a query early.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Limit {
    /// The [budget](crate::Config::budget) was spent.
    Budget,
    /// The [deadline](crate::Config::deadline) was passed.
    Deadline,
    /// The caller [stopped](crate::Problem::stopped_by) the query.
    Stopped,
    /// A pair's proof could not be prolonged: the next step is below the time's resolution.
    Stalled,
    /// The oracle gave up on a pair, and no other oracle was available.
    OracleGaveUp,
    /// Bodies that touch at the start, or one of which may be inside the other, are too near to
    /// each other to decide whether they overlap.
    Undecided,
}

impl fmt::Display for Limit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Limit::Budget => "budget",
            Limit::Deadline => "deadline",
            Limit::Stopped => "stopped",
            Limit::Stalled => "stalled",
            Limit::OracleGaveUp => "oracle gave up",
            Limit::Undecided => "undecided",
        })
    }
}

/// A checked pair of nearest points, with the features that hold them.
///
/// ```
/// use ccd_core::{glam::DVec3, schedule::BestFirst, *};
/// # struct Balls;
/// # impl DistanceOracle for Balls {
/// #     type Cache = ();
/// #     fn separation(&mut self, pair: &PiecePair<'_>, _: &mut ()) -> Result<Claim, GiveUp> {
/// #         let axis = pair.b_to_a.point(pair.b.points[0]) - pair.a.points[0];
/// #         Ok(Claim { axis, a: Combination::point(0), b: Combination::point(0) })
/// #     }
/// # }
/// let ball = Body::ball(0.5)?;
/// let flying = Motion::new(Pose::at(-3.0 * DVec3::X)?, DVec3::X, DVec3::ZERO)?;
/// let problem = Problem::new((&ball, flying), (&ball, Motion::STILL), 4.0, &Config::default())?;
/// let answer = BestFirst::default().solve(&problem, &mut Balls);
/// let Outcome::Contact { contact, .. } = answer.outcome else { panic!("they meet") };
/// // From A to B, with a point of either ball, which is one piece without vertices.
/// assert_eq!(contact.separation.normal, DVec3::X);
/// assert!(contact.separation.witness_b.distance(-0.5 * DVec3::X) < 1e-12);
/// assert_eq!((contact.piece_a, contact.piece_b), (0, 0));
/// # Ok::<(), InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// The separation in world coordinates at the time reported.
    pub separation: Separation,
    /// The feature of body A at its witness point.
    pub feature_a: Feature,
    /// The feature of body B at its witness point.
    pub feature_b: Feature,
    /// The piece of body A, as an index into [`Body::pieces`](crate::Body::pieces).
    pub piece_a: u32,
    /// The piece of body B.
    pub piece_b: u32,
}

impl Contact {
    /// Returns the contact with a lower bound of at most `least`, which bounds a part of the
    /// bodies.
    pub(crate) fn no_nearer_than(self, least: f64) -> Self {
        Contact {
            separation: Separation {
                lower: lesser(self.separation.lower, least),
                ..self.separation
            },
            ..self
        }
    }
}

/// A checked claim: two pieces are at least `lower` and at most `upper` apart.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Separation {
    /// A lower bound of the distance: the support gap along `normal`, minus rounding. Negative if
    /// no separating axis was found.
    pub lower: f64,
    /// An upper bound of the distance: that of the witnesses, plus rounding. In an answer about the
    /// [least](crate::schedule::ClosestApproach) or the [greatest](crate::schedule::GreatestDistance)
    /// distance, plus the excess of both bodies.
    pub upper: f64,
    /// Unit vector from A to B along which `lower` was checked.
    pub normal: DVec3,
    /// The witness point on A.
    pub witness_a: DVec3,
    /// The witness point on B.
    pub witness_b: DVec3,
}

/// The cost of an answer.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Stats {
    /// The number of pairs of nodes that were bounded or split, pairs of pieces included.
    pub iterations: u64,
    /// The approximate number of looks at points of pieces: in each step of an oracle's search, and
    /// each time a gap is followed.
    pub point_looks: u64,
    /// The number of calls of the oracle.
    pub oracle_calls: u64,
    /// The number of times that the oracle gave up.
    pub give_ups: u64,
    /// The largest number of pairs that waited at one time.
    pub peak_front: u64,
    /// The number of times that all pairs were advanced together: the steps of conservative
    /// advancement, the first distance included. 0 for schedules with a clock for every pair.
    pub advancements: u64,
    /// The effort of the oracle.
    pub effort: Effort,
}

impl Stats {
    /// Returns the work that the [budget](crate::Config::budget) limits: iterations, plus one for
    /// every [`LOOKS_PER_VISIT`] looks at points.
    #[inline]
    pub fn work(&self) -> u64 {
        self.iterations + self.point_looks / LOOKS_PER_VISIT
    }

    /// Adds the cost of another answer.
    pub(crate) fn add(&mut self, other: &Stats) {
        self.iterations += other.iterations;
        self.point_looks += other.point_looks;
        self.oracle_calls += other.oracle_calls;
        self.give_ups += other.give_ups;
        self.peak_front = self.peak_front.max(other.peak_front);
        self.advancements += other.advancements;
        self.effort = self.effort + other.effort;
    }
}

/// An outcome with its accuracy and its cost.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Answer<T = Outcome> {
    /// The outcome.
    pub outcome: T,
    /// The tolerance of the answer. It is the requested one, unless only a larger one can be
    /// certified at the coordinates of the scene, or the bodies were [let
    /// go](crate::StartPolicy::Leave) with a smaller one. Of bounds of a distance it is at least their
    /// width, which the [excess](crate::Body::with_excess) of the bodies is a part of.
    pub tolerance: f64,
    /// The cost.
    pub stats: Stats,
}

impl<T> Answer<T> {
    /// Returns the answer with another form of its outcome.
    pub fn map<U>(self, told: impl FnOnce(T) -> U) -> Answer<U> {
        Answer {
            outcome: told(self.outcome),
            tolerance: self.tolerance,
            stats: self.stats,
        }
    }
}
