//! Reads the faces of a geometry.

use super::{child_named, children_named, count_attribute, fault_at, line_of, numbers};
use crate::mesh::error::MeshFault;
use crate::mesh::polygons::Polygons;
use ccd_core::glam::DVec3;
use roxmltree::Node;
use std::collections::HashMap;

type ElementsById<'a, 'd> = HashMap<&'a str, Node<'a, 'd>>;

/// Reads the mesh of a geometry: its faces, with the corners' numbers among the positions.
pub(super) fn read_geometry(
    geometry: Node<'_, '_>,
    elements: &ElementsById<'_, '_>,
) -> Result<Polygons, MeshFault> {
    let Some(mesh) = child_named(geometry, "mesh") else {
        return Err(MeshFault::unsupported_content(
            "a geometry without a <mesh>",
            "meshes",
        ));
    };
    let mut polygons = Polygons::default();
    let Some(vertices) = child_named(mesh, "vertices") else {
        return Err(fault_at(mesh, "has no <vertices>"));
    };
    let inputs = children_named(vertices, "input");
    let mut positions = inputs.filter(|input| input.attribute("semantic") == Some("POSITION"));
    let Some(position) = positions.next() else {
        return Err(fault_at(vertices, "have no positions"));
    };
    polygons.vertices = read_positions(source_of(position, elements, "source")?, elements)?;
    for primitive in mesh.children().filter(Node::is_element) {
        match primitive.tag_name().name() {
            "lines" | "linestrips" => {
                let what = "lines passed over";
                let count = count_attribute(primitive, "count")?.unwrap_or(1);
                polygons.remarks.add(what, count, Some(line_of(primitive)));
            }
            "triangles" | "polylist" | "polygons" | "trifans" | "tristrips" => {
                let before = polygons.corner_ends.len();
                read_primitive(primitive, &mut polygons)?;
                check_face_count(primitive, polygons.corner_ends.len() - before)?;
            }
            _ => {}
        }
    }
    // No corner may name a vertex that is not there: shapes are placed unchecked.
    polygons
        .check_corners()
        .map_err(|fault| fault.at_element(format!("geometry at line {}", line_of(geometry))))?;
    Ok(polygons)
}

/// Returns the element that an attribute names as `#id`.
fn source_of<'a, 'd>(
    element: Node<'_, '_>,
    elements: &ElementsById<'a, 'd>,
    attribute: &str,
) -> Result<Node<'a, 'd>, MeshFault> {
    let name = element.attribute(attribute).unwrap_or_default();
    let found = name.strip_prefix('#').and_then(|id| elements.get(id));
    found.copied().ok_or_else(|| {
        fault_at(
            element,
            format!("has {attribute}={name:?}, which is no element"),
        )
    })
}

/// Reads the positions of a source: of each group of `stride` numbers those that are named X, Y and Z, or the first three.
fn read_positions(
    source: Node<'_, '_>,
    elements: &ElementsById<'_, '_>,
) -> Result<Vec<DVec3>, MeshFault> {
    let accessor = child_named(source, "technique_common")
        .and_then(|technique| child_named(technique, "accessor"));
    let Some(accessor) = accessor else {
        return Err(fault_at(source, "has no accessor"));
    };
    let array = source_of(accessor, elements, "source")?;
    let all: Vec<f64> = numbers(array)?;
    let stride = count_attribute(accessor, "stride")?.unwrap_or(1);
    let offset = count_attribute(accessor, "offset")?.unwrap_or(0);
    let count = count_attribute(accessor, "count")?.unwrap_or(0);
    // A parameter without a name is passed over.
    let parameters = children_named(accessor, "param").enumerate();
    let named: Vec<usize> = parameters
        .filter(|(_, parameter)| {
            parameter
                .attribute("name")
                .is_some_and(|name| !name.is_empty())
        })
        .map(|(place, _)| place)
        .collect();
    let [x, y, z] = match named[..] {
        [x, y, z, ..] => [x, y, z],
        _ => [0, 1, 2],
    };
    if stride < 3 || [x, y, z].iter().any(|place| *place >= stride) {
        return Err(fault_at(accessor, format!("has a stride of {stride}")));
    }
    let needed = count
        .checked_mul(stride)
        .and_then(|length| length.checked_add(offset));
    if needed.is_none_or(|needed| needed > all.len()) {
        return Err(fault_at(
            array,
            format!("has {} numbers, too few for {count} positions", all.len()),
        ));
    }
    let groups = all[offset..].chunks_exact(stride).take(count);
    Ok(groups
        .map(|group| DVec3::new(group[x], group[y], group[z]))
        .collect())
}

/// Appends the faces of a primitive.
fn read_primitive(primitive: Node<'_, '_>, polygons: &mut Polygons) -> Result<(), MeshFault> {
    let (mut stride, mut vertex_offset) = (0, None);
    for input in children_named(primitive, "input") {
        let offset = count_attribute(input, "offset")?.unwrap_or(0);
        if offset > MAX_INPUT_OFFSET {
            return Err(fault_at(input, format!("has an offset of {offset}")));
        }
        stride = stride.max(offset + 1);
        if input.attribute("semantic") == Some("VERTEX") {
            vertex_offset = Some(offset);
        }
    }
    let lists = || children_named(primitive, "p");
    let corners_of = |list: Node<'_, '_>| -> Result<Vec<i64>, MeshFault> {
        let all: Vec<i64> = numbers(list)?;
        if stride == 0 || !all.len().is_multiple_of(stride) {
            return Err(fault_at(
                list,
                format!("has {} numbers, no multiple of {stride}", all.len()),
            ));
        }
        let groups = all.chunks_exact(stride);
        Ok(groups
            .map(|group| group[vertex_offset.unwrap_or(0)])
            .collect())
    };
    if vertex_offset.is_none() {
        // A primitive without corners needs no inputs.
        return match lists().next() {
            None => Ok(()),
            Some(_) => Err(fault_at(primitive, "has no input of vertices")),
        };
    }
    if child_named(primitive, "ph").is_some() {
        return Err(MeshFault::unsupported_content(
            "polygons with holes (<ph>)",
            "triangles",
        ));
    }
    let kind = primitive.tag_name().name();
    for list in lists() {
        let corners = corners_of(list)?;
        match kind {
            "triangles" => {
                let (triangles, rest) = corners.as_chunks::<3>();
                if !rest.is_empty() {
                    return Err(fault_at(list, "has corners that make no triangle"));
                }
                triangles
                    .iter()
                    .for_each(|corners| polygons.push_face(*corners));
            }
            "polylist" => push_polylist(primitive, list, &corners, polygons)?,
            "polygons" => polygons.push_face(corners),
            "trifans" => {
                for pair in corners.get(1..).unwrap_or_default().windows(2) {
                    polygons.push_face([corners[0], pair[0], pair[1]]);
                }
            }
            _ => {
                for (k, corners) in corners.windows(3).enumerate() {
                    // Every other triangle of a strip is the other way around.
                    let [a, b] = if k % 2 == 0 { [0, 1] } else { [1, 0] };
                    polygons.push_face([corners[a], corners[b], corners[2]]);
                }
            }
        }
    }
    Ok(())
}

/// Refuses a primitive with fewer faces than it says. For strips and fans the number is that of strips and fans.
fn check_face_count(primitive: Node<'_, '_>, found: usize) -> Result<(), MeshFault> {
    let said = count_attribute(primitive, "count")?.unwrap_or(0);
    if found >= said {
        return Ok(());
    }
    let problem = format!("has {found} faces, but count={said:?}");
    Err(fault_at(primitive, problem))
}

/// Appends faces whose numbers of corners are in a list of their own.
fn push_polylist(
    primitive: Node<'_, '_>,
    list: Node<'_, '_>,
    corners: &[i64],
    polygons: &mut Polygons,
) -> Result<(), MeshFault> {
    let Some(counts) = child_named(primitive, "vcount") else {
        return Err(fault_at(primitive, "has no <vcount>"));
    };
    let mut rest = corners;
    for count in numbers::<usize>(counts)? {
        let Some((face, others)) = rest.split_at_checked(count) else {
            return Err(fault_at(list, "has fewer corners than <vcount> says"));
        };
        polygons.push_face(face.iter().copied());
        rest = others;
    }
    if rest.is_empty() {
        return Ok(());
    }
    Err(fault_at(list, "has more corners than <vcount> says"))
}

/// The largest offset of an input. Files have a few inputs; the offset is a size in memory.
const MAX_INPUT_OFFSET: usize = 1000;
