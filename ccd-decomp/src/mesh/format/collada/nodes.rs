//! Traverses the nodes of a scene, and collects the parts that they place.

use super::{child_named, children_named, fault_at, geometry, transform};
use crate::mesh::affine::AffineMap;
use crate::mesh::content::assembly::{Assembly, Part};
use crate::mesh::error::MeshFault;
use roxmltree::{Node, NodeId};
use std::collections::HashMap;

/// The greatest number of nodes, one below or in place of another. A node that is below itself has more.
const MAX_DEPTH: usize = 256;

/// The state of a traversal of the scene's nodes. Each geometry is read at its first use.
pub(super) struct SceneTraversal<'a, 'd> {
    pub(super) elements_by_id: HashMap<&'a str, Node<'a, 'd>>,
    /// The index of the shape for each geometry that has been read.
    pub(super) shape_index_by_geometry: HashMap<NodeId, usize>,
    pub(super) part_names: Vec<Option<String>>,
    pub(super) assembly: Assembly,
}

impl<'a, 'd> SceneTraversal<'a, 'd> {
    /// Reads the scene that the document shows or, if it names none, the first one. Without scenes it reads all geometries.
    pub(super) fn read_scene(
        &mut self,
        root: Node<'a, 'd>,
        map: AffineMap,
    ) -> Result<(), MeshFault> {
        let shown = child_named(root, "scene")
            .and_then(|scene| child_named(scene, "instance_visual_scene"));
        let first = child_named(root, "library_visual_scenes")
            .and_then(|library| child_named(library, "visual_scene"));
        let scene = match shown {
            Some(instance) => Some(self.referred(instance, "visual_scene")?),
            None => first,
        };
        if let Some(scene) = scene {
            return self.visit(children_named(scene, "node").collect(), map);
        }
        for library in children_named(root, "library_geometries") {
            for geometry in children_named(library, "geometry") {
                self.place(geometry, geometry.attribute("name"), map)?;
            }
        }
        Ok(())
    }

    /// Visits nodes and all below them, parents first.
    fn visit(&mut self, tops: Vec<Node<'a, 'd>>, map: AffineMap) -> Result<(), MeshFault> {
        let tops = tops.into_iter().rev();
        let mut waiting: Vec<_> = tops.map(|node| (node, map, 0)).collect();
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
                        below.push((self.referred(child, "node")?, map, depth + 1));
                    }
                    "instance_geometry" => {
                        let geometry = self.referred(child, "geometry")?;
                        let name = node.attribute("name").or(geometry.attribute("name"));
                        self.place(geometry, name, map)?;
                    }
                    "instance_controller" => {
                        let what = "skins and morphs passed over";
                        self.assembly
                            .remarks
                            .add(what, 1, Some(super::line_of(child)));
                    }
                    _ => {}
                }
            }
            waiting.extend(below.into_iter().rev());
        }
        Ok(())
    }

    /// Returns the element that an instance names, which has to be of a kind.
    fn referred(&self, instance: Node<'a, 'd>, kind: &str) -> Result<Node<'a, 'd>, MeshFault> {
        let url = instance.attribute("url").unwrap_or_default();
        let id = url.strip_prefix('#');
        let Some(id) = id else {
            return Err(MeshFault::unsupported_content(
                format!("{url:?} in another file"),
                "a document with all that it shows",
            ));
        };
        match self.elements_by_id.get(id) {
            Some(found) if found.tag_name().name() == kind => Ok(*found),
            _ => Err(fault_at(
                instance,
                format!("names {url:?}, which is no {kind}"),
            )),
        }
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
