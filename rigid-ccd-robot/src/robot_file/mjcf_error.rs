//! Errors of MJCF files.

/// The reason why an MJCF file cannot be read.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MjcfError {
    /// The file is no XML.
    #[error("{error}")]
    Syntax {
        /// The parser's message.
        error: String,
    },
    /// Elements are nested too deeply, or there are too many of them.
    #[error("elements are nested too deeply, or are too many; does a file include itself?")]
    TooManyElements,
    /// An element is not known here. It may stand for a shape or a joint.
    #[error("element `{element}` in `{parent}` is not supported")]
    UnknownElement {
        /// The name of the element.
        element: String,
        /// The name of the element around it.
        parent: String,
    },
    /// An element does not have an attribute of this name.
    #[error("an element `{element}` has no attribute `{attribute}`")]
    UnknownAttribute {
        /// The kind of the element, and its name.
        element: String,
        /// The name of the attribute.
        attribute: String,
    },
    /// An attribute does not have a value of its kind.
    #[error("{attribute}=\"{value}\" of an element `{element}` is not valid")]
    InvalidAttribute {
        /// The kind of the element, and its name.
        element: String,
        /// The name of the attribute.
        attribute: String,
        /// The value that is given; empty if there is none.
        value: String,
    },
    /// An element names something that the model does not have.
    #[error("there is no {kind} `{name}`")]
    UnknownName {
        /// What it would be, such as `body`.
        kind: &'static str,
        /// The name that nothing has.
        name: String,
    },
    /// A shape has no body of its kind.
    #[error("{shape} is not supported; leave it out of the file, and model it as an obstacle")]
    UnsupportedShape {
        /// What the shape is.
        shape: &'static str,
    },
}

impl MjcfError {
    pub(crate) fn unknown_name(kind: &'static str, name: &str) -> Self {
        MjcfError::UnknownName {
            kind,
            name: name.to_owned(),
        }
    }
}
