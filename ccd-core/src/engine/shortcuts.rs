//! Optional shortcuts of the search. In a certain kind of scene, each proves at once what the search would prove in
//! many steps. No answer depends on them.
//!
//! The README of this folder has the scene that needs each of them, and what it saves there.

pub(crate) mod bounding_volumes;
pub(crate) mod flat_nodes;
mod placed;
pub(crate) mod screw;
pub(crate) mod turning_nodes;
pub(crate) mod turning_pieces;

#[cfg(test)]
mod tests;
