//! Converts random shapes and motions to parry's types, in one precision.

use super::library::math::{IVector, Pose, Real, Rotation, Vector};
use super::library::query::NonlinearRigidMotion;
pub(crate) use super::library::shape::SharedShape;
use super::library::shape::{Cone, Cylinder, HeightField, RoundShape, Triangle, Voxels};
use super::library::utils::Array2;
use crate::scenes::{MotionSpec, ShapeSpec};

pub(crate) fn vector(v: [f32; 3]) -> Vector {
    let [x, y, z] = v.map(Real::from);
    Vector::new(x, y, z)
}

pub(crate) fn pose(place: [f32; 3], turned: [f32; 4]) -> Pose {
    let [x, y, z, w] = turned.map(Real::from);
    Pose::from_parts(vector(place), super::unit(Rotation::from_xyzw(x, y, z, w)))
}

pub(crate) fn motion(moves: &MotionSpec) -> NonlinearRigidMotion {
    NonlinearRigidMotion::new(
        pose(moves.place, moves.turned),
        vector(moves.center),
        vector(moves.velocity),
        vector(moves.spin),
    )
}

pub(crate) fn shape(recipe: &ShapeSpec) -> SharedShape {
    let real = Real::from;
    match recipe {
        ShapeSpec::Ball(radius) => SharedShape::ball(real(*radius)),
        ShapeSpec::Cuboid([x, y, z]) => SharedShape::cuboid(real(*x), real(*y), real(*z)),
        ShapeSpec::RoundCuboid([x, y, z], r) => {
            SharedShape::round_cuboid(real(*x), real(*y), real(*z), real(*r))
        }
        ShapeSpec::Capsule(a, b, r) => SharedShape::capsule(vector(*a), vector(*b), real(*r)),
        ShapeSpec::Segment([a, b]) => SharedShape::segment(vector(*a), vector(*b)),
        ShapeSpec::Triangle([a, b, c]) => SharedShape::triangle(vector(*a), vector(*b), vector(*c)),
        ShapeSpec::RoundTriangle([a, b, c], r) => SharedShape::new(RoundShape {
            inner_shape: Triangle::new(vector(*a), vector(*b), vector(*c)),
            border_radius: real(*r),
        }),
        ShapeSpec::Hull(points, r) => {
            let points: Vec<Vector> = points.iter().map(|p| vector(*p)).collect();
            if *r > 0.0 {
                SharedShape::round_convex_hull(&points, real(*r)).expect("a hull")
            } else {
                SharedShape::convex_hull(&points).expect("a hull")
            }
        }
        ShapeSpec::Mesh(vertices, faces) => {
            let vertices = vertices.iter().copied().map(vector);
            SharedShape::trimesh(vertices.collect(), faces.clone()).expect("a mesh")
        }
        ShapeSpec::Heights(heights, rows, scale) => {
            let columns = heights.len() / rows;
            let heights = Array2::new(*rows, columns, heights.iter().copied().map(real).collect());
            SharedShape::new(HeightField::new(heights, vector(*scale)))
        }
        ShapeSpec::Cylinder(half, radius, border) => {
            if *border > 0.0 {
                SharedShape::round_cylinder(real(*half), real(*radius), real(*border))
            } else {
                SharedShape::new(Cylinder::new(real(*half), real(*radius)))
            }
        }
        ShapeSpec::Cone(half, radius, border) => {
            if *border > 0.0 {
                SharedShape::round_cone(real(*half), real(*radius), real(*border))
            } else {
                SharedShape::new(Cone::new(real(*half), real(*radius)))
            }
        }
        ShapeSpec::Voxels(size, cells) => {
            let cell = |[x, y, z]: [i32; 3]| IVector::new(x.into(), y.into(), z.into());
            let cells: Vec<IVector> = cells.iter().copied().map(cell).collect();
            SharedShape::new(Voxels::new(vector(*size), &cells))
        }
        ShapeSpec::Polyline(points) => {
            SharedShape::polyline(points.iter().copied().map(vector).collect(), None)
        }
        ShapeSpec::Compound(parts) => {
            let part = |(place, turned, inner): &(_, _, _)| (pose(*place, *turned), shape(inner));
            SharedShape::compound(parts.iter().map(part).collect())
        }
    }
}
