//! Checks that the names of MJCF elements are unique.

use crate::robot_file::mjcf_error::MjcfError;
use std::collections::HashSet;

/// The names that are in use, by element kind.
#[derive(Default)]
pub(super) struct Names(HashSet<(String, String)>);

impl Names {
    /// Adds a name, if there is one. Returns an error if an element of the same kind already has it.
    pub(super) fn add(&mut self, kind: &str, name: Option<&str>) -> Result<(), MjcfError> {
        match name {
            Some(name) if !self.0.insert((kind.to_owned(), name.to_owned())) => {
                Err(MjcfError::repeated_name(kind, name))
            }
            _ => Ok(()),
        }
    }
}
