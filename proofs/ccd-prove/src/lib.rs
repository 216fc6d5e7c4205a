#![doc = include_str!("../README.md")]

mod body;
mod bounds;
mod cell;
mod cover;
mod cursor;
mod error;
mod nearest;
mod pair;
mod placed;
mod plane;
mod positions;
mod resting;
mod scene;
mod screw;
mod split;
mod stated_link;
mod statement;
mod stop;
mod stretch;
mod tolerances;
mod tree;
mod way;
mod write;

pub use body::Body;
pub use cell::ProvenCell;
pub use error::{CellNotProvable, NoMesh, NotProven, PathNotProven};
pub use pair::ProvenPair;
pub use positions::ImpossiblePosition;
pub use scene::{AxisKind, Carried, Joint, Link, Pair, Scene, Witness};
pub use stated_link::StatedLink;
pub use statement::{StatedWitness, Statement, Subject, steps_text};
pub use write::{Proof, prove};
