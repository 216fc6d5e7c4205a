//! Draws random numbers, points and rotations.

use crate::raw_motion::RawPose;
use crate::vector::Vector;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use std::ops::Range;

pub struct RandomSource(Pcg64);

impl RandomSource {
    /// Creates the random stream of one query, so that each query can be run alone.
    pub fn new(seed: u64, index: u64) -> Self {
        RandomSource(Pcg64::seed_from_u64(
            seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ index,
        ))
    }

    pub fn uniform(&mut self, range: Range<f64>) -> f64 {
        range.start + (range.end - range.start) * self.0.random::<f64>()
    }

    pub fn log_uniform(&mut self, range: Range<f64>) -> f64 {
        10f64.powf(self.uniform(range.start.log10()..range.end.log10()))
    }

    pub fn count(&mut self, range: Range<usize>) -> usize {
        self.0.random_range(range)
    }

    pub fn bool_with_probability(&mut self, fraction: f64) -> bool {
        self.0.random::<f64>() < fraction
    }

    pub fn pick<T: Copy>(&mut self, of: &[T]) -> T {
        of[self.count(0..of.len())]
    }

    /// Returns a random point in the cube from −1 to 1 along each axis.
    pub fn point(&mut self) -> [f64; 3] {
        [(); 3].map(|()| self.uniform(-1.0..1.0))
    }

    pub fn direction(&mut self) -> [f64; 3] {
        loop {
            let v = Vector(self.point());
            let length = v.length();
            if length > 0.1 && length < 1.0 {
                return (v * (1.0 / length)).0;
            }
        }
    }

    /// Returns a random quaternion, not of unit length.
    pub fn quaternion(&mut self) -> [f64; 4] {
        [(); 4].map(|()| self.uniform(-1.0..1.0))
    }

    pub fn pose(&mut self, position: [f64; 3]) -> RawPose {
        let quaternion = if self.bool_with_probability(0.3) {
            [1.0, 0.0, 0.0, 0.0]
        } else {
            self.quaternion()
        };
        RawPose {
            position,
            quaternion,
        }
    }
}

pub fn add_arrays(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    (Vector(a) + Vector(b)).0
}

pub fn scale_array(a: [f64; 3], s: f64) -> [f64; 3] {
    (Vector(a) * s).0
}
