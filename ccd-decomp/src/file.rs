//! Stores bodies that are prepared for queries in files, and loads them.

pub(crate) mod error;
mod frame;
pub(crate) mod obj;
use crate::mesh::remark::Remarks;
use crate::prepare::model::StoredBodyContent;
use crate::prepare::report::Report;
use ccd_core::limits::MAX_COORDINATE;
use ccd_core::{Hierarchy, HullNode, HullTree, Pieces, Solidity};
use error::{StoreError, StoreFault};
use std::io::{self, BufReader, Read, Write};
use std::path::Path;

/// The file extension of a stored body, without the dot.
pub const STORED_BODY_EXTENSION: &str = "ccd";

/// Returns whether a path has the file extension of a stored body.
pub(crate) fn has_stored_body_extension(path: &Path) -> bool {
    let extension = path.extension().unwrap_or_default();
    extension.eq_ignore_ascii_case(STORED_BODY_EXTENSION)
}

/// The fields of a model in the order in which they are stored; remarks follow if there are any. A hull tree is stored
/// without its pieces. Any change to these types or their order needs a new version of the format.
type StoredFields = (
    Pieces,
    Hierarchy,
    Solidity,
    Option<Vec<HullNode>>,
    Option<(Pieces, Hierarchy)>,
    Report,
);

impl StoredBodyContent {
    /// Stores the model in a file, by convention called `NAME.ccd`.
    ///
    /// It is written to a temporary file (`.part`) first: an interrupted write does not damage an older file. Links are
    /// followed. Pipes and devices are written directly.
    ///
    /// # Errors
    /// [`StoreFault::Unwritable`] if the file cannot be written.
    pub fn save(&self, path: impl AsRef<Path>) -> Result<(), StoreError> {
        let path = path.as_ref();
        ccd_file::write(path, |out| self.write_stored_body(out))
            .map_err(|error| StoreError::new(path, StoreFault::Unwritable(error)))
    }

    /// Loads a model that [`StoredBodyContent::save`] stored.
    ///
    /// # Guarantee
    /// The body gives the same answers as the stored one, bit by bit. No bytes panic: a modified file is an error or,
    /// with a forged checksum, a valid body.
    ///
    /// # Errors
    /// [`StoreError`], which names the file.
    pub fn load(path: impl AsRef<Path>) -> Result<Self, StoreError> {
        let path = path.as_ref();
        let file = ccd_file::open(path).map_err(StoreFault::Unreadable);
        file.and_then(|file| StoredBodyContent::read_stored_body(BufReader::new(file)))
            .map_err(|fault| StoreError::new(path, fault))
    }

    /// Writes the model to any writer, in the format of [`StoredBodyContent::save`].
    ///
    /// # Errors
    /// [`StoreFault::Unwritable`] if the writer fails.
    pub fn write(&self, writer: impl Write) -> Result<(), StoreError> {
        Ok(self
            .write_stored_body(writer)
            .map_err(StoreFault::Unwritable)?)
    }

    /// Reads a model from any reader, to the end, with the guarantee of [`StoredBodyContent::load`].
    ///
    /// # Errors
    /// [`StoreError`], without the name of a file.
    pub fn read(reader: impl Read) -> Result<Self, StoreError> {
        Ok(StoredBodyContent::read_stored_body(reader)?)
    }

    fn write_stored_body(&self, writer: impl Write) -> io::Result<()> {
        let StoredBodyContent {
            pieces,
            hierarchy,
            solidity: volume,
            hull_tree,
            surface,
            report,
        } = self;
        let nodes = hull_tree.as_ref().map(HullTree::to_nodes);
        let stored = (pieces, hierarchy, volume, nodes, surface, report);
        let mut payload = postcard::to_allocvec(&stored).map_err(io::Error::other)?;
        let remarks = &report.repairs.remarks;
        if !remarks.is_empty() {
            payload = postcard::to_extend(remarks, payload).map_err(io::Error::other)?;
        }
        frame::write(writer, &payload)
    }

    fn read_stored_body(reader: impl Read) -> Result<Self, StoreFault> {
        let payload = frame::read(reader)?;
        let (stored, rest): (StoredFields, &[u8]) = postcard::take_from_bytes(&payload)
            .map_err(|error| StoreFault::invalid_content(&error))?;
        let (pieces, hierarchy, volume, nodes, surface, mut report) = stored;
        if !rest.is_empty() {
            let (remarks, rest): (Remarks, _) = postcard::take_from_bytes(rest)
                .map_err(|error| StoreFault::invalid_content(&error))?;
            if remarks.is_empty() || !rest.is_empty() {
                return Err(StoreFault::invalid_content(&"there is more than a body"));
            }
            report.repairs.remarks = remarks;
        }
        let tree = |nodes: Vec<HullNode>| HullTree::new(&pieces, &nodes);
        let hull_tree = nodes.map(tree).transpose();
        let model = StoredBodyContent {
            hull_tree: hull_tree.map_err(|error| StoreFault::invalid_content(&error))?,
            pieces,
            hierarchy,
            solidity: volume,
            surface,
            report,
        };
        model
            .check()
            .map_err(|error| StoreFault::invalid_content(&error))?;
        Ok(model)
    }

    /// Checks that the fields of a loaded model are consistent with each other, and returns what is wrong if not. Each
    /// field has been checked by itself.
    fn check(&self) -> Result<(), &'static str> {
        let pieces = self.pieces.len();
        // A binary tree has one more leaf than inner nodes.
        let fits = |pieces: &Pieces, hierarchy: &Hierarchy| {
            hierarchy.nodes().len().div_ceil(2) == pieces.len()
        };
        let surface = self.surface.as_ref();
        if !(fits(&self.pieces, &self.hierarchy) && surface.is_none_or(|(p, h)| fits(p, h))) {
            return Err("the hierarchy is over another number of pieces");
        }
        let whole = || {
            let solid = self.solidity == Solidity::Solid;
            solid && pieces == 1 && self.pieces.get(0).radius == 0.0
        };
        if surface.is_some_and(|(pieces, _)| !(whole() && pieces.are_all_triangles())) {
            return Err("the surface is not that of one solid piece");
        }
        if self.report.pieces != pieces {
            return Err("the report counts another number of pieces");
        }
        // Written so that NaN is refused.
        if !(0.0..=MAX_COORDINATE).contains(&self.report.excess) {
            return Err("what the pieces stick out by is no length");
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests;
