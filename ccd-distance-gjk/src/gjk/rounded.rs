//! A pair rounded to f32, eight points abreast.

use super::minkowski::{Difference, Exact};
use super::simplex::Vertex;
use ccd_core::glam::{DVec3, Mat3A, Vec3A};
use ccd_core::order::greater;
use wide::f32x8;

/// A pair in f32, each piece in its own axes and told from its own first point; the difference's
/// vertices are scaled to about one.
#[derive(Clone, Debug, Default)]
pub(crate) struct Rounded {
    a: Points,
    b: Points,
    b_to_a: Mat3A,
    a_to_b: Mat3A,
    between: Vec3A,
    /// What makes the difference's vertices about one: volumes of 1e13 would overflow.
    scale: f32,
}

impl Rounded {
    /// Takes the place of whatever was there, in the same memory.
    pub(crate) fn set(&mut self, exact: &Exact<'_>) {
        self.a.set(exact.pair.a.points);
        self.b.set(exact.pair.b.points);
        self.between = exact.between().as_vec3a();
        let size = greater(self.a.extent(), self.b.extent());
        self.scale = match greater(size, self.between.abs().max_element()).recip() {
            scale if scale.is_normal() => scale,
            _ => 1.0,
        };
        let turn = exact.pair.b_to_a.rotation;
        self.b_to_a = Mat3A::from_cols(
            turn.x_axis.as_vec3a(),
            turn.y_axis.as_vec3a(),
            turn.z_axis.as_vec3a(),
        );
        self.a_to_b = self.b_to_a.transpose();
    }
}

impl Difference for Rounded {
    type Vector = Vec3A;

    fn support(&self, direction: Vec3A) -> Vertex<Vec3A> {
        let a = self.a.least(-direction);
        let b = self.b.least(self.a_to_b * direction);
        self.vertex(a, b).unwrap_or(Vertex {
            point: self.between(),
            a: 0,
            b: 0,
        })
    }

    fn vertex(&self, a: u32, b: u32) -> Option<Vertex<Vec3A>> {
        let point = self.b_to_a * self.b.get(b)? - self.a.get(a)? + self.between;
        Some(Vertex {
            point: self.scale * point,
            a,
            b,
        })
    }

    fn between(&self) -> Vec3A {
        self.scale * self.between
    }
}

const LANES: usize = 8;

/// Points in blocks of eight; the last block is filled up with the last point.
#[derive(Clone, Debug, Default)]
struct Points {
    /// The coordinates of each block.
    blocks: Vec<[f32x8; 3]>,
    len: u32,
}

impl Points {
    fn set(&mut self, points: &[DVec3]) {
        let first = points.first().copied().unwrap_or_default();
        self.len = points.len() as u32;
        self.blocks.clear();
        self.blocks.extend(points.chunks(LANES).map(|chunk| {
            let mut block = [[0.0; LANES]; 3];
            for lane in 0..LANES {
                let point = chunk[lane.min(chunk.len() - 1)];
                let [x, y, z] = (point - first).to_array();
                block[0][lane] = x as f32;
                block[1][lane] = y as f32;
                block[2][lane] = z as f32;
            }
            block.map(f32x8::new)
        }));
    }

    /// The largest coordinate.
    fn extent(&self) -> f32 {
        let far = |far: f32x8, [x, y, z]: &[f32x8; 3]| {
            far.fast_max(x.abs()).fast_max(y.abs()).fast_max(z.abs())
        };
        let far = self.blocks.iter().fold(f32x8::ZERO, far);
        far.to_array().into_iter().fold(0.0, greater)
    }

    fn get(&self, index: u32) -> Option<Vec3A> {
        let (block, lane) = (index as usize / LANES, index as usize % LANES);
        let coordinates = self.blocks.get(block).filter(|_| index < self.len)?;
        Some(Vec3A::from_array(
            coordinates.map(|row| row.to_array()[lane]),
        ))
    }

    /// The index of a least point along `direction`.
    fn least(&self, direction: Vec3A) -> u32 {
        let [dx, dy, dz] = direction.to_array().map(f32x8::splat);
        let mut best = f32x8::splat(f32::INFINITY);
        let mut at = f32x8::ZERO;
        for (k, &[x, y, z]) in self.blocks.iter().enumerate() {
            let height = x.mul_add(dx, y.mul_add(dy, z * dz));
            let lower = height.simd_lt(best);
            best = lower.select(height, best);
            // Past 2^24 blocks a neighbour is named instead: that costs steps in f64.
            at = lower.select(f32x8::splat(k as f32), at);
        }
        let (best, at) = (best.to_array(), at.to_array());
        let lane = (1..LANES).fold(0, |low, k| if best[k] < best[low] { k } else { low });
        let index = (at[lane] as usize * LANES + lane) as u32;
        // A filled-up lane stands for the last point.
        index.min(self.len.saturating_sub(1))
    }
}
