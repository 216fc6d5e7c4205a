//! Which shortcuts of the search a query uses.

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
}

/// The set of shortcuts that a query uses.
///
/// # Guarantee
/// Any choice gives answers with the same guarantee. Without a shortcut, the scenes that it is made for take longer,
/// and may reach the budget.
///
/// ```
/// use ccd_core::{Settings, schedule::{Shortcut, Shortcuts}};
/// let settings = Settings { shortcuts: Shortcuts::ALL.without(Shortcut::Screw), ..Settings::DEFAULT };
/// assert!(settings.shortcuts.contains(Shortcut::Balls) && !settings.shortcuts.contains(Shortcut::Screw));
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

    /// Returns the set of one shortcut.
    #[cfg(test)]
    pub(crate) fn only(shortcut: Shortcut) -> Self {
        Shortcuts(1 << shortcut as u8)
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
