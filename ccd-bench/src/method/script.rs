//! Peer libraries in other languages, run by a script: `scripts/peers.py answer`.

use clap::ValueEnum;

/// The methods of the script, by its names.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, ValueEnum)]
pub enum ScriptKind {
    /// One static distance of Coal at the start, the least cost of any method.
    CoalDistance,
    /// Static tests of Coal at equal steps.
    CoalSteps,
    /// FCL's conservative advancement.
    FclCa,
    /// FCL's tests at equal steps.
    FclNaive,
}
