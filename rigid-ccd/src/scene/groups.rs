//! Collision groups, which select the pairs of bodies to examine.

/// The collision groups that a body is in, and those that it is checked against, as 32-bit masks.
///
/// ```
/// use rigid_ccd::scene::Groups;
/// let ship = Groups { memberships: 0b01, filter: 0b10 };
/// let shot = Groups { memberships: 0b10, filter: 0b01 };
/// assert!(ship.may_pair_with(shot) && !ship.may_pair_with(ship));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Groups {
    /// The mask of the groups that the body is in.
    pub memberships: u32,
    /// The mask of the groups that the body is checked against.
    pub filter: u32,
}

impl Groups {
    /// Membership in all groups, checked against all groups: the default.
    pub const ALL: Groups = Groups {
        memberships: u32::MAX,
        filter: u32::MAX,
    };

    /// Returns whether two bodies form a pair: the filter of each has a group of the other.
    pub fn may_pair_with(self, other: Groups) -> bool {
        self.memberships & other.filter != 0 && other.memberships & self.filter != 0
    }
}

impl Default for Groups {
    fn default() -> Self {
        Groups::ALL
    }
}
