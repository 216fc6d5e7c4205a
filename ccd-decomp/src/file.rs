//! Prepared bodies as files: written once, read at every start.

pub(crate) mod error;
mod frame;
pub(crate) mod obj;
use crate::prepare::model::Model;
use crate::prepare::report::Report;
use ccd_core::{Hierarchy, HullNode, HullTree, Pieces, Volume};
use error::{StoreError, StoreFault};
use std::fs::{self, File};
use std::io::{self, BufReader, Read, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};

/// The extension of a stored body's file.
pub const STORED_EXTENSION: &str = "ccd";

/// Returns whether a file holds a stored body, by its extension.
pub(crate) fn is_stored(path: &Path) -> bool {
    let extension = path.extension().unwrap_or_default();
    extension.eq_ignore_ascii_case(STORED_EXTENSION)
}

/// The stored parts of a model, in this order. A hull tree is stored without its pieces, which are there
/// already. A change to any of these types, or to their order, needs another version of the format.
type Stored = (
    Pieces,
    Hierarchy,
    Volume,
    Option<Vec<HullNode>>,
    Option<(Pieces, Hierarchy)>,
    Report,
);

impl Model {
    /// Stores the model in a file, by convention called `NAME.ccd`.
    ///
    /// Until it is complete, it is in a file beside it, whose name ends in `.part`: a write that is cut short destroys no
    /// older file. A link is followed. A pipe or a device is written directly.
    ///
    /// # Errors
    /// [`StoreFault::Unwritable`] when the operating system refuses.
    pub fn save(&self, path: impl AsRef<Path>) -> Result<(), StoreError> {
        let path = path.as_ref();
        let unwritable = StoreFault::Unwritable;
        let saved = match fs::metadata(path) {
            Ok(there) if !there.is_file() => {
                let file = File::options().write(true).open(path);
                file.map_err(unwritable).and_then(|file| self.store(file))
            }
            Ok(_) => {
                // A file that must not be written must not be replaced either.
                let writable = File::options().write(true).open(path);
                let target = writable.and_then(|_| fs::canonicalize(path));
                target
                    .map_err(unwritable)
                    .and_then(|target| self.replace(&target))
            }
            Err(_) => self.replace(path),
        };
        saved.map_err(|fault| fault.in_file(path))
    }

    /// Stores the model beside a file, and then in its place.
    fn replace(&self, target: &Path) -> Result<(), StoreFault> {
        let (part, file) = part_of(target).map_err(StoreFault::Unwritable)?;
        let stored = self.store(file);
        let stored =
            stored.and_then(|()| fs::rename(&part, target).map_err(StoreFault::Unwritable));
        if stored.is_err() {
            // What stays behind does no harm.
            let _ = fs::remove_file(&part);
        }
        stored
    }

    /// Loads a model that [`Model::save`] stored.
    ///
    /// # Guarantee
    /// The body gives the same answers as the stored one, bit by bit. No bytes panic: a changed file is an error
    /// or, where even the checksum was forged, still a valid body.
    ///
    /// # Errors
    /// [`StoreError`], which names the file.
    pub fn load(path: impl AsRef<Path>) -> Result<Self, StoreError> {
        let path = path.as_ref();
        let file = File::open(path).map_err(StoreFault::Unreadable);
        file.and_then(|file| Model::unpack(BufReader::new(file)))
            .map_err(|fault| fault.in_file(path))
    }

    /// Writes the model to any writer, in the format of [`Model::save`].
    ///
    /// # Errors
    /// [`StoreFault::Unwritable`] when the writer fails.
    pub fn write(&self, writer: impl Write) -> Result<(), StoreError> {
        Ok(self.store(writer)?)
    }

    /// Reads a model from any reader, to the end, with the guarantee of [`Model::load`].
    ///
    /// # Errors
    /// [`StoreError`], without the name of a file.
    pub fn read(reader: impl Read) -> Result<Self, StoreError> {
        Ok(Model::unpack(reader)?)
    }

    fn store(&self, writer: impl Write) -> Result<(), StoreFault> {
        let Model {
            pieces,
            hierarchy,
            volume,
            hull_tree,
            surface,
            report,
        } = self;
        let nodes = hull_tree.as_ref().map(HullTree::to_nodes);
        let stored = (pieces, hierarchy, volume, nodes, surface, report);
        let unwritable = |error| StoreFault::Unwritable(io::Error::other(error));
        let payload = postcard::to_allocvec(&stored).map_err(unwritable)?;
        frame::write(writer, &payload).map_err(StoreFault::Unwritable)
    }

    fn unpack(reader: impl Read) -> Result<Self, StoreFault> {
        let payload = frame::read(reader)?;
        let (stored, rest): (Stored, &[u8]) =
            postcard::take_from_bytes(&payload).map_err(|error| StoreFault::invalid(&error))?;
        if !rest.is_empty() {
            return Err(StoreFault::invalid(&"there is more than a body"));
        }
        let (pieces, hierarchy, volume, nodes, surface, report) = stored;
        let tree = |nodes: Vec<HullNode>| HullTree::new(&pieces, &nodes);
        let hull_tree = nodes.map(tree).transpose();
        let model = Model {
            hull_tree: hull_tree.map_err(|error| StoreFault::invalid(&error))?,
            pieces,
            hierarchy,
            volume,
            surface,
            report,
        };
        model.check().map_err(|error| StoreFault::invalid(&error))?;
        Ok(model)
    }

    /// Checks that the parts, which are valid by themselves, belong together.
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
            let solid = self.volume == Volume::Solid;
            solid && pieces == 1 && self.pieces.get(0).radius == 0.0
        };
        if surface.is_some_and(|(pieces, _)| !(whole() && pieces.all_triangles())) {
            return Err("the surface is not that of one solid piece");
        }
        if self.report.pieces != pieces {
            return Err("the report counts another number of pieces");
        }
        Ok(())
    }
}

/// Creates a file beside another, with a name that nothing has: threads and processes may save side by side.
fn part_of(target: &Path) -> io::Result<(PathBuf, File)> {
    static COUNT: AtomicU64 = AtomicU64::new(0);
    let name = target.file_name().unwrap_or_default();
    loop {
        let count = COUNT.fetch_add(1, Ordering::Relaxed);
        let mut part = name.to_owned();
        part.push(format!(".{}-{count}.part", std::process::id()));
        let part = target.with_file_name(part);
        match File::create_new(&part) {
            // Left behind by a process of the same number.
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {}
            created => return Ok((part, created?)),
        }
    }
}

#[cfg(test)]
mod tests;
