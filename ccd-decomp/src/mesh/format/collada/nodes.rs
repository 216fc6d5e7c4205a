//! Traverses the nodes of a scene, and collects the parts that they place.

use super::{
    ElementsById, child_named, children_named, fault_at, geometry, referred_element, transform,
};
use crate::mesh::affine::AffineMap;
use crate::mesh::content::assembly::{Assembly, Part};
use crate::mesh::error::MeshFault;
use roxmltree::{Node, NodeId};
use std::collections::HashMap;

/// The greatest number of nodes, one below or in place of another. A node that is below itself has more.
const MAX_DEPTH: usize = 256;

/// The elements of nodes that place no shape, or that are transforms, which are read for themselves.
const HARMLESS_IN_NODES: [&str; 10] = [
    "asset",
    "extra",
    "instance_camera",
    "instance_light",
    "lookat",
    "matrix",
    "rotate",
    "scale",
    "skew",
    "translate",
];

/// The state of a traversal of the scene's nodes. Each geometry is read at its first use.
pub(super) struct SceneTraversal<'a, 'd> {
    pub(super) elements_by_id: ElementsById<'a, 'd>,
    /// The index of the shape for each geometry that has been read.
    pub(super) shape_index_by_geometry: HashMap<NodeId, usize>,
    pub(super) part_names: Vec<Option<String>>,
    pub(super) assembly: Assembly,
}

impl<'a, 'd> SceneTraversal<'a, 'd> {
    /// Reads the scene that the document shows or, if it names none, the first one. Without scenes it reads all geometries.
    pub(super) fn read_scene(&mut self, root: Node<'a, 'd>) -> Result<(), MeshFault> {
        let shown = child_named(root, "scene")
            .and_then(|scene| child_named(scene, "instance_visual_scene"));
        let all_in = |library, kind| {
            children_named(root, library).flat_map(move |library| children_named(library, kind))
        };
        let scene = match shown {
            Some(instance) => Some(self.referred(instance, "visual_scene", "url")?),
            None => all_in("library_visual_scenes", "visual_scene").next(),
        };
        if let Some(scene) = scene {
            return self.visit(children_named(scene, "node").collect());
        }
        for geometry in all_in("library_geometries", "geometry") {
            self.place(geometry, geometry.attribute("name"), AffineMap::IDENTITY)?;
        }
        Ok(())
    }

    /// Visits nodes and all below them, parents first.
    fn visit(&mut self, tops: Vec<Node<'a, 'd>>) -> Result<(), MeshFault> {
        let tops = tops.into_iter().rev();
        let mut waiting: Vec<_> = tops.map(|node| (node, AffineMap::IDENTITY, 0)).collect();
        while let Some((node, above, depth)) = waiting.pop() {
            if depth > MAX_DEPTH {
                return Err(fault_at(node, "is below itself, or too deep"));
            }
            // A node that many others name is a part each time.
            self.assembly.budget.spend(1)?;
            let map = above.compose_after(&transform::node_transform(node)?);
            let mut below = Vec::new();
            for child in node.children().filter(Node::is_element) {
                match child.tag_name().name() {
                    "node" => below.push((child, map, depth + 1)),
                    "instance_node" => {
                        below.push((self.referred(child, "node", "url")?, map, depth + 1));
                    }
                    "instance_geometry" => {
                        let geometry = self.referred(child, "geometry", "url")?;
                        let name = node.attribute("name").or(geometry.attribute("name"));
                        self.place(geometry, name, map)?;
                    }
                    "instance_controller" => {
                        let (geometry, bound) = self.geometry_at_rest(child)?;
                        let name = node.attribute("name").or(geometry.attribute("name"));
                        self.place(geometry, name, map.compose_after(&bound))?;
                        let what = "skins and morphs taken at rest";
                        self.assembly.remarks.add(what, 1, None);
                    }
                    name if HARMLESS_IN_NODES.contains(&name) => {}
                    _ => return Err(fault_at(child, "is no element of a node")),
                }
            }
            waiting.extend(below.into_iter().rev());
        }
        Ok(())
    }

    /// Returns the geometry that a controller bends, and the map by which it is bound.
    fn geometry_at_rest(
        &self,
        instance: Node<'a, 'd>,
    ) -> Result<(Node<'a, 'd>, AffineMap), MeshFault> {
        let mut bound = AffineMap::IDENTITY;
        let mut at = self.referred(instance, "controller", "url")?;
        for _ in 0..MAX_DEPTH {
            let kind = at
                .children()
                .find(|child| ["skin", "morph"].contains(&child.tag_name().name()));
            let Some(bending) = kind else {
                return Err(fault_at(at, "is neither a skin nor a morph"));
            };
            if let Some(matrix) = child_named(bending, "bind_shape_matrix") {
                bound = bound.compose_after(&transform::matrix(matrix)?.into());
            }
            let kinds = ["geometry", "controller"];
            at = referred_element(&self.elements_by_id, bending, "source", &kinds)?;
            if at.tag_name().name() == "geometry" {
                return Ok((at, bound));
            }
        }
        Err(fault_at(instance, "names a controller that bends itself"))
    }

    /// Returns the element of a kind that an attribute of another one names.
    fn referred(
        &self,
        from: Node<'a, 'd>,
        kind: &str,
        attribute: &str,
    ) -> Result<Node<'a, 'd>, MeshFault> {
        referred_element(&self.elements_by_id, from, attribute, &[kind])
    }

    fn place(
        &mut self,
        geometry: Node<'a, 'd>,
        name: Option<&str>,
        map: AffineMap,
    ) -> Result<(), MeshFault> {
        let shape = match self.shape_index_by_geometry.get(&geometry.id()) {
            Some(&shape) => shape,
            None => {
                let shape = geometry::read_geometry(geometry, &self.elements_by_id)?;
                self.assembly.remarks.add_counts(&shape.remarks);
                self.assembly.shapes.push(shape);
                let number = self.assembly.shapes.len() - 1;
                self.shape_index_by_geometry.insert(geometry.id(), number);
                number
            }
        };
        // A geometry without faces is no part.
        if self.assembly.shapes[shape].corner_ends.is_empty() {
            return Ok(());
        }
        let name = name.filter(|name| !name.is_empty());
        self.part_names.push(name.map(str::to_owned));
        self.assembly.parts.push(Part {
            shape,
            placement: map,
        });
        Ok(())
    }
}
