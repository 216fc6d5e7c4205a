//! Points whose hulls, part by part, cover a solid.
//!
//! A corner of the hull of what a solid has in a box is on the solid's surface, or a corner of the box:
//! anywhere else a straight line through it goes on in the solid and the box both ways. So the surface
//! in a part's cubes, and those of the cubes' corners that are in the solid, have a hull that contains
//! all that the solid has in those cubes. A corner whose eight cubes belong to one part is none of the
//! hull's, by the same argument.

use super::solid::Solid;
use super::voxels::{Cell, Voxels};
use ccd_core::glam::DVec3;

/// What a cube has of the solid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Content {
    /// Not known yet.
    Unknown,
    /// Some of the surface.
    Surface,
    /// All of it is in the solid.
    Full,
    /// None of it is.
    Nothing,
}

/// For every part the points whose hull, grown by the rounding of cuts, contains what the solid has in
/// the cubes of that label.
pub(super) fn points_by_part(
    solid: &Solid<'_>,
    voxels: &Voxels,
    mut labels: Vec<u32>,
) -> Vec<Vec<DVec3>> {
    let count = labels.iter().max().map_or(0, |&last| last as usize + 1);
    let mut parts = vec![Vec::new(); count];
    let mut contents = vec![Content::Unknown; voxels.len()];
    for triangle in solid.triangles() {
        voxels.for_each_met(triangle, |cell| contents[cell] = Content::Surface);
        voxels.for_each_piece(triangle, &labels, |part, polygon| {
            parts[part as usize].extend(polygon);
        });
    }
    fill(solid, voxels, &mut contents);
    for (label, content) in labels.iter_mut().zip(&contents) {
        if *content == Content::Nothing {
            *label = NO_PART;
        }
    }
    add_corners(solid, voxels, &contents, &labels, &mut parts);
    parts
}

/// The label of a cube that has nothing of the solid.
const NO_PART: u32 = u32::MAX;

/// Tells full cubes from empty ones: those that are connected without meeting the surface are alike.
fn fill(solid: &Solid<'_>, voxels: &Voxels, contents: &mut [Content]) {
    let mut stack = Vec::new();
    for seed in 0..contents.len() {
        if contents[seed] != Content::Unknown {
            continue;
        }
        let content = match solid.winds_about(voxels.corner(voxels.cell(seed))) {
            true => Content::Full,
            false => Content::Nothing,
        };
        contents[seed] = content;
        stack.push(seed);
        while let Some(cell) = stack.pop() {
            for next in voxels.neighbours(voxels.cell(cell)) {
                if contents[next] == Content::Unknown {
                    contents[next] = content;
                    stack.push(next);
                }
            }
        }
    }
}

/// Adds to the parts those corners of their cubes that are in the solid, but for corners amid one part.
fn add_corners(
    solid: &Solid<'_>,
    voxels: &Voxels,
    contents: &[Content],
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
                let inside = match (has(Content::Full), has(Content::Nothing)) {
                    (true, _) => true,
                    (_, true) => false,
                    _ => solid.winds_about(corner),
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

/// The cubes, up to eight, that a corner is one of.
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
