//! How the engine computes: its shortcuts and its vector instructions.

/// How the engine computes: which shortcuts it takes, and with which vector instructions. For measurements and tests.
///
/// # Guarantee
/// Any choice gives answers with the same guarantee. Vector instructions do not change a bit of them.
///
/// ```
/// use ccd_core::schedule::{EngineOptions, Shortcut, Shortcuts};
/// use ccd_core::{Body, Motion, Query, Settings};
/// let ball = Body::sphere(0.5)?;
/// let query = Query::new((&ball, Motion::STILL), (&ball, Motion::STILL), 1.0, &Settings::DEFAULT)?;
/// let shortcuts = Shortcuts::ALL.without(Shortcut::Screw);
/// let query = query.with_engine_options(EngineOptions { shortcuts, ..EngineOptions::DEFAULT });
/// # Ok::<(), ccd_core::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct EngineOptions {
    /// The shortcuts that the search takes.
    pub shortcuts: Shortcuts,
    /// The vector instructions with which bounds are computed.
    pub vector_instructions: VectorInstructions,
}

impl EngineOptions {
    /// All shortcuts, and the best instructions of the machine.
    pub const DEFAULT: EngineOptions = EngineOptions {
        shortcuts: Shortcuts::ALL,
        vector_instructions: VectorInstructions::Best,
    };
}

/// The choice of vector instructions for the bounds of nodes.
///
/// On x86 these are AVX2 or SSE2. Other targets have one set each, NEON for instance.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum VectorInstructions {
    /// The best instructions of the machine, detected at run time.
    #[default]
    Best,
    /// The instructions of the target that the program was built for, which every such machine has.
    Baseline,
}

/// A shortcut of the search, which can be turned off to measure its benefit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shortcut {
    /// Proves two distant bodies apart for the whole query at once, by bounding balls on straight paths.
    Balls,
    /// Proves two bodies apart for the whole query at once, by one fixed plane between their bounding boxes.
    Boxes,
    /// Searches one period of the motion instead of all periods, for bodies that turn many times.
    Rounds,
    /// Proves a bolt and its nut, or a shaft and its sleeve, apart at once, by surfaces that the screw motion maps to
    /// themselves.
    Screw,
    /// Computes bounds in f64 for pairs of flat nodes that approach face to face, if f32 is too coarse for them.
    FlatNodes,
    /// Separates small nodes from a large turning node by planes that turn with the large node.
    TurningNodes,
    /// Separates two pieces by a plane that turns with one of them.
    TurningPieces,
}

impl Shortcut {
    /// All shortcuts, in the order of the enum.
    pub const ALL: [Shortcut; 7] = [
        Shortcut::Balls,
        Shortcut::Boxes,
        Shortcut::Rounds,
        Shortcut::Screw,
        Shortcut::FlatNodes,
        Shortcut::TurningNodes,
        Shortcut::TurningPieces,
    ];

    /// Returns the name of the shortcut, as the file of its code has it.
    pub const fn name(self) -> &'static str {
        match self {
            Shortcut::Balls => "balls",
            Shortcut::Boxes => "boxes",
            Shortcut::Rounds => "rounds",
            Shortcut::Screw => "screw",
            Shortcut::FlatNodes => "flat_nodes",
            Shortcut::TurningNodes => "turning_nodes",
            Shortcut::TurningPieces => "turning_pieces",
        }
    }
}

/// The set of shortcuts that a query uses.
///
/// # Guarantee
/// Any choice gives answers with the same guarantee. Without a shortcut, the scenes that it is made for take longer,
/// and may reach the budget.
///
/// ```
/// use ccd_core::schedule::{Shortcut, Shortcuts};
/// let shortcuts = Shortcuts::ALL.without(Shortcut::Screw);
/// assert!(shortcuts.contains(Shortcut::Boxes) && !shortcuts.contains(Shortcut::Screw));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shortcuts(u8);

impl Shortcuts {
    /// The set of all shortcuts, the default.
    pub const ALL: Shortcuts = Shortcuts(u8::MAX);

    /// Returns the set without one shortcut.
    #[must_use]
    pub const fn without(self, shortcut: Shortcut) -> Self {
        Shortcuts(self.0 & !(1 << shortcut as u8))
    }

    /// Returns whether the set contains a shortcut.
    #[inline]
    pub const fn contains(self, shortcut: Shortcut) -> bool {
        self.0 >> shortcut as u8 & 1 == 1
    }
}

impl Default for Shortcuts {
    fn default() -> Self {
        Shortcuts::ALL
    }
}
