//! Reads the primitives of a glTF mesh, such as triangle lists and strips, as triangles.

use super::accessor::AccessorReader;
use super::extensions;
use super::schema::{Mesh, Primitive};
use crate::mesh::error::{MeshFault, element_name, quoted};
use crate::mesh::polygons::{Polygons, check_count_fits_indices};
use std::collections::HashMap;
use std::ops::Range;

/// Reads the triangles of a mesh, one primitive after the other. Primitives with the same positions share vertices.
pub(super) fn read_mesh(
    mesh: &Mesh,
    accessors: &mut AccessorReader<'_>,
) -> Result<Polygons, MeshFault> {
    let mut shape = Polygons::default();
    let mut known = HashMap::new();
    for (k, primitive) in mesh.primitives.iter().enumerate() {
        add_primitive(primitive, &mut shape, &mut known, accessors)
            .map_err(|fault| fault.at_element(element_name("primitive", k, None)))?;
    }
    Ok(shape)
}

/// Adds the triangles of a primitive to a shape. For each accessor, `known` has the range of the shape's vertices that were
/// read from it.
fn add_primitive(
    primitive: &Primitive,
    shape: &mut Polygons,
    known: &mut HashMap<usize, Range<usize>>,
    accessors: &mut AccessorReader<'_>,
) -> Result<(), MeshFault> {
    let mode = primitive.mode.unwrap_or(TRIANGLES_MODE);
    if mode > TRIANGLE_FAN_MODE {
        let problem = format!("is of mode {mode}, which there is not");
        return Err(MeshFault::malformed_content(problem));
    }
    if let Some(name) = primitive.attributes.unknown_name() {
        let problem = format!("has an attribute {}, which there is not", quoted(name));
        return Err(MeshFault::malformed_content(problem));
    }
    // A primitive without positions draws nothing.
    let position = primitive.attributes.position;
    let Some(position) = position.filter(|_| !primitive.is_points_or_lines()) else {
        return Ok(());
    };
    if primitive.extensions.draco.is_some() && !accessors.has_uncompressed_data(position) {
        return Err(extensions::draco_fault());
    }
    let vertices = match known.get(&position) {
        Some(vertices) => vertices.clone(),
        None => {
            let points = accessors.points(position)?;
            check_count_fits_indices("vertices", points.len())?;
            if let Some(vertex) = points.iter().position(|point| !point.is_finite()) {
                return Err(MeshFault::NotFinite { vertex, line: None });
            }
            let first = shape.vertices.len();
            shape.vertices.extend(points);
            let vertices = first..shape.vertices.len();
            known.insert(position, vertices.clone());
            vertices
        }
    };
    let corners = match primitive.indices {
        Some(indices) => accessors.indices(indices)?,
        None => (0..vertices.len() as u32).collect(),
    };
    if mode == TRIANGLES_MODE && !corners.len().is_multiple_of(3) {
        let count = corners.len();
        let problem = format!("has {count} corners, which make no whole triangles");
        return Err(MeshFault::malformed_content(problem));
    }
    // A strip has a triangle for almost each corner.
    accessors.spend_corners(3 * corners.len())?;
    for (face, triangle) in triangles(mode, &corners).enumerate() {
        if let Some(&vertex) = triangle.iter().find(|&&v| v as usize >= vertices.len()) {
            return Err(MeshFault::NoSuchVertex {
                face,
                line: None,
                vertex: vertex.into(),
                vertices: vertices.len(),
                first_vertex_number: 0,
            });
        }
        let corners = triangle.map(|v| vertices.start as i64 + i64::from(v));
        shape.push_face(corners);
    }
    Ok(())
}

/// The glTF mode of primitives that are separate triangles. Smaller modes are points and lines; the next two are strips
/// and fans.
const TRIANGLES_MODE: u32 = 4;
const TRIANGLE_STRIP_MODE: u32 = 5;
const TRIANGLE_FAN_MODE: u32 = 6;

/// Returns the triangles of a primitive with the given mode and corners, all in the same orientation. Every second
/// triangle of a strip is reversed for that.
fn triangles(mode: u32, corners: &[u32]) -> impl Iterator<Item = [u32; 3]> {
    let count = match mode {
        TRIANGLES_MODE => corners.len() / 3,
        _ => corners.len().saturating_sub(2),
    };
    (0..count).map(move |k| {
        let at = match mode {
            TRIANGLES_MODE => [3 * k, 3 * k + 1, 3 * k + 2],
            TRIANGLE_STRIP_MODE => [k, k + 1 + k % 2, k + 2 - k % 2],
            _ => [k + 1, k + 2, 0],
        };
        at.map(|corner| corners[corner])
    })
}
