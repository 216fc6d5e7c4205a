//! The steps of a proof, and their opcodes.

/// A step of a proof: a split, or a leaf that proves two nodes apart over an interval of time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Step {
    /// Splits the node of a body: 0 is A, 1 is B.
    SplitNode(usize),
    /// Splits the interval of time.
    SplitTime,
    /// A leaf with a separating plane. The number is the frame with which the plane rotates: 0 is the world, 1 is A, 2 is B.
    Plane(usize),
    /// A leaf with the bounding ball of the node of a body: 0 is A, 1 is B.
    Ball(usize),
}

const SPLIT_NODE: u8 = 0;
const SPLIT_TIME: u8 = 2;
const PLANE: u8 = 3;
const BALL: u8 = 6;

impl Step {
    /// Returns the first byte of the step in a certificate.
    pub(crate) fn opcode(self) -> u8 {
        match self {
            Step::SplitNode(body) => SPLIT_NODE + body as u8,
            Step::SplitTime => SPLIT_TIME,
            Step::Plane(frame) => PLANE + frame as u8,
            Step::Ball(body) => BALL + body as u8,
        }
    }

    /// Returns the step with an opcode. Returns `None` if there is no such step.
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
