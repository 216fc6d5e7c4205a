//! Computes points for each part, such that the hulls of all parts together cover the solid.
//!
//! Take the hull of the part of a solid in a box. A corner of it is on the solid's surface, or a corner of the
//! box: through any other point a straight line continues in the solid and the box both ways. Therefore the
//! surface in a part's cubes, and those corners of the cubes that are in the solid, have a hull that contains all
//! that the solid has in those cubes. A corner whose eight cubes belong to one part is no corner of the hull, by
//! the same argument.

use super::target::Target;
use super::voxels::{Cell, VoxelGrid};
use crate::tolerance::edge_tolerance;
use crate::work::Work;
use ccd_core::glam::DVec3;
use ccd_core::vector::unit;
use rayon::prelude::*;

/// Returns points for each part. Their hull, enlarged by the rounding of cuts, contains the solid within the voxels
/// of the part.
pub(super) fn points_by_part(
    target: &Target<'_>,
    voxels: &VoxelGrid,
    labels: &[u32],
) -> Vec<Vec<DVec3>> {
    let count = labels.iter().max().map_or(0, |&last| last as usize + 1);
    let mut parts = vec![Vec::new(); count];
    let near = edge_tolerance(target.farthest_coordinate());
    let triangles: Vec<_> = target.triangles().collect();
    let on_surface: Vec<_> = triangles
        .par_chunks(TRIANGLES_PER_TASK)
        .flat_map_iter(|triangles| cut_triangles(triangles, voxels, labels, near))
        .collect();
    let inside = corners_between_parts(target, voxels, labels);
    for (part, point) in on_surface.into_iter().chain(inside) {
        parts[part as usize].push(point);
    }
    parts
}

/// The number of triangles in a parallel task.
const TRIANGLES_PER_TASK: usize = 1024;

/// Cuts triangles at the voxels of different parts. Returns the corners of the polygons, each with its part number.
fn cut_triangles(
    triangles: &[[DVec3; 3]],
    voxels: &VoxelGrid,
    labels: &[u32],
    near: f64,
) -> Vec<(u32, DVec3)> {
    let (mut all, mut of_one) = (Vec::new(), Vec::new());
    for &triangle in triangles {
        voxels.for_each_labelled_polygon(triangle, labels, |part, polygon| {
            of_one.extend(polygon.iter().map(|&point| (part, point)));
        });
        of_one.sort_unstable_by_key(|&(part, _)| part);
        for of_part in of_one.chunk_by(|one, next| one.0 == next.0) {
            let points = of_part.iter().map(|&(_, point)| point).collect();
            let kept = remove_points_between(points, triangle, near);
            all.extend(kept.into_iter().map(|point| (of_part[0].0, point)));
        }
        of_one.clear();
    }
    all
}

/// Removes points on an edge of the triangle that are between two others, up to rounding.
fn remove_points_between(mut points: Vec<DVec3>, [a, b, c]: [DVec3; 3], near: f64) -> Vec<DVec3> {
    for [from, to] in [[a, b], [b, c], [c, a]] {
        let Some(along) = unit(to - from) else {
            continue;
        };
        let is_on = |p: &DVec3| (*p - from).cross(along).length() <= near;
        let height = |p: &DVec3| (*p - from).dot(along);
        let by_height = |p: &DVec3, q: &DVec3| height(p).total_cmp(&height(q));
        let on = || points.iter().copied().filter(is_on);
        let ends = [on().min_by(by_height), on().max_by(by_height)];
        points.retain(|p| !is_on(p) || ends.contains(&Some(*p)));
    }
    points
}

/// Returns each voxel corner that is in the solid, with every part that has a voxel at that corner. Corners whose
/// eight voxels all belong to one part are left out.
fn corners_between_parts(
    target: &Target<'_>,
    voxels: &VoxelGrid,
    labels: &[u32],
) -> Vec<(u32, DVec3)> {
    let [x, y, z] = voxels.axis_counts();
    let of_layer = |i: usize| {
        let places = (0..=y).flat_map(|j| (0..=z).map(move |k| [i, j, k]));
        let mut found = Vec::new();
        for place in places {
            let mut around: Vec<u32> = cells_around(voxels, place)
                .map(|cell| labels[cell])
                .collect();
            let is_complete = around.len() == 8;
            around.sort_unstable();
            around.dedup();
            let is_between = around.len() > 1 || !is_complete;
            let corner = voxels.corner(place);
            if is_between && target.winds_about(corner, &Work::unbounded()) {
                found.extend(around.into_iter().map(|part| (part, corner)));
            }
        }
        found
    };
    (0..=x).into_par_iter().flat_map_iter(of_layer).collect()
}

/// Iterates over the voxels around a grid corner, up to eight.
fn cells_around(voxels: &VoxelGrid, corner: Cell) -> impl Iterator<Item = usize> {
    let counts = voxels.axis_counts();
    (0..8_usize).filter_map(move |k| {
        let mut cell = corner;
        for (axis, place) in cell.iter_mut().enumerate() {
            *place = place.checked_sub(k >> axis & 1)?;
            if *place >= counts[axis] {
                return None;
            }
        }
        Some(voxels.index(cell))
    })
}

#[cfg(test)]
mod tests;
