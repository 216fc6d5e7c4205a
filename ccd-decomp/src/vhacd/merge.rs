//! Fewer parts: those that fill their common hull best are merged first.

use super::Part;
use crate::hull::{HullError, likely_triangles};
use ccd_core::glam::DVec3;

/// Merges pairs of parts until there are no more than so many: always the pair whose hull has the least
/// volume beyond their own.
///
/// # Complexity
/// O(n²) hulls at worst; of parts apart from each other the boxes stand in for the hulls.
pub(super) fn down_to(parts: Vec<Part>, most: usize) -> Result<Vec<Part>, HullError> {
    let mut merger = Merger::new(parts);
    // Each step leaves one less, or none.
    while merger.count > most {
        merger.merge_best()?;
    }
    Ok(merger.parts.into_iter().flatten().map(|p| p.part).collect())
}

struct Merger {
    parts: Vec<Option<Measured>>,
    count: usize,
    /// The price of merging the pairs `(k, l)`, `k < l`, at `[l][k]`.
    prices: Vec<Vec<f64>>,
}

struct Measured {
    part: Part,
    volume: f64,
    bounds: [DVec3; 2],
}

impl Merger {
    fn new(parts: Vec<Part>) -> Self {
        let parts: Vec<_> = parts.into_iter().map(|p| Some(Measured::of(p))).collect();
        let mut merger = Merger {
            count: parts.len(),
            prices: parts
                .iter()
                .enumerate()
                .map(|(k, _)| vec![0.0; k])
                .collect(),
            parts,
        };
        for l in 0..merger.parts.len() {
            for k in 0..l {
                merger.prices[l][k] = merger.price(k, l);
            }
        }
        merger
    }

    fn price(&self, k: usize, l: usize) -> f64 {
        match (&self.parts[k], &self.parts[l]) {
            (Some(one), Some(other)) => one.price_with(other),
            _ => f64::INFINITY,
        }
    }

    fn merge_best(&mut self) -> Result<(), HullError> {
        let live = |k: usize| self.parts[k].is_some();
        let pairs = (0..self.parts.len()).flat_map(|l| (0..l).map(move |k| (k, l)));
        let best = pairs
            .filter(|&(k, l)| live(k) && live(l))
            .min_by(|&(k, l), &(m, n)| self.prices[l][k].total_cmp(&self.prices[n][m]));
        let Some((k, l)) = best else {
            self.count = 0;
            return Ok(());
        };
        if let (Some(one), Some(other)) = (self.parts[k].take(), self.parts[l].take()) {
            self.parts[k] = Some(Measured::of(Part::of(&one.corners_with(&other))?));
        }
        self.count -= 1;
        for other in 0..self.parts.len() {
            if other != k && self.parts[other].is_some() {
                let (low, high) = (k.min(other), k.max(other));
                self.prices[high][low] = self.price(low, high);
            }
        }
        Ok(())
    }
}

impl Measured {
    fn of(part: Part) -> Self {
        let corners = || part.corners.iter().copied();
        Measured {
            volume: volume(&part.corners, part.triangles()),
            bounds: [
                corners().fold(DVec3::INFINITY, DVec3::min),
                corners().fold(DVec3::NEG_INFINITY, DVec3::max),
            ],
            part,
        }
    }

    fn corners_with(&self, other: &Measured) -> Vec<DVec3> {
        let corners = self.part.corners.iter().chain(&other.part.corners);
        corners.copied().collect()
    }

    /// The volume that merging adds. The box is more than the hull, which keeps parts that are apart
    /// from being merged before others.
    fn price_with(&self, other: &Measured) -> f64 {
        let lo = self.bounds[0].min(other.bounds[0]);
        let hi = self.bounds[1].max(other.bounds[1]);
        let apart = |axis: usize| {
            self.bounds[0][axis] > other.bounds[1][axis]
                || other.bounds[0][axis] > self.bounds[1][axis]
        };
        let common = || {
            let corners = self.corners_with(other);
            let triangles = likely_triangles(&corners)?;
            Some(volume(&corners, triangles.into_iter()))
        };
        let common = if (0..3).any(apart) { None } else { common() };
        common.unwrap_or((hi - lo).element_product()) - self.volume - other.volume
    }
}

/// The volume within triangles, rounded: it serves to compare.
fn volume(points: &[DVec3], triangles: impl Iterator<Item = [u32; 3]>) -> f64 {
    let at = |v: u32| points[v as usize] - points[0];
    let six = triangles.map(|[a, b, c]| at(a).dot(at(b).cross(at(c))));
    six.sum::<f64>() / 6.0
}
