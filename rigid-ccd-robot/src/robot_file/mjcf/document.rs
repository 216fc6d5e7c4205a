//! Parses an MJCF file. Included files replace the elements that include them.

use super::attributes::Attributes;
use crate::robot_file::error::RobotFileError;
use crate::robot_file::mjcf_error::MjcfError;
use crate::robot_file::{parse_xml, read};
use roxmltree::Node;
use std::collections::HashSet;
use std::path::{Path, PathBuf};

/// The largest nesting depth of elements and included files. Deeper nesting could overflow the stack.
const MAX_DEPTH: usize = 200;

/// The largest number of elements.
pub(super) const MAX_ELEMENTS: usize = 1 << 20;

/// An element of an MJCF.
pub(super) struct Element {
    pub(super) name: String,
    pub(super) attributes: Attributes,
    pub(super) children: Vec<Element>,
}

impl Element {
    /// Creates the error that this element is not supported in a parent.
    pub(super) fn unknown_in(&self, parent: &str) -> MjcfError {
        MjcfError::UnknownElement {
            element: self.name.clone(),
            parent: parent.to_owned(),
        }
    }
}

/// Iterates over the children of all sections with a name.
pub(super) fn children_of_sections<'r>(
    root: &'r Element,
    section: &'r str,
) -> impl Iterator<Item = &'r Element> {
    let sections = root
        .children
        .iter()
        .filter(move |element| element.name == section);
    sections.flat_map(|section| &section.children)
}

/// Parses a text, and the files that it includes, which are relative to a folder. Returns the root element.
pub(super) fn parse(text: &str, folder: &Path) -> Result<Element, RobotFileError> {
    let mut reader = Reader {
        folder,
        element_count: 0,
        included: HashSet::new(),
    };
    let document = parse_xml(text).map_err(|error| MjcfError::Syntax { error })?;
    let mut elements = reader.elements(document.root_element(), 0)?;
    Ok(elements.swap_remove(0))
}

/// Rejects names with a namespace prefix, such as `x:geom`. MJCF has none.
fn refuse_prefixes(node: Node<'_, '_>) -> Result<(), MjcfError> {
    let qualified = |prefix: &str, name: &str| format!("{prefix}:{name}");
    let name = node.tag_name();
    let prefix_of = |namespace| node.lookup_prefix(namespace);
    if let Some(prefix) = name.namespace().and_then(prefix_of) {
        let parent = node.parent_element();
        return Err(MjcfError::UnknownElement {
            element: qualified(prefix, name.name()),
            parent: parent
                .map_or("", |parent| parent.tag_name().name())
                .to_owned(),
        });
    }
    for attribute in node.attributes() {
        if let Some(prefix) = attribute.namespace().and_then(prefix_of) {
            return Err(MjcfError::UnknownAttribute {
                element: name.name().to_owned(),
                attribute: qualified(prefix, attribute.name()),
            });
        }
    }
    Ok(())
}

struct Reader<'r> {
    folder: &'r Path,
    element_count: usize,
    /// The files that were already included.
    included: HashSet<PathBuf>,
}

impl Reader<'_> {
    /// Converts an element. An `include` is replaced by the children of the included file's root element.
    fn elements(
        &mut self,
        node: Node<'_, '_>,
        depth: usize,
    ) -> Result<Vec<Element>, RobotFileError> {
        self.element_count += 1;
        if depth > MAX_DEPTH || self.element_count > MAX_ELEMENTS {
            return Err(MjcfError::TooManyElements.into());
        }
        refuse_prefixes(node)?;
        let attributes = Attributes::read(node);
        if node.tag_name().name() == "include" {
            if let Some(child) = self.children(node, depth + 1)?.first() {
                return Err(child.unknown_in("include").into());
            }
            if let Some(other) = attributes.names().find(|name| *name != "file") {
                return Err(attributes.unknown(other).into());
            }
            let name = attributes.required_name("file")?;
            let file = self.folder.join(name);
            if !self.included.insert(file.clone()) {
                return Err(MjcfError::repeated_name("include", name).into());
            }
            let text = read(&file)?;
            let document =
                parse_xml(&text).map_err(|error| RobotFileError::Syntax { file, error })?;
            return self.children(document.root_element(), depth + 1);
        }
        Ok(vec![Element {
            name: node.tag_name().name().to_owned(),
            attributes,
            children: self.children(node, depth + 1)?,
        }])
    }

    fn children(
        &mut self,
        node: Node<'_, '_>,
        depth: usize,
    ) -> Result<Vec<Element>, RobotFileError> {
        let mut children = Vec::new();
        for child in node.children().filter(Node::is_element) {
            children.extend(self.elements(child, depth)?);
        }
        Ok(children)
    }
}
