//! Peer libraries in other languages, which the script `scripts/peers.py` runs.

use clap::ValueEnum;

/// The methods that the script runs, with the script's names for them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, ValueEnum)]
pub enum ScriptMethod {
    /// A single distance query of Coal at the start poses, timed as the least that a method can cost.
    CoalDistance,
    /// Static intersection tests of Coal at equal steps.
    CoalSteps,
    /// Conservative advancement of FCL.
    FclCa,
    /// Static intersection tests of FCL at equal steps.
    FclNaive,
}
