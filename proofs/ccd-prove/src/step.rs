//! The steps of a proof, and the byte that each begins with.

/// A step of a proof: a split, or a leaf that proves its parts apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Step {
    /// Splits the part of a body: 0 is A, 1 is B.
    SplitNode(usize),
    /// Splits the interval of time.
    SplitTime,
    /// A leaf with a separating plane, which turns with a frame: 0 is the world, 1 is A, 2 is B.
    Plane(usize),
    /// A leaf with the bounding ball of the part of a body: 0 is A, 1 is B.
    Ball(usize),
}

const SPLIT_NODE: u8 = 0;
const SPLIT_TIME: u8 = 2;
const PLANE: u8 = 3;
const BALL: u8 = 6;

impl Step {
    /// Returns the byte that the step begins with.
    pub(crate) fn opcode(self) -> u8 {
        match self {
            Step::SplitNode(body) => SPLIT_NODE + body as u8,
            Step::SplitTime => SPLIT_TIME,
            Step::Plane(frame) => PLANE + frame as u8,
            Step::Ball(body) => BALL + body as u8,
        }
    }

    /// Returns the step that begins with a byte. Returns `None` if there is no such step.
    pub(crate) fn from_opcode(opcode: u8) -> Option<Step> {
        match opcode {
            0..=1 => Some(Step::SplitNode(usize::from(opcode - SPLIT_NODE))),
            SPLIT_TIME => Some(Step::SplitTime),
            3..=5 => Some(Step::Plane(usize::from(opcode - PLANE))),
            6..=7 => Some(Step::Ball(usize::from(opcode - BALL))),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests;
