//! A reader of XML elements.

use crate::mesh::error::{MeshFault, Quote};
use quick_xml::XmlVersion;
use quick_xml::events::{BytesStart, Event};
use quick_xml::name::ResolveResult;
use quick_xml::reader::NsReader;
use std::borrow::Cow;
use std::io::BufRead;

/// A reader of XML elements. Text between them is skipped.
pub(super) struct Xml<R> {
    reader: NsReader<R>,
    buffer: Vec<u8>,
    depth: usize,
    /// The namespace of the outermost element.
    own: Option<Namespace>,
}

/// A namespace; `None` for names without one.
type Namespace = Option<String>;

/// The next event of the reader.
pub(super) enum Step<'a> {
    /// An element begins.
    Start(Element<'a>),
    /// The innermost element ends.
    End,
    /// Text or a comment.
    Between,
    /// The text ends, and with it all elements.
    Done,
}

/// The start of an element.
pub(super) struct Element<'a> {
    start: BytesStart<'a>,
    origin: Origin,
}

/// The origin of an element's name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Origin {
    /// The namespace of the outermost element.
    Own,
    /// Another namespace: an extension.
    Extension,
}

impl<R: BufRead> Xml<R> {
    pub(super) fn new(reader: R) -> Self {
        let mut reader = NsReader::from_reader(reader);
        let config = reader.config_mut();
        config.expand_empty_elements = true;
        // Texts are skipped, with their faults.
        config.allow_dangling_amp = true;
        Xml {
            reader,
            buffer: Vec::new(),
            depth: 0,
            own: None,
        }
    }

    pub(super) fn into_inner(self) -> R {
        self.reader.into_inner()
    }

    pub(super) fn next(&mut self) -> Result<Step<'_>, MeshFault> {
        self.buffer.clear();
        let event = self.reader.read_event_into(&mut self.buffer);
        match event.map_err(|error| fault(&error, self.reader.buffer_position()))? {
            Event::Start(start) => {
                self.depth += 1;
                let (found, _) = self.reader.resolver().resolve_element(start.name());
                let found = namespace(&found);
                let own = self.own.get_or_insert_with(|| found.map(str::to_owned));
                let origin = if own.as_deref() == found {
                    Origin::Own
                } else {
                    Origin::Extension
                };
                Ok(Step::Start(Element { start, origin }))
            }
            Event::End(_) => {
                self.depth = self.depth.saturating_sub(1);
                Ok(Step::End)
            }
            Event::DocType(_) => {
                let problem = "has a document type, which a 3MF must not have";
                Err(MeshFault::syntax(None, problem.into()))
            }
            Event::Eof if self.depth > 0 => {
                let missing = "its XML".into();
                Err(MeshFault::Truncated { missing })
            }
            Event::Eof => Ok(Step::Done),
            _ => Ok(Step::Between),
        }
    }
}

impl<'a> Element<'a> {
    /// Returns the name without prefix.
    pub(super) fn name(&self) -> &str {
        self.start.local_name().into_inner()
    }

    /// Returns the origin of the name.
    pub(super) fn origin(&self) -> Origin {
        self.origin
    }

    /// Returns the values of some attributes: without a prefix or, if the name begins with a colon, with any prefix.
    pub(super) fn values<const N: usize>(
        &self,
        names: [&str; N],
    ) -> Result<[Option<Cow<'_, str>>; N], MeshFault> {
        let mut values = [const { None }; N];
        self.each(|prefix, local, value| {
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

    /// Visits all attributes: prefix, name without it, and value.
    pub(super) fn each<'s>(
        &'s self,
        mut visit: impl FnMut(Option<&str>, &str, Cow<'s, str>),
    ) -> Result<(), MeshFault> {
        for attribute in self.start.attributes() {
            let attribute = attribute.map_err(|error| problem(&error))?;
            let value = attribute.normalized_value(XmlVersion::Explicit1_0);
            let prefix = attribute.key.prefix();
            let prefix = prefix.as_ref().map(|prefix| prefix.as_ref());
            let local = attribute.key.local_name();
            visit(
                prefix,
                local.as_ref(),
                value.map_err(|error| problem(&error))?,
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

fn fault(error: &quick_xml::Error, position: u64) -> MeshFault {
    let error = error.to_string();
    let problem = format!(
        "its XML is not valid before byte {position}: {:?}",
        Quote(&error)
    );
    MeshFault::syntax(None, problem)
}

fn problem(error: &dyn std::fmt::Display) -> MeshFault {
    let error = error.to_string();
    MeshFault::syntax(
        None,
        format!("its XML has a bad attribute: {:?}", Quote(&error)),
    )
}
