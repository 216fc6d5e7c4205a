//! Checks convex patches of a closed surface, by exact arithmetic. The hull is in the solid, the faces are on the hull,
//! and the names are right.

use crate::checks::CheckResult;
use crate::exact::{
    ConvexCombination, Location, SampleCounts, Solid, is_convex_polygon, is_degenerate, samples,
    side_of, triangle_contains_point,
};
use crate::models::Mesh;
use ccd_core::glam::DVec3;
use ccd_core::{Facet, FacetOrigin, Polytope};
use std::cmp::Ordering;
use std::collections::HashMap;

/// A convex patch to check: faces of a mesh, and the polytope that represents them.
#[derive(Clone, Debug)]
pub struct Claim<'a> {
    /// The numbers of the mesh faces in the patch.
    pub faces: &'a [u32],
    /// The polytope that should be the convex hull of the faces.
    pub polytope: &'a Polytope,
}

/// Checks that every face of a mesh is in exactly one patch.
///
/// # Errors
/// Names the face that is not in exactly one patch.
pub fn check_partition(mesh: &Mesh, claims: &[Claim<'_>]) -> CheckResult {
    let mut count = vec![0; mesh.faces.len()];
    for &face in claims.iter().flat_map(|claim| claim.faces) {
        *count
            .get_mut(face as usize)
            .ok_or_else(|| format!("there is no face {face}"))? += 1;
    }
    match count.iter().position(|&n| n != 1) {
        Some(face) => Err(format!("face {face} is of {} patches", count[face])),
        None => Ok(()),
    }
}

/// Checks that sampled points of a patch's hull are inside the solid or on its surface. Returns the number of points.
///
/// # Errors
/// Names the point that is outside the solid.
pub fn check_hull_in_solid(
    solid: &Solid<'_>,
    claim: &Claim<'_>,
    effort: SampleCounts,
    seed: u64,
) -> Result<usize, String> {
    let all = samples(claim.polytope, effort, seed);
    match all.iter().find(|p| solid.locate(p) == Location::Outside) {
        Some(p) => Err(format!(
            "{p:?} is outside, in the hull of {:?}",
            claim.faces
        )),
        None => Ok(all.len()),
    }
}

/// Checks that a patch's points are vertices of the mesh, that its facets bound its hull, and that its face numbers are
/// right.
///
/// # Errors
/// Names the point, facet or face that is not.
pub fn check_polytope(mesh: &Mesh, claim: &Claim<'_>) -> CheckResult {
    check_vertex_ids(mesh, claim.polytope)?;
    check_hull(claim.polytope)?;
    check_face_names(mesh, claim)
}

fn check_vertex_ids(mesh: &Mesh, polytope: &Polytope) -> CheckResult {
    if polytope.points.len() != polytope.vertex_ids.len() || polytope.radius != 0.0 {
        return Err("not as many numbers as points, or a radius".into());
    }
    for (k, (p, &id)) in polytope.points.iter().zip(&polytope.vertex_ids).enumerate() {
        if mesh.vertices.get(id as usize) != Some(p) {
            return Err(format!("{p} is not vertex {id}"));
        }
        if polytope.points[..k].contains(p) {
            return Err(format!("{p} is there twice"));
        }
    }
    Ok(())
}

/// Checks that the facets are convex polygons with no point in front of them, and together form a closed surface.
fn check_hull(polytope: &Polytope) -> CheckResult {
    let points = &polytope.points;
    let spots: Vec<ConvexCombination> = points
        .iter()
        .map(|&p| ConvexCombination::mean([p]))
        .collect();
    let mut edges: HashMap<(u32, u32), i32> = HashMap::new();
    for facet in &polytope.facets {
        let corners = &facet.corners;
        for k in 0..corners.len() {
            let (v, w) = (corners[k], corners[(k + 1) % corners.len()]);
            *edges.entry((v, w)).or_default() += 1;
            *edges.entry((w, v)).or_default() -= 1;
        }
        let fan: Vec<[DVec3; 3]> = triangles(polytope, corners).collect();
        let polygon: Vec<DVec3> = corners.iter().map(|&c| points[c as usize]).collect();
        if fan.is_empty() || !is_convex_polygon(&polygon) {
            return Err(format!("{facet:?} has no area, or is not convex"));
        }
        for triangle in fan {
            let front = |p: &&ConvexCombination| side_of(triangle, p) == Ordering::Greater;
            if let Some(p) = spots.iter().find(front) {
                return Err(format!("{p:?} is in front of {facet:?}"));
            }
        }
    }
    match edges.iter().find(|edge| *edge.1 != 0) {
        Some((edge, _)) => Err(format!("the facets are open at {edge:?}")),
        None if polytope.facets.len() < 2 => Err("too few facets".into()),
        None => Ok(()),
    }
}

/// Returns triangles that make up a convex polygon, without those of no area.
fn triangles<'a>(
    polytope: &'a Polytope,
    corners: &'a [u32],
) -> impl Iterator<Item = [DVec3; 3]> + 'a {
    let at = |k: usize| polytope.points[corners[k] as usize];
    let fan = (2..corners.len()).map(move |k| [at(0), at(k - 1), at(k)]);
    fan.filter(|triangle| !is_degenerate(*triangle))
}

/// Checks that every face of the patch is named exactly once, by a facet that equals or contains the face, with outward
/// orientation.
fn check_face_names(mesh: &Mesh, claim: &Claim<'_>) -> CheckResult {
    let polytope = claim.polytope;
    let (mut named, inside_out) = (Vec::new(), mesh.signed_volume() < 0.0);
    for facet in &polytope.facets {
        if let FacetOrigin::Face(id) = facet.origin {
            named.push(id);
            let corners = facet.corners.iter().map(|&c| polytope.points[c as usize]);
            if !is_same_cycle(
                &corners.collect::<Vec<_>>(),
                outward_corners(mesh, id, inside_out)?,
            ) {
                return Err(format!("{facet:?} is not face {id}"));
            }
        }
    }
    for it in &polytope.faces {
        named.push(it.id);
        if !is_same_cycle(&it.corners, outward_corners(mesh, it.id, inside_out)?) {
            return Err(format!("{it:?} is not face {}", it.id));
        }
        let holds = |corners: &[u32]| {
            it.corners
                .iter()
                .all(|&p| polygon_contains_point(polytope, corners, p))
        };
        let is_whole = |facet: &&Facet| matches!(facet.origin, FacetOrigin::Face(_));
        let mut others = polytope.facets.iter().filter(|it| !is_whole(it));
        if !others.any(|facet| holds(&facet.corners)) {
            return Err(format!("{it:?} lies on no facet that is not a face"));
        }
    }
    check_merged_facets(polytope)?;
    named.sort_unstable();
    let mut faces = claim.faces.to_vec();
    faces.sort_unstable();
    if named == faces {
        Ok(())
    } else {
        Err(format!(
            "the faces are {faces:?}, but named are {named:?}: {polytope:?}"
        ))
    }
}

/// Checks that a facet merged from several faces is covered by them, at sampled points.
fn check_merged_facets(polytope: &Polytope) -> CheckResult {
    let merged = |facet: &&Facet| facet.origin == FacetOrigin::Faces;
    for facet in polytope.facets.iter().filter(merged) {
        let corners: Vec<DVec3> = facet
            .corners
            .iter()
            .map(|&c| polytope.points[c as usize])
            .collect();
        // Points between the middle and each edge, and nearer to each corner.
        let inner = (0..2 * corners.len()).map(|k| {
            let drawn = [k / 2, k.div_ceil(2)].map(|k| (5, corners[k % corners.len()]));
            ConvexCombination::new(corners.iter().map(|&p| (1, p)).chain(drawn))
        });
        let on_face = |p: &ConvexCombination| {
            let mut faces = polytope.faces.iter();
            faces.any(|face| triangle_contains_point(face.corners, p))
        };
        if let Some(p) = inner.into_iter().find(|p| !on_face(p)) {
            return Err(format!("{p:?} is on no face of {facet:?}"));
        }
    }
    Ok(())
}

/// Returns the corners of a face, counter-clockwise seen from outside.
fn outward_corners(mesh: &Mesh, id: u32, inside_out: bool) -> Result<[DVec3; 3], String> {
    if id as usize >= mesh.faces.len() {
        return Err(format!("there is no face {id}"));
    }
    let [a, b, c] = mesh.triangle(id as usize);
    Ok(if inside_out { [a, c, b] } else { [a, b, c] })
}

/// Returns true if a loop of three vertices is the triangle `a b c`, from any start.
fn is_same_cycle(corners: &[DVec3], [a, b, c]: [DVec3; 3]) -> bool {
    [[a, b, c], [b, c, a], [c, a, b]]
        .iter()
        .any(|it| corners == it)
}

/// Returns true if a convex polygon of the polytope contains a point, by exact arithmetic.
fn polygon_contains_point(polytope: &Polytope, corners: &[u32], p: DVec3) -> bool {
    let spot = ConvexCombination::mean([p]);
    triangles(polytope, corners).any(|triangle| triangle_contains_point(triangle, &spot))
}
