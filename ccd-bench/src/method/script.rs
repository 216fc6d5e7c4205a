//! Peer libraries of other languages, which a script asks: `scripts/peers.py answer`.

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

    /// Returns the name that the script has for it.
    pub fn name(self) -> &'static str {
        match self {
            ScriptKind::CoalSteps => "coal-steps",
            ScriptKind::FclAdvancement => "fcl-ca",
            ScriptKind::FclSteps => "fcl-naive",
        }
    }
}
