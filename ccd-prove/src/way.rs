//! What moves between two links, in floating point.

use crate::placed::Placed;
use crate::tolerances::MOST_TURN;
use ccd_core::glam::DVec3;

/// How a link moves, as it is seen from another one, in half of a stretch of time.
#[derive(Default)]
pub(crate) struct Way {
    /// How the arm from centre to centre changes.
    pub(crate) change: DVec3,
    pub(crate) turn: DVec3,
    /// The sum of the angles of all joints.
    pub(crate) turned: f64,
    twist: f64,
    pub(crate) bend: f64,
}

impl Way {
    pub(crate) fn new(links: &[Placed], from: usize, to: usize) -> Way {
        let mut way = Way::default();
        let (mut left, mut entered, mut path) = (from, to, Vec::new());
        while left != entered {
            if left > entered {
                let link = &links[left];
                way.turn_by(-link.turn);
                way.move_by(-link.arm, -link.travel);
                left = link.parent;
            } else {
                path.push(entered);
                entered = links[entered].parent;
            }
        }
        for link in path.into_iter().rev().map(|k| &links[k]) {
            way.move_by(link.arm, link.travel);
            way.turn_by(link.turn);
        }
        way
    }

    /// Returns whether nothing moves on the way.
    pub(crate) fn rests(&self) -> bool {
        self.turned == 0.0 && self.change == DVec3::ZERO
    }

    /// Returns whether the checker proves anything over so long a stretch.
    pub(crate) fn is_short(&self) -> bool {
        self.turned < MOST_TURN
    }

    fn turn_by(&mut self, turn: DVec3) {
        self.turned += turn.length();
        self.twist += self.rate() * turn.length();
        self.turn += turn;
    }

    fn move_by(&mut self, arm: DVec3, travel: DVec3) {
        self.change += travel + self.turn.cross(arm);
        let (rate, travel) = (self.rate(), travel.length());
        self.bend += self.factor() * (arm.length() + travel) + 2.0 * rate * travel;
    }

    /// Returns the factor by which the distance from the centre bounds the second derivative of what the link carries.
    pub(crate) fn factor(&self) -> f64 {
        let rate = self.rate();
        self.twist + rate * rate
    }

    /// Returns a bound of the turn over the whole stretch.
    fn rate(&self) -> f64 {
        self.turn.length() + self.twist
    }
}
