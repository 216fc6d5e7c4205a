//! Peer libraries behind the interface of solvers.
//!
//! They answer the same queries about the same meshes, each by the call that its makers offer for
//! that. The docs of each type say which parameters the call takes and which it does not offer.
//! Some peers take minutes for a query, or never return. They are therefore called through
//! [`Guarded`](super::guarded::Guarded), in a process that can be stopped.
//!
//! | peer | call |
//! |---|---|
//! | [`parry::double::cast`], [`parry::single::cast`] | parry's nonlinear cast of one mesh against another |
//! | [`parry::double::sweep`], [`parry::single::sweep`] | parry's swept convex bodies, over pairs of triangles |
//! | [`rapier::Simulated`] | one step of rapier with its continuous collision detection |

pub mod parry;
pub mod rapier;
#[cfg(test)]
mod tests;

use crate::method::solver::{Claim, Solver};
use crate::method::wire;
use anyhow::Result;
use ccd_decomp::TriangleMesh;
use clap::ValueEnum;

/// The peer libraries.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, ValueEnum)]
pub enum PeerKind {
    /// The method [`parry::double::cast`].
    ParryF64,
    /// The method [`parry::single::cast`].
    ParryF32,
    /// The method [`parry::double::sweep`].
    ParrySweepF64,
    /// The method [`parry::single::sweep`].
    ParrySweepF32,
    /// The method [`rapier::Simulated`].
    RapierStepF64,
    /// A method that never answers, for tests of the guard.
    Hanging,
    /// A method that ends its process at every query, for tests of the guard.
    Dying,
}

impl PeerKind {
    /// Returns all peers, except those made for tests.
    pub fn all() -> impl Iterator<Item = PeerKind> {
        let for_tests = [PeerKind::Hanging, PeerKind::Dying];
        let all = PeerKind::value_variants().iter().copied();
        all.filter(move |kind| !for_tests.contains(kind))
    }

    /// Returns true if the answers depend on the tolerance. The other peers are run at one
    /// tolerance only.
    pub fn takes_tolerance(self) -> bool {
        match self {
            PeerKind::ParrySweepF64 | PeerKind::ParrySweepF32 | PeerKind::RapierStepF64 => true,
            PeerKind::ParryF64 | PeerKind::ParryF32 | PeerKind::Hanging | PeerKind::Dying => false,
        }
    }

    /// Returns the peer itself, in this process; its calls may never return.
    ///
    /// # Errors
    /// If the peer refuses a mesh.
    pub fn solver(self, a: &TriangleMesh, b: &TriangleMesh) -> Result<Box<dyn Solver>> {
        use parry::{double, single};
        Ok(match self {
            PeerKind::ParryF64 => Box::new(double::cast::Cast::new(a, b)?),
            PeerKind::ParryF32 => Box::new(single::cast::Cast::new(a, b)?),
            PeerKind::ParrySweepF64 => Box::new(double::sweep::SweptPairs::new(a, b)?),
            PeerKind::ParrySweepF32 => Box::new(single::sweep::SweptPairs::new(a, b)?),
            PeerKind::RapierStepF64 => Box::new(rapier::Simulated::new(a, b)?),
            PeerKind::Hanging => Box::new(wire::Hanging),
            PeerKind::Dying => Box::new(wire::Dying),
        })
    }
}

/// Returns a contact at `time`, clamped to the duration because of rounding. An invalid time is no answer.
fn contact_at(time: f64, duration: f64) -> Claim {
    if time.is_finite() {
        let time = time.clamp(0.0, duration);
        Claim::Contact { time }
    } else {
        Claim::Unresolved { safe_until: 0.0 }
    }
}
