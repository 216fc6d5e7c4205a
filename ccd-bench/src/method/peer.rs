//! Peer libraries behind the interface of solvers.
//!
//! They answer the same queries about the same meshes, each by the call that its makers offer for that;
//! what a call takes, and what it cannot be told, stands with its type. Since some of them take minutes
//! for a query, or for ever, they are asked through [`Guarded`], in a process that can be stopped.
//!
//! | peer | what is called |
//! |---|---|
//! | [`parry::double::cast`], [`parry::single::cast`] | parry's nonlinear cast of one mesh against another |
//! | [`parry::double::sweep`], [`parry::single::sweep`] | parry's swept convex bodies, over pairs of triangles |
//! | [`rapier::Simulated`] | one step of rapier with its continuous collision detection |

mod guarded;
pub mod parry;
pub mod rapier;
#[cfg(test)]
mod tests;
pub mod wire;

pub use guarded::{Asked, Guarded};

use crate::method::solver::{Claim, Solver};
use ccd_decomp::TriangleMesh;
use clap::ValueEnum;

/// The peers there are.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, ValueEnum)]
pub enum PeerKind {
    /// [`parry::double::cast`].
    ParryF64,
    /// [`parry::single::cast`].
    ParryF32,
    /// [`parry::double::sweep`].
    ParrySweepF64,
    /// [`parry::single::sweep`].
    ParrySweepF32,
    /// [`rapier::Simulated`].
    RapierStepF64,
    /// Never answers: what a guard is tried on.
    #[value(hide = true)]
    Hanging,
    /// Dies of every query.
    #[value(hide = true)]
    Dying,
}

/// A mesh that a peer cannot use.
#[derive(Clone, Debug, thiserror::Error)]
#[error("the peer refuses the mesh: {why}")]
pub struct PeerError {
    why: String,
}

impl PeerKind {
    /// All of them, but for those that tests are made with.
    pub const ALL: [PeerKind; 5] = [
        PeerKind::ParryF64,
        PeerKind::ParryF32,
        PeerKind::ParrySweepF64,
        PeerKind::ParrySweepF32,
        PeerKind::RapierStepF64,
    ];

    /// What the command line and the tables call it.
    pub fn name(self) -> &'static str {
        match self {
            PeerKind::ParryF64 => "parry-f64",
            PeerKind::ParryF32 => "parry-f32",
            PeerKind::ParrySweepF64 => "parry-sweep-f64",
            PeerKind::ParrySweepF32 => "parry-sweep-f32",
            PeerKind::RapierStepF64 => "rapier-step-f64",
            PeerKind::Hanging => "hanging",
            PeerKind::Dying => "dying",
        }
    }

    /// Whether a tolerance changes its answers: of the others one tolerance is as good as any.
    pub fn takes_tolerance(self) -> bool {
        match self {
            PeerKind::ParrySweepF64 | PeerKind::ParrySweepF32 | PeerKind::RapierStepF64 => true,
            PeerKind::ParryF64 | PeerKind::ParryF32 | PeerKind::Hanging | PeerKind::Dying => false,
        }
    }

    /// The peer itself, in this process: its calls may last for ever.
    ///
    /// # Errors
    /// When it refuses a mesh.
    pub fn solver(
        self,
        a: &TriangleMesh,
        b: &TriangleMesh,
        tolerance: f64,
    ) -> Result<Box<dyn Solver>, PeerError> {
        use parry::{double, single};
        Ok(match self {
            PeerKind::ParryF64 => Box::new(double::cast::Cast::new(a, b)?),
            PeerKind::ParryF32 => Box::new(single::cast::Cast::new(a, b)?),
            PeerKind::ParrySweepF64 => Box::new(double::sweep::SweptPairs::new(a, b, tolerance)?),
            PeerKind::ParrySweepF32 => Box::new(single::sweep::SweptPairs::new(a, b, tolerance)?),
            PeerKind::RapierStepF64 => Box::new(rapier::Simulated::new(a, b, tolerance)?),
            PeerKind::Hanging => Box::new(wire::Hanging),
            PeerKind::Dying => Box::new(wire::Dying),
        })
    }
}

/// A contact at a time, which rounding may have moved out of the query; a time that is none is no answer.
fn contact_at(time: f64, duration: f64) -> Claim {
    if time.is_finite() {
        let time = time.clamp(0.0, duration);
        Claim::Contact { time }
    } else {
        Claim::Unresolved { safe_until: 0.0 }
    }
}
