//! Which bodies are asked for contacts with which.

/// The groups that a body is in, and those that it is asked for contacts with: 32 of each, bit by bit.
///
/// ```
/// use rigid_ccd::Groups;
/// let ship = Groups { memberships: 0b01, filter: 0b10 };
/// let shot = Groups { memberships: 0b10, filter: 0b01 };
/// assert!(ship.pairs_with(shot) && !ship.pairs_with(ship));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Groups {
    /// The groups that the body is in.
    pub memberships: u32,
    /// The groups that it is asked for contacts with.
    pub filter: u32,
}

impl Groups {
    /// In all groups, and asked for contacts with all: the default.
    pub const ALL: Groups = Groups {
        memberships: u32::MAX,
        filter: u32::MAX,
    };

    /// Returns whether two bodies are a pair: each is in a group that the other one is asked for.
    pub fn pairs_with(self, other: Groups) -> bool {
        self.memberships & other.filter != 0 && other.memberships & self.filter != 0
    }
}

impl Default for Groups {
    fn default() -> Self {
        Groups::ALL
    }
}
