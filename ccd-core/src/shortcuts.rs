//! Shortcuts: each proves at once what the search would prove in many steps, in the scenes that it is made for. No
//! answer depends on them.
//!
//! The README of this folder has the scene that needs each of them, and what it saves there.

pub(crate) mod approach;
pub(crate) mod closer_look;
mod flat_pair;
pub(crate) mod out_of_reach;
mod placed;
pub(crate) mod roots;
pub(crate) mod rounds;
pub(crate) mod screw;
pub(crate) mod sweeping_node;
pub(crate) mod sweeping_piece;

/// A shortcut of the search, which can be left out for a measurement.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shortcut {
    /// Two balls on straight paths prove bodies apart that are far from each other all the time.
    Balls,
    /// One fixed plane between the boxes of both bodies proves them apart for good.
    Boxes,
    /// One period is searched for all periods of bodies that turn many times.
    Rounds,
    /// Surfaces that a screw carries into themselves keep a bolt and its nut, or a shaft and its sleeve, apart for good.
    Screw,
    /// Flat nodes that approach face to face are followed in f64, where f32 is too coarse.
    FlatNodes,
    /// Planes that turn with a large node are tried for small nodes beside it.
    TurningNodes,
    /// Planes that turn with a piece are tried for pieces beside it.
    TurningPieces,
}

impl Shortcut {
    /// All shortcuts.
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

/// The shortcuts that a query takes: all of them, unless some are left out for a measurement.
///
/// # Guarantee
/// Any choice gives answers with the same guarantee. Without a shortcut, the scenes that it is made for take longer, and
/// may reach the budget.
///
/// ```
/// use ccd_core::{Settings, schedule::{Shortcut, Shortcuts}};
/// let settings = Settings { shortcuts: Shortcuts::ALL.without(Shortcut::Screw), ..Settings::DEFAULT };
/// assert!(settings.shortcuts.has(Shortcut::Balls) && !settings.shortcuts.has(Shortcut::Screw));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shortcuts(u8);

impl Shortcuts {
    /// All shortcuts, the default.
    pub const ALL: Shortcuts = Shortcuts(u8::MAX);

    /// Returns these shortcuts except one.
    #[must_use]
    pub const fn without(self, shortcut: Shortcut) -> Self {
        Shortcuts(self.0 & !(1 << shortcut as u8))
    }

    /// Returns true if the shortcut is taken.
    #[inline]
    pub const fn has(self, shortcut: Shortcut) -> bool {
        self.0 >> shortcut as u8 & 1 == 1
    }
}

impl Default for Shortcuts {
    fn default() -> Self {
        Shortcuts::ALL
    }
}

#[cfg(test)]
mod tests;
