//! Errors of MJCF files.

/// The reason why an MJCF file cannot be read.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MjcfError {
    /// The file is not valid XML.
    #[error("{error}")]
    Syntax {
        /// The parser's message.
        error: String,
    },
    /// Elements are nested too deeply, or there are too many.
    #[error("elements are nested too deeply, or there are too many")]
    TooManyElements,
    /// An element is not supported. It may be a shape or a joint.
    #[error("element `{element}` in `{parent}` is not supported")]
    UnknownElement {
        /// The name of the element.
        element: String,
        /// The name of its parent element.
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
    /// The value of an attribute is missing or not valid.
    #[error("{attribute}=\"{value}\" of an element `{element}` is not valid")]
    InvalidAttribute {
        /// The kind of the element, and its name.
        element: String,
        /// The name of the attribute.
        attribute: String,
        /// The value in the file; empty if there is none.
        value: String,
    },
    /// An element refers to an element that the model does not have.
    #[error("there is no {kind} `{name}`")]
    UnknownName {
        /// The kind of the missing element, such as `body`.
        kind: &'static str,
        /// The unknown name.
        name: String,
    },
    /// Several elements of one kind have the same name, or a file is included more than once.
    #[error("there are several elements `{kind}` with the name `{name}`")]
    RepeatedName {
        /// The kind of the elements.
        kind: String,
        /// The name of the elements, or the name of the file.
        name: String,
    },
    /// MuJoCo would move the body's frame to its center of mass, which changes the positions of its free joint.
    #[error(
        "the frame of body `{body}` is aligned with its inertia, which is not supported; set align=\"false\""
    )]
    AlignedBody {
        /// The name of the body.
        body: String,
    },
    /// A pair has two geoms of one body, which are never compared.
    #[error("an element `{pair}` has two geoms of the body `{body}`; leave it out of the file")]
    PairOfOneBody {
        /// The kind of the element, and its name.
        pair: String,
        /// The name of the body.
        body: String,
    },
    /// A shape cannot be converted to a body.
    #[error("{shape} is not supported; leave it out of the file, and model it as an obstacle")]
    UnsupportedShape {
        /// A description of the shape.
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

    pub(crate) fn repeated_name(kind: &str, name: &str) -> Self {
        MjcfError::RepeatedName {
            kind: kind.to_owned(),
            name: name.to_owned(),
        }
    }
}
