//! The voxel grid of a mesh, and cuts of triangles at voxels.

use super::target::Target;
use crate::tolerance::{self, MAX_VOXEL_TESTS, voxel_resolution};
use ccd_core::glam::DVec3;
use ccd_core::order::{greater, lesser};
use std::ops::RangeInclusive;

/// A voxel grid over a mesh. Its planes are at stored coordinates, so that adjacent voxels share planes exactly.
pub(super) struct VoxelGrid {
    planes: [Vec<f64>; 3],
    /// The lower corner of the mesh, which is the centre of the first voxel.
    origin: DVec3,
    /// The side length of a voxel.
    step: f64,
    resolution: u32,
    /// The margin by which voxels are widened for cuts, so that rounding loses nothing.
    margin: f64,
}

/// The indices of a voxel along each axis.
pub(super) type Cell = [usize; 3];

impl VoxelGrid {
    /// Creates the grid for a number of hulls. It is coarser if large triangles meet too many voxels; `None` if
    /// coordinates are too coarse for any grid.
    pub(super) fn new(target: &Target<'_>, hulls: u32) -> Option<Self> {
        let mut resolution = voxel_resolution(hulls);
        // Halved at most a few times.
        while resolution >= tolerance::MIN_VOXEL_RESOLUTION {
            let voxels = VoxelGrid::with_resolution(target, resolution)?;
            if voxels.is_affordable(target) {
                return Some(voxels);
            }
            resolution /= 2;
        }
        None
    }

    fn with_resolution(target: &Target<'_>, resolution: u32) -> Option<Self> {
        let [lo, hi] = target.bounds();
        let step = (hi - lo).max_element() / f64::from(resolution - 1);
        let margin = tolerance::clip_rounding(target.farthest_coordinate());
        // Written so that NaN fails.
        if !(step > tolerance::MIN_VOXEL_SIZE * margin) {
            return None;
        }
        let planes = [0, 1, 2].map(|axis| {
            let count = ((hi[axis] - lo[axis]) / step + 0.5) as usize + 1;
            let plane = |k: usize| lo[axis] + (k as f64 - 0.5) * step;
            (0..=count).map(plane).collect()
        });
        Some(VoxelGrid {
            planes,
            origin: lo,
            step,
            resolution,
            margin,
        })
    }

    fn is_affordable(&self, target: &Target<'_>) -> bool {
        let boxed = |t| {
            self.voxel_ranges(t)
                .map(|r| r.count())
                .iter()
                .product::<usize>()
        };
        target.triangles().map(boxed).sum::<usize>() <= MAX_VOXEL_TESTS
    }

    pub(super) fn resolution(&self) -> u32 {
        self.resolution
    }

    /// Converts a point to grid units. The origin is the centre of the first voxel.
    pub(super) fn to_grid_units(&self, point: DVec3) -> DVec3 {
        (point - self.origin) / self.step
    }

    pub(super) fn axis_counts(&self) -> [usize; 3] {
        [0, 1, 2].map(|axis| self.planes[axis].len() - 1)
    }

    pub(super) fn len(&self) -> usize {
        self.axis_counts().iter().product()
    }

    pub(super) fn index(&self, [i, j, k]: Cell) -> usize {
        let [_, y, z] = self.axis_counts();
        (i * y + j) * z + k
    }

    pub(super) fn cell_of(&self, index: usize) -> Cell {
        let [_, y, z] = self.axis_counts();
        [index / z / y, index / z % y, index % z]
    }

    /// Iterates over the voxels that share a face with the voxel `cell`.
    pub(super) fn neighbours(&self, cell: Cell) -> impl Iterator<Item = usize> {
        let counts = self.axis_counts();
        (0..6).filter_map(move |k| {
            let (axis, mut next) = (k / 2, cell);
            next[axis] = match k % 2 {
                0 => next[axis].checked_sub(1)?,
                _ => next[axis] + 1,
            };
            (next[axis] < counts[axis]).then(|| self.index(next))
        })
    }

    /// Returns the intersection point of three grid planes, by their indices.
    pub(super) fn corner(&self, [i, j, k]: Cell) -> DVec3 {
        DVec3::new(self.planes[0][i], self.planes[1][j], self.planes[2][k])
    }

    /// Returns the range of voxels along each axis that a triangle's bounding box may meet, slightly widened.
    fn voxel_ranges(&self, triangle: [DVec3; 3]) -> [RangeInclusive<usize>; 3] {
        let counts = self.axis_counts();
        [0, 1, 2].map(|axis| {
            let place = |p: DVec3| (p[axis] - self.origin[axis]) / self.step + 0.5;
            let places = triangle.map(place);
            let lo = places.iter().copied().fold(f64::INFINITY, lesser) - 0.125;
            let hi = places.iter().copied().fold(f64::NEG_INFINITY, greater) + 0.125;
            // Conversions saturate.
            let last = counts[axis] - 1;
            (lo as usize).min(last)..=(hi as usize).min(last)
        })
    }

    /// Cuts a triangle where part labels change. Calls `visit` with each label and a polygon, whose hull, enlarged by
    /// the margin, contains the triangle within the label's voxels.
    ///
    /// Cuts make corners that are nearly collinear. Blocks of voxels are therefore halved only while their labels
    /// differ.
    pub(super) fn for_each_labelled_polygon(
        &self,
        triangle: [DVec3; 3],
        labels: &[u32],
        mut visit: impl FnMut(u32, &[DVec3]),
    ) {
        let mut stack = vec![(self.voxel_ranges(triangle), triangle.to_vec())];
        // Terminates: blocks are halved, and a single voxel has one label.
        while let Some((block, polygon)) = stack.pop() {
            if polygon.is_empty() {
                continue;
            }
            let [xs, ys, zs] = block.clone();
            let (first, mut rows) = (
                labels[self.index([*xs.start(), *ys.start(), *zs.start()])],
                xs.flat_map(|i| ys.clone().map(move |j| (i, j))),
            );
            let is_first = |(i, j)| {
                let row = self.index([i, j, *zs.start()])..=self.index([i, j, *zs.end()]);
                labels[row].iter().all(|&label| label == first)
            };
            if rows.all(is_first) {
                visit(first, &polygon);
                continue;
            }
            let length = |axis: &usize| block[*axis].end() - block[*axis].start();
            let axis = (0..3).max_by_key(length).unwrap_or(0);
            let (start, end) = (*block[axis].start(), *block[axis].end());
            let middle = start + (end - start) / 2;
            for half in [middle + 1..=end, start..=middle] {
                let (mut piece, mut block) = (Vec::new(), block.clone());
                self.clip_to_layers(&polygon, axis, half.clone(), &mut piece);
                block[axis] = half;
                stack.push((block, piece));
            }
        }
    }

    /// Clips a polygon to some layers of voxels, widened by the margin.
    fn clip_to_layers(
        &self,
        polygon: &[DVec3],
        axis: usize,
        layers: RangeInclusive<usize>,
        part: &mut Vec<DVec3>,
    ) {
        let planes = &self.planes[axis];
        let lo = planes[*layers.start()] - self.margin;
        let hi = planes[*layers.end() + 1] + self.margin;
        let mut above = Vec::with_capacity(polygon.len() + 1);
        clip_to_half_space(polygon, axis, |x| x >= lo, lo, &mut above);
        clip_to_half_space(&above, axis, |x| x <= hi, hi, part);
    }
}

/// Clips a triangle to a box.
pub(super) fn clip_to_box(triangle: &[DVec3; 3], [lo, hi]: [DVec3; 2], part: &mut Vec<DVec3>) {
    let mut rest = Vec::new();
    part.clear();
    part.extend(triangle);
    for axis in 0..3 {
        clip_to_half_space(part, axis, |x| x >= lo[axis], lo[axis], &mut rest);
        clip_to_half_space(&rest, axis, |x| x <= hi[axis], hi[axis], part);
    }
}

/// Clips a convex polygon to one side of a plane (Sutherland and Hodgman).
fn clip_to_half_space(
    polygon: &[DVec3],
    axis: usize,
    keeps: impl Fn(f64) -> bool,
    plane: f64,
    part: &mut Vec<DVec3>,
) {
    part.clear();
    let next = polygon.iter().cycle().skip(1);
    for (&p, &q) in polygon.iter().zip(next) {
        if keeps(p[axis]) {
            part.push(p);
        }
        if keeps(p[axis]) != keeps(q[axis]) {
            // An edge gives the same point from either side.
            let (p, q) = if p[axis] < q[axis] { (p, q) } else { (q, p) };
            let mut between = p + (plane - p[axis]) / (q[axis] - p[axis]) * (q - p);
            between[axis] = plane;
            part.push(between);
        }
    }
}

#[cfg(test)]
mod tests;
