//! Certified continuous collision detection for rigid bodies: two bodies move; when do they first
//! touch, where, and with which features?
//!
//! A [`Body`] is a set of convex [pieces](Pieces) with a tree over them; a [`Motion`] carries it
//! along; a [`Problem`] poses the query; a [`Schedule`] answers it with the help of a
//! [`DistanceOracle`], the backend that measures the distance of two pieces. Backends, mesh files and
//! commands live in crates of their own: this one knows no backend, no file, no IO.
//!
//! # Guarantee
//! 1. **Never late.** For every time reported, no contact happens before it: for every mesh, motion
//!    and backend, in floating point.
//! 2. **Tight.** With [`Outcome::Contact`] the distance at that time is within margin + tolerance,
//!    shown by two witness points.
//! 3. **Always ends.** When a limit is reached, the outcome is [`Outcome::Unresolved`], and its time
//!    is still a certified lower bound. Bad input is a typed [`InputError`].
//! 4. **Checkable.** A backend is never believed: its claim is [checked](Separation) with one support
//!    query. A wrong one makes a query slow or unresolved, never late.
//! 5. **Same answer** whichever backend, schedule or order of the two bodies, within the tolerance;
//!    the same call twice gives the same bits; except for what a [deadline](Config::deadline) ends.
//!
//! # From the paper to the files
//! | step | where |
//! |---|---|
//! | motion between two poses `[FAST06 §4.1]` | `motion.rs`, in a query's own units `path.rs` |
//! | how far a body can advance along an axis `[FAST06 §4.2]` | [`motion_bound`], eight nodes at once `schedule/lanes/` |
//! | hierarchy of bounding volumes `[FAST06 §5.1]` | `hierarchy.rs`, laid out for vector units `tree/` |
//! | distance of two pieces, and its check | `oracle.rs`, `separation.rs` |
//! | conservative advancement, all pairs `[FAST06 Alg. 1]` | `schedule/naive.rs` |
//! | conservative advancement, best first | `schedule/best_first.rs` |
//! | the same over hull trees `[FAST06 §3.3, §5.1]` | `hull_tree.rs`, `schedule/fast/` |
//! | farthest corner along a direction `[FAST06 §4.2]` | `support.rs` |
//! | one pair of pieces at one instant | `schedule/pair.rs`, `schedule/instant.rs` |
//! | features of all contacts at a time `[FAST06 §5.2]` | `contacts.rs` |
//! | contact at the start, one body inside the other | `schedule/nearest.rs`, `overlap.rs`, `containment.rs` |
//! | every allowance for rounding | [`tolerance`] |
//!
//! # Example
//! ```
//! use ccd_core::{glam::DVec3, schedule::{BestFirst, Schedule}, *};
//!
//! /// The distance of two points, which is all that two balls need.
//! #[derive(Default)]
//! struct Points;
//!
//! impl DistanceOracle for Points {
//!     type Cache = ();
//!     fn separation(&mut self, pair: &PiecePair<'_>, _: &mut ()) -> Result<Claim, GiveUp> {
//!         let ([a], [b]) = (pair.a.points, pair.b.points) else {
//!             return Err(GiveUp::TooManyPoints);
//!         };
//!         Ok(Claim {
//!             axis: pair.b_to_a.point(*b) - *a,
//!             a: Combination::point(0),
//!             b: Combination::point(0),
//!         })
//!     }
//! }
//!
//! let ball = Body::ball(0.5)?;
//! let start = Pose::at(DVec3::new(-3.0, 0.0, 0.0))?;
//! let problem = Problem::new(
//!     Moving { body: &ball, motion: Motion::new(start, 4.0 * DVec3::X, DVec3::Z)? },
//!     Moving { body: &ball, motion: Motion::still(Pose::IDENTITY) },
//!     1.0,
//!     &Config { tolerance: 1e-6, ..Config::default() },
//! )?;
//! let answer = BestFirst::default().solve(&problem, &mut Points);
//! let Outcome::Contact { time, .. } = answer.outcome else { panic!("they meet") };
//! assert!(time <= 0.5 && time > 0.5 - 1e-6);
//! # Ok::<(), InputError>(())
//! ```
//!
//! # Features
//! - `nalgebra`: conversions between [`Pose`] and `nalgebra::Isometry3<f64>`.
//! - `hull-tree`: trees of convex hulls, checked by exact predicates, and the schedule over them.
//! - `serde`: pieces, hierarchies and hull trees can be stored; what is read is checked as what is
//!   made.
//! - `avx512`: lets the crate be built with AVX-512 by a rustc that has LLVM 22 or older, which
//!   miscompiles it; for one that is known not to. From LLVM 23 on it takes no feature.

#[cfg(all(target_feature = "avx512f", faulty_avx512, not(feature = "avx512")))]
compile_error!(
    "LLVM 22, which is behind this rustc, miscompiles AVX-512 (rust issue 158622), and a certificate is \
     worth nothing then: add `-C target-cpu=x86-64-v3` to the rustflags, as .cargo/config.toml does here, \
     or the feature `avx512` if your compiler is known to be free of it"
);
mod body;
mod contacts;
mod distance;
mod error;
pub mod limits;
mod math;
mod motion;
mod outcome;
mod problem;
pub mod schedule;
#[cfg(test)]
mod tests;
pub mod tolerance;

pub use body::combination::Combination;
pub use body::facets::Facets;
pub use body::feature::Feature;
pub use body::hierarchy::{Hierarchy, HierarchyNode};
#[cfg(feature = "hull-tree")]
pub use body::hull_tree::{FacetClass, Hull, HullFault, HullNode, HullTree, HullTreeError, Loops};
pub use body::piece::Piece;
pub use body::pieces::Pieces;
pub use body::polytope::{Face, Facet, Origin, Polytope};
pub use body::support::{DIRECTIONS, Support, SupportScan, SupportTable, SupportTree};
pub use body::{Body, Volume};
pub use contacts::{ContactsError, FeaturePair};
pub use distance::oracle::{Claim, DistanceOracle, Effort, GiveUp, OrElse, PiecePair};
pub use error::InputError;
pub use glam;
#[cfg(feature = "exact")]
pub use math::exact;
pub use math::{order, point_tree, vector};
pub use motion::Motion;
pub use motion::bound::Bound;
pub use motion::pose::{Frame, Pose};
pub use outcome::{Answer, Contact, Limit, Outcome, Overlap, Separation, Stats};
pub use problem::{Config, Moving, Problem, StartPolicy};
pub use schedule::Schedule;
