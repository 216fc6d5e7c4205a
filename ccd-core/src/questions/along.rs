//! Questions about bodies on trajectories, answered one stretch of time after the other.
//!
//! On a stretch of time each body follows a motion, with a constant acceleration of its center, up to a known
//! deviation. The query about these motions uses the sum of both deviations as a margin: if the motions keep this
//! margin, the bodies are apart. A contact within the deviations proves nothing, and the stretch is cut.

mod any;
pub(crate) mod closest;
pub(crate) mod contacts;
mod drive;
pub(crate) mod interval;
mod lengths;
mod motions;
mod stretches;

#[cfg(test)]
mod tests;
