#![doc = include_str!("../README.md")]

mod body;
mod bounds;
mod cell;
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
mod statement;
mod statement_link;
mod step;
mod stop;
mod subdivision;
mod tolerances;
mod tree;
mod write;

pub use body::Body;
pub use cell::ProvenCell;
pub use error::{CellNotProvable, NoMesh, NotProven, PathNotProven};
pub use pair::ProvenPair;
pub use positions::ImpossiblePosition;
pub use scene::{AxisKind, Joint, Link, Pair, Scene, SceneBody, Witness};
pub use statement::{Statement, StatementWitness, Subject, steps_text};
pub use statement_link::StatementLink;
pub use write::{Proof, prove};
