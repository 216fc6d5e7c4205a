//! Errors of URDF files.

/// The reason why an element of a URDF cannot be read.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum UrdfError {
    /// The file has elements or expressions that xacro has to replace first.
    #[error("`{found}` is of xacro, which makes a URDF of it: run `xacro FILE.xacro > FILE.urdf`")]
    Xacro {
        /// The element or the expression.
        found: String,
    },
    /// The version of URDF is not known.
    #[error("version=\"{version}\" of URDF is not known; 1.0, 1.1 and 1.2 are")]
    UnknownVersion {
        /// The version that is given.
        version: String,
    },
    /// The file is of another kind.
    #[error(
        "the first element is `{element}`; that of a URDF is `robot`, that of an MJCF `mujoco`"
    )]
    NotARobot {
        /// The name of the first element.
        element: String,
    },
    /// An element is not known in the one around it.
    #[error("an element `{element}` in `{parent}` is not known")]
    UnknownElement {
        /// The name of the element.
        element: String,
        /// The name of the element around it.
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
    /// An element that has to be there is not.
    #[error("an element `{element}` is missing")]
    MissingElement {
        /// The name of the element, or what it is.
        element: String,
    },
    /// There are two elements where only one may be.
    #[error("there is more than one element `{element}`")]
    RepeatedElement {
        /// The name of the elements.
        element: String,
    },
    /// An attribute that has to be there is not.
    #[error("an element `{element}` needs an attribute `{attribute}`")]
    MissingAttribute {
        /// The name of the element.
        element: String,
        /// The name of the attribute.
        attribute: String,
    },
    /// An attribute does not have a value of its kind.
    #[error("{attribute}=\"{value}\" of an element `{element}` is not {wanted}")]
    InvalidAttribute {
        /// The name of the element.
        element: String,
        /// The name of the attribute.
        attribute: String,
        /// The value that is given.
        value: String,
        /// What it has to be.
        wanted: String,
    },
    /// An attribute is of a later version of URDF.
    #[error(
        "{attribute} of an element `{element}` needs version=\"{version}\" of an element `robot`"
    )]
    LaterVersion {
        /// The name of the element.
        element: String,
        /// The name of the attribute.
        attribute: String,
        /// The first version that has it.
        version: &'static str,
    },
}
