//! The C interface of `rigid-ccd`. Programs include `include/rigid_ccd.h`, which cbindgen generates from this crate.
//!
//! | to … | file |
//! |---|---|
//! | tell whether and why a call has failed | `status.rs` |
//! | dereference the pointers that C passes | `arguments.rs`, `growing.rs` |
//! | make bodies, from shapes, arrays and files | `body.rs` |
//! | move bodies at constant velocities | `motion.rs` |
//! | move bodies along trajectories | `trajectory.rs` |
//! | set tolerances and limits | `settings.rs` |
//! | ask about two bodies | `solver.rs` |
//! | stop a query from another thread | `stop.rs` |
//! | read answers | `answer.rs`, `feature.rs` |
//! | put a robot among obstacles | `cell.rs` |
//! | ask about paths of a robot | `cell_solver.rs`, `path.rs`, `joint_curve.rs`, `path_answer.rs` |
//! | write an answer to a file, for a later check | `evidence.rs` |
//!
//! # Contract of all functions
//! A function never panics into C and never calls back. It keeps no pointer to its arguments after it returns. Each
//! pointer argument is null or points to a value of its type that lives during the call. Each handle comes from this
//! library and has not been freed. A null pointer that is not allowed is an error, not undefined behaviour. Threads may share
//! handles as `const` pointers. A solver belongs to one thread at a time.

#![allow(unsafe_code, reason = "pointers from C are followed here")]

mod answer;
mod arguments;
mod body;
mod cell;
mod cell_solver;
mod evidence;
mod feature;
mod growing;
mod joint_curve;
mod motion;
mod path;
mod path_answer;
mod settings;
mod solver;
mod status;
mod stop;
mod trajectory;

pub use answer::{RccdAnswer, RccdLimit, RccdOutcome};
pub use body::*;
pub use cell::*;
pub use cell_solver::*;
pub use evidence::rccd_evidence_write;
pub use feature::{RccdFeature, RccdFeatureKind};
pub use joint_curve::*;
pub use motion::{RccdMotion, RccdPose, rccd_motion_at_rest, rccd_motion_between};
pub use path::RccdPath;
pub use path_answer::RccdPathAnswer;
pub use settings::{RccdContactNormals, RccdSettings, RccdStartPolicy, rccd_settings_default};
pub use solver::*;
pub use status::{RccdStatus, rccd_last_error, rccd_version};
pub use stop::*;
pub use trajectory::*;

/// Asserts that threads can share handles, and that solvers can move to another thread.
const _: () = {
    const fn shared<T: Send + Sync>() {}
    const fn sent<T: Send>() {}
    shared::<RccdBody>();
    shared::<RccdTrajectory>();
    shared::<RccdJointCurve>();
    shared::<RccdCell>();
    shared::<RccdStop>();
    sent::<RccdSolver>();
    sent::<rigid_ccd_robot::CellSolver<'static>>();
};
