//! Merges parts of a decomposition, the pair with the least added hull volume first.

use super::extremes::{extreme_points, remove_inner_points};
use crate::bounds::Bounds;
use crate::hull::exact_hull::ExactHull;
use crate::tolerance::COST_SAMPLE_POINTS;
use ccd_core::glam::DVec3;
use rayon::prelude::*;

/// Merges parts, given by points, until at most `most` are left. Each step merges the pair whose common hull adds the
/// least volume.
///
/// # Complexity
/// O(n²) hulls of few points each, for any number of a part's points. Boxes replace the hulls of disjoint parts.
///
/// # Guarantee
/// The hull of merged parts contains these parts. Rounded volumes only affect the choice.
pub(super) fn merge_to_count(parts: Vec<Vec<DVec3>>, most: usize) -> Vec<Vec<DVec3>> {
    let mut merger = PartMerger::new(parts);
    // Each step removes one part.
    while merger.count > most && merger.merge_best() {}
    let parts = merger.parts.into_iter().flatten();
    parts.map(|part| part.points).collect()
}

struct PartMerger {
    parts: Vec<Option<MeasuredPart>>,
    count: usize,
    /// The volume that merging the parts `k < l` adds, at `[l][k]`.
    merge_costs: Vec<Vec<f64>>,
}

struct MeasuredPart {
    points: Vec<DVec3>,
    /// A few of the part's points, whose hull is nearly as large as that of all.
    sample_points: Vec<DVec3>,
    /// The volume of the hull of the sample points.
    volume: f64,
    bounds: Bounds,
}

impl PartMerger {
    fn new(parts: Vec<Vec<DVec3>>) -> Self {
        let measured = |points: Vec<DVec3>| Some(MeasuredPart::new(points));
        let parts: Vec<_> = parts.into_par_iter().map(measured).collect();
        let mut merger = PartMerger {
            count: parts.len(),
            merge_costs: parts
                .iter()
                .enumerate()
                .map(|(k, _)| vec![0.0; k])
                .collect(),
            parts,
        };
        for l in 0..merger.parts.len() {
            for k in 0..l {
                merger.merge_costs[l][k] = merger.pair_cost(k, l);
            }
        }
        merger
    }

    fn pair_cost(&self, k: usize, l: usize) -> f64 {
        match (&self.parts[k], &self.parts[l]) {
            (Some(one), Some(other)) => one.merge_cost(other),
            _ => f64::INFINITY,
        }
    }

    /// Merges the pair with the least added volume. Returns whether there was one.
    fn merge_best(&mut self) -> bool {
        let live = |k: usize| self.parts[k].is_some();
        let pairs = (0..self.parts.len()).flat_map(|l| (0..l).map(move |k| (k, l)));
        let best = pairs
            .filter(|&(k, l)| live(k) && live(l))
            .min_by(|&(k, l), &(m, n)| self.merge_costs[l][k].total_cmp(&self.merge_costs[n][m]));
        let Some((k, l)) = best else {
            return false;
        };
        if let (Some(mut one), Some(other)) = (self.parts[k].take(), self.parts[l].take()) {
            one.points.extend(other.points);
            self.parts[k] = Some(MeasuredPart::new(one.points));
        }
        self.count -= 1;
        for other in 0..self.parts.len() {
            if other != k && self.parts[other].is_some() {
                let (low, high) = (k.min(other), k.max(other));
                self.merge_costs[high][low] = self.pair_cost(low, high);
            }
        }
        true
    }
}

impl MeasuredPart {
    fn new(points: Vec<DVec3>) -> Self {
        let points = remove_inner_points(points);
        let sample_points = extreme_points(&points, COST_SAMPLE_POINTS);
        MeasuredPart {
            volume: volume(&sample_points).unwrap_or(0.0),
            bounds: Bounds::enclosing(points.iter().copied()),
            sample_points,
            points,
        }
    }

    /// Returns the volume that merging two parts adds. Boxes are larger than hulls, so that disjoint parts are merged
    /// last.
    fn merge_cost(&self, other: &MeasuredPart) -> f64 {
        let common = || volume(&[&self.sample_points[..], &other.sample_points].concat());
        let meet = self.bounds.meets(&other.bounds);
        let both = self.bounds.union(other.bounds);
        let of_box = (both.hi - both.lo).element_product();
        meet.then(common).flatten().unwrap_or(of_box) - self.volume - other.volume
    }
}

/// Returns the rounded volume of the hull of points; `None` if they are coplanar.
fn volume(points: &[DVec3]) -> Option<f64> {
    let at = |v: u32| points[v as usize] - points[0];
    let triangles = ExactHull::facets_of(points)?.into_iter();
    let six = triangles.map(|[a, b, c]| at(a).dot(at(b).cross(at(c))));
    Some(six.sum::<f64>() / 6.0)
}
