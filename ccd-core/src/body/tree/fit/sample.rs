//! A sample of a node's points, on which the box sizes of many frames are compared quickly.

use super::NodePoints;
use crate::math::order::{greater, lesser};
use crate::math::vector::bounding_box;
use crate::tuning::MAX_SAMPLED_TRIANGLES;
use glam::{DMat3, DVec3, Vec3};

/// The number of points whose heights are computed at once by vector instructions.
const LANES: usize = 8;

const MAX_SAMPLE_POINTS: usize = 3 * MAX_SAMPLED_TRIANGLES;

/// A sample of a node's points, moved to the origin and scaled to unit size. The memory is reused by one sample after
/// the other.
#[derive(Clone, Debug)]
pub(crate) struct PointSample {
    point_buffer: [DVec3; MAX_SAMPLE_POINTS],
    count: usize,
    /// The points in blocks of eight x, y and z coordinates; the last block repeats the last point.
    blocks: [[[f32; LANES]; 3]; MAX_SAMPLE_POINTS / LANES],
}

impl PointSample {
    /// A sample without points: the initial value of memory that [`PointSample::fill_from`] fills.
    pub(crate) const EMPTY: PointSample = PointSample {
        point_buffer: [DVec3::ZERO; MAX_SAMPLE_POINTS],
        count: 0,
        blocks: [[[0.0; LANES]; 3]; MAX_SAMPLE_POINTS / LANES],
    };

    /// Fills the sample with a node's points, or with every k-th point if there are too many. Triangles are taken with
    /// all three corners.
    pub(in super::super) fn fill_from(&mut self, node_points: &NodePoints<'_>) {
        self.count = 0;
        let size = if node_points.are_triangles { 3 } else { 1 };
        let groups = node_points.points.len() / size;
        let step = groups.div_ceil(MAX_SAMPLE_POINTS / size).max(1);
        for group in (0..groups).step_by(step) {
            let points = &node_points.points[size * group..size * (group + 1)];
            self.point_buffer[self.count..][..size].copy_from_slice(points);
            self.count += size;
        }
        self.scale_to_unit_and_fill_blocks();
    }

    /// Returns the sampled points, moved to the origin and scaled to unit size.
    pub(super) fn points(&self) -> &[DVec3] {
        &self.point_buffer[..self.count]
    }

    /// Returns half the surface area of the sample's bounding box along the columns of a frame.
    pub(super) fn half_surface_area(&self, frame: &DMat3) -> f32 {
        let axes = [0, 1, 2].map(|k| frame.col(k).as_vec3());
        let mut low = [[f32::INFINITY; LANES]; 3];
        let mut high = [[f32::NEG_INFINITY; LANES]; 3];
        for [x, y, z] in &self.blocks[..self.count.div_ceil(LANES)] {
            for (k, Vec3 { x: a, y: b, z: c }) in axes.into_iter().enumerate() {
                for lane in 0..LANES {
                    let height = a * x[lane] + b * y[lane] + c * z[lane];
                    low[k][lane] = lesser(low[k][lane], height);
                    high[k][lane] = greater(high[k][lane], height);
                }
            }
        }
        let size = [0, 1, 2].map(|k| {
            let low = low[k].into_iter().fold(f32::INFINITY, lesser);
            high[k].into_iter().fold(f32::NEG_INFINITY, greater) - low
        });
        size[0] * size[1] + size[1] * size[2] + size[2] * size[0]
    }

    fn scale_to_unit_and_fill_blocks(&mut self) {
        let (low, high) = bounding_box(self.points().iter().copied());
        let middle = 0.5 * (low + high);
        // If the length is too short, it has no reciprocal.
        let scale = Some((high - low).max_element().recip()).filter(|s| s.is_finite());
        for point in &mut self.point_buffer[..self.count] {
            *point = (*point - middle) * scale.unwrap_or(1.0);
        }
        let Some(&last) = self.points().last() else {
            return;
        };
        for (k, block) in self.blocks[..self.count.div_ceil(LANES)]
            .iter_mut()
            .enumerate()
        {
            for lane in 0..LANES {
                let at = k * LANES + lane;
                let point = if at < self.count {
                    self.point_buffer[at]
                } else {
                    last
                };
                for (row, x) in block.iter_mut().zip(point.as_vec3().to_array()) {
                    row[lane] = x;
                }
            }
        }
    }
}
