//! The names of elements of an MJCF file.

use crate::robot_file::mjcf_error::MjcfError;
use std::collections::HashSet;

/// The names of elements by their kinds. Elements of one kind have different names.
#[derive(Default)]
pub(super) struct Names(HashSet<(String, String)>);

impl Names {
    /// Adds the name of an element, if it has one. No other element of the kind has it.
    pub(super) fn add(&mut self, kind: &str, name: Option<&str>) -> Result<(), MjcfError> {
        match name {
            Some(name) if !self.0.insert((kind.to_owned(), name.to_owned())) => {
                Err(MjcfError::repeated_name(kind, name))
            }
            _ => Ok(()),
        }
    }
}
