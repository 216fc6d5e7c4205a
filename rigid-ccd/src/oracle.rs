//! Distance backends: those of this library, and the traits and types for a backend of your own.

pub use ccd_core::{
    Claim, DistanceOracle, Effort, Frame, GiveUpReason, OrElse, PiecePair, Separation,
};
pub use ccd_distance_gjk::{ClosedForm, Direct, Gjk};
#[cfg(feature = "vmarch")]
pub use ccd_distance_vmarch::Vmarch;
