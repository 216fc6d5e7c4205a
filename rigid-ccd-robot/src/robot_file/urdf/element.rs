//! URDF elements whose attributes and children are validated.

use super::vocabulary::{Vocabulary, contains, vocabulary_of};
use crate::remark::CellRemark;
use crate::robot_file::parse_xml;
use crate::robot_file::urdf_error::UrdfError;
use roxmltree::{Document, Error, Node};

/// The namespace prefix of elements that xacro has to expand before the file is a URDF.
const XACRO: &str = "xacro";

/// The largest number of undeclared namespace prefixes in a file. Some programs write prefixes without declaring them.
const MAX_UNDECLARED_PREFIXES: usize = 16;

/// A validated element.
#[derive(Clone, Copy)]
pub(super) struct Element<'t> {
    node: Node<'t, 't>,
    vocabulary: &'static Vocabulary,
}

/// Declares all namespace prefixes that the text uses without a declaration. Other URDF parsers do not require
/// declarations.
pub(super) fn with_declared_prefixes(text: &str) -> Result<String, String> {
    let mut text = text.to_owned();
    for _ in 0..MAX_UNDECLARED_PREFIXES {
        let prefix = match Document::parse(&text) {
            Ok(_) => return Ok(text),
            Err(Error::UnknownNamespace(prefix, _)) => prefix,
            Err(error) => return Err(error.to_string()),
        };
        text = text.replacen("<robot", &format!("<robot xmlns:{prefix}=\"{prefix}\""), 1);
    }
    parse_xml(&text).map(|_| String::new())
}

impl<'t> Element<'t> {
    /// Returns the root element of a document.
    pub(super) fn root(document: &'t Document<'t>) -> Result<Self, UrdfError> {
        let root = document.root_element();
        if let Some(node) = root.descendants().find(|node| is_of_xacro(*node)) {
            let element = format!("{XACRO}:{}", node.tag_name().name());
            return Err(UrdfError::Xacro { text: element });
        }
        let name = root.tag_name().name();
        if name != "robot" {
            let element = name.to_owned();
            return Err(UrdfError::NotARobot { element });
        }
        Element::new(root, "")
    }

    /// Wraps an element. Rejects unknown elements and attributes.
    fn new(node: Node<'t, 't>, parent: &str) -> Result<Self, UrdfError> {
        let name = node.tag_name().name();
        let Some(vocabulary) = vocabulary_of(parent, name) else {
            return Err(UrdfError::UnknownElement {
                element: qualified_name(node),
                parent: parent.to_owned(),
            });
        };
        let element = Element { node, vocabulary };
        for attribute in node.attributes() {
            let value = attribute.value();
            if value.contains("${") || value.contains("$(") {
                return Err(UrdfError::Xacro {
                    text: value.to_owned(),
                });
            }
            // Attributes with a prefix belong to other programs.
            let is_known = attribute.namespace().is_some()
                || contains(vocabulary.attributes, attribute.name());
            if !is_known {
                return Err(UrdfError::UnknownAttribute {
                    element: name.to_owned(),
                    attribute: attribute.name().to_owned(),
                });
            }
        }
        Ok(element)
    }

    pub(super) fn name(&self) -> &'t str {
        self.node.tag_name().name()
    }

    /// Returns the children that are not ignored, in order. Rejects unknown children. Adds a remark for each ignored
    /// child that other programs may use.
    pub(super) fn children(
        &self,
        remarks: &mut Vec<CellRemark>,
    ) -> Result<Vec<Element<'t>>, UrdfError> {
        let mut children = Vec::new();
        for child in self.node.children().filter(Node::is_element) {
            let name = child.tag_name().name();
            if prefix(child).is_some() || contains(self.vocabulary.left_out, name) {
                remarks.push(CellRemark::left_out(format!(
                    "{} in {}",
                    qualified_name(child),
                    self.label()
                )));
            } else if !contains(self.vocabulary.harmless, name) {
                children.push(Element::new(child, self.name())?);
            }
        }
        Ok(children)
    }

    /// Returns an attribute; `None` if it is absent.
    pub(super) fn get(&self, attribute: &str) -> Option<&'t str> {
        self.node.attribute(attribute)
    }

    /// Returns an attribute that must be present.
    pub(super) fn required(&self, attribute: &str) -> Result<&'t str, UrdfError> {
        self.get(attribute)
            .ok_or_else(|| UrdfError::MissingAttribute {
                element: self.name().to_owned(),
                attribute: attribute.to_owned(),
            })
    }

    /// Parses an attribute as a fixed number of numbers; `None` if it is absent.
    pub(super) fn numbers<const COUNT: usize>(
        &self,
        attribute: &str,
    ) -> Result<Option<[f64; COUNT]>, UrdfError> {
        let Some(text) = self.get(attribute) else {
            return Ok(None);
        };
        let numbers = text
            .split_ascii_whitespace()
            .map(|number| number.parse().ok());
        let numbers: Option<Vec<f64>> = numbers.collect();
        let numbers = numbers.and_then(|numbers| <[f64; COUNT]>::try_from(numbers).ok());
        let required = match COUNT {
            1 => "a number".to_owned(),
            count => format!("{count} numbers"),
        };
        numbers
            .map(Some)
            .ok_or_else(|| self.invalid(attribute, &required))
    }

    /// Parses an attribute that must be present as a number.
    pub(super) fn number(&self, attribute: &str) -> Result<f64, UrdfError> {
        self.required(attribute)?;
        let [number] = self.numbers(attribute)?.unwrap_or([f64::NAN]);
        Ok(number)
    }

    /// Creates the error for an attribute with an invalid value.
    pub(super) fn invalid(&self, attribute: &str, required: &str) -> UrdfError {
        UrdfError::InvalidAttribute {
            element: self.name().to_owned(),
            attribute: attribute.to_owned(),
            value: self.get(attribute).unwrap_or_default().to_owned(),
            required: required.to_owned(),
        }
    }

    /// Returns the element's kind and name for messages.
    fn label(&self) -> String {
        match self.get("name") {
            Some(name) => format!("{} {name}", self.name()),
            None => self.name().to_owned(),
        }
    }
}

/// Returns the only element with a name; `None` if there is none.
pub(super) fn only<'e, 't>(
    elements: &'e [Element<'t>],
    name: &str,
) -> Result<Option<&'e Element<'t>>, UrdfError> {
    let mut named = elements.iter().filter(|element| element.name() == name);
    let first = named.next();
    match named.next() {
        None => Ok(first),
        Some(_) => Err(UrdfError::RepeatedElement {
            element: name.to_owned(),
        }),
    }
}

/// Returns the only element with a name, which must be present.
pub(super) fn required<'e, 't>(
    elements: &'e [Element<'t>],
    name: &str,
) -> Result<&'e Element<'t>, UrdfError> {
    only(elements, name)?.ok_or_else(|| UrdfError::MissingElement {
        element: name.to_owned(),
    })
}

/// Returns whether an element belongs to xacro, whatever prefix the file declares for it.
fn is_of_xacro(node: Node<'_, '_>) -> bool {
    let namespace = node.tag_name().namespace();
    prefix(node) == Some(XACRO) || namespace.is_some_and(|name| name.ends_with(XACRO))
}

fn prefix<'t>(node: Node<'t, 't>) -> Option<&'t str> {
    let namespace = node.tag_name().namespace()?;
    Some(node.lookup_prefix(namespace).unwrap_or(""))
}

fn qualified_name(node: Node<'_, '_>) -> String {
    let name = node.tag_name().name();
    match prefix(node) {
        Some(prefix) if !prefix.is_empty() => format!("{prefix}:{name}"),
        _ => name.to_owned(),
    }
}
