//! Errors of URDF files.

/// The reason why an element of a URDF cannot be read.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum UrdfError {
    /// The file contains elements or expressions that xacro has to expand first.
    #[error(
        "`{text}` belongs to xacro, and this file is not a URDF yet: run `xacro FILE.xacro > FILE.urdf`"
    )]
    Xacro {
        /// The element or the expression.
        text: String,
    },
    /// The version of URDF is unknown.
    #[error("version=\"{version}\" of URDF is not supported; 1.0, 1.1 and 1.2 are")]
    UnknownVersion {
        /// The version in the file.
        version: String,
    },
    /// The root element is not `robot`.
    #[error("the root element is `{element}`; a URDF has `robot`, an MJCF has `mujoco`")]
    NotARobot {
        /// The name of the root element.
        element: String,
    },
    /// An element is unknown in its parent.
    #[error("an element `{element}` in `{parent}` is not known")]
    UnknownElement {
        /// The name of the element.
        element: String,
        /// The name of its parent element.
        parent: String,
    },
    /// An element does not have an attribute of this name.
    #[error("an element `{element}` has no attribute `{attribute}`")]
    UnknownAttribute {
        /// The name of the element.
        element: String,
        /// The name of the attribute.
        attribute: String,
    },
    /// A required element is missing.
    #[error("an element `{element}` is missing")]
    MissingElement {
        /// The name or the kind of the element.
        element: String,
    },
    /// An element that may occur only once occurs more often.
    #[error("there is more than one element `{element}`")]
    RepeatedElement {
        /// The name of the elements.
        element: String,
    },
    /// A required attribute is missing.
    #[error("an element `{element}` needs an attribute `{attribute}`")]
    MissingAttribute {
        /// The name of the element.
        element: String,
        /// The name of the attribute.
        attribute: String,
    },
    /// An attribute has an invalid value.
    #[error("{attribute}=\"{value}\" of an element `{element}` is not {required}")]
    InvalidAttribute {
        /// The name of the element.
        element: String,
        /// The name of the attribute.
        attribute: String,
        /// The value in the file.
        value: String,
        /// The required kind of value.
        required: String,
    },
    /// An attribute needs a later version of URDF.
    #[error(
        "{attribute} of an element `{element}` needs version=\"{version}\" in the element `robot`"
    )]
    LaterVersion {
        /// The name of the element.
        element: String,
        /// The name of the attribute.
        attribute: String,
        /// The first version with this attribute.
        version: &'static str,
    },
}
