//! Computes ground truth: a rigorous bracket of the exact first contact of two moving surfaces.
//!
//! It judges the engine and its rivals, and shares no code with them: it has its own tree,
//! distance, motion and rounding. It reads only the numbers of a motion and of a mesh.
//!
//! | to … | see |
//! |---|---|
//! | enclose numbers, rotations and placements by interval arithmetic | `interval`, `enclosure`, `track` |
//! | show that boxes or triangles stay apart over a span of time | `snapshot`, `triangle` |
//! | prove that two triangles share a point at an instant | `pierce` |
//! | search in time, earliest first | `search` |
//! | bracket the distance at one time | `gap` |

mod enclosure;
mod gap;
mod interval;
mod pierce;
mod rounding;
mod search;
mod snapshot;
mod surface;
mod table;
#[cfg(test)]
mod tests;
mod track;
mod triangle;

pub use surface::Surface;
pub use table::{TRUTH_COLUMNS, TRUTH_STATUSES, TruthRow};

use ccd_tables::motions::Motions;
use search::Search;

/// What is proven about the first contact of a query; times are from 0 to the duration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Truth {
    /// The surfaces share no point before `lo`, and they share one at `hi`.
    Hit {
        /// A time before which the surfaces are proven to share no point, usually less than 1e-13 of the duration
        /// before the first contact.
        lo: f64,
        /// The time at which a common point is proven.
        hi: f64,
    },
    /// The surfaces share no point at any time.
    Free,
    /// The surfaces share a point at the start, or cannot be separated there in floating point.
    ContactAtStart,
    /// The surfaces share no point before `lo`, cannot be separated at `lo`, and no contact could be proven from then
    /// on. They touch without intersecting, or nearly touch.
    Graze {
        /// The first time at which the surfaces cannot be separated.
        lo: f64,
    },
    /// The search reached its work limit; the surfaces share no point before `lo`.
    Undecided {
        /// The time before which the surfaces are proven to share no point.
        lo: f64,
    },
}

/// Proven bounds of the distance of two surfaces at one time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DistanceBounds {
    /// The lower bound of the distance, which is not negative.
    pub distance_lower_bound: f64,
    /// The upper bound of the distance; infinite if a body has no triangles.
    pub upper_distance: f64,
}

/// Brackets the first contact and the distance of two moving surfaces with proven bounds.
#[derive(Clone, Copy, Debug)]
pub struct TruthSolver<'a> {
    a: &'a Surface,
    b: &'a Surface,
}

impl<'a> TruthSolver<'a> {
    /// Creates a referee for the surfaces of body A and body B, which may be the same surface.
    pub fn new(a: &'a Surface, b: &'a Surface) -> Self {
        TruthSolver { a, b }
    }

    /// Brackets the time at which the surfaces first share a point.
    ///
    /// # Guarantee
    /// The [`Truth`] holds exactly for the motion x(t) = c₀ + v t + exp(t \[ω\]×) R₀ (p − c) with
    /// c₀ = T + R₀ c, with the numbers of the query taken as exact. R₀ is the rotation of the
    /// normalised quaternion. Quaternions of the engine are units to within 4e-16, so its own
    /// placement departs from this one by up to 4e-16 of |p|.
    ///
    /// Surfaces that only touch, or slide on each other, can be graze or hit. Their `hi` may be
    /// later than the first contact by more than usual, since only intersection can be proven.
    /// After a doubtful time the search skips ever longer times while the doubt lasts, so that a
    /// contact in between is not shown; `lo` is never late.
    ///
    /// # Complexity
    /// The pairs of triangles near each other before the first contact, times some 46 halvings, up
    /// to a fixed number of tests.
    pub fn first_contact(&self, query: &Motions) -> Truth {
        Search::new(self, query).run()
    }

    /// Returns bounds on the distance of the surfaces at a time.
    ///
    /// # Guarantee
    /// The exact distance, for the motion of [`TruthSolver::first_contact`], lies in the bracket. It is
    /// 0 if the surfaces intersect, within the width of the bracket, and infinite for a body
    /// without triangles.
    pub fn distance_bounds(&self, query: &Motions, time: f64) -> DistanceBounds {
        gap::distance_bounds(Search::new(self, query), time)
    }
}
