//! What moves between two links.

use crate::motion::{Motion, Placed};
use crate::number::{ONE, Vector, ZERO, up};
use alloc::vec::Vec;

/// A link in the middle of a stretch of time as it is seen from another one, and how it moves in half of it: what Lemma 2 of the
/// README needs of the way from that one.
#[derive(Clone, Copy)]
pub(crate) struct Way {
    /// From centre to centre, how that changes, and how the link turns.
    pub(crate) arm: Vector,
    pub(crate) change: Vector,
    pub(crate) turn: Vector,
    /// The sum of the angles of all joints, and a bound of the derivative of the turn.
    turned: i128,
    twist: i128,
    /// Bounds of the turn, and of the second derivative of what the link carries, over its distance from the centre.
    rate: i128,
    pub(crate) factor: i128,
    /// A bound of the second derivative of the arm.
    pub(crate) bend: i128,
}

impl Way {
    pub(crate) fn new(links: &[Placed], from: usize, to: usize) -> Way {
        let mut way = Way { arm: ZERO, change: ZERO, turn: ZERO, turned: 0, twist: 0, rate: 0, factor: 0, bend: 0 };
        let (mut left, mut entered, mut path) = (from, to, Vec::new());
        while left != entered {
            // A link has a larger number than its parent.
            if left > entered {
                let Placed { parent, motion, .. } = links[left];
                way.turn_by(ZERO - motion.turn);
                way.move_by(ZERO - motion.arm, ZERO - motion.travel);
                left = parent;
            } else {
                path.push(links[entered].motion);
                entered = links[entered].parent;
            }
        }
        for Motion { arm, travel, turn } in path.into_iter().rev() {
            way.move_by(arm, travel);
            way.turn_by(turn);
        }
        way
    }

    /// Returns whether the joints turn by no more than two radians: nothing is proven over a longer stretch.
    pub(crate) fn is_short(&self) -> bool {
        self.turned <= 2 * i128::from(ONE.mid[0])
    }

    fn turn_by(&mut self, turn: Vector) {
        let angle = turn.length();
        self.turned += angle;
        // Of a way that is not short nothing else is of use.
        if turn != ZERO && self.is_short() {
            self.twist += self.turn.cross(turn).length() + up(self.twist, angle);
            self.turn = self.turn + turn;
            self.rate = self.turn.length() + self.twist;
            self.factor = self.twist + up(self.rate, self.rate);
        }
    }

    fn move_by(&mut self, arm: Vector, travel: Vector) {
        self.arm = self.arm + arm;
        self.change = self.change + travel + self.turn.cross(arm);
        self.bend += up(self.factor, arm.length() + travel.length()) + 2 * up(self.rate, travel.length());
    }
}
