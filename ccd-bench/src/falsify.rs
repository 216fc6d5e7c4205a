//! Falsification: a seeded search for meshes and motions at which a method fails, and the smallest such case.
//!
//! | to … | see |
//! |---|---|
//! | know what is changed | `attempt`, `space` |
//! | know what is looked for, and what counts as nearer | [`Aim`] |
//! | ask a method and judge its answer | `examiner` |
//! | climb from random attempts | [`Hunt`] |
//! | make a failure small | `shrink` |
//! | see what was found | [`write_gallery`], [`table`] |

mod aim;
mod attempt;
mod climb;
mod examiner;
mod gallery;
mod shrink;
mod space;
#[cfg(test)]
mod tests;

pub use aim::Aim;
pub use attempt::{Attempt, Body, Course};
pub use climb::{Failure, Hunt, Report};
pub use gallery::{table, write_gallery};
