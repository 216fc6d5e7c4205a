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
    angle: f64,
    /// A bound of the second derivative of the arm.
    bend: f64,
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
        self.angle == 0.0 && self.change == DVec3::ZERO
    }

    /// Returns whether the checker proves anything over so long a stretch.
    pub(crate) fn is_short(&self) -> bool {
        self.angle < MOST_TURN
    }

    /// Returns a bound of the second derivative of a point that the link carries so far from its centre; infinity if the checker
    /// proves nothing over so long a stretch.
    pub(crate) fn bend(&self, reach: f64) -> f64 {
        if self.is_short() {
            self.bend + self.angle * self.angle * reach
        } else {
            f64::INFINITY
        }
    }

    fn turn_by(&mut self, turn: DVec3) {
        self.angle += turn.length();
        self.turn += turn;
    }

    fn move_by(&mut self, arm: DVec3, travel: DVec3) {
        self.change += travel + self.turn.cross(arm);
        let (angle, rate) = (self.angle, travel.length());
        self.bend += angle * (angle * (arm.length() + rate) + 2.0 * rate);
    }
}
