//! Ground truth: a rigorous bracket of the exact first contact of two moving surfaces.
//!
//! It judges the engine and its rivals and shares no code with them: tree, distance, motion and rounding
//! are its own, and all that it reads are the numbers of a motion and of a mesh.
//!
//! | to … | see |
//! |---|---|
//! | enclose rotations and placements by interval arithmetic | `enclosure`, `track` |
//! | show that boxes or triangles stay apart over a span of time | `moment`, `triangle` |
//! | show that two triangles share a point at an instant | `pierce` |
//! | search in time, earliest first | `search` |
//! | bracket the distance at one time | `gap` |

mod enclosure;
mod gap;
mod moment;
mod pierce;
mod rounding;
mod search;
mod surface;
mod table;
#[cfg(test)]
mod tests;
mod track;
mod triangle;

pub use surface::Surface;
pub use table::{TRUTH_COLUMNS, TruthRow, read_truths, write_truths};

use rigid_ccd::table::motions::Query;
use search::Search;

/// What is true of a query, as far as it can be proven; times are from 0 to the duration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Truth {
    /// The surfaces share no point before `lo`, and they do at `hi`.
    Hit {
        /// Just before the first contact, usually by less than 1e-13 of the duration.
        lo: f64,
        /// Just after it.
        hi: f64,
    },
    /// They share no point at any time.
    Free,
    /// They share a point at the start, or cannot be told apart there in floating point.
    Start,
    /// They share no point before `lo`, there they cannot be told apart, and no proof of contact was found
    /// then or later: they touch without intersecting, or all but touch.
    Graze {
        /// When they first come that near.
        lo: f64,
    },
    /// They share no point before `lo`; the work that may be spent on a query is spent.
    Undecided {
        /// Until when it is known.
        lo: f64,
    },
}

/// Two bounds of a distance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bracket {
    /// It is at least this, and this is not negative.
    pub lower: f64,
    /// It is at most this.
    pub upper: f64,
}

/// Judges queries about two surfaces.
#[derive(Clone, Copy, Debug)]
pub struct Referee<'a> {
    a: &'a Surface,
    b: &'a Surface,
}

impl<'a> Referee<'a> {
    /// For body A and body B, which may be the same.
    pub fn new(a: &'a Surface, b: &'a Surface) -> Self {
        Referee { a, b }
    }

    /// When the surfaces first share a point.
    ///
    /// # Guarantee
    /// What the [`Truth`] says holds exactly for the motion x(t) = c₀ + v t + exp(t \[ω\]×) R₀ (p − c) with
    /// c₀ = T + R₀ c and the numbers of the query taken as exact; R₀ is the rotation that the quaternion
    /// has the direction of. Quaternions of the engine are units to within 4e-16, and so its own placement
    /// departs from this one by up to 4e-16 of |p|.
    ///
    /// Surfaces that only touch, or slide on each other, can be graze or hit: their `hi` may be later than
    /// the first contact by more than usual, since only intersection can be proven. After a doubtful time
    /// the search leaves out ever longer times while it stays in doubt, so that a contact in between is not
    /// shown; `lo` is never late.
    ///
    /// # Complexity
    /// The pairs of triangles near each other before the first contact, times some 46 halvings; no more
    /// than a fixed number of tests.
    pub fn first_contact(&self, query: &Query) -> Truth {
        Search::new(self, query).run()
    }

    /// How far the surfaces are apart at a time.
    ///
    /// # Guarantee
    /// The exact distance, of the motion as [`Referee::first_contact`] has it, lies in the bracket; 0 where
    /// the surfaces intersect, as long as the bracket is that narrow; infinite of a body without triangles.
    pub fn distance(&self, query: &Query, time: f64) -> Bracket {
        gap::distance(Search::new(self, query), time)
    }
}
