//! Arithmetic on four vectors at a time, and the shortest of many vectors.

use ccd_core::glam::DVec3;
use wide::f64x4;

/// Four vectors in SIMD lanes, with one register for each coordinate.
#[derive(Clone, Copy, Debug)]
pub(super) struct Vec3x4(pub(super) [f64x4; 3]);

/// The shortest vector so far in each of the four lanes.
#[derive(Clone, Copy, Debug)]
pub(super) struct ShortestVectors {
    squared_lengths: f64x4,
    vectors: Vec3x4,
}

impl Vec3x4 {
    /// Packs four vectors, one per lane; of three vectors one is repeated.
    #[inline(always)]
    pub(super) fn new([a, b, c, d]: [DVec3; 4]) -> Self {
        Vec3x4([
            f64x4::new([a.x, b.x, c.x, d.x]),
            f64x4::new([a.y, b.y, c.y, d.y]),
            f64x4::new([a.z, b.z, c.z, d.z]),
        ])
    }

    /// Returns the same vector four times.
    #[inline(always)]
    pub(super) fn splat(v: DVec3) -> Self {
        Vec3x4([f64x4::splat(v.x), f64x4::splat(v.y), f64x4::splat(v.z)])
    }

    /// Returns `self + factors · direction`.
    #[inline(always)]
    pub(super) fn plus_scaled(self, factors: f64x4, direction: DVec3) -> Self {
        self.plus_scaled_each(factors, Vec3x4::splat(direction))
    }

    /// Returns `self + factors · directions`, lane by lane.
    #[inline(always)]
    pub(super) fn plus_scaled_each(self, factors: f64x4, Vec3x4(d): Vec3x4) -> Self {
        let Vec3x4([x, y, z]) = self;
        Vec3x4([
            factors.mul_add(d[0], x),
            factors.mul_add(d[1], y),
            factors.mul_add(d[2], z),
        ])
    }

    /// Returns `self − other`, lane by lane.
    #[inline(always)]
    pub(super) fn minus(self, Vec3x4(o): Vec3x4) -> Self {
        let Vec3x4([x, y, z]) = self;
        Vec3x4([x - o[0], y - o[1], z - o[2]])
    }

    /// Returns the inner products with one vector.
    #[inline(always)]
    pub(super) fn dot(self, v: DVec3) -> f64x4 {
        self.dot_each(Vec3x4::splat(v))
    }

    /// Returns the inner products with other vectors, lane by lane.
    #[inline(always)]
    pub(super) fn dot_each(self, Vec3x4(o): Vec3x4) -> f64x4 {
        let Vec3x4([x, y, z]) = self;
        x.mul_add(o[0], y.mul_add(o[1], z * o[2]))
    }

    /// Returns the cross products with other vectors, lane by lane.
    #[inline(always)]
    pub(super) fn cross_each(self, Vec3x4(o): Vec3x4) -> Self {
        let Vec3x4([x, y, z]) = self;
        Vec3x4([
            y.mul_sub(o[2], z * o[1]),
            z.mul_sub(o[0], x * o[2]),
            x.mul_sub(o[1], y * o[0]),
        ])
    }

    /// Returns the vector in one of the four lanes.
    pub(super) fn lane(self, k: usize) -> DVec3 {
        let Vec3x4(v) = self;
        DVec3::from_array(v.map(|lanes| lanes.to_array()[k]))
    }
}

impl ShortestVectors {
    /// Returns the state before any vectors are added, with infinite lengths.
    #[inline(always)]
    pub(super) fn empty() -> Self {
        ShortestVectors {
            squared_lengths: f64x4::splat(f64::INFINITY),
            vectors: Vec3x4::splat(DVec3::ZERO),
        }
    }

    /// Adds four more vectors, one to each lane; NaN is never shorter.
    #[inline(always)]
    pub(super) fn include_four(self, more: Vec3x4) -> Self {
        let squared = more.dot_each(more);
        let shorter = squared.simd_lt(self.squared_lengths);
        let keep = |k: usize| shorter.select(more.0[k], self.vectors.0[k]);
        ShortestVectors {
            squared_lengths: self.squared_lengths.fast_min(squared),
            vectors: Vec3x4([keep(0), keep(1), keep(2)]),
        }
    }

    /// Returns the squared length of the shortest vector in any lane, and the vector.
    #[inline(always)]
    pub(super) fn shortest(self) -> (f64, DVec3) {
        let (lane, squared) = least_lane(self.squared_lengths);
        (squared, self.vectors.lane(lane))
    }
}

/// Returns the lane of the least of four numbers, and the number.
#[inline(always)]
pub(super) fn least_lane(numbers: f64x4) -> (usize, f64) {
    let n = numbers.to_array();
    let low = if n[1] < n[0] { 1 } else { 0 };
    let high = if n[3] < n[2] { 3 } else { 2 };
    let lane = if n[high] < n[low] { high } else { low };
    (lane, n[lane])
}
