//! Published methods, built here as rivals from their descriptions.
//!
//! They share no code with the engine that they are compared with: they have their own meshes,
//! distances, bounding volumes and motions.
//!
//! | rival | source |
//! |---|---|
//! | [`Contact`]: continuous OBB test, interval arithmetic, bisection | \[CONTACT02\] |
//! | [`DynamicChecker`]: adaptive bisection by undirected bounds | \[DCC02\] |
//! | [`C2a`]: controlled conservative advancement over swept spheres | \[C2A09\] |
//! | [`FixedTimeSteps`]: a static test at every step | the usual practice without continuous methods |

mod c2a;
mod contact;
mod dynamic_checker;
mod interval;
mod lanes;
mod motion;
mod obb_tree;
mod patience;
mod principal_axes;
mod rectangles;
mod resolution;
mod screw;
mod stepping;
mod swept_spheres;
#[cfg(test)]
mod tests;
mod tree;
mod triangles_apart;
mod triangles_cross;

pub use c2a::C2a;
pub use contact::Contact;
pub use dynamic_checker::DynamicChecker;
pub use motion::{Placement, RivalMotion};
pub use screw::{are_screw_motions, to_screw_motions};
pub use stepping::FixedTimeSteps;
