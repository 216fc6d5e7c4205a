//! Assigns voxels to parts, by the library's V-HACD.

use super::target::Target;
use super::voxels::VoxelGrid;
use crate::tolerance::{MAX_VHACD_PARTS, PARTS_PER_HULL, VHACD_BALANCE_WEIGHT, VHACD_CONCAVITY};
use ccd_core::glam::DVec3;
use parry3d_f64::math::Vector;
use parry3d_f64::transformation::vhacd::{VHACD, VHACDParameters};
use parry3d_f64::transformation::voxelization::FillMode;
use std::collections::VecDeque;
use std::panic::catch_unwind;

/// Returns the part number of every voxel; `None` if the library fails.
///
/// Voxels that the library omits get the part of a nearby voxel. The guarantee holds for any labels.
pub(super) fn label_voxels(
    target: &Target<'_>,
    voxels: &VoxelGrid,
    hulls: u32,
) -> Option<Vec<u32>> {
    let parts = run_vhacd(target, voxels, hulls)?;
    const NONE: u32 = u32::MAX;
    let counts = voxels.axis_counts();
    let mut labels = vec![NONE; voxels.len()];
    let mut queue = VecDeque::new();
    for (cell, part) in parts {
        if cell.iter().zip(counts).all(|(&k, count)| k < count) {
            let index = voxels.index(cell);
            labels[index] = part;
            queue.push_back(index);
        }
    }
    while let Some(index) = queue.pop_front() {
        for next in voxels.neighbours(voxels.cell_of(index)) {
            if labels[next] == NONE {
                labels[next] = labels[index];
                queue.push_back(next);
            }
        }
    }
    // Without labels from the library, all voxels are one part.
    for label in labels.iter_mut().filter(|label| **label == NONE) {
        *label = 0;
    }
    Some(labels)
}

/// Assigns voxels to parts by V-HACD. There are more parts than requested hulls; the library makes up to twice its
/// parameter.
fn run_vhacd(
    target: &Target<'_>,
    voxels: &VoxelGrid,
    hulls: u32,
) -> Option<Vec<([usize; 3], u32)>> {
    let fill_mode = if target.is_closed() {
        FillMode::FloodFill {
            detect_cavities: true,
        }
    } else {
        FillMode::SurfaceOnly
    };
    let parts = hulls.saturating_mul(PARTS_PER_HULL).min(MAX_VHACD_PARTS);
    let parameters = VHACDParameters {
        resolution: voxels.resolution(),
        concavity: VHACD_CONCAVITY,
        max_convex_hulls: parts,
        fill_mode,
        alpha: VHACD_BALANCE_WEIGHT,
        ..VHACDParameters::default()
    };
    // Scaled to suit the library's absolute tolerances.
    let scale = f64::from(voxels.resolution() - 1);
    let scaled = |p: DVec3| Vector::from((voxels.to_grid_units(p) / scale).to_array());
    let points: Vec<Vector> = target.triangles().flatten().map(scaled).collect();
    let faces: Vec<[u32; 3]> = (0..target.triangles().len() as u32)
        .map(|k| [3 * k, 3 * k + 1, 3 * k + 2])
        .collect();
    // The library asserts conditions that rounding can violate.
    let found = catch_unwind(|| VHACD::decompose(&parameters, &points, &faces, false)).ok()?;
    let mut cells = Vec::new();
    for (part, voxels) in found.voxel_parts().iter().enumerate() {
        let place = |k: i64| usize::try_from(k).unwrap_or(usize::MAX);
        let of_part = voxels.voxels().iter().map(|voxel| {
            let cell = voxel.coords;
            ([place(cell.x), place(cell.y), place(cell.z)], part as u32)
        });
        cells.extend(of_part);
    }
    Some(cells)
}
