//! Converts bodies to triangles for drawing.

use ccd_core::glam::DVec3;
use ccd_core::order::greater;
use ccd_core::{Body, Piece, Pose};
use ccd_view::DrawnMesh;
use parry3d_f64::transformation::try_convex_hull;
use std::collections::{HashMap, HashSet};
use std::f64::consts::PI;

/// The number of points that approximate the sphere about each point of a rounded piece.
const SPHERE_POINT_COUNT: u32 = 320;

/// Returns the triangles of a body's surface: the faces of its mesh, or the hulls of its pieces.
pub fn drawn_mesh(body: &Body) -> DrawnMesh {
    let mut builder = MeshBuilder::default();
    for piece in body.pieces().iter() {
        let mut has_no_triangles = true;
        if piece.radius == 0.0 {
            for (_, corners) in piece.mesh_triangles() {
                builder.push(corners);
                has_no_triangles = false;
            }
        }
        if has_no_triangles && piece.facets.is_empty() {
            builder.push_hull(&piece);
        }
    }
    builder.mesh
}

/// Returns the corners of a feature to highlight, in the world: one for a vertex, two for an edge, three for each
/// triangle of a face.
pub(super) fn feature_corners(
    body: &Body,
    pose: &Pose,
    feature: &str,
    witness: DVec3,
) -> Vec<DVec3> {
    let local_witness = pose.inverse().transform_point(witness);
    let triangles = || {
        body.pieces()
            .iter()
            .flat_map(|piece| piece.mesh_triangles().collect::<Vec<_>>())
    };
    let corners = match feature.split_at_checked(1) {
        Some(("v", _)) => vec![local_witness],
        Some(("e", _)) => {
            let edges = triangles().flat_map(|(_, [a, b, c])| [[a, b], [b, c], [c, a]]);
            let nearest = edges.min_by(|one, two| {
                distance_to_segment(local_witness, *one)
                    .total_cmp(&distance_to_segment(local_witness, *two))
            });
            nearest.map_or_else(Vec::new, |edge| edge.to_vec())
        }
        Some(("f", number)) => triangles()
            .filter(|(face, _)| number.parse() == Ok(*face))
            .flat_map(|(_, corners)| corners)
            .collect(),
        _ => Vec::new(),
    };
    corners
        .iter()
        .map(|point| pose.transform_point(*point))
        .collect()
}

fn distance_to_segment(point: DVec3, [from, to]: [DVec3; 2]) -> f64 {
    let direction = to - from;
    let fraction =
        (point - from).dot(direction) / greater(direction.length_squared(), f64::MIN_POSITIVE);
    point.distance(from + fraction.clamp(0.0, 1.0) * direction)
}

/// A mesh under construction, with duplicate vertices and faces merged.
#[derive(Default)]
struct MeshBuilder {
    mesh: DrawnMesh,
    numbers: HashMap<[u64; 3], u32>,
    drawn_faces: HashSet<[u32; 3]>,
}

impl MeshBuilder {
    fn push(&mut self, corners: [DVec3; 3]) {
        let numbers = corners.map(|corner| self.vertex_index(corner));
        let mut sorted = numbers;
        sorted.sort_unstable();
        // Two pieces may share a face, and so may both sides of a flat piece.
        if self.drawn_faces.insert(sorted) {
            self.mesh.faces.push(numbers);
        }
    }

    fn vertex_index(&mut self, corner: DVec3) -> u32 {
        let vertices = &mut self.mesh.vertices;
        let bits = corner.to_array().map(f64::to_bits);
        *self.numbers.entry(bits).or_insert_with(|| {
            vertices.push(corner);
            vertices.len() as u32 - 1
        })
    }

    /// Adds the hull of a piece's points, grown by the piece's radius. A flat hull without a radius is not drawn.
    fn push_hull(&mut self, piece: &Piece<'_>) {
        let sphere_points: Vec<DVec3> = if piece.radius > 0.0 {
            sphere_directions()
                .map(|direction| piece.radius * direction)
                .collect()
        } else {
            vec![DVec3::ZERO]
        };
        let points = piece
            .points
            .iter()
            .flat_map(|point| sphere_points.iter().map(move |by| *point + *by));
        let points: Vec<_> = points.collect();
        let parry_points: Vec<_> = points.iter().map(|p| (*p).to_array().into()).collect();
        let Ok((corners, faces)) = try_convex_hull(&parry_points) else {
            return;
        };
        // parry finds no hull of denormal points, which are too small to draw.
        if !corners.iter().all(|corner| corner.is_finite()) {
            return;
        }
        for face in faces {
            self.push(face.map(|k| DVec3::from_array(corners[k as usize].into())));
        }
    }
}

/// Returns evenly distributed unit vectors on a spiral from pole to pole.
fn sphere_directions() -> impl Iterator<Item = DVec3> {
    let golden_angle = PI * (3.0 - 5f64.sqrt());
    (0..SPHERE_POINT_COUNT).map(move |k| {
        let z = 1.0 - (2.0 * f64::from(k) + 1.0) / f64::from(SPHERE_POINT_COUNT);
        let (sine, cosine) = (golden_angle * f64::from(k)).sin_cos();
        let radius = (1.0 - z * z).sqrt();
        DVec3::new(radius * cosine, radius * sine, z)
    })
}
