//! The accuracy of an answer, and the limits of the work on it.

use crate::limits;
use std::time::Duration;

/// The accuracy of an answer, and the definition of a contact.
///
/// ```
/// use ccd_core::Config;
/// // Contact is where the bodies come within a hundredth, to within a millionth.
/// let config = Config { margin: 0.01, tolerance: 1e-6, ..Config::default() };
/// assert_eq!(Config::default().tolerance, 1e-3);
/// # assert_eq!(config.deadline, None);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Config {
    /// A contact is reported at a distance of at most margin + tolerance. In the scene's unit of
    /// length, at least [`LEAST_TOLERANCE`](limits::LEAST_TOLERANCE).
    pub tolerance: f64,
    /// The distance to keep; 0 reports touching. In the scene's unit of length.
    pub margin: f64,
    /// A distance that the closest approach is to be compared with: the search ends as soon as it is
    /// proven to be kept, or seen not to be, by the shapes that the bodies may
    /// [exceed](crate::Body::with_excess). With none the closest approach is measured. Other
    /// questions have the margin. In the scene's unit of length.
    pub clearance: Option<f64>,
    /// The treatment of a contact at the start.
    pub start: StartPolicy,
    /// The most [work](crate::Stats::work) before the query is left unresolved: iterations over
    /// pairs of nodes, and other steps of the same cost. Each takes about a microsecond or less,
    /// and up to about 150 bytes.
    ///
    /// Along [trajectories](crate::Trajectory) it is for each part between two
    /// [corners](crate::Trajectory::corner), such as two poses of a path, and so grows with the path: a
    /// path of `n` poses takes at most `2 n` budgets, of which those for many poses at once are hardly
    /// used. The closest approach takes up to half as much again for early bounds. No path takes more than 65,536. The search for the [last
    /// contact](crate::schedule::ContactInterval) has as much again.
    pub budget: u64,
    /// The longest time before the query is left unresolved; with none no clock is read.
    ///
    /// It is checked every few hundred visits, and therefore exceeded by less than a millisecond if
    /// pieces are small. A call of an oracle is never interrupted. Whether the deadline is reached
    /// depends on the machine: answers that it ends differ from one call to the next.
    pub deadline: Option<Duration>,
    /// The vector instructions to compute with. Answers are the same, to the last bit.
    pub instructions: Instructions,
}

impl Default for Config {
    fn default() -> Self {
        Config {
            tolerance: limits::DEFAULT_TOLERANCE,
            margin: 0.0,
            clearance: None,
            start: StartPolicy::default(),
            budget: limits::DEFAULT_BUDGET,
            deadline: None,
            instructions: Instructions::default(),
        }
    }
}

/// The vector instructions to compute with.
///
/// On x86 these are AVX2 or SSE2. Other targets have one set each, NEON for instance.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Instructions {
    /// The best of the machine, found at run time.
    #[default]
    Best,
    /// Those of the target that the program was built for, which every machine of that target has.
    Baseline,
}

/// The treatment of a contact at the start.
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
/// // Two balls touch, and fly apart.
/// let leaving = Motion::new(Pose::at(DVec3::X)?, DVec3::X, DVec3::ZERO)?;
/// let outcome = |start| -> Result<Outcome, InputError> {
///     let config = Config { start, ..Config::default() };
///     let problem = Problem::new((&ball, Motion::STILL), (&ball, leaving), 1.0, &config)?;
///     Ok(BestFirst::default().solve(&problem, &mut Balls).outcome)
/// };
/// assert!(matches!(outcome(StartPolicy::Report)?, Outcome::Touching { .. }));
/// assert!(matches!(outcome(StartPolicy::Leave)?, Outcome::Free { .. }));
/// # Ok::<(), InputError>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum StartPolicy {
    /// The answer is [`Touching`](crate::Outcome::Touching).
    #[default]
    Report,
    /// Bodies that are within the tolerance at the start are let go for as long as they do not
    /// approach. The answer is the time at which they come within half the gap that they began
    /// with; from then on that is the tolerance.
    ///
    /// If that gap is no more than rounding, or the bodies begin inside the margin, pieces that
    /// rest on each other are let go until they approach. This takes a look at every pair of pieces
    /// that begins inside the margin: a margin as large as the bodies may cost the whole budget.
    ///
    /// Pieces that touch only later are let go as well, as long as the plane in which the bodies
    /// began to touch is between them and they do not approach it: a body slides on flat ground from
    /// one triangle onto the next, and onto another flat top of the same height. The plane stays with
    /// either body. All else that touches later is a contact, and so are two open surfaces that slide
    /// within the plane: their sides are unknown.
    Leave,
}
