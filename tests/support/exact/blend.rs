//! Convex combinations of points, without rounding.

use super::number::{Interval, Number};
use ccd_core::glam::DVec3;
use dashu_ratio::Relaxed;
use std::cell::OnceCell;

/// A convex combination of points with whole numbers as weights: `Σ w p / Σ w`, exactly.
#[derive(Clone, Debug, PartialEq)]
pub struct Blend(Vec<(u32, DVec3)>);

impl Blend {
    /// Combines some points, each with its weight.
    ///
    /// # Panics
    /// If all weights are 0.
    pub fn new(parts: impl IntoIterator<Item = (u32, DVec3)>) -> Self {
        let parts: Vec<(u32, DVec3)> = parts.into_iter().collect();
        assert!(parts.iter().any(|part| part.0 > 0), "no weight");
        Blend(parts)
    }

    /// Returns the mean of some points.
    pub fn mean(points: impl IntoIterator<Item = DVec3>) -> Self {
        Blend::new(points.into_iter().map(|p| (1, p)))
    }

    /// Returns the point in floats, up to a rounding error.
    pub fn rounded(&self) -> DVec3 {
        let [x, y, z] = self.coordinates::<Interval>().map(|x| x.lo);
        DVec3::new(x, y, z)
    }

    fn coordinates<N: Number>(&self) -> [N; 3] {
        let whole: u32 = self.0.iter().map(|part| part.0).sum();
        [0, 1, 2].map(|axis| {
            let weighted =
                |&(w, p): &(u32, DVec3)| N::from_f64(p[axis]).times(&N::from_f64(f64::from(w)));
            let sum = self.0.iter().map(weighted);
            sum.fold(N::from_f64(0.0), |all, one| all.plus(&one))
                .over(whole)
        })
    }
}

/// A point for predicates, with fractions that are computed on first use.
pub(super) struct Spot<'a> {
    blend: &'a Blend,
    pub(super) near: [Interval; 3],
    exact: OnceCell<[Relaxed; 3]>,
}

impl<'a> Spot<'a> {
    pub(super) fn new(blend: &'a Blend) -> Self {
        Spot {
            blend,
            near: blend.coordinates(),
            exact: OnceCell::new(),
        }
    }

    pub(super) fn exact(&self) -> &[Relaxed; 3] {
        self.exact.get_or_init(|| self.blend.coordinates())
    }
}
