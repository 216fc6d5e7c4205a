//! Merges parts of a decomposition, the pair with the least added hull volume first.

use crate::bounds::Bounds;
use crate::hull::exact_hull::ExactHull;
use crate::hull::{HullError, hull};
use crate::tolerance::COST_SAMPLE_POINTS;
use ccd_core::Hull;
use ccd_core::glam::DVec3;
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::f64::consts::PI;

/// Returns the hulls of parts, which are given by points, after merging them until at most `most` are left. Each step
/// merges the pair whose common hull adds the least volume.
///
/// # Complexity
/// O(n²) hulls of few points each, for any number of a part's points. Boxes replace the hulls of disjoint parts.
///
/// # Guarantee
/// The hull of merged parts contains these parts. Rounded volumes only affect the choice.
///
/// # Errors
/// [`HullError`] if a point is out of range for exact predicates.
pub(super) fn merge_to_count(parts: &[Vec<DVec3>], most: usize) -> Result<Vec<Hull>, HullError> {
    let measured = parts.par_iter().map(|points| MeasuredPart::new(points));
    let measured: Vec<MeasuredPart> = measured.collect::<Result<_, _>>()?;
    let mut parts: BTreeMap<usize, MeasuredPart> = measured.into_iter().enumerate().collect();
    // The volume that merging two parts adds, by the larger number and the smaller.
    let cost = |parts: &BTreeMap<usize, MeasuredPart>, k: usize, l: usize| {
        ([l, k], parts[&k].merge_cost(&parts[&l]))
    };
    let pairs = (0..parts.len()).flat_map(|l| (0..l).map(move |k| (k, l)));
    let mut costs: BTreeMap<[usize; 2], f64> = pairs.map(|(k, l)| cost(&parts, k, l)).collect();
    // Each step removes one part.
    while parts.len() > most
        && let Some((&[l, k], _)) = costs.iter().min_by(|p, q| p.1.total_cmp(q.1))
        && let (Some(one), Some(other)) = (parts.remove(&k), parts.remove(&l))
    {
        costs.retain(|pair, _| !pair.iter().any(|end| [k, l].contains(end)));
        let merged = MeasuredPart::new(&[one.hull.points, other.hull.points].concat())?;
        parts.insert(k, merged);
        let others = parts.keys().filter(|&&m| m != k);
        costs.extend(others.map(|&m| cost(&parts, m.min(k), m.max(k))));
    }
    Ok(parts.into_values().map(|part| part.hull).collect())
}

struct MeasuredPart {
    hull: Hull,
    /// A few of the hull's corners, whose hull is nearly as large.
    sample_points: Vec<DVec3>,
    /// The volume of the hull of the sample points.
    volume: f64,
    bounds: Bounds,
}

impl MeasuredPart {
    fn new(points: &[DVec3]) -> Result<Self, HullError> {
        let hull = hull(points)?;
        let sample_points = extreme_points(&hull.points, COST_SAMPLE_POINTS);
        Ok(MeasuredPart {
            volume: volume(&sample_points).unwrap_or(0.0),
            bounds: Bounds::enclosing(hull.points.iter().copied()),
            sample_points,
            hull,
        })
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

/// Returns the extreme points in `directions` evenly spread directions, without duplicates, in the order of the list.
///
/// The directions are spread evenly over the box of the points, stretched to a cube.
fn extreme_points(points: &[DVec3], directions: u32) -> Vec<DVec3> {
    let Bounds { lo, hi } = Bounds::enclosing(points.iter().copied());
    let stretch = |x: f64| if x > 0.0 { x.recip() } else { 0.0 };
    let scale = DVec3::from_array((hi - lo).to_array().map(stretch));
    let mut found: Vec<usize> = (0..directions)
        .filter_map(|k| {
            let direction_of = scale * direction(k, directions);
            let along = points.iter().map(|&p| direction_of.dot(p - lo)).enumerate();
            let best = along.reduce(|best, next| if next.1 > best.1 { next } else { best });
            best.map(|(place, _)| place)
        })
        .collect();
    found.sort_unstable();
    found.dedup();
    found.into_iter().map(|place| points[place]).collect()
}

/// Returns the `k`-th of `count` evenly spread directions (golden-angle spiral).
fn direction(k: u32, count: u32) -> DVec3 {
    let z = 1.0 - (2.0 * f64::from(k) + 1.0) / f64::from(count);
    let radius = (1.0 - z * z).sqrt();
    let angle = PI * (3.0 - 5.0_f64.sqrt()) * f64::from(k);
    DVec3::new(radius * angle.cos(), radius * angle.sin(), z)
}

/// Returns the rounded volume of the hull of points; `None` if they are coplanar.
fn volume(points: &[DVec3]) -> Option<f64> {
    let at = |v: u32| points[v as usize] - points[0];
    let triangles = ExactHull::facets_of(points)?.into_iter();
    let six = triangles.map(|[a, b, c]| at(a).dot(at(b).cross(at(c))));
    Some(six.sum::<f64>() / 6.0)
}

#[cfg(test)]
mod tests;
