//! Opens the zip archive of a 3MF, and finds its root model.

use super::model::{self, Model};
use super::xml::{XmlEvent, XmlReader};
use crate::mesh::error::{MeshFault, Quote};
use crate::tolerance::{UNPACKED_SIZE_BASE, UNPACKED_SIZE_PER_BYTE};
use flate2::bufread::DeflateDecoder;
use rawzip::{CompressionMethod, ZipArchive, ZipArchiveEntryWayfinder, ZipSliceArchive};
use std::collections::BTreeMap;
use std::io::{self, BufReader, Read};

/// An open zip archive with a limit on the unpacked bytes.
pub(super) struct Package<'a> {
    archive: ZipSliceArchive<&'a [u8]>,
    entries: BTreeMap<String, Entry>,
    limit: u64,
    /// The number of bytes that may still be unpacked; `None` after more.
    remaining_bytes: Option<u64>,
}

#[derive(Clone, Copy)]
struct Entry {
    wayfinder: ZipArchiveEntryWayfinder,
    method: CompressionMethod,
    is_encrypted: bool,
}

/// The path in the archive of the file that names the root model.
const RELATIONSHIPS_PATH: &str = "_rels/.rels";
const DEFAULT_MODEL_PATH: &str = "3D/3dmodel.model";

/// The suffix of the relationship type that marks the root model.
const MODEL_TYPE_SUFFIX: &str = "/3dmodel";

/// The buffer size for unpacking, in bytes.
const BUFFER_BYTES: usize = 1 << 16;

impl<'a> Package<'a> {
    pub(super) fn open(bytes: &'a [u8]) -> Result<Self, MeshFault> {
        let archive = ZipArchive::from_slice(bytes).map_err(|error| zip_fault(&error))?;
        let mut entries = BTreeMap::new();
        let mut records = archive.entries();
        while let Some(record) = records.next_entry().map_err(|error| zip_fault(&error))? {
            let path = String::from_utf8_lossy(record.file_path().as_ref()).into_owned();
            entries.entry(normalized_path(&path)).or_insert(Entry {
                wayfinder: record.wayfinder(),
                method: record.compression_method(),
                is_encrypted: record.flags().is_encrypted(),
            });
        }
        let limit = UNPACKED_SIZE_BASE + UNPACKED_SIZE_PER_BYTE.saturating_mul(bytes.len() as u64);
        Ok(Package {
            archive,
            entries,
            limit,
            remaining_bytes: Some(limit),
        })
    }

    /// Returns the number of bytes that have been unpacked from the archive.
    pub(super) fn unpacked_bytes(&self) -> u64 {
        self.limit - self.remaining_bytes.unwrap_or(0)
    }

    /// Returns the path of the root model in the archive.
    pub(super) fn root_model_path(&mut self) -> Result<String, MeshFault> {
        if !self.entries.contains_key(RELATIONSHIPS_PATH) {
            return if self
                .entries
                .contains_key(&normalized_path(DEFAULT_MODEL_PATH))
            {
                Ok(DEFAULT_MODEL_PATH.into())
            } else {
                let problem =
                    format!("is a zip without {RELATIONSHIPS_PATH:?}, so that it is no 3MF");
                Err(MeshFault::malformed_content(problem))
            };
        }
        let found = self.read(RELATIONSHIPS_PATH, |xml| {
            loop {
                let element = match xml.next()? {
                    XmlEvent::Start(element) if element.name() == "Relationship" => element,
                    XmlEvent::Done => return Ok(None),
                    _ => continue,
                };
                let [kind, target] = element.attribute_values(["Type", "Target"])?;
                let is_model = kind.is_some_and(|kind| kind.ends_with(MODEL_TYPE_SUFFIX));
                if let Some(target) = target.filter(|_| is_model) {
                    return Ok(Some(target.into_owned()));
                }
            }
        });
        let found = found.map_err(|fault| fault.at(format!("{RELATIONSHIPS_PATH:?}")))?;
        found.ok_or_else(|| {
            MeshFault::malformed_content(format!("its {RELATIONSHIPS_PATH:?} names no model"))
        })
    }

    /// Unpacks and parses one model of the package.
    #[expect(
        clippy::redundant_closure,
        reason = "a function has one lifetime, a closure any"
    )]
    pub(super) fn model(&mut self, path: &str) -> Result<Model, MeshFault> {
        self.read(path, |xml| model::read(xml))
    }

    fn read<T>(
        &mut self,
        path: &str,
        parse: impl FnOnce(&mut XmlReader<BufReader<EntryReader<'_>>>) -> Result<T, MeshFault>,
    ) -> Result<T, MeshFault> {
        let Some(&entry) = self.entries.get(&normalized_path(path)) else {
            return Err(MeshFault::malformed_content("is not in the package"));
        };
        let content = unpacked(&self.archive, entry)?;
        let left = &mut self.remaining_bytes;
        let unpacking = BufReader::with_capacity(BUFFER_BYTES, EntryReader { content, left });
        let parsed = parse(&mut XmlReader::new(unpacking));
        let limit = self.limit;
        self.remaining_bytes
            .ok_or(MeshFault::UnpackedTooLarge { limit })?;
        parsed
    }
}

/// A reader of one archive entry, which unpacks on reading and verifies the checksum at the end.
struct EntryReader<'a> {
    content: Box<dyn Read + 'a>,
    left: &'a mut Option<u64>,
}

/// Returns the content of an entry, which is unpacked on reading.
fn unpacked<'a>(
    archive: &'a ZipSliceArchive<&'a [u8]>,
    entry: Entry,
) -> Result<Box<dyn Read + 'a>, MeshFault> {
    if entry.is_encrypted {
        let instead = "3MF without encryption";
        return Err(MeshFault::unsupported("an encrypted model", instead));
    }
    let found = archive.get_entry(entry.wayfinder);
    let found = found.map_err(|error| zip_fault(&error))?;
    match entry.method {
        CompressionMethod::STORE => Ok(Box::new(found.verifying_reader(found.data()))),
        CompressionMethod::DEFLATE => {
            let inflated = DeflateDecoder::new(found.data());
            Ok(Box::new(found.verifying_reader(inflated)))
        }
        other => {
            let what = format!("an entry compressed by method {}", other.as_u16());
            Err(MeshFault::unsupported(what, "3MF compressed by deflate"))
        }
    }
}

impl Read for EntryReader<'_> {
    fn read(&mut self, out: &mut [u8]) -> io::Result<usize> {
        let read = self.content.read(out)?;
        *self.left = self.left.and_then(|left| left.checked_sub(read as u64));
        let exceeded = || io::Error::other("there is more than a mesh may have");
        self.left.map(|_| read).ok_or_else(exceeded)
    }
}

/// Normalizes a path for comparison: part names are case-insensitive.
pub(super) fn normalized_path(path: &str) -> String {
    path.trim_start_matches('/').to_lowercase()
}

fn zip_fault(error: &rawzip::Error) -> MeshFault {
    let error = error.to_string();
    MeshFault::malformed_content(format!("its zip is not whole: {:?}", Quote(&error)))
}
