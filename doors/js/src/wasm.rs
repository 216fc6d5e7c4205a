//! The classes that the modules in `doors/js/module` wrap.
//!
//! Those modules check arguments, and convert answers to plain objects. Numbers are passed through the memory of
//! [`Solver`], because passing an object or an array takes longer than a short query.
//!
//! | file | content |
//! |---|---|
//! | `body` | bodies from shapes, arrays and files |
//! | `movement`, `poses` | movements of bodies: constant velocities, poses, a throw, the link of a robot |
//! | `solver`, `answer`, `fields` | questions about two bodies, and their answers as numbers with names |
//! | `robot`, `cell`, `path_answer` | robots and mechanisms, and questions about their paths |
//! | `fault` | errors as JavaScript has them |
//! | `limits` | the limits that leave a question unresolved |
//! | `host` | messages to JavaScript besides answers: remarks, and the text of a fault |

mod answer;
mod body;
mod cell;
mod fault;
mod fields;
mod host;
mod limits;
mod movement;
mod path_answer;
mod poses;
mod robot;
mod solver;

pub use answer::AnswerKind;
pub use body::{Body, Mesh};
pub use cell::{Cell, PathSettings};
pub use host::start;
pub use limits::{limit_advice, limit_name};
pub use movement::Movement;
pub use path_answer::PathAnswer;
pub use robot::{Robot, RobotBuilder};
pub use solver::{Question, Solver};
