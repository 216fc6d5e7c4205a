//! Peer libraries in other languages, run by a script: `scripts/peers.py answer`.

/// The methods of the script.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ScriptKind {
    /// Static tests of Coal at equal steps.
    CoalSteps,
    /// FCL's conservative advancement.
    FclAdvancement,
    /// FCL's tests at equal steps.
    FclSteps,
}

impl ScriptKind {
    /// All methods of the script.
    pub const ALL: [ScriptKind; 3] = [
        ScriptKind::CoalSteps,
        ScriptKind::FclAdvancement,
        ScriptKind::FclSteps,
    ];

    /// Returns the script's name of the method.
    pub fn name(self) -> &'static str {
        match self {
            ScriptKind::CoalSteps => "coal-steps",
            ScriptKind::FclAdvancement => "fcl-ca",
            ScriptKind::FclSteps => "fcl-naive",
        }
    }
}
