//! Draws sample points of the convex hull of a polytope.

use super::blend::ConvexCombination;
use ccd_core::Polytope;
use ccd_core::glam::DVec3;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

/// The numbers of random sample points to draw from a polytope.
#[derive(Clone, Copy, Debug)]
pub struct SampleCounts {
    /// The number of random points on each facet, in addition to its mean and the middles of its edges.
    pub points_per_facet: usize,
    /// The number of random points on segments between two corners of a polytope.
    pub chord_point_count: usize,
    /// The number of random points that are combinations of four corners of a polytope.
    pub inner_point_count: usize,
}

impl SampleCounts {
    /// The numbers of points for models of a few hundred faces.
    pub const THOROUGH: SampleCounts = SampleCounts {
        points_per_facet: 6,
        chord_point_count: 24,
        inner_point_count: 16,
    };

    /// The numbers of points for models of thousands of faces.
    pub const QUICK: SampleCounts = SampleCounts {
        points_per_facet: 1,
        chord_point_count: 4,
        inner_point_count: 4,
    };
}

/// The sum of the weights of a random point. It is a power of two, so that coordinates stay as short in binary as those
/// of the corners.
const WEIGHT_SUM: u32 = 64;

/// Returns points of a polytope's hull: means of corners, middles of edges, and random points on facets, chords and
/// inside. The result depends only on the polytope and the seed.
pub fn samples(polytope: &Polytope, effort: SampleCounts, seed: u64) -> Vec<ConvexCombination> {
    let mut rng = Pcg64::seed_from_u64(seed);
    let points = &polytope.points;
    let mut out = vec![ConvexCombination::mean(points.iter().copied())];
    for facet in &polytope.facets {
        let corners: Vec<DVec3> = facet.corners.iter().map(|&c| points[c as usize]).collect();
        out.push(ConvexCombination::mean(corners.iter().copied()));
        for k in 0..corners.len() {
            let next = corners[(k + 1) % corners.len()];
            out.push(ConvexCombination::mean([corners[k], next]));
        }
        out.extend((0..effort.points_per_facet).map(|_| random_combination(&mut rng, &corners, 3)));
    }
    out.extend((0..effort.chord_point_count).map(|_| random_combination(&mut rng, points, 2)));
    out.extend((0..effort.inner_point_count).map(|_| random_combination(&mut rng, points, 4)));
    out
}

/// Returns a random convex combination of `count` of the points, in which a point may occur repeatedly.
fn random_combination(rng: &mut Pcg64, points: &[DVec3], count: usize) -> ConvexCombination {
    let mut rest = WEIGHT_SUM;
    let mut parts: Vec<(u32, DVec3)> = (1..count)
        .map(|_| {
            let weight = rng.random_range(0..=rest);
            rest -= weight;
            (weight, points[rng.random_range(0..points.len())])
        })
        .collect();
    parts.push((rest, points[rng.random_range(0..points.len())]));
    ConvexCombination::new(parts)
}
