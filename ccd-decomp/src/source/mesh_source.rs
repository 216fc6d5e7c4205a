//! Parses the descriptions of meshes, and of their parts, on a command line.

use crate::file::has_stored_body_extension;
use crate::load::mesh_source::MeshSource;
use crate::mesh::adjustments::{Adjustments, UnknownAdjustment};
use crate::mesh::format::Format;
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::str::FromStr;

/// Splits a text into the file name, the mark after the file name (`#` or `@`), and the rest; `None` without a mark.
fn split_at_mark(text: &str) -> Option<(&str, char, &str)> {
    let mut ends = text.match_indices(['#', '@']);
    let (at, mark) = ends.find(|&(at, mark)| {
        let file = Path::new(&text[..at]);
        // A folder may end like a mesh.
        let is_folder = mark == "@" && text[at..].contains(['/', '\\']);
        let is_stored = mark == "@" && has_stored_body_extension(file);
        !is_folder && (is_stored || Format::from_path(file).is_ok())
    })?;
    Some((&text[..at], mark.chars().next()?, &text[at + 1..]))
}

impl FromStr for MeshSource {
    type Err = UnknownAdjustment;

    fn from_str(text: &str) -> Result<Self, UnknownAdjustment> {
        let Some((file, mark, rest)) = split_at_mark(text).filter(|_| !Path::new(text).is_file())
        else {
            return Ok(PathBuf::from(text).into());
        };
        let (mut part, mut words) = (None, Vec::new());
        if mark == '@' {
            words.extend(rest.split('@'));
        } else {
            let mut name = rest;
            while let Some((before, word)) = name.rsplit_once('@')
                && Adjustments::NONE.with_parsed_adjustment(word).is_ok()
            {
                name = before;
                words.push(word);
            }
            words.reverse();
            part = Some(name.to_owned());
        }
        let mut words = words.into_iter();
        Ok(MeshSource {
            file: file.into(),
            part,
            adjustments: words.try_fold(Adjustments::NONE, Adjustments::with_parsed_adjustment)?,
        })
    }
}

/// Parses a description given as a string of the operating system, such as a command-line argument. A path that is not
/// UTF-8 is a file name without a part.
impl TryFrom<OsString> for MeshSource {
    type Error = UnknownAdjustment;

    fn try_from(text: OsString) -> Result<Self, UnknownAdjustment> {
        match text.to_str() {
            Some(text) => text.parse(),
            None => Ok(PathBuf::from(text).into()),
        }
    }
}
