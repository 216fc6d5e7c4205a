//! Computes points for each part, such that the hulls of all parts together cover the solid.
//!
//! Take the hull of the part of a solid in a box. A corner of it is on the solid's surface, or a corner of the
//! box: through any other point a straight line continues in the solid and the box both ways. Therefore the
//! surface in a part's cubes, and those corners of the cubes that are in the solid, have a hull that contains all
//! that the solid has in those cubes. A corner whose eight cubes belong to one part is no corner of the hull, by
//! the same argument.

use super::target::Target;
use super::voxels::{Cell, Voxels};
use crate::exact::predicates::lexicographic;
use crate::tolerance::on_edge_distance;
use crate::work::Work;
use ccd_core::glam::DVec3;
use ccd_core::vector::unit;
use rayon::prelude::*;

/// The relation of a voxel to the solid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum VoxelClass {
    /// The voxel is not classified yet.
    Unknown,
    /// The voxel meets the surface.
    Surface,
    /// The voxel lies inside the solid.
    Full,
    /// The voxel lies outside the solid.
    Nothing,
}

/// Returns points for each part. Their hull, enlarged by the rounding of cuts, contains the solid within the voxels
/// of the part.
pub(super) fn points_by_part(
    target: &Target<'_>,
    voxels: &Voxels,
    contents: &[VoxelClass],
    mut labels: Vec<u32>,
) -> Vec<Vec<DVec3>> {
    let count = labels.iter().max().map_or(0, |&last| last as usize + 1);
    let mut parts = vec![Vec::new(); count];
    let near = on_edge_distance(target.farthest_coordinate());
    let triangles: Vec<_> = target.triangles().collect();
    let pieces: Vec<_> = triangles
        .par_chunks(TRIANGLES_PER_TASK)
        .map(|triangles| cut_triangles(triangles, voxels, &labels, near))
        .collect();
    for (part, point) in pieces.into_iter().flatten() {
        parts[part as usize].push(point);
    }
    for (label, content) in labels.iter_mut().zip(contents) {
        if *content == VoxelClass::Nothing {
            *label = NO_PART;
        }
    }
    add_corners(target, voxels, contents, &labels, &mut parts);
    parts.into_par_iter().map(remove_duplicates).collect()
}

/// The label of a voxel outside the solid.
const NO_PART: u32 = u32::MAX;

/// The number of triangles in a parallel task.
const TRIANGLES_PER_TASK: usize = 1024;

/// Classifies every voxel as on the surface, inside or outside.
pub(super) fn classify_voxels(target: &Target<'_>, voxels: &Voxels) -> Vec<VoxelClass> {
    let triangles: Vec<_> = target.triangles().collect();
    let met = |triangles: &[[DVec3; 3]]| {
        let mut cells = Vec::new();
        for &triangle in triangles {
            voxels.for_each_voxel_met(triangle, |cell| cells.push(cell));
        }
        cells.sort_unstable();
        cells.dedup();
        cells
    };
    let met: Vec<_> = triangles.par_chunks(TRIANGLES_PER_TASK).map(met).collect();
    let mut contents = vec![VoxelClass::Unknown; voxels.len()];
    for cell in met.into_iter().flatten() {
        contents[cell] = VoxelClass::Surface;
    }
    classify_remaining(target, voxels, &mut contents);
    contents
}

/// Cuts triangles at the voxels of different parts. Returns the corners of the polygons, each with its part number.
fn cut_triangles(
    triangles: &[[DVec3; 3]],
    voxels: &Voxels,
    labels: &[u32],
    near: f64,
) -> Vec<(u32, DVec3)> {
    let (mut all, mut of_one) = (Vec::new(), Vec::new());
    for &triangle in triangles {
        voxels.for_each_piece(triangle, labels, |part, polygon| {
            of_one.extend(polygon.iter().map(|&point| (part, point)));
        });
        of_one.sort_unstable_by_key(|&(part, _)| part);
        for of_part in of_one.chunk_by(|one, next| one.0 == next.0) {
            let points = of_part.iter().map(|&(_, point)| point).collect();
            let kept = remove_between(points, triangle, near);
            all.extend(kept.into_iter().map(|point| (of_part[0].0, point)));
        }
        of_one.clear();
    }
    all
}

/// Removes points on an edge of the triangle that are between two others, up to rounding.
fn remove_between(mut points: Vec<DVec3>, [a, b, c]: [DVec3; 3], near: f64) -> Vec<DVec3> {
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

/// Removes duplicate points.
pub(super) fn remove_duplicates(mut points: Vec<DVec3>) -> Vec<DVec3> {
    points.sort_unstable_by(|&p, &q| lexicographic(p, q));
    points.dedup();
    points
}

/// Classifies the voxels that do not meet the surface: connected ones are all inside or all outside.
fn classify_remaining(target: &Target<'_>, voxels: &Voxels, contents: &mut [VoxelClass]) {
    let mut stack = Vec::new();
    for seed in 0..contents.len() {
        if contents[seed] != VoxelClass::Unknown {
            continue;
        }
        let content = if target.winds_about(voxels.corner(voxels.cell_of(seed)), &Work::unbounded())
        {
            VoxelClass::Full
        } else {
            VoxelClass::Nothing
        };
        contents[seed] = content;
        stack.push(seed);
        while let Some(cell) = stack.pop() {
            for next in voxels.neighbours(voxels.cell_of(cell)) {
                if contents[next] == VoxelClass::Unknown {
                    contents[next] = content;
                    stack.push(next);
                }
            }
        }
    }
}

/// Adds each voxel corner that is in the solid to every part with a voxel at that corner. Corners whose eight voxels
/// all belong to one part are left out.
fn add_corners(
    target: &Target<'_>,
    voxels: &Voxels,
    contents: &[VoxelClass],
    labels: &[u32],
    parts: &mut [Vec<DVec3>],
) {
    let [x, y, z] = voxels.counts();
    for i in 0..=x {
        for j in 0..=y {
            for k in 0..=z {
                let mut around: Vec<usize> = cells_around(voxels, [i, j, k]).collect();
                let first = labels[around[0]];
                if around.len() == 8 && around.iter().all(|&cell| labels[cell] == first) {
                    continue;
                }
                let corner = voxels.corner([i, j, k]);
                let has = |content| around.iter().any(|&cell| contents[cell] == content);
                let inside = match (has(VoxelClass::Full), has(VoxelClass::Nothing)) {
                    (true, _) => true,
                    (_, true) => false,
                    _ => target.winds_about(corner, &Work::unbounded()),
                };
                if inside {
                    around.sort_unstable_by_key(|&cell| labels[cell]);
                    around.dedup_by_key(|cell| labels[*cell]);
                    let labelled = around.iter().filter(|&&cell| labels[cell] != NO_PART);
                    labelled.for_each(|&cell| parts[labels[cell] as usize].push(corner));
                }
            }
        }
    }
}

/// Iterates over the voxels around a grid corner, up to eight.
fn cells_around(voxels: &Voxels, corner: Cell) -> impl Iterator<Item = usize> {
    let counts = voxels.counts();
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
