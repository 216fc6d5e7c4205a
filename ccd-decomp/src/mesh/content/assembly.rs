//! Assemblies: scenes in which shapes are placed as parts.

use super::allowance::{ExpansionBudget, expansion_cost};
use crate::mesh::affine::AffineMap;
use crate::mesh::error::MeshFault;
use crate::mesh::polygons::Polygons;
use std::ops::Range;

/// A list of objects, and the parts of a scene that place them.
///
/// # Guarantee
/// No object is a member of itself, directly or not. Every number names an object. Every part has a face.
#[derive(Debug)]
pub(crate) struct Assembly {
    objects: Vec<Object>,
    pub(crate) parts: Vec<Part>,
    /// By object, the cost of its expansion with all members.
    expansion_costs: Vec<u64>,
    allowance: ExpansionBudget,
}

/// An object: a shape of its own, and members, which are other objects at given transforms.
#[derive(Debug, Default)]
pub(crate) struct Object {
    /// The object's own triangles, possibly none; their corners index the vertices of this shape.
    pub(crate) shape: Polygons,
    pub(crate) members: Vec<PlacedObject>,
}

/// A reference to an object, with the transform that places it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PlacedObject {
    pub(crate) object: usize,
    pub(crate) map: AffineMap,
}

/// A part of the scene, which places one object.
#[derive(Debug)]
pub(crate) struct Part {
    pub(crate) name: Option<String>,
    pub(crate) placed: PlacedObject,
}

/// The error for an object that contains itself, directly or through its members.
pub(crate) struct Cycle {
    pub(crate) object: usize,
}

impl Assembly {
    /// Creates an assembly from objects and parts. Parts without faces are omitted.
    pub(crate) fn new(
        objects: Vec<Object>,
        mut parts: Vec<Part>,
        allowance: ExpansionBudget,
    ) -> Result<Self, Cycle> {
        let order = topological_order(&objects)?;
        let (mut sizes, mut has_faces) = (vec![0_u64; objects.len()], vec![false; objects.len()]);
        for k in order {
            let Object { shape, members } = &objects[k];
            let own = 1 + expansion_cost(shape.vertices.len() as u64, shape.corners.len() as u64);
            let within = members.iter().map(|member| sizes[member.object]);
            sizes[k] = within.fold(own, u64::saturating_add);
            let mut below = members.iter().map(|member| has_faces[member.object]);
            has_faces[k] = !shape.ends.is_empty() || below.any(|has| has);
        }
        parts.retain(|part| has_faces[part.placed.object]);
        Ok(Assembly {
            objects,
            parts,
            expansion_costs: sizes,
            allowance,
        })
    }

    /// Returns the triangles of some parts, one part after the other.
    pub(super) fn expand(&self, parts: Range<usize>) -> Result<Polygons, MeshFault> {
        self.check_expansion_cost(parts.clone())?;
        let mut all = Polygons::default();
        let parts = self.parts[parts].iter();
        let mut waiting: Vec<PlacedObject> = parts.rev().map(|part| part.placed).collect();
        while let Some(PlacedObject { object, map }) = waiting.pop() {
            let Object { shape, members } = &self.objects[object];
            append_image(&mut all, shape, &map);
            waiting.extend(members.iter().rev().map(|member| PlacedObject {
                object: member.object,
                map: map.compose_after(&member.map),
            }));
        }
        Ok(all)
    }

    /// Checks that the expansion of some parts does not exceed the allowance.
    pub(super) fn check_expansion_cost(&self, parts: Range<usize>) -> Result<(), MeshFault> {
        let mut allowance = self.allowance;
        let mut sizes = self.parts[parts]
            .iter()
            .map(|part| self.expansion_costs[part.placed.object]);
        sizes.try_for_each(|size| allowance.spend(size))
    }
}

/// Appends the image of a shape under an affine map. A mirroring map reverses the triangles, so that a solid stays
/// one.
fn append_image(all: &mut Polygons, shape: &Polygons, map: &AffineMap) {
    let first = all.vertices.len() as i64;
    let image = |&point| map.apply(point);
    all.vertices.extend(shape.vertices.iter().map(image));
    let mirrors = map.reverses_orientation();
    for triangle in shape.faces() {
        let start = all.corners.len();
        all.push_face(triangle.iter().map(|corner| first + corner));
        if mirrors {
            all.corners[start + 1..].reverse();
        }
    }
}

/// Sorts the objects so that each comes after its members. Returns an error if one contains itself.
fn topological_order(objects: &[Object]) -> Result<Vec<usize>, Cycle> {
    let mut order = Vec::with_capacity(objects.len());
    let (mut is_begun, mut is_done) = (vec![false; objects.len()], vec![false; objects.len()]);
    // An object waits twice: until it is begun, and below its members until they are done.
    let mut waiting: Vec<(usize, bool)> = (0..objects.len()).map(|k| (k, false)).collect();
    while let Some((object, ends)) = waiting.pop() {
        if ends {
            is_done[object] = true;
            order.push(object);
        } else if !std::mem::replace(&mut is_begun[object], true) {
            waiting.push((object, true));
            let members = objects[object].members.iter();
            waiting.extend(members.map(|member| (member.object, false)));
        } else if !is_done[object] {
            return Err(Cycle { object });
        }
    }
    Ok(order)
}

#[cfg(test)]
mod tests;
