//! A query: two moving bodies, a duration, and how accurately to answer.

use crate::body::Body;
use crate::error::InputError;
use crate::motion::Motion;
use crate::tolerance;

/// How accurately to answer, and what to count as a contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Config {
    /// A contact is reported at a distance of at most margin + tolerance. In the scene's unit of
    /// length, positive.
    pub tolerance: f64,
    /// The distance to keep; 0 reports touching. In the scene's unit of length.
    pub margin: f64,
    /// What becomes of a contact at the start.
    pub start: StartPolicy,
    /// How many pairs of nodes may be visited before the query is left unresolved; each takes up to
    /// about 150 bytes.
    pub budget: u64,
}

impl Default for Config {
    fn default() -> Self {
        Config {
            tolerance: tolerance::DEFAULT_TOLERANCE,
            margin: 0.0,
            start: StartPolicy::default(),
            budget: tolerance::DEFAULT_BUDGET,
        }
    }
}

/// What becomes of a contact at the start.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum StartPolicy {
    /// It is the answer: [`Touching`](crate::Outcome::Touching).
    #[default]
    Report,
    /// Pieces that are within the tolerance at the start are let go for as long as they do not
    /// approach; the first contact beyond that is the answer.
    Leave,
}

/// A body and how it moves.
#[derive(Clone, Copy, Debug)]
pub struct Moving<'a> {
    /// What moves.
    pub body: &'a Body,
    /// How.
    pub motion: Motion,
}

/// A well-posed query.
#[derive(Clone, Debug)]
pub struct Problem<'a> {
    pub(crate) a: Moving<'a>,
    pub(crate) b: Moving<'a>,
    pub(crate) duration: f64,
    pub(crate) tolerance: f64,
    pub(crate) margin: f64,
    pub(crate) start: StartPolicy,
    pub(crate) budget: u64,
    /// Bounds the rounding of any distance computed in f64, see [`tolerance::distance_rounding`].
    pub(crate) rounding: f64,
}

impl<'a> Problem<'a> {
    /// Poses a query over `[0, duration]`.
    ///
    /// # Errors
    /// [`InputError::OutOfRange`] for a duration that is negative or a tolerance that is not
    /// positive, [`InputError::NotFinite`].
    pub fn new(
        a: Moving<'a>,
        b: Moving<'a>,
        duration: f64,
        config: &Config,
    ) -> Result<Self, InputError> {
        Ok(Problem { a, b, duration, tolerance: config.tolerance, margin: config.margin, start: config.start, budget: config.budget, rounding: 0.0 })
    }
}
