//! Compares methods of continuous collision detection: scenes, exact answers, rivals, peers, measurements and charts.
//!
//! | to … | see |
//! |---|---|
//! | make the bodies and motions of the paper's scenes | [`scene`] |
//! | bracket the exact first contact | [`truth`] |
//! | answer by this project, by published rivals, or by peer libraries | [`method`] |
//! | time and judge every method on every scene | [`run`] |
//! | find where each method fails | [`stability`] |
//! | show the measurements | [`show`] |

pub mod command;
pub mod method;
mod names;
pub mod run;
pub mod scene;
pub mod show;
pub mod stability;
pub mod truth;
