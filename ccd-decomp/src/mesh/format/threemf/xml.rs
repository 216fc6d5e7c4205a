//! An XML reader that returns elements with their namespaces resolved.

use crate::mesh::error::{MeshFault, Quote};
use quick_xml::XmlVersion;
use quick_xml::events::{BytesStart, Event};
use quick_xml::name::ResolveResult;
use quick_xml::reader::NsReader;
use std::borrow::Cow;
use std::io::BufRead;

/// A reader of XML elements. Text between them is skipped.
pub(super) struct XmlReader<R> {
    reader: NsReader<R>,
    buffer: Vec<u8>,
    depth: usize,
    /// The namespace of the outermost element, once it has been read.
    root_namespace: Option<Namespace>,
}

/// The URI of a namespace; `None` for names without a namespace.
type Namespace = Option<String>;

/// The next event of the XML reader.
pub(super) enum XmlEvent<'a> {
    /// The start of an element.
    Start(Element<'a>),
    /// The end of the innermost open element.
    End,
    /// Text or a comment, which is skipped.
    TextOrComment,
    /// The end of the document.
    Done,
}

/// The start tag of an element, with its attributes.
pub(super) struct Element<'a> {
    start: BytesStart<'a>,
    /// Whether its name is of another namespace than that of the outermost element.
    pub(super) is_extension: bool,
}

impl<R: BufRead> XmlReader<R> {
    pub(super) fn new(reader: R) -> Self {
        let mut reader = NsReader::from_reader(reader);
        let config = reader.config_mut();
        config.expand_empty_elements = true;
        // Texts are skipped, with their faults.
        config.allow_dangling_amp = true;
        XmlReader {
            reader,
            buffer: Vec::new(),
            depth: 0,
            root_namespace: None,
        }
    }

    pub(super) fn next(&mut self) -> Result<XmlEvent<'_>, MeshFault> {
        self.buffer.clear();
        let event = self.reader.read_event_into(&mut self.buffer);
        let event = event.map_err(|error| {
            let (error, position) = (error.to_string(), self.reader.buffer_position());
            let error = Quote(&error);
            MeshFault::malformed_content(format!(
                "its XML is not valid before byte {position}: {error:?}"
            ))
        });
        match event? {
            Event::Start(start) => {
                self.depth += 1;
                let (found, _) = self.reader.resolver().resolve_element(start.name());
                let found = namespace(&found);
                let own = self
                    .root_namespace
                    .get_or_insert_with(|| found.map(str::to_owned));
                let is_extension = own.as_deref() != found;
                Ok(XmlEvent::Start(Element {
                    start,
                    is_extension,
                }))
            }
            Event::End(_) => {
                self.depth = self.depth.saturating_sub(1);
                Ok(XmlEvent::End)
            }
            Event::DocType(_) => {
                let problem = "has a document type, which a 3MF must not have";
                Err(MeshFault::malformed_content(problem))
            }
            Event::Eof if self.depth > 0 => Err(MeshFault::truncated_file("its XML")),
            Event::Eof => Ok(XmlEvent::Done),
            _ => Ok(XmlEvent::TextOrComment),
        }
    }
}

impl<'a> Element<'a> {
    /// Returns the element's name without its prefix.
    pub(super) fn name(&self) -> &str {
        self.start.local_name().into_inner()
    }

    /// Returns the values of the named attributes. A plain name matches attributes without prefix; a name that begins
    /// with a colon matches any prefix.
    pub(super) fn attribute_values<const N: usize>(
        &self,
        names: [&str; N],
    ) -> Result<[Option<Cow<'_, str>>; N], MeshFault> {
        let mut values = [const { None }; N];
        self.for_each_attribute(|prefix, local, value| {
            let is = |name: &&str| match name.strip_prefix(':') {
                Some(name) => prefix.is_some() && name == local,
                None => prefix.is_none() && *name == local,
            };
            if let Some(k) = names.iter().position(is) {
                values[k] = Some(value);
            }
        })?;
        Ok(values)
    }

    /// Calls the closure with the prefix, the name without it, and the value of every attribute.
    pub(super) fn for_each_attribute<'s>(
        &'s self,
        mut visit: impl FnMut(Option<&str>, &str, Cow<'s, str>),
    ) -> Result<(), MeshFault> {
        for attribute in self.start.attributes() {
            let attribute = attribute.map_err(|error| bad_attribute(&error))?;
            let value = attribute.normalized_value(XmlVersion::Explicit1_0);
            let prefix = attribute.key.prefix();
            let prefix = prefix.as_ref().map(|prefix| prefix.as_ref());
            let local = attribute.key.local_name();
            visit(
                prefix,
                local.as_ref(),
                value.map_err(|error| bad_attribute(&error))?,
            );
        }
        Ok(())
    }
}

fn namespace<'r>(resolved: &'r ResolveResult<'_>) -> Option<&'r str> {
    match resolved {
        ResolveResult::Bound(namespace) => Some(namespace.as_ref()),
        ResolveResult::Unbound => None,
        ResolveResult::Unknown(prefix) => Some(prefix),
    }
}

fn bad_attribute(error: &dyn std::fmt::Display) -> MeshFault {
    let error = error.to_string();
    MeshFault::malformed_content(format!("its XML has a bad attribute: {:?}", Quote(&error)))
}
