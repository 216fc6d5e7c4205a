//! Makes small polytopes at simple positions, and finds their features by position.

use super::shape::{self, Shape};
use crate::feature::Feature;
use crate::placed::PlacedPair;
use crate::polytope::Polytope;
use ccd_core::Frame;
use ccd_core::glam::{DMat3, DQuat, DVec3};

pub(crate) fn prepared_polytope(shape: &Shape) -> Polytope {
    let pieces = shape.pieces();
    Polytope::new(&pieces.get(0)).expect("a convex polytope")
}

/// Creates the cube from −1 to 1 along every axis.
pub(crate) fn cube() -> Polytope {
    prepared_polytope(&shape::cuboid(DVec3::ONE))
}

pub(crate) fn point() -> Polytope {
    prepared_polytope(&shape::shape_of_points(&[DVec3::ZERO]))
}

/// Creates a polytope of one edge, from −`half` to `half`.
pub(crate) fn needle(half: DVec3) -> Polytope {
    prepared_polytope(&shape::shape_of_points(&[-half, half]))
}

pub(crate) fn pair_with_b_moved<'a>(a: &'a Polytope, b: &'a Polytope, by: DVec3) -> PlacedPair<'a> {
    pair_with_placed_b(a, b, DQuat::IDENTITY, by)
}

pub(crate) fn pair_with_placed_b<'a>(
    a: &'a Polytope,
    b: &'a Polytope,
    by: DQuat,
    to: DVec3,
) -> PlacedPair<'a> {
    let frame = Frame {
        rotation: DMat3::from_quat(by),
        translation: to,
    };
    PlacedPair::new(a, b, &frame)
}

/// Returns the corner nearest to a point, in the polytope's own coordinates.
pub(crate) fn nearest_vertex(polytope: &Polytope, at: DVec3) -> u32 {
    nearest_index(polytope.vertices.iter().map(|v| v.point), at)
}

/// Returns the edge whose middle is nearest to a point.
pub(crate) fn edge_with_nearest_middle(polytope: &Polytope, at: DVec3) -> u32 {
    let middle = |e: &crate::polytope::Edge| e.start + 0.5 * e.length * e.direction;
    nearest_index(polytope.edges.iter().map(middle), at)
}

/// Returns the face whose normal is nearest to a direction.
pub(crate) fn face_along(polytope: &Polytope, along: DVec3) -> u32 {
    nearest_index(polytope.faces.iter().map(|f| f.normal), along)
}

fn nearest_index(points: impl Iterator<Item = DVec3>, at: DVec3) -> u32 {
    let distances = points.map(|p| p.distance(at)).zip(0..);
    let least = distances.min_by(|one, other| one.0.total_cmp(&other.0));
    least.expect("a feature").1
}

/// Returns all vertices, edges and faces of a polytope.
pub(crate) fn features(polytope: &Polytope) -> Vec<Feature> {
    let vertices = (0..polytope.vertices.len() as u32).map(Feature::Vertex);
    let edges = (0..polytope.edges.len() as u32).map(Feature::Edge);
    let faces = (0..polytope.faces.len() as u32).map(Feature::Face);
    vertices.chain(edges).chain(faces).collect()
}
