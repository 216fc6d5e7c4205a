//! The attributes of an MJCF element, merged with those of its class.

use crate::robot_file::mjcf_error::MjcfError;
use ccd_core::vector::unit;
use rigid_ccd::glam::{DQuat, DVec3};
use roxmltree::{Attribute, Node};
use std::collections::BTreeMap;
use std::ops::RangeInclusive;

/// The attributes that specify a rotation. An element has at most one of them.
pub(super) const ORIENTATIONS: [&str; 5] = ["quat", "axisangle", "xyaxes", "zaxis", "euler"];

/// Numeric attributes. If empty, they count as absent, as in MuJoCo.
const NUMBERS: &str = "axis axisangle conaffinity contype count elevation euler face fromto group margin ncol nrow o_margin \
    offset polycoef pos quat range ref refpos refquat scale size xyaxes zaxis";

/// The lengths of vectors and quaternions that MuJoCo accepts.
const ACCEPTED_LENGTHS: RangeInclusive<f64> = 1e-10..=1e100;

/// The attributes of an element, by name.
#[derive(Clone, Debug, Default)]
pub(super) struct Attributes {
    /// The name of the element.
    pub(super) element: String,
    values: BTreeMap<String, String>,
}

impl Attributes {
    /// Reads the attributes of an element. Empty numeric attributes are left out.
    pub(super) fn read(node: Node<'_, '_>) -> Self {
        let is_present = |attribute: &Attribute<'_, '_>| {
            let is_empty = attribute.value().trim_ascii().is_empty();
            !(is_empty && NUMBERS.split(' ').any(|number| number == attribute.name()))
        };
        let values = node.attributes().filter(is_present);
        Attributes {
            element: node.tag_name().name().to_owned(),
            values: values
                .map(|attribute| (attribute.name().to_owned(), attribute.value().to_owned()))
                .collect(),
        }
    }

    /// Returns the attributes of a class, with these attributes added and replacing the class's. A shorter `size`
    /// replaces only the first numbers of the class's `size`.
    pub(super) fn over(&self, class: &Attributes) -> Result<Self, MjcfError> {
        let mut values = class.values.clone();
        let is_specified = |name: &&str| self.values.contains_key(*name);
        if let Some(name) = ORIENTATIONS.into_iter().find(is_specified) {
            for other in ORIENTATIONS {
                // In MuJoCo any rotation replaces a quaternion of the class. In other combinations the rotation
                // of the class applies. This is probably a mistake in the file, so it is an error here.
                if other != name && values.remove(other).is_some() && other != "quat" {
                    return Err(self.invalid(name));
                }
            }
        }
        for (name, value) in &self.values {
            let merged = match values.get(name) {
                Some(class_value) if name == "size" => {
                    let rest = class_value
                        .split_ascii_whitespace()
                        .skip(value.split_ascii_whitespace().count());
                    let all = value.split_ascii_whitespace().chain(rest);
                    all.collect::<Vec<_>>().join(" ")
                }
                _ => value.clone(),
            };
            values.insert(name.clone(), merged);
        }
        Ok(Attributes {
            element: self.element.clone(),
            values,
        })
    }

    /// Appends a suffix to the name, if there is one.
    pub(super) fn add_to_name(&mut self, suffix: &str) {
        if let Some(name) = self.values.get_mut("name") {
            name.push_str(suffix);
        }
    }

    /// Returns the value of an attribute, which may be empty.
    pub(super) fn get(&self, name: &str) -> Option<&str> {
        self.values.get(name).map(String::as_str)
    }

    /// Returns the name in an attribute; `None` if it is absent or empty.
    pub(super) fn name(&self, attribute: &str) -> Option<&str> {
        self.get(attribute).filter(|name| !name.is_empty())
    }

    /// Returns the name in an attribute, which must not be absent or empty.
    pub(super) fn required_name(&self, attribute: &str) -> Result<&str, MjcfError> {
        self.name(attribute).ok_or_else(|| self.invalid(attribute))
    }

    /// Parses an attribute as a list of numbers; `None` if it is absent.
    pub(super) fn numbers(&self, name: &str) -> Result<Option<Vec<f64>>, MjcfError> {
        let Some(text) = self.get(name) else {
            return Ok(None);
        };
        let numbers = text
            .split_ascii_whitespace()
            .map(|number| number.parse::<f64>().ok());
        let finite = numbers.map(|number| number.filter(|number| number.is_finite()));
        let numbers: Option<Vec<f64>> = finite.collect();
        numbers.map(Some).ok_or_else(|| self.invalid(name))
    }

    /// Parses an attribute as a fixed number of numbers; `None` if it is absent.
    pub(super) fn array<const COUNT: usize>(
        &self,
        name: &str,
    ) -> Result<Option<[f64; COUNT]>, MjcfError> {
        let Some(numbers) = self.numbers(name)? else {
            return Ok(None);
        };
        let array = numbers.try_into().map_err(|_| self.invalid(name))?;
        Ok(Some(array))
    }

    /// Normalises a vector. The error names the attribute that it comes from.
    pub(super) fn direction(&self, name: &str, vector: DVec3) -> Result<DVec3, MjcfError> {
        let has_direction = |_: &DVec3| ACCEPTED_LENGTHS.contains(&vector.length());
        let direction = unit(vector).filter(has_direction);
        direction.ok_or_else(|| self.invalid(name))
    }

    /// Parses an attribute as a quaternion; `None` if it is absent.
    pub(super) fn quaternion(&self, name: &str) -> Result<Option<DQuat>, MjcfError> {
        let Some([w, x, y, z]) = self.array(name)? else {
            return Ok(None);
        };
        let quaternion = DQuat::from_xyzw(x, y, z, w);
        if !ACCEPTED_LENGTHS.contains(&quaternion.length()) {
            return Err(self.invalid(name));
        }
        Ok(Some(quaternion))
    }

    /// Parses an attribute as an integer. Returns `default` if it is absent.
    pub(super) fn integer_or(&self, name: &str, default: i32) -> Result<i32, MjcfError> {
        match self.get(name) {
            Some(text) => text.trim_ascii().parse().map_err(|_| self.invalid(name)),
            None => Ok(default),
        }
    }

    /// Parses an attribute as a boolean. Returns `default` if it is absent.
    pub(super) fn truth_or(&self, name: &str, default: bool) -> Result<bool, MjcfError> {
        match self.get(name) {
            Some("true") => Ok(true),
            Some("false") => Ok(false),
            None => Ok(default),
            Some(_) => Err(self.invalid(name)),
        }
    }

    /// Iterates over the names of the attributes.
    pub(super) fn names(&self) -> impl Iterator<Item = &str> {
        self.values.keys().map(String::as_str)
    }

    /// Returns the element's kind and name for messages.
    pub(super) fn label(&self) -> String {
        match self.name("name") {
            Some(name) => format!("{} {name}", self.element),
            None => self.element.clone(),
        }
    }

    /// Creates the error for an unknown attribute.
    pub(super) fn unknown(&self, name: &str) -> MjcfError {
        MjcfError::UnknownAttribute {
            element: self.label(),
            attribute: name.to_owned(),
        }
    }

    /// Creates the error for an attribute with an invalid value.
    pub(super) fn invalid(&self, name: &str) -> MjcfError {
        MjcfError::InvalidAttribute {
            element: self.label(),
            attribute: name.to_owned(),
            value: self.values.get(name).cloned().unwrap_or_default(),
        }
    }
}
