//! The classes of attributes that elements inherit.

use super::attributes::Attributes;
use super::document::Element;
use crate::robot_file::mjcf_error::MjcfError;
use std::collections::BTreeMap;

/// The class of elements without one.
const MAIN: &str = "main";

/// The attributes of one class, by the names of elements.
type ClassAttributes = BTreeMap<String, Attributes>;

/// The classes of a model, each with what it inherits.
pub(super) struct Classes(BTreeMap<String, ClassAttributes>);

impl Classes {
    /// Reads the sections `default` of a model.
    pub(super) fn read(root: &Element) -> Result<Self, MjcfError> {
        let mut classes = Classes(BTreeMap::from([(MAIN.to_owned(), ClassAttributes::new())]));
        for section in root.children.iter().filter(|own| own.name == "default") {
            // The outermost class counts for all elements, whatever its name is.
            let inherited = classes.0[MAIN].clone();
            let main = classes.add(section, &inherited, MAIN)?;
            classes.0.insert(MAIN.to_owned(), main);
        }
        Ok(classes)
    }

    /// Adds a class and the classes within it, and returns its attributes.
    fn add(
        &mut self,
        class: &Element,
        inherited: &ClassAttributes,
        name: &str,
    ) -> Result<ClassAttributes, MjcfError> {
        let name = class.attributes.get("class").unwrap_or(name);
        let mut own = self.0.get(name).unwrap_or(inherited).clone();
        for element in class
            .children
            .iter()
            .filter(|element| element.name != "default")
        {
            let merged = match own.get(&element.name) {
                Some(of_class) => element.attributes.over(of_class)?,
                None => element.attributes.clone(),
            };
            own.insert(element.name.clone(), merged);
        }
        self.0.insert(name.to_owned(), own.clone());
        for inner in class
            .children
            .iter()
            .filter(|element| element.name == "default")
        {
            let name = inner.attributes.required("class")?.to_owned();
            self.add(inner, &own, &name)?;
        }
        Ok(own)
    }

    /// Returns the attributes of an element with those of its class: its own one, or else that of the body around it.
    pub(super) fn merged(
        &self,
        element: &Element,
        of_body: Option<&str>,
    ) -> Result<Attributes, MjcfError> {
        self.merged_as(&element.name, element, of_body)
    }

    /// Like [`Classes::merged`], for an element for which classes have another name.
    pub(super) fn merged_as(
        &self,
        name: &str,
        element: &Element,
        of_body: Option<&str>,
    ) -> Result<Attributes, MjcfError> {
        let class = element.attributes.get("class").or(of_body).unwrap_or(MAIN);
        let Some(class) = self.0.get(class) else {
            return Err(MjcfError::unknown_name("class", class));
        };
        match class.get(name) {
            Some(of_class) => element.attributes.over(of_class),
            None => Ok(element.attributes.clone()),
        }
    }
}
