//! Accelerations: each saves time in some scenes, and can be left out. No answer depends on them.
//!
//! The README of this folder has the scene that needs each of them, and what it saves there.

pub(crate) mod approach;
pub(crate) mod closer_look;
mod flat_pair;
pub(crate) mod out_of_reach;
mod placed;
pub(crate) mod roots;
pub(crate) mod rounds;
pub(crate) mod screw;
pub(crate) mod sweeping_node;
pub(crate) mod sweeping_piece;
