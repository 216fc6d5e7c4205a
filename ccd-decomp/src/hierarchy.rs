//! WIP
use ccd_core::{Hierarchy, InputError, Pieces};
/// WIP
pub fn build_hierarchy(pieces: &Pieces) -> Result<Hierarchy, InputError> {
    Ok(Hierarchy::median_split(pieces))
}
