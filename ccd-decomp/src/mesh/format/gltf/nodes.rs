//! Traverses the nodes of a glTF scene, and collects the parts that they place.

use super::accessor::AccessorReader;
use super::schema::Root;
use super::{element_at_index, primitive, transform};
use crate::mesh::affine::AffineMap;
use crate::mesh::content::assembly::{Assembly, Part};
use crate::mesh::content::{Content, Geometry};
use crate::mesh::error::{MeshFault, element_name};
use crate::mesh::remark::Remarks;
use crate::mesh::unit::Unit;
use std::collections::HashMap;

/// Reads the default scene of the file or, if none is named, the first scene. In a file without scenes it reads all
/// nodes, and in a file without nodes all meshes.
pub(super) fn read_scene(root: &Root, accessors: AccessorReader<'_>) -> Result<Content, MeshFault> {
    let mut walk = SceneTraversal {
        document: root,
        shape_index_by_mesh: HashMap::new(),
        is_node_visited: vec![false; root.nodes.len()],
        part_names: Vec::new(),
        assembly: Assembly {
            shapes: Vec::new(),
            parts: Vec::new(),
            budget: accessors.expansion_budget,
            remarks: Remarks::default(),
        },
        accessor_reader: accessors,
    };
    match (root.scene, root.scenes.first()) {
        (Some(scene), _) => {
            walk.visit_subtrees(&element_at_index(&root.scenes, "scene", scene)?.nodes)?;
        }
        (None, Some(first)) => walk.visit_subtrees(&first.nodes)?,
        (None, None) if root.nodes.is_empty() => (0..root.meshes.len())
            .try_for_each(|mesh| walk.place(mesh, None, AffineMap::IDENTITY))?,
        (None, None) => walk.visit_all_nodes()?,
    }
    walk.add_remarks();
    Ok(Content {
        unit: Some(Unit::Metre),
        part_names: walk.part_names,
        geometry: Geometry::Assembly(walk.assembly),
    })
}

/// The state of a traversal of the scene's nodes. Each mesh is read at its first use.
struct SceneTraversal<'a> {
    document: &'a Root,
    accessor_reader: AccessorReader<'a>,
    /// The index of the shape for each mesh that has been read, by mesh index.
    shape_index_by_mesh: HashMap<usize, usize>,
    is_node_visited: Vec<bool>,
    part_names: Vec<Option<String>>,
    assembly: Assembly,
}

impl SceneTraversal<'_> {
    /// Visits the nodes `tops` and all their descendants, parents first.
    fn visit_subtrees(&mut self, tops: &[usize]) -> Result<(), MeshFault> {
        let top = |&node: &usize| (node, AffineMap::IDENTITY);
        let mut waiting: Vec<(usize, AffineMap)> = tops.iter().rev().map(top).collect();
        while let Some((number, above)) = waiting.pop() {
            let node = element_at_index(&self.document.nodes, "node", number)?;
            let place = || element_name("node", number, node.name.as_deref());
            // Nodes form a tree. The check also ends at cycles.
            if std::mem::replace(&mut self.is_node_visited[number], true) {
                return Err(
                    MeshFault::malformed_content("is below itself, or below two others")
                        .at_element(place()),
                );
            }
            let own = transform::node_transform(node).map_err(|fault| fault.at_element(place()))?;
            let map = above.compose_after(&own);
            if own.collapses_to_point() {
                continue;
            }
            if let Some(mesh) = node.mesh {
                let placed = match node.extensions.instancing {
                    Some(_) => Err(MeshFault::unsupported_content(
                        "instances in a buffer (EXT_mesh_gpu_instancing)",
                        "glTF with a node for each instance",
                    )),
                    None => self.place(mesh, node.name.clone(), map),
                };
                placed.map_err(|fault| fault.at_element(place()))?;
            }
            waiting.extend(node.children.iter().rev().map(|&child| (child, map)));
        }
        Ok(())
    }

    /// Visits all nodes of the file, starting at the roots.
    fn visit_all_nodes(&mut self) -> Result<(), MeshFault> {
        let mut is_below = vec![false; self.document.nodes.len()];
        for &child in self.document.nodes.iter().flat_map(|node| &node.children) {
            element_at_index(&self.document.nodes, "node", child)?;
            is_below[child] = true;
        }
        let tops = (0..is_below.len()).filter(|&node| !is_below[node]);
        let tops: Vec<usize> = tops.collect();
        if tops.is_empty() {
            return Err(MeshFault::malformed_content("is below itself")
                .at_element(element_name("node", 0, None)));
        }
        self.visit_subtrees(&tops)
    }

    /// Adds remarks about content that was skipped, or that was read in its rest pose.
    fn add_remarks(&mut self) {
        let root = self.document;
        let nodes = root.nodes.iter().zip(&self.is_node_visited);
        let with_mesh = nodes.filter(|(node, _)| node.mesh.is_some());
        let (shown, others): (Vec<_>, Vec<_>) = with_mesh.partition(|(_, visited)| **visited);
        let skinned = shown.iter().filter(|(node, _)| node.skin.is_some());
        let used = self.shape_index_by_mesh.keys();
        let used = used.flat_map(|&mesh| &root.meshes[mesh].primitives);
        let thin = used.clone().filter(|used| used.is_points_or_lines());
        let changing = used.filter(|used| !used.targets.is_empty());
        let remarks = &mut self.assembly.remarks;
        let mut add = |what, count| remarks.add(what, count, None);
        add(
            "nodes that the scene does not show passed over",
            others.len(),
        );
        add("primitives of points or lines passed over", thin.count());
        add("nodes taken without their skin", skinned.count());
        add(
            "primitives with morph targets taken at rest",
            changing.count(),
        );
    }

    fn place(
        &mut self,
        mesh: usize,
        label: Option<String>,
        map: AffineMap,
    ) -> Result<(), MeshFault> {
        let about = element_at_index(&self.document.meshes, "mesh", mesh)?;
        let shape = match self.shape_index_by_mesh.get(&mesh) {
            Some(&shape) => shape,
            None => {
                let place = || element_name("mesh", mesh, about.name.as_deref());
                let shape = primitive::read_mesh(about, &mut self.accessor_reader)
                    .map_err(|fault| fault.at_element(place()))?;
                self.assembly.shapes.push(shape);
                let number = self.assembly.shapes.len() - 1;
                self.shape_index_by_mesh.insert(mesh, number);
                number
            }
        };
        // A mesh without faces is no part.
        if self.assembly.shapes[shape].corner_ends.is_empty() {
            return Ok(());
        }
        // An empty name counts as no name.
        let given = |name: &String| !name.is_empty();
        let name = label.filter(given).or(about.name.clone().filter(given));
        self.part_names.push(name);
        self.assembly.parts.push(Part {
            shape,
            placement: map,
        });
        Ok(())
    }
}
