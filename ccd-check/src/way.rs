//! What moves between two links.

use crate::motion::{Links, Placed};
use crate::number::*;
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
    /// Returns the ways from a link to all links.
    pub(crate) fn all(links: &Links, placed: &[Placed], from: usize) -> Vec<Way> {
        let twist = links.loss_of_turns();
        let mut way = Way { arm: ZERO, change: ZERO, turn: ZERO, turned: 0, twist, rate: 0, factor: 0, bend: 0 };
        let mut ways = alloc::vec![None; placed.len()];
        let mut at = from;
        while at != 0 {
            ways[at] = Some(way);
            let moves = placed[at].moves.map(|v| sub(ZERO, v));
            way.turn_by(moves, placed[at].lengths);
            way.move_by(moves, placed[at].lengths);
            at = placed[at].parent;
        }
        ways[0] = Some(way);
        let mut all: Vec<Way> = Vec::with_capacity(placed.len());
        for (link, known) in placed.iter().zip(ways) {
            all.push(known.unwrap_or_else(|| {
                let mut way: Way = all[link.parent];
                way.move_by(link.moves, link.lengths);
                way.turn_by(link.moves, link.lengths);
                way
            }));
        }
        all
    }

    /// Returns whether the joints turn by no more than two radians: nothing is proven over a longer stretch.
    pub(crate) fn is_short(&self) -> bool {
        self.turned <= 2 * i128::from(ONE)
    }

    fn turn_by(&mut self, [.., turn]: [Vector; 3], [.., angle]: [i128; 3]) {
        self.turned += angle;
        // Of a way that is not short nothing else is of use.
        if self.is_short() {
            self.twist += up(self.rate, angle);
            self.turn = add(self.turn, turn);
            self.rate = length(self.turn) + self.twist;
            self.factor = self.twist + up(self.rate, self.rate);
        }
    }

    fn move_by(&mut self, [arm, travel, _]: [Vector; 3], [arm_length, travel_length, _]: [i128; 3]) {
        self.arm = add(self.arm, arm);
        self.change = add(self.change, add(travel, cross(self.turn, arm)));
        self.bend += up(self.factor, arm_length + travel_length) + 2 * up(self.rate, travel_length);
    }
}
