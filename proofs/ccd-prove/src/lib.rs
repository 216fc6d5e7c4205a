#![doc = include_str!("../README.md")]

mod body;
mod bounds;
mod cell;
mod cover;
mod cursor;
mod error;
mod interval;
mod link_motion;
mod nearest;
mod pair;
mod positions;
mod rigid_groups;
mod scene;
mod separating_plane;
mod split;
mod stated_link;
mod statement;
mod step;
mod stop;
mod tolerances;
mod tree;
mod write;

pub use body::Body;
pub use cell::ProvenCell;
pub use error::{CellNotProvable, NoMesh, NotProven, PathNotProven};
pub use pair::ProvenPair;
pub use positions::ImpossiblePosition;
pub use scene::{AxisKind, Joint, Link, Pair, Scene, SceneBody, Witness};
pub use stated_link::StatedLink;
pub use statement::{StatedWitness, Statement, Subject, steps_text};
pub use write::{Proof, prove};
