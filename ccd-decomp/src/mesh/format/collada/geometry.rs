//! Reads the faces of a geometry.

use super::{
    ElementsById, child_named, children_named, count_attribute, fault_at, line_of, numbers,
    referred_element,
};
use crate::mesh::error::MeshFault;
use crate::mesh::polygons::Polygons;
use ccd_core::glam::DVec3;
use roxmltree::Node;

/// The largest offset of an input. Files have a few inputs; the offset is a size in memory.
const MAX_INPUT_OFFSET: usize = 1000;

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
    polygons.vertices = read_positions(
        referred_element(elements, position, "source", &["source"])?,
        elements,
    )?;
    for primitive in mesh.children().filter(Node::is_element) {
        match primitive.tag_name().name() {
            "lines" | "linestrips" => {
                polygons.remarks.add("lines passed over", 1, None);
            }
            "triangles" | "polylist" | "polygons" | "trifans" | "tristrips" => {
                read_primitive(primitive, &mut polygons)?;
            }
            "source" | "vertices" | "extra" => {}
            name => {
                return Err(MeshFault::unsupported_content(
                    format!("<{name}>"),
                    "triangles or polygons",
                ));
            }
        }
    }
    // No corner may name a vertex that is not there: shapes are placed unchecked.
    polygons
        .check_corners()
        .map_err(|fault| fault.at_element(format!("geometry at line {}", line_of(geometry))))?;
    Ok(polygons)
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
    let array = referred_element(elements, accessor, "source", &["float_array", "int_array"])?;
    let all: Vec<f64> = numbers(array)?;
    if count_attribute(array, "count")?.is_some_and(|count| count != all.len()) {
        let problem = format!("has {} numbers, and says another count", all.len());
        return Err(fault_at(array, problem));
    }
    let stride = count_attribute(accessor, "stride")?.unwrap_or(1);
    let offset = count_attribute(accessor, "offset")?.unwrap_or(0);
    let count = count_attribute(accessor, "count")?.unwrap_or(0);
    let [x, y, z] = coordinate_places(accessor);
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

/// Returns the places of the coordinates in a group of numbers: those that are named X, Y and Z, the first three with a name,
/// or the first three.
fn coordinate_places(accessor: Node<'_, '_>) -> [usize; 3] {
    let parameters = || children_named(accessor, "param").enumerate();
    let named = |name: &str| {
        let mut found = parameters().filter(|(_, param)| param.attribute("name") == Some(name));
        found.next().map(|(place, _)| place)
    };
    if let (Some(x), Some(y), Some(z)) = (named("X"), named("Y"), named("Z")) {
        return [x, y, z];
    }
    let has_name =
        |param: &Node<'_, '_>| param.attribute("name").is_some_and(|name| !name.is_empty());
    let with_names: Vec<usize> = parameters()
        .filter(|(_, param)| has_name(param))
        .map(|(place, _)| place)
        .collect();
    match with_names[..] {
        [x, y, z, ..] => [x, y, z],
        _ => [0, 1, 2],
    }
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
    if child_named(primitive, "ph").is_some() {
        return Err(MeshFault::unsupported_content(
            "polygons with holes (<ph>)",
            "triangles",
        ));
    }
    if vertex_offset.is_none() && lists().next().is_some() {
        return Err(fault_at(primitive, "has no input of vertices"));
    }
    let faces_before = polygons.corner_ends.len();
    let kind = primitive.tag_name().name();
    let mut list_count = 0;
    for list in lists() {
        let corners = corners_of(list)?;
        list_count += 1;
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
            _ if corners.len() < 3 => {
                let count = corners.len();
                return Err(fault_at(list, format!("has {count} corners")));
            }
            "polygons" => polygons.push_face(corners),
            "trifans" => {
                for pair in corners[1..].windows(2) {
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
    let found = match kind {
        "triangles" | "polylist" => polygons.corner_ends.len() - faces_before,
        _ => list_count,
    };
    check_count(primitive, found)
}

/// Refuses a primitive with fewer faces, strips or fans than it says.
fn check_count(primitive: Node<'_, '_>, found: usize) -> Result<(), MeshFault> {
    let of_corners = match child_named(primitive, "vcount") {
        Some(counts) => numbers::<usize>(counts)?.len(),
        None => 0,
    };
    let said = count_attribute(primitive, "count")?
        .unwrap_or(0)
        .max(of_corners);
    if found >= said {
        return Ok(());
    }
    let problem = format!("has {found} of the {said} that it says");
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
