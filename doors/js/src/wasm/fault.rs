//! Errors of JavaScript: a `RangeError` for a number that is out of range, and an `Error` for anything else.
//!
//! The modules in `doors/js/module` throw a `TypeError` before they call, for a value of a wrong type or an unknown
//! option.

use rigid_ccd::mesh::{MeshError, MeshFault};
use rigid_ccd::{Error, InputError};
use rigid_ccd_robot::{PathError, RobotError};
use std::error::Error as AnyError;
use wasm_bindgen::JsValue;
use wasm_bindgen::prelude::wasm_bindgen;

#[wasm_bindgen]
extern "C" {
    type RangeError;
    #[wasm_bindgen(constructor)]
    fn new(text: &str) -> RangeError;

    #[wasm_bindgen(js_name = Error)]
    type PlainError;
    #[wasm_bindgen(constructor, js_class = "Error")]
    fn new(text: &str) -> PlainError;
}

/// The error that a call throws.
#[derive(Debug)]
pub struct Fault {
    text: String,
    is_about_range: bool,
}

impl Fault {
    /// Makes an `Error` with a message.
    #[expect(clippy::needless_pass_by_value, reason = "errors are mapped by it")]
    pub(crate) fn plain(text: impl ToString) -> Self {
        Fault {
            text: text.to_string(),
            is_about_range: false,
        }
    }

    /// Makes a `RangeError` with a message.
    pub(crate) fn of_range(text: impl ToString) -> Self {
        Fault {
            is_about_range: true,
            ..Fault::plain(text)
        }
    }

    /// Returns a function that puts the name of the element in front of a message.
    pub(crate) fn of_element<E: AnyError + 'static>(element: impl ToString) -> impl Fn(E) -> Self {
        move |error| {
            let Fault {
                text,
                is_about_range,
            } = Fault::from(error);
            Fault {
                text: format!("{}: {text}", element.to_string()),
                is_about_range,
            }
        }
    }
}

impl<E: AnyError + 'static> From<E> for Fault {
    fn from(error: E) -> Self {
        Fault {
            text: error.to_string(),
            is_about_range: is_about_range(&error),
        }
    }
}

impl From<Fault> for JsValue {
    fn from(fault: Fault) -> Self {
        if fault.is_about_range {
            RangeError::new(&fault.text).into()
        } else {
            PlainError::new(&fault.text).into()
        }
    }
}

/// Returns whether an error of Rust is about a number that is out of range.
fn is_about_range(error: &(dyn AnyError + 'static)) -> bool {
    if let Some(error) = error.downcast_ref::<InputError>() {
        return is_input_about_range(error);
    }
    if let Some(error) = error.downcast_ref::<RobotError>() {
        return is_robot_about_range(error);
    }
    if let Some(error) = error.downcast_ref::<MeshError>() {
        return matches!(
            error.fault,
            MeshFault::NotFinite { .. }
                | MeshFault::CoordinateTooLarge { .. }
                | MeshFault::NoSuchVertex { .. }
        );
    }
    match error.downcast_ref::<PathError>() {
        Some(
            PathError::InvalidConfiguration { error, .. }
            | PathError::InvalidCurvePoint { error, .. },
        ) => is_robot_about_range(error),
        Some(PathError::Query(Error::Input(error))) => is_input_about_range(error),
        Some(error) => matches!(
            error,
            PathError::InvalidRangeSetting { .. } | PathError::BeyondPlane { .. }
        ),
        None => false,
    }
}

fn is_input_about_range(error: &InputError) -> bool {
    matches!(
        error,
        InputError::NotFinite { .. }
            | InputError::ZeroQuaternion
            | InputError::OutOfRange { .. }
            | InputError::JointOutOfLimits { .. }
            | InputError::BadPoint { .. }
            | InputError::BadRadius { .. }
            | InputError::VertexOutOfRange { .. }
    )
}

fn is_robot_about_range(error: &RobotError) -> bool {
    match error {
        RobotError::Input(error) => is_input_about_range(error),
        error => matches!(
            error,
            RobotError::InvalidLimits { .. }
                | RobotError::InvalidPosition { .. }
                | RobotError::TooFar { .. }
        ),
    }
}
