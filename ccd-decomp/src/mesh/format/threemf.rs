//! The reader of 3MF: models in XML, packed in a zip archive.
//!
//! The crates for 3MF are not used: none limits the unpacked size, and `threemf` does not distinguish the models of a
//! package.

mod model;
mod package;
mod transform;
mod xml;

use crate::mesh::affine::AffineMap;
use crate::mesh::content::allowance::Allowance;
use crate::mesh::content::assembly::{Assembly, Object, Part, PlacedObject};
use crate::mesh::content::{Content, Layout};
use crate::mesh::error::{MeshFault, Quote};
use crate::mesh::polygons::Polygons;
use crate::mesh::remark::Remarks;
use crate::mesh::unit::Unit;
use model::{Model, ObjectRef, Shape};
use package::Package;
use std::collections::BTreeMap;

/// Reads a 3MF package as an assembly of parts.
pub(super) fn parse(bytes: &[u8]) -> Result<Content, MeshFault> {
    if bytes.is_empty() {
        return Err(MeshFault::NoVertices);
    }
    let mut models = Models::read(Package::open(bytes)?)?;
    let unit = models.list[0].model.unit.unwrap_or(Unit::Millimetre);
    let parts = models.parts()?;
    let objects = models.objects()?;
    let unused = models.check_used(&objects, &parts)?;
    let mut remarks = Remarks::default();
    for Named { model, .. } in &models.list {
        remarks.append(&model.remarks);
    }
    if unused > 0 {
        remarks.add(
            "objects that the build does not place passed over",
            unused,
            None,
        );
    }
    let allowance = Allowance::for_file(models.package.unpacked() + bytes.len() as u64);
    let assembly = Assembly::new(objects, parts, allowance).map_err(|circle| {
        let problem = "is a component of itself".into();
        MeshFault::syntax(None, problem).at(models.place(circle.object))
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
    list: Vec<Named>,
    /// The number of each model in the package, by its path.
    numbers: BTreeMap<String, usize>,
    /// The assembly's object number, by model number and object id in that model.
    known: BTreeMap<(usize, u32), usize>,
    /// The model number and the index there of each object of the assembly.
    places: Vec<(usize, usize)>,
}

struct Named {
    path: String,
    model: Model,
}

impl<'a> Models<'a> {
    /// Reads the root model and all models that it refers to.
    fn read(mut package: Package<'a>) -> Result<Self, MeshFault> {
        let first = package.root_model_path()?;
        let mut models = Models {
            package,
            list: Vec::new(),
            numbers: BTreeMap::new(),
            known: BTreeMap::new(),
            places: Vec::new(),
        };
        models.model_number(&first)?;
        let mut next = 0;
        while let Some(Named { model, .. }) = models.list.get(next) {
            for path in model.paths() {
                models.model_number(&path)?;
            }
            next += 1;
        }
        models.number_objects()?;
        models.check_units()?;
        Ok(models)
    }

    /// Returns the number of the model at a path, and reads the model on the first call.
    fn model_number(&mut self, path: &str) -> Result<usize, MeshFault> {
        let key = package::normalized_path(path);
        if let Some(&number) = self.numbers.get(&key) {
            return Ok(number);
        }
        let model = self.package.model(path);
        let model = model.map_err(|fault| fault.at(format!("{:?}", Quote(path))))?;
        self.numbers.insert(key, self.list.len());
        let path = path.into();
        self.list.push(Named { path, model });
        Ok(self.list.len() - 1)
    }

    fn number_objects(&mut self) -> Result<(), MeshFault> {
        for (number, Named { path, model }) in self.list.iter().enumerate() {
            for (k, object) in model.objects.iter().enumerate() {
                let new = self.known.insert((number, object.id), self.places.len());
                if new.is_some() {
                    let problem = format!("has two objects {}", object.id);
                    return Err(MeshFault::syntax(None, problem).at(format!("{:?}", Quote(path))));
                }
                self.places.push((number, k));
            }
        }
        Ok(())
    }

    /// Checks that all models are in the unit of the first one.
    fn check_units(&self) -> Result<(), MeshFault> {
        let unit = self.list[0].model.unit.unwrap_or(Unit::Millimetre);
        let differs = |named: &&Named| named.model.unit.is_some_and(|other| other != unit);
        match self.list.iter().find(differs) {
            None => Ok(()),
            Some(Named { path, .. }) => Err(MeshFault::Unsupported {
                what: format!("the model {:?} in another unit than {unit}", Quote(path)),
                instead: "models in one unit",
            }),
        }
    }

    /// Returns the parts of the assembly: the build items of the root model.
    fn parts(&self) -> Result<Vec<Part>, MeshFault> {
        let items = &self.list[0].model.items;
        if items.is_empty() {
            let problem = "has no items in its build: nothing of it is to be made".into();
            return Err(MeshFault::syntax(None, problem));
        }
        let part = |(k, item): (usize, &ObjectRef)| {
            let found = self.find_object(0, item);
            let object = found.map_err(|fault| fault.at(format!("item {k} of the build")))?;
            let placed = PlacedObject {
                object,
                map: item.map,
            };
            let (model, place) = self.places[object];
            let own = self.list[model].model.objects[place].name.clone();
            let name = own.or(item.part_number.clone());
            Ok(Part { name, placed })
        };
        items.iter().enumerate().map(part).collect()
    }

    /// Returns the object number that a build item or component of the model `from` refers to.
    fn find_object(&self, from: usize, used: &ObjectRef) -> Result<usize, MeshFault> {
        let model = match &used.path {
            None => Some(&from),
            Some(path) => self.numbers.get(&package::normalized_path(path)),
        };
        let object = model.and_then(|&model| self.known.get(&(model, used.object)));
        object.copied().ok_or_else(|| {
            let problem = format!("names object {}, which there is not", used.object);
            MeshFault::syntax(None, problem)
        })
    }

    /// Returns all objects of the assembly, with the shapes moved out of the models.
    fn objects(&mut self) -> Result<Vec<Object>, MeshFault> {
        let mut objects = Vec::with_capacity(self.places.len());
        for number in 0..self.places.len() {
            let (model, place) = self.places[number];
            let shape = &mut self.list[model].model.objects[place].shape;
            let object = match shape {
                Shape::Mesh(polygons) => Object {
                    shape: std::mem::take(polygons),
                    members: Vec::new(),
                },
                Shape::Components(_) => Object {
                    shape: Polygons::default(),
                    members: self.members(number)?,
                },
                Shape::Foreign(_) => Object::default(),
            };
            objects.push(object);
        }
        Ok(objects)
    }

    fn members(&self, number: usize) -> Result<Vec<PlacedObject>, MeshFault> {
        let (model, place) = self.places[number];
        let Shape::Components(components) = &self.list[model].model.objects[place].shape else {
            return Ok(Vec::new());
        };
        let member = |(k, component): (usize, &ObjectRef)| {
            let found = self.find_object(model, component);
            let at = |fault: MeshFault| fault.at(format!("{}, component {k}", self.place(number)));
            let map: AffineMap = component.map;
            Ok(PlacedObject {
                object: found.map_err(at)?,
                map,
            })
        };
        components.iter().enumerate().map(member).collect()
    }

    /// Checks that all used objects are triangle meshes. Returns the number of unused objects.
    fn check_used(&self, objects: &[Object], parts: &[Part]) -> Result<usize, MeshFault> {
        let mut seen = vec![false; objects.len()];
        let mut waiting: Vec<usize> = parts.iter().map(|part| part.placed.object).collect();
        while let Some(number) = waiting.pop() {
            if std::mem::replace(&mut seen[number], true) {
                continue;
            }
            let (model, place) = self.places[number];
            if let Shape::Foreign(what) = &self.list[model].model.objects[place].shape {
                let fault = MeshFault::Unsupported {
                    what: format!("a shape of another kind, {:?}", Quote(what)),
                    instead: "a mesh of triangles",
                };
                return Err(fault.at(self.place(number)));
            }
            waiting.extend(objects[number].members.iter().map(|member| member.object));
        }
        Ok(seen.iter().filter(|seen| !**seen).count())
    }

    /// Returns the name of an object of the assembly for messages.
    fn place(&self, number: usize) -> String {
        let (model, place) = self.places[number];
        let Named { path, model } = &self.list[model];
        let object = &model.objects[place];
        model::place(Some(path), object.id, object.name.as_deref())
    }
}

#[cfg(test)]
mod tests;
