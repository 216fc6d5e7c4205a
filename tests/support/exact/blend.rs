//! Convex combinations of points, in exact arithmetic.

use ccd_core::glam::DVec3;
use ccd_core::order::greater;
use dashu_ratio::Relaxed;
use std::cell::OnceCell;

/// A convex combination of points, `Σ w p / Σ w`, kept exactly as the points and their whole-numbered weights.
#[derive(Clone, Debug, PartialEq)]
pub struct ConvexCombination(Vec<(u32, DVec3)>);

impl ConvexCombination {
    /// Creates the combination of some points, each with its weight.
    ///
    /// # Panics
    /// If all weights are 0.
    pub fn new(parts: impl IntoIterator<Item = (u32, DVec3)>) -> Self {
        let parts: Vec<(u32, DVec3)> = parts.into_iter().collect();
        assert!(parts.iter().any(|part| part.0 > 0), "no weight");
        ConvexCombination(parts)
    }

    /// Returns the mean of some points.
    pub fn mean(points: impl IntoIterator<Item = DVec3>) -> Self {
        ConvexCombination::new(points.into_iter().map(|p| (1, p)))
    }

    fn total_weight(&self) -> u32 {
        self.0.iter().map(|part| part.0).sum()
    }

    /// Returns the point in f64, with a rounding error for each combined point.
    pub fn rounded(&self) -> DVec3 {
        let weighted = self.0.iter().map(|&(weight, p)| f64::from(weight) * p);
        weighted.sum::<DVec3>() / f64::from(self.total_weight())
    }

    fn exact_coordinates(&self) -> [Relaxed; 3] {
        let whole = Relaxed::from(self.total_weight());
        [0, 1, 2].map(|axis| {
            let weighted =
                |&(weight, p): &(u32, DVec3)| Relaxed::from(weight) * exact_fraction(p[axis]);
            let sum = self.0.iter().map(weighted);
            sum.fold(Relaxed::ZERO, |all, one| all + one) / &whole
        })
    }
}

/// Converts a finite f64 to an exact fraction.
pub(super) fn exact_fraction(x: f64) -> Relaxed {
    Relaxed::try_from(x).expect("a finite coordinate")
}

/// A point for predicates, rounded to f64; its exact coordinates are computed on first use.
pub(super) struct LazyPoint<'a> {
    combination: &'a ConvexCombination,
    pub(super) rounded_point: DVec3,
    /// The largest absolute coordinate of the combined points.
    pub(super) max_coordinate: f64,
    exact: OnceCell<[Relaxed; 3]>,
}

/// A bound on the rounding error of a combination of up to hundreds of points, in units of their largest coordinate.
const ROUNDING: f64 = 1e-13;

impl<'a> LazyPoint<'a> {
    pub(super) fn new(blend: &'a ConvexCombination) -> Self {
        let sizes = blend.0.iter().map(|(_, p)| p.abs().max_element());
        LazyPoint {
            combination: blend,
            rounded_point: blend.rounded(),
            max_coordinate: sizes.fold(0.0, greater),
            exact: OnceCell::new(),
        }
    }

    /// Returns a bound on the rounding error of the coordinates in `rounded_point`.
    pub(super) fn rounding(&self) -> f64 {
        ROUNDING * self.max_coordinate
    }

    pub(super) fn exact_coordinates(&self) -> &[Relaxed; 3] {
        self.exact
            .get_or_init(|| self.combination.exact_coordinates())
    }
}
