//! Certified continuous collision detection for rigid bodies. Two bodies move: when do they first touch, where, and
//! with which features?
//!
//! A [`Body`] is a set of convex [pieces](Pieces) with a tree over them, and a [`Motion`] moves it. A [`Query`]
//! combines two moving bodies with a duration and settings. A [`Schedule`] answers it with the help of a
//! [`DistanceOracle`], the backend that measures the distance of two pieces. Backends, mesh files and commands live
//! in separate crates: this one contains no backend, no file format, no IO.
//!
//! # Example
//! When do two balls meet whose paths pass each other off center?
//!
//! ```
//! use ccd_core::{glam::DVec3, schedule::{BestFirst, Schedule}, *};
//!
//! /// Measures two balls: the way from one center to the other is all there is to know.
//! struct Balls;
//!
//! impl DistanceOracle for Balls {
//!     type Cache = ();
//!     fn separation(&mut self, pair: &PiecePair<'_>, _: &mut ()) -> Result<Claim, GiveUpReason> {
//!         let axis = pair.b_to_a.transform_point(pair.b.points[0]) - pair.a.points[0];
//!         Ok(Claim { axis, a: ConvexCombination::from_single_point(0), b: ConvexCombination::from_single_point(0) })
//!     }
//! }
//!
//! let ball = Body::sphere(0.5)?;
//! let flying = |from: DVec3, velocity: DVec3| Motion::new(Pose::at(from)?, velocity, DVec3::ZERO);
//! let a = flying(DVec3::new(-3.0, 0.6, 0.0), 2.0 * DVec3::X)?;
//! let b = flying(DVec3::new(3.0, 0.0, 0.0), -2.0 * DVec3::X)?;
//! let settings = Settings { tolerance: 1e-6, ..Settings::DEFAULT };
//! let query = Query::new((&ball, a), (&ball, b), 2.0, &settings)?;
//! let answer = BestFirst::default().first_contact(&query, &mut Balls)?;
//! let Outcome::Contact { time, contact } = answer.outcome else { panic!("they meet") };
//! // Centers that are 0.6 apart sideways are 1 apart when they are 0.8 apart along x: at 5.2 / 4.
//! assert!(time <= 1.3 && time > 1.3 - 1e-6);
//! assert!(contact.separation.upper <= 1e-6);
//! # Ok::<(), InputError>(())
//! ```
//! Other crates have backends for all convex pieces.
//!
//! # Guarantee
//! 1. **Never late.** For every time reported, no contact happens before it: for every mesh, motion
//!    and backend, in floating point.
//! 2. **Tight.** With [`Outcome::Contact`] the distance at that time is within margin + tolerance,
//!    shown by two witness points.
//! 3. **Always ends.** When a limit is reached, the outcome is [`Outcome::Unresolved`], and its time
//!    is still a certified lower bound. Bad input is a typed [`InputError`].
//! 4. **Checkable.** A claim of a backend is never used unchecked: it is [checked](Separation) with one support
//!    query. A wrong one makes a query slow or unresolved, never late.
//! 5. **Same answer** whichever backend, schedule or order of the two bodies, within the tolerance. The same call
//!    twice gives the same bits, unless a [deadline](Settings::deadline) ends it.
//!
//! # The sources
//! | folder | holds |
//! |---|---|
//! | `question.rs`, `query.rs`, `settings.rs`, `problem.rs`, `answer.rs` | the question, in a user's units and in a search's own; the answer |
//! | `body/` | convex pieces, the wide tree over them `[FAST06 §5.1]`, trees of hulls `[FAST06 §3.3]`, farthest corners `[FAST06 §4.2]` |
//! | `motion/` | motions `[FAST06 §4.1]`, bounds of rates `[FAST06 §4.2]`, Δt = d / μ `[FAST06 Eq. 2]`, trajectories of any kind |
//! | `distance/` | oracles, and the check of their claims |
//! | `engine/` | the search: the first contact by conservative advancement, best first; `engine/shortcuts/` what makes it faster and can be left out |
//! | `questions/` | any contact, the closest approach, searches in steps, trajectories stretch by stretch |
//! | `paper/` | all pairs on one clock `[FAST06 Alg. 1]`, hull trees and a front `[FAST06 Alg. 2, §5.1]` |
//! | `contacts/` | the features of all contacts at a time `[FAST06 §5.2]` |
//! | [`limits`], [`rounding`], [`tuning`] | accepted ranges; allowances that proofs rely on; numbers that only cost time |
//!
//! # Features
//! - `nalgebra`: conversions between [`Pose`] and `nalgebra::Isometry3<f64>`.
//! - `exact`: the module `exact`, signs of determinants on stored numbers.
//! - `hull-tree`: trees of convex hulls, checked by exact signs, and the schedule over them.
//! - `serde`: pieces, hierarchies and hull trees can be stored; what is read is checked as what is
//!   made.
//! - `avx512`: allows a build with AVX-512 by a rustc with LLVM 22 or older. These versions miscompile it: the feature
//!   is for one that is known not to. From LLVM 23 on no feature is needed.

#[cfg(all(target_feature = "avx512f", faulty_avx512, not(feature = "avx512")))]
compile_error!(
    "LLVM 22, which is behind this rustc, miscompiles AVX-512 (rust issue 158622), and a certificate is \
     worth nothing then: remove `-C target-cpu=native` from the rustflags, or replace it by `x86-64-v3`; add \
     the feature `avx512` if your compiler is known to be free of the fault"
);
mod answer;
mod body;
mod contacts;
mod distance;
mod engine;
mod error;
pub mod limits;
mod math;
mod motion;
mod paper;
mod problem;
mod query;
mod question;
mod questions;
pub mod rounding;
pub mod schedule;
mod settings;
mod swept_box;
#[cfg(test)]
mod tests;
mod touching_plane;
pub mod tuning;

pub use answer::{
    Answer, ClearanceVerdict, Contact, Effort, Hit, HitKind, Limit, Outcome, Overlap, Separation,
    Stats, Unresolved,
};
#[doc(hidden)]
pub use body::disjoint_sets::DisjointSets;
pub use body::facets::{Facets, fan_triangles};
pub use body::feature::Feature;
pub use body::hierarchy::{Hierarchy, HierarchyNode};
#[cfg(feature = "hull-tree")]
pub use body::hull_tree::{
    FacetClass, Hull, HullFault, HullNode, HullTree, HullTreeError, PolygonList,
};
pub use body::piece::ConvexCombination;
pub use body::piece::Piece;
pub use body::pieces::Pieces;
pub use body::polytope::{Facet, FacetOrigin, MeshFace, Polytope};
pub use body::round::{EnclosingPolytope, SolidOfRevolution};
pub use body::shell::connected_part_numbers;
pub use body::support::{
    SupportMap, SupportScan, SupportTable, SupportTree, TABLE_DIRECTION_COUNT,
};
pub use body::{Body, Solidity};
pub use contacts::ContactsError;
pub use distance::oracle::{Claim, DistanceOracle, GiveUpReason, OrElse, PiecePair};
pub use error::InputError;
#[doc(hidden)]
pub use error::{ShortNumber, check, check_finite};
#[doc(hidden)]
pub use fearless_simd;
pub use glam;
#[cfg(feature = "exact")]
pub use math::exact;
#[doc(hidden)]
pub use math::simd;
pub use math::{double_double, order, point_tree, vector};
pub use motion::Motion;
pub use motion::bound::VelocityBound;
pub use motion::pose::{Frame, Pose};
#[doc(hidden)]
pub use motion::shortest_rotation_vector;
pub use motion::trajectory::{
    Acceleration, AccelerationBounds, DeviationBound, SmoothTrajectory, Stretch, Trajectory,
};
pub use query::{Movement, MovingBody, Query};
pub use question::Question;
pub use schedule::Schedule;
pub use settings::{ContactNormals, Setting, SettingField, Settings, StartPolicy};
pub use swept_box::SweptBox;
