//! Decides with exact arithmetic whether a piece's facets bound a convex polytope.

use crate::body::facets::{edges_of, fan_triangles};
use crate::body::piece::Piece;
use crate::body::support::SupportMap;
use crate::math::exact::{
    first_underflow_prone_point_index, ray_meets_one_triangle, side_of_plane,
};
use glam::DVec3;

/// Builds the search structure for extremal points of a hull with many points. Edges are climbed if they are proven to
/// be those of the hull. Otherwise a tree is searched, which uses no facets.
pub(crate) fn build_support_map(hull: &Piece<'_>) -> SupportMap {
    if is_convex(hull) {
        SupportMap::new(hull.points, hull.facets)
    } else {
        SupportMap::from_points(hull.points)
    }
}

/// Returns whether the facets bound a convex polytope of which every point is a corner.
///
/// # Guarantee
/// A positive answer is exact. The facets are treated as fans of triangles, no two of which have a side in the same
/// direction. From a point behind all of them, their surface covers all directions equally often, and exactly once if
/// a single direction is covered once. Such a surface is that of a convex polytope if it bends inward at no edge
/// `[MEHLHORN96]`. If the triangles of each facet are coplanar and its outline turns one way only, the facet is a
/// convex part of a face. From every corner of the facet an edge then leads up along any direction that goes up from
/// there in that face.
fn is_convex(hull: &Piece<'_>) -> bool {
    if hull.facets.is_empty() || first_underflow_prone_point_index(hull.points).is_some() {
        return false;
    }
    let middle = hull.points.iter().sum::<DVec3>() / hull.points.len() as f64;
    let mut on_facets = vec![false; hull.points.len()];
    let mut triangles: Vec<[u32; 3]> = Vec::new();
    for corners in hull.facets.iter() {
        corners.iter().for_each(|&v| on_facets[v as usize] = true);
        triangles.extend(fan_triangles(corners));
        if !are_coplanar(hull.points, corners) || !is_convex_polygon(hull.points, corners, middle) {
            return false;
        }
    }
    let position = |triangle: &[u32; 3]| triangle.map(|v| hull.points[v as usize]);
    let behind = |triangle: &[u32; 3]| side_of_plane(position(triangle), middle).is_lt();
    on_facets.into_iter().all(|on| on)
        && triangles.iter().all(behind)
        && is_locally_convex(&triangles, position)
        && middle_ray_hits_once(&triangles, position, middle)
}

/// Returns whether all corners are in the plane of the first three.
fn are_coplanar(points: &[DVec3], corners: &[u32]) -> bool {
    let position = |&v: &u32| points[v as usize];
    let first = [0, 1, 2].map(|k| position(&corners[k]));
    let mut others = corners[3..].iter().map(position);
    others.all(|p| side_of_plane(first, p).is_eq())
}

/// Returns whether a facet is a convex polygon: seen from the point `middle` behind it, no corner is reflex.
fn is_convex_polygon(points: &[DVec3], corners: &[u32], middle: DVec3) -> bool {
    let position = |k: usize| points[corners[k % corners.len()] as usize];
    let fan = |k: usize| [position(k), position(k + 1), position(k + 2)];
    (0..corners.len()).all(|k| side_of_plane(fan(k), middle).is_le())
}

/// Returns whether the surface is locally convex: the neighbour across every edge is not in front of the triangle's
/// plane.
fn is_locally_convex(triangles: &[[u32; 3]], position: impl Fn(&[u32; 3]) -> [DVec3; 3]) -> bool {
    let mut sides: Vec<((u32, u32), &[u32; 3])> = triangles
        .iter()
        .flat_map(|triangle| edges_of(triangle).map(move |side| (side, triangle)))
        .collect();
    sides.sort_unstable();
    let once = sides.windows(2).all(|pair| pair[0].0 != pair[1].0);
    let across = |&(from, to): &(u32, u32)| {
        let at = sides.binary_search_by_key(&(to, from), |&(side, _)| side);
        at.ok().map(|at| sides[at].1)
    };
    let bends = |(edge, triangle): &((u32, u32), &[u32; 3])| {
        let next = across(edge);
        next.is_some_and(|next| {
            let mut corners = position(next).into_iter();
            corners.all(|p| side_of_plane(position(triangle), p).is_le())
        })
    };
    once && sides.iter().all(bends)
}

/// Returns whether the ray from `middle` through the first triangle meets no other triangle and no edge.
fn middle_ray_hits_once(
    triangles: &[[u32; 3]],
    position: impl Fn(&[u32; 3]) -> [DVec3; 3],
    middle: DVec3,
) -> bool {
    triangles.first().is_some_and(|first| {
        let target = position(first).into_iter().sum::<DVec3>() / 3.0;
        ray_meets_one_triangle(triangles.iter().map(position), middle, target)
    })
}

#[cfg(test)]
mod tests;
