//! Surveys stability: families of scenes get harder step by step, and show where each method fails.
//!
//! | to … | see |
//! |---|---|
//! | know what a family is, and its exact answers | [`Family`], [`FamilyScene`], [`ExactCase`] |
//! | list the families | [`families()`] |
//! | judge an answer | [`judge`] |
//! | ask all methods, each in a process that can be stopped | [`Survey`] |
//! | know what was asked and answered | [`Findings`] |
//! | see how far each method follows | [`summary`], [`first_failure_table`], [`solved_range_heat_map`], [`cost_growth_heat_map`] |

mod families;
mod family;
mod findings;
mod judge;
mod shapes;
mod summary;
mod survey;

pub use families::families;
pub use family::{ExactCase, Family, FamilyScene};
pub use findings::Findings;
pub use judge::judge;
pub use summary::{cost_growth_heat_map, first_failure_table, solved_range_heat_map, summary};
pub use survey::Survey;
