//! Distance backends: those to choose from, and what one of your own takes and claims.

pub use ccd_core::{Claim, DistanceOracle, Effort, Frame, GiveUp, OrElse, PiecePair, Separation};
pub use ccd_distance_gjk::{ClosedForm, Direct, Gjk};
#[cfg(feature = "vmarch")]
pub use ccd_distance_vmarch::Vmarch;
