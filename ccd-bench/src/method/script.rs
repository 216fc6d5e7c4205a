//! Peer libraries in other languages, which the script `scripts/peers.py` runs.

use clap::ValueEnum;

/// The methods that the script runs, by its names.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, ValueEnum)]
pub enum ScriptKind {
    /// A single static distance of Coal at the start, the least cost of any method.
    CoalDistance,
    /// Static intersection tests of Coal at equal steps.
    CoalSteps,
    /// Conservative advancement of FCL.
    FclCa,
    /// Static intersection tests of FCL at equal steps.
    FclNaive,
}
