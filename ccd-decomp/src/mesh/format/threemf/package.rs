//! Opens the zip archive of a 3MF, and finds its root model.

use super::model::{self, Model};
use super::xml::{Xml, XmlEvent};
use crate::mesh::error::{MeshFault, Quote};
use crate::tolerance::{UNPACKED_BASE, UNPACKED_PER_BYTE};
use flate2::bufread::DeflateDecoder;
use rawzip::{CompressionMethod, ZipArchive, ZipArchiveEntryWayfinder, ZipSliceArchive};
use std::collections::BTreeMap;
use std::io::{self, BufReader, Read};

/// An open zip archive with a limit on the unpacked bytes.
pub(super) struct Package<'a> {
    archive: ZipSliceArchive<&'a [u8]>,
    entries: BTreeMap<String, Entry>,
    limit: u64,
    left: u64,
}

#[derive(Clone, Copy)]
struct Entry {
    wayfinder: ZipArchiveEntryWayfinder,
    method: CompressionMethod,
    encrypted: bool,
}

/// The path in the archive of the file that names the root model.
const RELATIONSHIPS: &str = "_rels/.rels";
const USUAL_MODEL: &str = "3D/3dmodel.model";

/// The suffix of the relationship type that marks the root model.
const MODEL_TYPE: &str = "/3dmodel";

/// The buffer size for unpacking, in bytes.
const BUFFER: usize = 1 << 16;

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
                encrypted: record.flags().is_encrypted(),
            });
        }
        let limit = UNPACKED_BASE + UNPACKED_PER_BYTE.saturating_mul(bytes.len() as u64);
        Ok(Package {
            archive,
            entries,
            limit,
            left: limit,
        })
    }

    /// Returns the number of bytes that have been unpacked from the archive.
    pub(super) fn unpacked_bytes(&self) -> u64 {
        self.limit - self.left
    }

    /// Returns the path of the root model in the archive.
    pub(super) fn root_model_path(&mut self) -> Result<String, MeshFault> {
        if !self.entries.contains_key(RELATIONSHIPS) {
            return if self.entries.contains_key(&normalized_path(USUAL_MODEL)) {
                Ok(USUAL_MODEL.into())
            } else {
                let problem = format!("is a zip without {RELATIONSHIPS:?}, so that it is no 3MF");
                Err(MeshFault::malformed(problem))
            };
        }
        let found = self.read(RELATIONSHIPS, |xml| {
            loop {
                let element = match xml.next()? {
                    XmlEvent::Start(element) if element.name() == "Relationship" => element,
                    XmlEvent::Done => return Ok(None),
                    _ => continue,
                };
                let [kind, target] = element.attribute_values(["Type", "Target"])?;
                let is_model = kind.is_some_and(|kind| kind.ends_with(MODEL_TYPE));
                if let Some(target) = target.filter(|_| is_model) {
                    return Ok(Some(target.into_owned()));
                }
            }
        });
        let found = found.map_err(|fault| fault.at(format!("{RELATIONSHIPS:?}")))?;
        found.ok_or_else(|| MeshFault::malformed(format!("its {RELATIONSHIPS:?} names no model")))
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
        parse: impl FnOnce(&mut Xml<BufReader<Unpacking<'_>>>) -> Result<T, MeshFault>,
    ) -> Result<T, MeshFault> {
        let Package {
            archive,
            entries,
            limit,
            left,
        } = self;
        let Some(entry) = entries.get(&normalized_path(path)) else {
            return Err(MeshFault::malformed("is not in the package"));
        };
        let limit = *limit;
        let unpacking = Unpacking::new(archive, entry, left)?;
        let mut xml = Xml::new(BufReader::with_capacity(BUFFER, unpacking));
        let parsed = parse(&mut xml);
        if xml.into_inner().get_ref().is_exceeded {
            Err(MeshFault::Unpacks { limit })
        } else {
            parsed
        }
    }
}

/// A reader of one archive entry, which unpacks on reading and verifies the checksum at the end.
struct Unpacking<'a> {
    content: Box<dyn Read + 'a>,
    left: &'a mut u64,
    is_exceeded: bool,
}

impl<'a> Unpacking<'a> {
    fn new(
        archive: &'a ZipSliceArchive<&'a [u8]>,
        entry: &Entry,
        left: &'a mut u64,
    ) -> Result<Self, MeshFault> {
        if entry.encrypted {
            return Err(MeshFault::unsupported(
                "an encrypted model",
                "3MF without encryption",
            ));
        }
        let found = archive
            .get_entry(entry.wayfinder)
            .map_err(|error| zip_fault(&error))?;
        let content: Box<dyn Read + 'a> = match entry.method {
            CompressionMethod::STORE => Box::new(found.verifying_reader(found.data())),
            CompressionMethod::DEFLATE => {
                Box::new(found.verifying_reader(DeflateDecoder::new(found.data())))
            }
            other => {
                return Err(MeshFault::unsupported(
                    format!("an entry compressed by method {}", other.as_u16()),
                    "3MF compressed by deflate",
                ));
            }
        };
        Ok(Unpacking {
            content,
            left,
            is_exceeded: false,
        })
    }
}

impl Read for Unpacking<'_> {
    fn read(&mut self, out: &mut [u8]) -> io::Result<usize> {
        let read = self.content.read(out)?;
        match self.left.checked_sub(read as u64) {
            Some(left) => {
                *self.left = left;
                Ok(read)
            }
            None => {
                self.is_exceeded = true;
                Err(io::Error::other("there is more than a mesh may have"))
            }
        }
    }
}

/// Normalizes a path for comparison: part names are case-insensitive.
pub(super) fn normalized_path(path: &str) -> String {
    path.trim_start_matches('/').to_lowercase()
}

fn zip_fault(error: &rawzip::Error) -> MeshFault {
    let error = error.to_string();
    MeshFault::malformed(format!("its zip is not whole: {:?}", Quote(&error)))
}
