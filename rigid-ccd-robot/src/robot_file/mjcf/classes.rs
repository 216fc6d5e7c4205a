//! The default classes of an MJCF, from which elements inherit attributes.

use super::attributes::Attributes;
use super::document::Element;
use crate::robot_file::mjcf_error::MjcfError;
use std::collections::BTreeMap;

/// The name of the outermost class, which applies to elements without a class.
const MAIN: &str = "main";

/// The attributes of one class, by element kind.
type ClassAttributes = BTreeMap<String, Attributes>;

/// The classes of a model by name, with inherited attributes merged in.
pub(super) struct Classes(BTreeMap<String, ClassAttributes>);

impl Classes {
    /// Reads the `default` sections of a model.
    pub(super) fn read(root: &Element) -> Result<Self, MjcfError> {
        let mut classes = Classes(BTreeMap::from([(MAIN.to_owned(), ClassAttributes::new())]));
        let mut name_of_main = None;
        for section in root
            .children
            .iter()
            .filter(|section| section.name == "default")
        {
            // The outermost class applies to all elements. All sections must give it the same name.
            let name = section.attributes.name("class").unwrap_or(MAIN);
            if *name_of_main.get_or_insert(name) != name {
                return Err(section.attributes.invalid("class"));
            }
            let inherited = classes.0[MAIN].clone();
            let main = classes.add(section, &inherited, name)?;
            classes.0.insert(MAIN.to_owned(), main);
        }
        Ok(classes)
    }

    /// Adds a class and its nested classes. Returns its attributes.
    fn add(
        &mut self,
        class: &Element,
        inherited: &ClassAttributes,
        name: &str,
    ) -> Result<ClassAttributes, MjcfError> {
        let mut attributes = inherited.clone();
        for element in class
            .children
            .iter()
            .filter(|element| element.name != "default")
        {
            let merged = match attributes.get(&element.name) {
                Some(class_attributes) => element.attributes.over(class_attributes)?,
                None => element.attributes.clone(),
            };
            attributes.insert(element.name.clone(), merged);
        }
        self.0.insert(name.to_owned(), attributes.clone());
        for inner in class
            .children
            .iter()
            .filter(|element| element.name == "default")
        {
            let name = inner.attributes.required_name("class")?;
            if self.0.contains_key(name) {
                return Err(MjcfError::repeated_name("class", name));
            }
            self.add(inner, &attributes, name)?;
        }
        Ok(attributes)
    }

    /// Checks that a class exists.
    pub(super) fn check(&self, name: &str) -> Result<(), MjcfError> {
        self.attributes_of(name).map(|_| ())
    }

    fn attributes_of(&self, name: &str) -> Result<&ClassAttributes, MjcfError> {
        let class = self.0.get(name);
        class.ok_or_else(|| MjcfError::unknown_name("class", name))
    }

    /// Returns the attributes of an element merged with the attributes of its class. An element without a class has the
    /// default class of its body.
    pub(super) fn merged(
        &self,
        element: &Element,
        body_class: Option<&str>,
    ) -> Result<Attributes, MjcfError> {
        self.merged_as(&element.name, element, body_class)
    }

    /// Returns the merged attributes of an element that classes list under another name, like [`Classes::merged`].
    pub(super) fn merged_as(
        &self,
        name: &str,
        element: &Element,
        body_class: Option<&str>,
    ) -> Result<Attributes, MjcfError> {
        let class = element
            .attributes
            .get("class")
            .or(body_class)
            .unwrap_or(MAIN);
        match self.attributes_of(class)?.get(name) {
            Some(class_attributes) => element.attributes.over(class_attributes),
            None => Ok(element.attributes.clone()),
        }
    }
}
