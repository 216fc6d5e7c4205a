//! Computes the distances from points to pieces, to meshes, and to their features.

use crate::models::Mesh;
use crate::referee::{nearest_on_segment, nearest_on_triangle};
use ccd_core::glam::DVec3;
use ccd_core::order::{greater, lesser};
use ccd_core::{FacetOrigin, Feature, Piece, Polytope};

/// Returns the distance from a point to a piece in the world; 0 inside the piece.
pub(crate) fn distance_to_piece(
    p: DVec3,
    piece: &Piece<'_>,
    to_world: impl Fn(DVec3) -> DVec3,
) -> f64 {
    let points: Vec<DVec3> = piece.points.iter().map(|&q| to_world(q)).collect();
    let core = match points[..] {
        [a] => a.distance(p),
        [a, b] => nearest_on_segment(p, [a, b]).distance(p),
        [a, b, c] => nearest_on_triangle(p, [a, b, c]).distance(p),
        _ => {
            let loops: Vec<Vec<DVec3>> = piece
                .facets
                .iter()
                .map(|corners| corners.iter().map(|&c| points[c as usize]).collect())
                .collect();
            let normal = |l: &[DVec3]| -> DVec3 {
                let fan = l.windows(2).skip(1);
                fan.map(|e| (e[0] - l[0]).cross(e[1] - l[0])).sum()
            };
            let height = |l: &Vec<DVec3>| normal(l).dot(p - l[0]);
            // A polygon has two facets and no interior.
            if loops.len() != 2 && loops.iter().all(|l| height(l) <= 0.0) {
                0.0
            } else {
                loops
                    .iter()
                    .map(|l| distance_to_polygon(p, l))
                    .fold(f64::INFINITY, lesser)
            }
        }
    };
    greater(0.0, core - piece.radius)
}

/// Returns the distance from a point to the surface of a mesh.
pub(crate) fn distance_to_mesh(p: DVec3, mesh: &Mesh, to_world: impl Fn(DVec3) -> DVec3) -> f64 {
    let off = |k| {
        let corners = mesh.triangle(k).map(&to_world);
        nearest_on_triangle(p, corners).distance(p)
    };
    (0..mesh.faces.len()).map(off).fold(f64::INFINITY, lesser)
}

/// Returns the distance from a point to a feature of a mesh.
///
/// # Errors
/// The mesh has no such feature.
pub fn distance_to_mesh_feature(
    p: DVec3,
    feature: Feature,
    mesh: &Mesh,
    to_world: impl Fn(DVec3) -> DVec3,
) -> Result<f64, String> {
    let vertex = |v: u32| mesh.vertices.get(v as usize).map(|&q| to_world(q));
    let bad = || format!("the mesh has no {feature}");
    match feature {
        Feature::Vertex(v) => Ok(vertex(v).ok_or_else(bad)?.distance(p)),
        Feature::Edge(v, w) => {
            let side = |f: &[u32; 3]| f.contains(&v) && f.contains(&w);
            mesh.faces.iter().find(|f| side(f)).ok_or_else(bad)?;
            let ends = [vertex(v).ok_or_else(bad)?, vertex(w).ok_or_else(bad)?];
            Ok(nearest_on_segment(p, ends).distance(p))
        }
        Feature::Face(f) => {
            mesh.faces.get(f as usize).ok_or_else(bad)?;
            let corners = mesh.triangle(f as usize).map(to_world);
            Ok(nearest_on_triangle(p, corners).distance(p))
        }
        Feature::Piece(_) => Err("a triangle's feature has a better name".into()),
    }
}

pub(crate) fn distance_to_part_feature(
    p: DVec3,
    feature: Feature,
    parts: &[Polytope],
    to_world: impl Fn(DVec3) -> DVec3,
) -> Result<f64, String> {
    let mut nearest = f64::INFINITY;
    for part in parts {
        let id = |k: usize| part.vertex_ids.get(k).copied().unwrap_or(k as u32);
        let named = |v: u32| (0..part.points.len()).find(|&k| id(k) == v);
        let vertex = |v: u32| named(v).map(|k| to_world(part.points[k]));
        let distance = match feature {
            Feature::Vertex(v) => vertex(v).map(|q| q.distance(p)),
            Feature::Edge(v, w) => vertex(v)
                .zip(vertex(w))
                .map(|(v, w)| nearest_on_segment(p, [v, w]).distance(p)),
            Feature::Face(f) => face_corners(part, f).map(|corners| {
                let corners: Vec<DVec3> = corners.into_iter().map(&to_world).collect();
                distance_to_polygon(p, &corners)
            }),
            // The interior: another check ensures that the witness lies in the piece.
            Feature::Piece(_) => Some(0.0),
        };
        if let Some(distance) = distance {
            nearest = lesser(nearest, distance - part.radius);
        }
    }
    if nearest == f64::INFINITY {
        Err(format!("no part has {feature}"))
    } else {
        Ok(nearest)
    }
}

/// Returns the corners of the face numbered `face` of a part; `None` if the part has no such face.
fn face_corners(part: &Polytope, face: u32) -> Option<Vec<DVec3>> {
    let mut facets = part.facets.iter();
    let whole = facets.find(|facet| facet.origin == FacetOrigin::Face(face));
    let corners = whole.map(|it| {
        it.corners
            .iter()
            .map(|&c| part.points[c as usize])
            .collect()
    });
    let triangle = || part.faces.iter().find(|it| it.id == face);
    corners.or_else(|| triangle().map(|it| it.corners.to_vec()))
}

fn distance_to_polygon(p: DVec3, corners: &[DVec3]) -> f64 {
    let fan =
        (1..corners.len().saturating_sub(1)).map(|k| [corners[0], corners[k], corners[k + 1]]);
    fan.map(|t| nearest_on_triangle(p, t).distance(p))
        .fold(f64::INFINITY, lesser)
}
