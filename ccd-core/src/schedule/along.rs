//! Questions about bodies that move along trajectories, answered stretch by stretch.
//!
//! On a stretch each body follows a motion, with a constant acceleration of its centre, from which it strays by a
//! known amount. The query about these motions takes both strays for a margin: bodies that keep them are apart. A
//! contact within the strays proves nothing, and the stretch is cut.

pub(super) mod any;
pub(super) mod closest;
pub(super) mod farthest;
pub(super) mod first;
pub(super) mod interval;
mod leg;
mod lengths;
mod stretches;

#[cfg(test)]
mod tests;
