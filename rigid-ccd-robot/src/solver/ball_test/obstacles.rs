//! Lower bounds of the distances of eight points from an obstacle, and of one point from eight obstacles.

use super::error::UNIT_ROUNDOFF;
use crate::cell::part::HullPart;
use crate::cell::part::rounded_box::RoundedBox;
use ccd_core::fearless_simd::{Simd, f32x8, prelude::*};
use ccd_core::simd::{Vec3x8, load, splat};
use rigid_ccd::glam::{DVec3, Vec3};

/// The rounding error of a distance, in units of roundoff of the largest number that it is computed from: a rotation,
/// two sums and a length.
const DISTANCE_ERROR_ULPS: f64 = 32.0;

/// The obstacles of a cell: a rounded box around each part, or its half-space.
#[derive(Clone, Debug, Default)]
pub(super) struct Obstacles {
    pub(super) all: Vec<Obstacle>,
    /// The boxes, eight in each group. The last group is filled with copies of its last box.
    groups: Vec<BoxGroup>,
    half_spaces: Vec<u32>,
}

/// An obstacle's part.
#[derive(Clone, Copy, Debug)]
pub(super) struct Obstacle {
    shape: ObstacleShape,
    /// The index of the part in the cell.
    pub(super) part: usize,
    /// Whether the shape is the body itself. A point in an inexact shape may be outside the body.
    pub(super) is_exact: bool,
    /// An upper bound of the coordinates of the shape, without the radius.
    size: f64,
}

#[derive(Clone, Copy, Debug)]
enum ObstacleShape {
    Box(LaneBox),
    HalfSpace { normal: [f32; 3], offset: f32 },
}

/// A box with rounded edges. Its axes are the rows of a rotation, and `rotation · point + translation` is the point seen
/// from the box.
#[derive(Clone, Copy, Debug)]
struct LaneBox {
    rotation: [[f32; 3]; 3],
    translation: [f32; 3],
    half_extents: [f32; 3],
    radius: f32,
}

/// Eight boxes.
#[derive(Clone, Debug)]
struct BoxGroup {
    /// The indices of the obstacles.
    obstacles: Vec<u32>,
    rotation: [[[f32; 8]; 3]; 3],
    translation: [[f32; 8]; 3],
    half_extents: [[f32; 8]; 3],
    radius: [f32; 8],
    /// The largest of the sizes.
    size: f64,
}

impl Obstacles {
    /// Returns the obstacles with these parts. `first_part` is the index of the first of them in the cell.
    pub(super) fn new(parts: &[HullPart], first_part: usize) -> Self {
        let parts = parts.iter().enumerate();
        let all: Vec<Obstacle> = parts
            .map(|(k, part)| Obstacle::new(part, first_part + k))
            .collect();
        let (mut boxes, mut half_spaces) = (Vec::new(), Vec::new());
        for (index, obstacle) in (0..).zip(&all) {
            match obstacle.shape {
                ObstacleShape::Box(own) => boxes.push((index, own, obstacle.size)),
                ObstacleShape::HalfSpace { .. } => half_spaces.push(index),
            }
        }
        Obstacles {
            groups: boxes.chunks(8).map(BoxGroup::new).collect(),
            all,
            half_spaces,
        }
    }

    /// Calls `each` with the index of every obstacle that may be within a distance of a point. `reach` bounds the
    /// point's coordinates.
    #[inline(always)]
    pub(super) fn for_each_near<L: Simd>(
        &self,
        level: L,
        (point, reach): (Vec3, f64),
        distance: f64,
        mut each: impl FnMut(u32),
    ) {
        let points = Vec3x8::splat(level, point);
        for group in &self.groups {
            let within = (distance + distance_error(reach, group.size)) * (1.0 + 1e-6);
            let is_far = group
                .distances(level, points)
                .simd_gt(splat(level, within as f32));
            let mut near = !is_far.to_bitmask() as u8;
            while near != 0 {
                let lane = near.trailing_zeros() as usize;
                near &= near - 1;
                if let Some(&obstacle) = group.obstacles.get(lane) {
                    each(obstacle);
                }
            }
        }
        for &index in &self.half_spaces {
            each(index);
        }
    }
}

impl Obstacle {
    pub(super) fn new(part: &HullPart, part_index: usize) -> Self {
        let (shape, is_exact, size) = match &part.plane {
            Some(plane) => {
                let shape = ObstacleShape::HalfSpace {
                    normal: plane.normal.to_array().map(|x| x as f32),
                    offset: plane.offset as f32,
                };
                (shape, true, plane.offset.abs())
            }
            None => {
                let own = part.rounded_box();
                let size = own.center.length() + own.half_extents.length();
                (ObstacleShape::Box(LaneBox::new(&own)), own.is_exact, size)
            }
        };
        Obstacle {
            shape,
            part: part_index,
            is_exact,
            size,
        }
    }

    /// Returns the distances of eight points from the shape; negative or 0 inside.
    ///
    /// # Guarantee
    /// The error is at most [`Obstacle::error`].
    #[inline(always)]
    pub(super) fn distances<L: Simd>(&self, level: L, points: Vec3x8<L>) -> f32x8<L> {
        let number = |x: f32| splat(level, x);
        match &self.shape {
            ObstacleShape::Box(own) => {
                let [x, y, z] = &own.rotation;
                let [right, up, forward] = [
                    Vec3x8::splat(level, Vec3::from_array(*x)),
                    Vec3x8::splat(level, Vec3::from_array(*y)),
                    Vec3x8::splat(level, Vec3::from_array(*z)),
                ];
                let seen = Vec3x8 {
                    x: right.dot(points) + number(own.translation[0]),
                    y: up.dot(points) + number(own.translation[1]),
                    z: forward.dot(points) + number(own.translation[2]),
                };
                let half_extents = Vec3x8::splat(level, Vec3::from_array(own.half_extents));
                distances_from_box(level, seen, half_extents) - number(own.radius)
            }
            ObstacleShape::HalfSpace { normal, offset } => {
                let normal = Vec3x8::splat(level, Vec3::from_array(*normal));
                normal.dot(points) - number(*offset)
            }
        }
    }

    /// Returns a bound of the error of distances that prove a contact; infinity if a point inside may be outside the body.
    pub(super) fn touching_error(&self, error: f64) -> f64 {
        if self.is_exact { error } else { f64::INFINITY }
    }

    /// Bounds the error of distances of points whose coordinates are at most `reach`.
    pub(super) fn error(&self, reach: f64) -> f64 {
        distance_error(reach, self.size)
    }
}

fn distance_error(reach: f64, size: f64) -> f64 {
    DISTANCE_ERROR_ULPS * UNIT_ROUNDOFF * (reach + size)
}

impl LaneBox {
    fn new(own: &RoundedBox) -> Self {
        let rotation = own.axes.transpose();
        let single = |v: DVec3| v.to_array().map(|x| x as f32);
        let rows = own.axes.to_cols_array_2d();
        LaneBox {
            rotation: rows.map(|axis| axis.map(|x| x as f32)),
            translation: single(-(rotation * own.center)),
            half_extents: single(own.half_extents),
            radius: own.radius as f32,
        }
    }
}

impl BoxGroup {
    fn new(boxes: &[(u32, LaneBox, f64)]) -> Self {
        let lane = |k: usize| &boxes[k.min(boxes.len() - 1)].1;
        let row = |get: &dyn Fn(&LaneBox) -> f32| std::array::from_fn(|k| get(lane(k)));
        let axes = [0, 1, 2];
        let sizes = boxes.iter().map(|own| own.2);
        BoxGroup {
            obstacles: boxes.iter().map(|own| own.0).collect(),
            rotation: axes.map(|i| axes.map(|j| row(&|own| own.rotation[i][j]))),
            translation: axes.map(|i| row(&|own| own.translation[i])),
            half_extents: axes.map(|i| row(&|own| own.half_extents[i])),
            radius: row(&|own| own.radius),
            size: sizes.fold(0.0, ccd_core::order::greater),
        }
    }

    #[inline(always)]
    fn distances<L: Simd>(&self, level: L, points: Vec3x8<L>) -> f32x8<L> {
        let [x, y, z] = &self.rotation;
        let translation = Vec3x8::load(level, &self.translation);
        let seen = Vec3x8 {
            x: Vec3x8::load(level, x).dot(points) + translation.x,
            y: Vec3x8::load(level, y).dot(points) + translation.y,
            z: Vec3x8::load(level, z).dot(points) + translation.z,
        };
        let half_extents = Vec3x8::load(level, &self.half_extents);
        distances_from_box(level, seen, half_extents) - load(level, &self.radius)
    }
}

/// Returns the distances of points, seen from a box, from the box; 0 inside.
#[inline(always)]
fn distances_from_box<L: Simd>(level: L, seen: Vec3x8<L>, half_extents: Vec3x8<L>) -> f32x8<L> {
    let zero = splat(level, 0.0);
    let beyond = Vec3x8 {
        x: (seen.x.abs() - half_extents.x).max(zero),
        y: (seen.y.abs() - half_extents.y).max(zero),
        z: (seen.z.abs() - half_extents.z).max(zero),
    };
    beyond.length()
}

#[cfg(test)]
mod tests;
