//! Adapts peer libraries to the interface of all solvers.
//!
//! They answer the same queries about the same meshes, each by the call that its makers offer for
//! that. The docs of each type say which parameters the call takes and which it does not offer.
//! Some peers take minutes for a query, or never return. They are therefore called through
//! [`Guarded`](super::guarded::GuardedMethod), in a process that can be stopped.
//!
//! | peer | call |
//! |---|---|
//! | [`parry::double::cast`], [`parry::single::cast`] | parry's nonlinear cast of one mesh against another |
//! | [`parry::double::sweep`], [`parry::single::sweep`] | parry's swept convex bodies, over pairs of triangles |
//! | [`rapier::TwoBodySimulation`] | one step of rapier with its continuous collision detection |

pub mod parry;
pub mod rapier;
#[cfg(test)]
mod tests;

use crate::method::solver::{ContactClaim, Solver};
use anyhow::Result;
use ccd_decomp::TriangleMesh;
use clap::ValueEnum;

/// The peer libraries that this program calls, with one variant for each way to call them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, ValueEnum)]
pub enum PeerKind {
    /// Nonlinear casts of parry in double precision: [`parry::double::cast`].
    ParryF64,
    /// Nonlinear casts of parry in single precision: [`parry::single::cast`].
    ParryF32,
    /// Swept triangles of parry in double precision: [`parry::double::sweep`].
    ParrySweepF64,
    /// Swept triangles of parry in single precision: [`parry::single::sweep`].
    ParrySweepF32,
    /// One step of a rapier simulation: [`rapier::TwoBodySimulation`].
    RapierStepF64,
}

impl PeerKind {
    /// Returns true if the peer's answers depend on the tolerance. The other peers are run at one tolerance only.
    pub fn takes_tolerance(self) -> bool {
        match self {
            PeerKind::ParrySweepF64 | PeerKind::ParrySweepF32 | PeerKind::RapierStepF64 => true,
            PeerKind::ParryF64 | PeerKind::ParryF32 => false,
        }
    }

    /// Returns a solver that calls the peer in this process; its calls may never return.
    ///
    /// # Errors
    /// If the peer refuses a mesh.
    pub fn solver(self, a: &TriangleMesh, b: &TriangleMesh) -> Result<Box<dyn Solver>> {
        use parry::{double, single};
        Ok(match self {
            PeerKind::ParryF64 => Box::new(double::cast::CastMeshPair::new(a, b)?),
            PeerKind::ParryF32 => Box::new(single::cast::CastMeshPair::new(a, b)?),
            PeerKind::ParrySweepF64 => Box::new(double::sweep::SweptMeshPair::new(a, b)?),
            PeerKind::ParrySweepF32 => Box::new(single::sweep::SweptMeshPair::new(a, b)?),
            PeerKind::RapierStepF64 => Box::new(rapier::TwoBodySimulation::new(a, b)?),
        })
    }
}

/// Returns the claim of a contact at `time`, clamped to the duration because of rounding. An invalid time is no answer.
fn contact_claim_at(time: f64, duration: f64) -> ContactClaim {
    if time.is_finite() {
        let time = time.clamp(0.0, duration);
        ContactClaim::Contact { time }
    } else {
        ContactClaim::Unresolved { safe_until: 0.0 }
    }
}
