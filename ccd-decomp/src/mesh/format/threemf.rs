//! The reader of 3MF: models in XML, packed in a zip archive.
//!
//! The crates for 3MF are not used: none limits the unpacked size, and `threemf` does not distinguish the models of a
//! package.

mod model;
mod package;
mod transform;
mod xml;

use crate::mesh::content::allowance::ExpansionBudget;
use crate::mesh::content::assembly::{Assembly, Object, Part, PlacedObject};
use crate::mesh::content::{Content, Layout};
use crate::mesh::error::{MeshFault, Quote};
use crate::mesh::remark::Remarks;
use crate::mesh::unit::Unit;
use model::{Model, ModelObject, ObjectRef};
use package::Package;
use std::collections::BTreeMap;

/// Reads a 3MF package as an assembly of parts.
pub(super) fn parse(bytes: &[u8]) -> Result<Content, MeshFault> {
    if bytes.is_empty() {
        return Err(MeshFault::NoVertices);
    }
    let mut models = Models::read(Package::open(bytes)?)?;
    let unit = models.common_unit()?;
    let parts = models.parts()?;
    let objects = models.assembly_objects()?;
    let unused = models.check_used_objects(&objects, &parts)?;
    let mut remarks = Remarks::default();
    for model in &models.list {
        remarks.append(&model.remarks);
    }
    let what = "objects that the build does not place passed over";
    remarks.add(what, unused, None);
    let allowance = ExpansionBudget::for_file(models.package.unpacked_bytes() + bytes.len() as u64);
    let assembly = Assembly::new(objects, parts, allowance).map_err(|circle| {
        MeshFault::malformed_content("is a component of itself")
            .at(models.object_name(circle.object))
    })?;
    Ok(Content {
        unit: Some(unit),
        layout: Layout::Assembly(assembly),
        remarks,
    })
}

/// The models of a package: the root model first, then the models that it refers to.
struct Models<'a> {
    package: Package<'a>,
    list: Vec<Model>,
    /// The number of each model in the package, by its path.
    numbers: BTreeMap<String, usize>,
    /// The objects of all models, each with the number of its model.
    objects: Vec<(usize, ModelObject)>,
    /// The number of each object, by model number and object id in that model.
    object_numbers: BTreeMap<(usize, u32), usize>,
}

impl<'a> Models<'a> {
    /// Reads the root model and all models that it refers to.
    fn read(mut package: Package<'a>) -> Result<Self, MeshFault> {
        let first = package.root_model_path()?;
        let mut models = Models {
            package,
            list: Vec::new(),
            numbers: BTreeMap::new(),
            objects: Vec::new(),
            object_numbers: BTreeMap::new(),
        };
        models.read_model(&first)?;
        let mut next = 0;
        while let Some(model) = models.list.get(next) {
            for path in model.referenced_models() {
                models.read_model(&path)?;
            }
            next += 1;
        }
        models.number_objects()?;
        Ok(models)
    }

    /// Reads the model at a path, unless it was read before.
    fn read_model(&mut self, path: &str) -> Result<(), MeshFault> {
        let key = package::normalized_path(path);
        if !self.numbers.contains_key(&key) {
            let model = self.package.model(path);
            let model = model.map_err(|fault| fault.at(format!("{:?}", Quote(path))))?;
            self.numbers.insert(key, self.list.len());
            let path = path.into();
            self.list.push(Model { path, ..model });
        }
        Ok(())
    }

    fn number_objects(&mut self) -> Result<(), MeshFault> {
        for (number, model) in self.list.iter_mut().enumerate() {
            for object in model.objects.drain(..) {
                let key = (number, object.id);
                if self
                    .object_numbers
                    .insert(key, self.objects.len())
                    .is_some()
                {
                    let problem = format!("has two objects {}", object.id);
                    let place = format!("{:?}", Quote(&model.path));
                    return Err(MeshFault::malformed_content(problem).at(place));
                }
                self.objects.push((number, object));
            }
        }
        Ok(())
    }

    /// Returns the unit of the first model, and checks that it is that of all models.
    fn common_unit(&self) -> Result<Unit, MeshFault> {
        let unit = self.list[0].unit.unwrap_or(Unit::Millimetre);
        let differs = |model: &&Model| model.unit.is_some_and(|other| other != unit);
        match self.list.iter().find(differs) {
            None => Ok(unit),
            Some(Model { path, .. }) => Err(MeshFault::unsupported(
                format!("the model {:?} in another unit than {unit}", Quote(path)),
                "models in one unit",
            )),
        }
    }

    /// Returns the parts of the assembly: the build items of the root model.
    fn parts(&self) -> Result<Vec<Part>, MeshFault> {
        let items = &self.list[0].items;
        if items.is_empty() {
            return Err(MeshFault::malformed_content(
                "has no items in its build: nothing of it is to be made",
            ));
        }
        let part = |(k, item): (usize, &ObjectRef)| {
            let placed = self.placed(0, item);
            let placed = placed.map_err(|fault| fault.at(format!("item {k} of the build")))?;
            let own = self.objects[placed.object].1.name.clone();
            let name = own.or(item.part_number.clone());
            Ok(Part { name, placed })
        };
        items.iter().enumerate().map(part).collect()
    }

    /// Returns what a build item or component of the model `from` places.
    fn placed(&self, from: usize, used: &ObjectRef) -> Result<PlacedObject, MeshFault> {
        let model = match &used.path {
            None => Some(&from),
            Some(path) => self.numbers.get(&package::normalized_path(path)),
        };
        let object = model.and_then(|&model| self.object_numbers.get(&(model, used.object)));
        let map = used.map;
        match object {
            Some(&object) => Ok(PlacedObject { object, map }),
            None => Err(MeshFault::malformed_content(format!(
                "names object {}, which there is not",
                used.object
            ))),
        }
    }

    /// Returns all objects of the assembly, with the meshes moved out of the models.
    fn assembly_objects(&mut self) -> Result<Vec<Object>, MeshFault> {
        let mut objects = Vec::with_capacity(self.objects.len());
        for number in 0..self.objects.len() {
            let members = self.members(number)?;
            let shape = std::mem::take(&mut self.objects[number].1.mesh);
            objects.push(Object { shape, members });
        }
        Ok(objects)
    }

    fn members(&self, number: usize) -> Result<Vec<PlacedObject>, MeshFault> {
        let (model, object) = &self.objects[number];
        let member = |(k, component): (usize, &ObjectRef)| {
            let place = || format!("{}, component {k}", self.object_name(number));
            let placed = self.placed(*model, component);
            placed.map_err(|fault| fault.at(place()))
        };
        object.components.iter().enumerate().map(member).collect()
    }

    /// Checks that all used objects are triangle meshes. Returns the number of unused objects.
    fn check_used_objects(&self, objects: &[Object], parts: &[Part]) -> Result<usize, MeshFault> {
        let mut seen = vec![false; objects.len()];
        let mut waiting: Vec<usize> = parts.iter().map(|part| part.placed.object).collect();
        while let Some(number) = waiting.pop() {
            if std::mem::replace(&mut seen[number], true) {
                continue;
            }
            if let Some(what) = &self.objects[number].1.foreign_element {
                let fault = MeshFault::unsupported(
                    format!("a shape of another kind, {:?}", Quote(what)),
                    "a mesh of triangles",
                );
                return Err(fault.at(self.object_name(number)));
            }
            waiting.extend(objects[number].members.iter().map(|member| member.object));
        }
        Ok(seen.iter().filter(|seen| !**seen).count())
    }

    /// Returns the name of an object of the assembly for messages.
    fn object_name(&self, number: usize) -> String {
        let (model, object) = &self.objects[number];
        let path = &self.list[*model].path;
        model::object_name(Some(path), object.id, object.name.as_deref())
    }
}

#[cfg(test)]
mod tests;
