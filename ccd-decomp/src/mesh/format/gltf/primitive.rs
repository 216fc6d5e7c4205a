//! Reads the primitives of a glTF mesh as triangles.

use super::accessor::Accessors;
use super::extensions;
use super::schema::{Mesh, Primitive};
use crate::mesh::error::{MeshFault, element_name};
use crate::mesh::polygons::{Polygons, check_count};
use ccd_core::glam::DVec3;
use std::collections::HashMap;

/// Reads the triangles of a mesh, one primitive after the other. Primitives with the same positions share vertices.
pub(super) fn shape(mesh: &Mesh, accessors: &mut Accessors<'_>) -> Result<Polygons, MeshFault> {
    let mut shape = Polygons::default();
    let mut known = HashMap::new();
    for (k, primitive) in mesh.primitives.iter().enumerate() {
        add(primitive, &mut shape, &mut known, accessors)
            .map_err(|fault| fault.at(element_name("primitive", k, None)))?;
    }
    Ok(shape)
}

/// The range of vertex numbers in the shape that an accessor's points have.
#[derive(Clone, Copy)]
struct Vertices {
    first: usize,
    count: usize,
}

/// The topology of a primitive: how its indices form triangles.
#[derive(Clone, Copy)]
enum Mode {
    Triangles,
    Strip,
    Fan,
}

fn add(
    primitive: &Primitive,
    shape: &mut Polygons,
    known: &mut HashMap<usize, Vertices>,
    accessors: &mut Accessors<'_>,
) -> Result<(), MeshFault> {
    let Some(mode) = Mode::from_code(primitive.mode)? else {
        return Ok(());
    };
    // A primitive without positions draws nothing.
    let Some(position) = primitive.attributes.position else {
        return Ok(());
    };
    if primitive.extensions.draco.is_some() && !accessors.has_bytes(position) {
        return Err(extensions::draco());
    }
    let vertices = match known.get(&position) {
        Some(&vertices) => vertices,
        None => {
            let points = accessors.points(position)?;
            check_count("vertices", points.len())?;
            check_finite(&points)?;
            let vertices = Vertices {
                first: shape.vertices.len(),
                count: points.len(),
            };
            shape.vertices.extend(points);
            *known.entry(position).or_insert(vertices)
        }
    };
    let corners = match primitive.indices {
        Some(indices) => accessors.indices(indices)?,
        None => (0..vertices.count as u32).collect(),
    };
    mode.check(corners.len())?;
    // A strip has a triangle for almost each corner.
    accessors.take_corners(3 * corners.len())?;
    for (face, triangle) in mode.triangles(&corners).enumerate() {
        if let Some(&vertex) = triangle.iter().find(|&&v| v as usize >= vertices.count) {
            return Err(MeshFault::NoSuchVertex {
                face,
                line: None,
                vertex: vertex.into(),
                vertices: vertices.count,
                base: 0,
            });
        }
        let corners = triangle.map(|v| vertices.first as i64 + i64::from(v));
        shape.corners.extend(corners);
        shape.ends.push(shape.corners.len());
    }
    Ok(())
}

/// Checks that the points are finite, before a transform, while they have the file's numbers.
fn check_finite(points: &[DVec3]) -> Result<(), MeshFault> {
    match points.iter().position(|point| !point.is_finite()) {
        Some(vertex) => Err(MeshFault::NotFinite { vertex, line: None }),
        None => Ok(()),
    }
}

impl Mode {
    /// Returns the mode for a numeric code of glTF; `None` for points and lines.
    fn from_code(number: Option<u32>) -> Result<Option<Self>, MeshFault> {
        match number {
            Some(0..=3) => Ok(None),
            None | Some(4) => Ok(Some(Mode::Triangles)),
            Some(5) => Ok(Some(Mode::Strip)),
            Some(6) => Ok(Some(Mode::Fan)),
            Some(mode) => {
                let problem = format!("is of mode {mode}, which there is not");
                Err(MeshFault::syntax(None, problem))
            }
        }
    }

    fn check(self, corners: usize) -> Result<(), MeshFault> {
        match self {
            Mode::Triangles if !corners.is_multiple_of(3) => {
                let problem = format!("has {corners} corners, which make no whole triangles");
                Err(MeshFault::syntax(None, problem))
            }
            _ => Ok(()),
        }
    }

    /// Returns the triangles in a common orientation: every second triangle of a strip is reversed.
    fn triangles(self, corners: &[u32]) -> impl Iterator<Item = [u32; 3]> {
        let count = match self {
            Mode::Triangles => corners.len() / 3,
            Mode::Strip | Mode::Fan => corners.len().saturating_sub(2),
        };
        (0..count).map(move |k| {
            let at = match self {
                Mode::Triangles => [3 * k, 3 * k + 1, 3 * k + 2],
                Mode::Strip => [k, k + 1 + k % 2, k + 2 - k % 2],
                Mode::Fan => [k + 1, k + 2, 0],
            };
            at.map(|corner| corners[corner])
        })
    }
}
