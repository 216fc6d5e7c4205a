#![doc = include_str!("../README.md")]

mod body;
mod bounds;
mod cell;
mod cover;
mod error;
mod nearest;
mod pair;
mod placed;
mod plane;
mod resting;
mod scene;
mod screw;
mod split;
mod statement;
mod stretch;
mod tolerances;
mod tree;
mod way;
mod write;

pub use body::Body;
pub use cell::ProvenCell;
pub use error::{NoMesh, NotProven, PathNotProven};
pub use pair::ProvenPair;
pub use scene::{AxisKind, Carried, Joint, Link, Pair, Scene, Witness};
pub use statement::{StatedLink, StatedWitness, Statement, steps_text};
pub use write::{Proof, prove};
