//! Reads one model file of a 3MF: its objects and build items.

use super::transform;
use super::xml::{Element, XmlEvent, XmlReader};
use crate::mesh::affine::AffineMap;
use crate::mesh::error::{MeshFault, Quote, element_name};
use crate::mesh::polygons::Polygons;
use crate::mesh::remark::Remarks;
use crate::mesh::unit::Unit;
use ccd_core::glam::DVec3;
use std::collections::{BTreeMap, BTreeSet};
use std::io::BufRead;
use std::str::FromStr;

/// The content of a model file.
#[derive(Debug, Default)]
pub(super) struct Model {
    /// The path of the model in its package.
    pub(super) path: String,
    pub(super) unit: Option<Unit>,
    pub(super) objects: Vec<ModelObject>,
    pub(super) items: Vec<ObjectRef>,
    pub(super) remarks: Remarks,
}

#[derive(Debug)]
pub(super) struct ModelObject {
    pub(super) id: u32,
    /// The object's name or, without a name, its part number.
    pub(super) name: Option<String>,
    /// The triangles of a mesh.
    pub(super) mesh: Polygons,
    pub(super) components: Vec<ObjectRef>,
    /// The name of the element that defines the shape, if it is neither a mesh nor components.
    pub(super) foreign_element: Option<String>,
}

/// A reference from a component or build item to an object.
#[derive(Debug)]
pub(super) struct ObjectRef {
    pub(super) object: u32,
    pub(super) map: AffineMap,
    /// The path of the model that has the object; `None` for the same model.
    pub(super) path: Option<String>,
    pub(super) part_number: Option<String>,
}

/// The suffixes of the namespaces of extensions that do not change shapes.
const HARMLESS: [&str; 4] = [
    "/production/2015/06",
    "/material/2015/02",
    "/slice/2015/07",
    "/trianglesets/2021/07",
];

/// The elements that the reader handles. All others are skipped with their content.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Tag {
    Model,
    Resources,
    Object,
    Mesh,
    Vertices,
    Triangles,
    Components,
    Build,
    Other,
}

/// Reads a model from an XML reader.
pub(super) fn read<R: BufRead>(xml: &mut XmlReader<R>) -> Result<Model, MeshFault> {
    let mut model = Model::default();
    let mut open: Vec<Tag> = Vec::new();
    loop {
        match xml.next()? {
            XmlEvent::Start(element) => {
                let within = open.last().copied();
                let tag = model.start_element(within, &element);
                open.push(tag.map_err(|fault| model.at(&open, fault))?);
            }
            XmlEvent::End => {
                if open.last() == Some(&Tag::Mesh) {
                    let checked = model.check_mesh();
                    checked.map_err(|fault| model.at(&open, fault))?;
                }
                open.pop();
            }
            XmlEvent::TextOrComment => {}
            XmlEvent::Done => return Ok(model),
        }
    }
}

/// Returns the name of an object for messages.
pub(super) fn object_name(path: Option<&str>, id: u32, name: Option<&str>) -> String {
    let path = path.map_or_else(String::new, |path| format!("{:?}: ", Quote(path)));
    path + &element_name("object", id, name)
}

impl Model {
    /// Returns the paths of the other models that this model refers to.
    pub(super) fn referenced_models(&self) -> BTreeSet<String> {
        let components = self.objects.iter().flat_map(|object| &object.components);
        let uses = components.chain(&self.items);
        uses.filter_map(|used| used.path.clone()).collect()
    }

    /// Adds the name of the object that is being read to a fault.
    fn at(&self, open: &[Tag], fault: MeshFault) -> MeshFault {
        match self.objects.last() {
            Some(object) if open.get(2) == Some(&Tag::Object) => {
                fault.at(object_name(None, object.id, object.name.as_deref()))
            }
            _ => fault,
        }
    }

    /// Processes the start of an element inside the element `within`.
    fn start_element(
        &mut self,
        within: Option<Tag>,
        element: &Element<'_>,
    ) -> Result<Tag, MeshFault> {
        if element.is_extension {
            return Ok(self.start_extension_element(within, element.name()));
        }
        match (within, element.name()) {
            (None, "model") => self.start_model(element).map(|()| Tag::Model),
            (None, _) => Err(MeshFault::malformed_content(format!(
                "begins with {:?} instead of a model",
                Quote(element.name())
            ))),
            (Some(Tag::Model), "resources") => Ok(Tag::Resources),
            (Some(Tag::Model), "build") => Ok(Tag::Build),
            (Some(Tag::Build), "item") => self.add_item(element),
            (Some(Tag::Resources), "object") => self.add_object(element),
            (Some(Tag::Object), name) => self.start_shape(name),
            (Some(Tag::Mesh), "vertices") => Ok(Tag::Vertices),
            (Some(Tag::Mesh), "triangles") => Ok(Tag::Triangles),
            (Some(Tag::Vertices), "vertex") => self.add_vertex(element),
            (Some(Tag::Triangles), "triangle") => self.add_triangle(element),
            (Some(Tag::Components), "component") => self.add_component(element),
            // Some files omit the namespaces of extensions.
            (within, name) => Ok(self.start_extension_element(within, name)),
        }
    }

    fn start_model(&mut self, element: &Element<'_>) -> Result<(), MeshFault> {
        let [unit, required] = element.attribute_values(["unit", "requiredextensions"])?;
        self.unit = unit.map(|unit| parse_unit(&unit)).transpose()?;
        let mut namespaces = BTreeMap::new();
        element.for_each_attribute(|prefix, name, value| {
            if prefix == Some("xmlns") {
                namespaces.insert(name.to_owned(), value.into_owned());
            }
        })?;
        for prefix in required.unwrap_or_default().split_whitespace() {
            let namespace = namespaces.get(prefix).map_or(prefix, String::as_str);
            if !HARMLESS.iter().any(|end| namespace.ends_with(end)) {
                return Err(MeshFault::unsupported(
                    format!("what the extension {:?} says", Quote(namespace)),
                    "3MF without this extension",
                ));
            }
        }
        Ok(())
    }

    fn add_object(&mut self, element: &Element<'_>) -> Result<Tag, MeshFault> {
        let [id, name, part_number] = element.attribute_values(["id", "name", "partnumber"])?;
        let id = parse_number(id.as_deref(), "an object", "id")?;
        let given = |name: &str| !name.is_empty();
        let name = name.filter(|name| given(name)).or(part_number);
        self.objects.push(ModelObject {
            id,
            name: name.filter(|name| given(name)).map(Into::into),
            mesh: Polygons::default(),
            components: Vec::new(),
            foreign_element: Some("nothing".into()),
        });
        Ok(Tag::Object)
    }

    /// Processes the element that defines an object's shape.
    fn start_shape(&mut self, name: &str) -> Result<Tag, MeshFault> {
        let tag = match name {
            "mesh" => Tag::Mesh,
            "components" => Tag::Components,
            "metadatagroup" => return Ok(Tag::Other),
            other => return Ok(self.start_extension_element(Some(Tag::Object), other)),
        };
        if let Some(object) = self.objects.last_mut()
            && object.foreign_element.take().is_none()
        {
            return Err(MeshFault::malformed_content(
                "has two shapes; an object has one",
            ));
        }
        Ok(tag)
    }

    /// Processes an element of an extension, which may be an object's shape or the beam lattice of a mesh. Other
    /// elements are skipped, with a remark if they are inside a mesh.
    fn start_extension_element(&mut self, within: Option<Tag>, name: &str) -> Tag {
        let of_shape = matches!(within, Some(Tag::Mesh | Tag::Vertices | Tag::Triangles));
        if of_shape && name != "trianglesets" {
            self.remarks.add_named("elements", name, 1, None);
        }
        if let Some(ModelObject {
            foreign_element: foreign,
            ..
        }) = self.objects.last_mut()
        {
            let is_shape = within == Some(Tag::Object) && foreign.is_some();
            if is_shape || within == Some(Tag::Mesh) && name == "beamlattice" {
                *foreign = Some(name.into());
            }
        }
        Tag::Other
    }

    fn add_vertex(&mut self, element: &Element<'_>) -> Result<Tag, MeshFault> {
        if let Some(ModelObject { mesh, .. }) = self.objects.last_mut() {
            let vertex = mesh.vertices.len();
            let values = element.attribute_values(["x", "y", "z"])?;
            let mut point = DVec3::ZERO;
            for (axis, value) in values.iter().enumerate() {
                let name = ["x", "y", "z"][axis];
                point[axis] =
                    parse_number(value.as_deref(), &format_args!("vertex {vertex}"), name)?;
            }
            if !point.is_finite() {
                return Err(MeshFault::NotFinite { vertex, line: None });
            }
            mesh.vertices.push(point);
        }
        Ok(Tag::Other)
    }

    fn add_triangle(&mut self, element: &Element<'_>) -> Result<Tag, MeshFault> {
        if let Some(ModelObject { mesh, .. }) = self.objects.last_mut() {
            let face = mesh.ends.len();
            let values = element.attribute_values(["v1", "v2", "v3"])?;
            for (value, name) in values.iter().zip(["v1", "v2", "v3"]) {
                let what = format_args!("triangle {face}");
                let corner: u32 = parse_number(value.as_deref(), &what, name)?;
                mesh.corners.push(corner.into());
            }
            mesh.ends.push(mesh.corners.len());
        }
        Ok(Tag::Other)
    }

    /// Checks the triangle indices of a complete mesh, because triangles may precede vertices.
    fn check_mesh(&self) -> Result<(), MeshFault> {
        match self.objects.last() {
            Some(ModelObject {
                mesh,
                foreign_element: foreign,
                ..
            }) if foreign.is_none() => mesh.check_corners(),
            _ => Ok(()),
        }
    }

    fn add_component(&mut self, element: &Element<'_>) -> Result<Tag, MeshFault> {
        let used = ObjectRef::read(element, "a component")?;
        if let Some(ModelObject { components, .. }) = self.objects.last_mut() {
            components.push(used);
        }
        Ok(Tag::Other)
    }

    fn add_item(&mut self, element: &Element<'_>) -> Result<Tag, MeshFault> {
        self.items.push(ObjectRef::read(element, "an item")?);
        Ok(Tag::Other)
    }
}

impl ObjectRef {
    fn read(element: &Element<'_>, what: &str) -> Result<Self, MeshFault> {
        let names = ["objectid", "transform", ":path", "partnumber"];
        let [object, transform, path, part_number] = element.attribute_values(names)?;
        let map = transform.map(|transform| transform::parse(&transform));
        Ok(ObjectRef {
            object: parse_number(object.as_deref(), what, "objectid")?,
            map: map.transpose()?.unwrap_or(AffineMap::IDENTITY),
            path: path.map(Into::into),
            part_number: part_number.map(Into::into),
        })
    }
}

fn parse_unit(name: &str) -> Result<Unit, MeshFault> {
    let mut units = Unit::ALL.into_iter();
    units
        .find(|unit| unit.name_in_3mf() == name)
        .ok_or_else(|| {
            let name = Quote(name);
            MeshFault::malformed_content(format!("is in the unit {name:?}, which there is not"))
        })
}

/// Parses a number from the text of an attribute.
fn parse_number<T: FromStr>(
    value: Option<&str>,
    what: &(impl std::fmt::Display + ?Sized),
    name: &str,
) -> Result<T, MeshFault> {
    let Some(value) = value else {
        return Err(MeshFault::malformed_content(format!(
            "{what} has no {name}"
        )));
    };
    value.trim().parse().map_err(|_| {
        MeshFault::malformed_content(format!(
            "{what} has {:?} instead of a number as its {name}",
            Quote(value)
        ))
    })
}
