//! Converts parry's shapes to bodies.

use super::convert::{point_from_parry, pose_from_parry};
use super::library::math::{IVector, Real};
use super::library::shape::{
    Compound, Cone, ConvexPolyhedron, Cuboid, Cylinder, HalfSpace as ParryHalfSpace, HeightField,
    Polyline, Shape, TriMeshFlags, TypedShape, Voxels,
};
use crate::geometry::ShapeGeometry;
use crate::half_space::HalfSpace;
use crate::limits::{MAX_NESTING_DEPTH, MAX_VOXEL_COORDINATE};
use crate::order::{greater, length};
use crate::tolerance::VOXEL_ROUNDING;
use crate::{BodyOfShape, Meshes, Options, ShapeError};
use ccd_core::glam::DVec3;
use ccd_core::{InputError, SolidOfRevolution};

/// Makes the body of a shape, for casts and all other questions of [`rigid_ccd::Solver`].
///
/// # Errors
/// A [`ShapeError`] that names the part, triangle or size.
///
/// # Complexity
/// O(n log n) in the number of triangles, parts and voxels.
#[doc = ""]
#[doc = "```"]
#[doc = concat!("use ", parry!(), "::shape::{Cuboid, Cylinder};")]
#[doc = concat!("use ", parry!(), "::math::Vector;")]
#[doc = concat!("use rigid_ccd_parry::", precision!(), "::body;")]
/// use rigid_ccd_parry::Options;
/// let block = body(&Cuboid::new(Vector::splat(0.5)), &Options::default())?;
/// assert_eq!(block.excess(), 0.0);
/// let wheel = body(&Cylinder::new(0.1, 0.5), &Options::default())?;
/// assert!(wheel.excess() > 0.0 && wheel.excess() < 0.5 / 4000.0);
/// # Ok::<(), rigid_ccd_parry::ShapeError>(())
/// ```
pub fn body(shape: &dyn Shape, options: &Options) -> Result<BodyOfShape, ShapeError> {
    BodyOfShape::new(&shape_geometry(shape, options)?)
}

/// Returns the geometry of a shape in double precision.
pub(super) fn shape_geometry(
    shape: &dyn Shape,
    options: &Options,
) -> Result<ShapeGeometry, ShapeError> {
    let geometry = geometry_at_depth(shape, options, 0)?;
    let TypedShape::TriMesh(mesh) = shape.as_typed_shape() else {
        return Ok(geometry);
    };
    let is_oriented = mesh.flags().contains(TriMeshFlags::ORIENTED);
    if options.meshes == Meshes::SolidIfOriented && is_oriented {
        geometry.into_solid()
    } else {
        Ok(geometry)
    }
}

/// Converts parry's half-space to this crate's, in double precision.
pub(super) fn half_space(shape: &ParryHalfSpace) -> Result<HalfSpace, ShapeError> {
    HalfSpace::new(point_from_parry(shape.normal))
}

/// Returns the geometry of a shape that is nested in `depth` compounds.
fn geometry_at_depth(
    shape: &dyn Shape,
    options: &Options,
    depth: usize,
) -> Result<ShapeGeometry, ShapeError> {
    let mut geometry = ShapeGeometry::EMPTY;
    match shape.as_typed_shape() {
        TypedShape::Ball(ball) => {
            geometry.push_hull_of_points([DVec3::ZERO], checked_size("radius", ball.radius)?, 0);
        }
        TypedShape::Cuboid(cuboid) => push_cuboid(&mut geometry, cuboid, 0.0)?,
        TypedShape::RoundCuboid(round) => {
            let radius = border_radius(round.border_radius)?;
            push_cuboid(&mut geometry, &round.inner_shape, radius)?;
        }
        TypedShape::Capsule(capsule) => {
            let ends = [capsule.segment.a, capsule.segment.b].map(point_from_parry);
            geometry.push_hull_of_points(ends, checked_size("radius", capsule.radius)?, 0);
        }
        TypedShape::Segment(segment) => {
            geometry.push_hull_of_points([segment.a, segment.b].map(point_from_parry), 0.0, 0);
        }
        TypedShape::Triangle(t) => {
            geometry.push_triangles(
                [t.a, t.b, t.c].map(point_from_parry),
                &SINGLE_TRIANGLE_FACE,
                0..,
            );
        }
        TypedShape::RoundTriangle(round) => {
            let corners = round.inner_shape.vertices().map(point_from_parry);
            geometry.push_hull_of_points(corners, border_radius(round.border_radius)?, 0);
        }
        TypedShape::ConvexPolyhedron(polyhedron) => push_polyhedron(&mut geometry, polyhedron, 0.0),
        TypedShape::RoundConvexPolyhedron(round) => {
            let radius = border_radius(round.border_radius)?;
            push_polyhedron(&mut geometry, &round.inner_shape, radius);
        }
        TypedShape::TriMesh(mesh) => {
            let vertices = mesh.vertices().iter().copied().map(point_from_parry);
            geometry.push_triangles(vertices, mesh.indices(), 0..);
        }
        TypedShape::Polyline(line) => push_polyline(&mut geometry, line),
        TypedShape::HeightField(field) => push_height_field(&mut geometry, field),
        TypedShape::Voxels(voxels) => push_voxels(&mut geometry, voxels)?,
        TypedShape::Compound(compound) => push_compound(&mut geometry, compound, options, depth)?,
        TypedShape::HalfSpace(_) => return Err(ShapeError::HalfSpace),
        TypedShape::Custom(_) => return Err(ShapeError::CustomShapeType),
        typed => return solid_of_revolution_geometry(&typed, options),
    }
    Ok(geometry)
}

/// Returns the geometry of a cylinder or a cone, perhaps grown by a radius.
fn solid_of_revolution_geometry(
    shape: &TypedShape<'_>,
    options: &Options,
) -> Result<ShapeGeometry, ShapeError> {
    let cylinder =
        |s: &Cylinder| solid_of_revolution(SolidOfRevolution::cylinder, s.half_height, s.radius);
    let cone = |s: &Cone| solid_of_revolution(SolidOfRevolution::cone, s.half_height, s.radius);
    let (solid, border) = match shape {
        TypedShape::Cylinder(s) => (cylinder(s), 0.0),
        TypedShape::Cone(s) => (cone(s), 0.0),
        TypedShape::RoundCylinder(s) => (cylinder(&s.inner_shape), s.border_radius),
        TypedShape::RoundCone(s) => (cone(&s.inner_shape), s.border_radius),
        _ => return Err(ShapeError::CustomShapeType),
    };
    Ok(ShapeGeometry::from_solid_of_revolution(
        solid?,
        border_radius(border)?,
        options.excess,
    ))
}

fn solid_of_revolution(
    make: fn(f64, f64) -> Result<SolidOfRevolution, InputError>,
    half_height: Real,
    radius: Real,
) -> Result<SolidOfRevolution, ShapeError> {
    let half_height = checked_size("half height", half_height)?;
    make(checked_size("radius", radius)?, half_height).map_err(ShapeError::Body)
}

fn push_cuboid(
    geometry: &mut ShapeGeometry,
    cuboid: &Cuboid,
    radius: f64,
) -> Result<(), ShapeError> {
    let half = point_from_parry(cuboid.half_extents);
    for length in half.to_array() {
        check_size("half extent", length)?;
    }
    geometry.push_box(-half, half, radius);
    Ok(())
}

/// Adds the hull of a convex polyhedron's points, grown by a radius, to a geometry.
fn push_polyhedron(geometry: &mut ShapeGeometry, polyhedron: &ConvexPolyhedron, radius: f64) {
    let corners = polyhedron.vertices_adj_to_face();
    let facets = polyhedron.faces().iter().map(|face| {
        let first = face.first_vertex_or_edge as usize;
        let face_loop = corners.get(first..first + face.num_vertices_or_edges as usize)?;
        (face_loop.len() >= 3).then(|| face_loop.to_vec())
    });
    let loops: Option<Vec<Vec<u32>>> = facets.collect();
    let points = polyhedron
        .points()
        .iter()
        .copied()
        .map(point_from_parry)
        .collect();
    // If a facet is incomplete, no facets are used.
    geometry.push_hull(points, radius, loops.unwrap_or_default(), 0);
}

/// Adds the segments of a polyline to a geometry.
fn push_polyline(geometry: &mut ShapeGeometry, line: &Polyline) {
    // A missing vertex becomes NaN, which the engine refuses.
    let vertex =
        |v: u32| (line.vertices().get(v as usize)).map_or(DVec3::NAN, |v| point_from_parry(*v));
    for (number, ends) in (0..).zip(line.indices()) {
        geometry.push_hull_of_points(ends.map(vertex), 0.0, number);
    }
}

/// The only face of a mesh that has one triangle.
const SINGLE_TRIANGLE_FACE: [[u32; 3]; 1] = [[0, 1, 2]];

/// Adds the triangles of a height field to a geometry, with parry's sub-shape indices and order of corners.
fn push_height_field(geometry: &mut ShapeGeometry, field: &HeightField) {
    let (rows, columns) = (field.nrows(), field.ncols());
    for j in 0..columns {
        for i in 0..rows {
            let (left, right) = field.triangles_at(i, j);
            let number = j * rows + i;
            for (triangle, number) in [(left, number), (right, number + rows * columns)] {
                if let Some(triangle) = triangle {
                    geometry.push_triangles(
                        triangle.vertices().map(point_from_parry),
                        &SINGLE_TRIANGLE_FACE,
                        number as u32..,
                    );
                }
            }
        }
    }
}

/// Adds the boxes of filled voxels to a geometry.
fn push_voxels(geometry: &mut ShapeGeometry, voxels: &Voxels) -> Result<(), ShapeError> {
    let edge = point_from_parry(voxels.voxel_size());
    let [low, high] = voxels.domain();
    let is_near_origin = |v: IVector| {
        [v.x, v.y, v.z]
            .into_iter()
            .all(|k| i64::from(k).unsigned_abs() <= MAX_VOXEL_COORDINATE as u64)
    };
    // parry divides by the size of voxels to find them, so extreme sizes are refused.
    let sizes = 1e-30..=1e30;
    if !(edge.to_array().iter().all(|side| sizes.contains(side))
        && is_near_origin(low)
        && is_near_origin(high))
    {
        return Err(ShapeError::UnresolvableVoxels);
    }
    // parry compares the range with rounded positions, so the range is extended by a chunk.
    let chunk = IVector::new(8, 8, 8);
    let mut largest_distance = 0.0;
    for voxel in voxels.voxels_in_range(low - chunk, high + chunk) {
        let key = voxel.grid_coords;
        let key = DVec3::new(key.x as f64, key.y as f64, key.z as f64);
        let [low, high] = [key * edge, (key + 1.0) * edge];
        largest_distance = greater(largest_distance, greater(length(low), length(high)));
        geometry.push_box(low, high, 0.0);
    }
    geometry.slack = VOXEL_ROUNDING * largest_distance;
    Ok(())
}

/// Adds the parts of a compound to a geometry, each at its pose.
fn push_compound(
    geometry: &mut ShapeGeometry,
    compound: &Compound,
    options: &Options,
    depth: usize,
) -> Result<(), ShapeError> {
    if depth >= MAX_NESTING_DEPTH {
        return Err(ShapeError::NestedTooDeeply);
    }
    for (part, (pose, shape)) in (0..).zip(compound.shapes()) {
        let part_error = |error| ShapeError::Part {
            part,
            error: Box::new(error),
        };
        let inner = geometry_at_depth(&**shape, options, depth + 1).map_err(part_error)?;
        let pose = pose_from_parry(pose).map_err(|error| part_error(ShapeError::Body(error)))?;
        geometry
            .push_at_pose(&pose, &inner, part)
            .map_err(part_error)?;
    }
    Ok(())
}

fn border_radius(radius: Real) -> Result<f64, ShapeError> {
    checked_size("border radius", radius)
}

fn checked_size(size_name: &'static str, value: Real) -> Result<f64, ShapeError> {
    check_size(size_name, f64::from(value))
}

fn check_size(size_name: &'static str, value: f64) -> Result<f64, ShapeError> {
    if value >= 0.0 && value.is_finite() {
        Ok(value)
    } else {
        Err(ShapeError::InvalidSize {
            what: size_name,
            value,
        })
    }
}

#[cfg(test)]
mod tests;
