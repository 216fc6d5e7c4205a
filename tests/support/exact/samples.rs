//! Draws sample points of a polytope's hull.

use super::blend::Blend;
use ccd_core::Polytope;
use ccd_core::glam::DVec3;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

/// The numbers of random sample points to draw.
#[derive(Clone, Copy, Debug)]
pub struct Effort {
    /// The number of points on each facet, in addition to its mean and its edges' middles.
    pub per_facet: usize,
    /// The number of points of each polytope on segments between two of its corners.
    pub chords: usize,
    /// The number of points of each polytope that combine four of its corners.
    pub blends: usize,
}

impl Effort {
    /// The numbers of points for models of a few hundred faces.
    pub const THOROUGH: Effort = Effort {
        per_facet: 6,
        chords: 24,
        blends: 16,
    };

    /// The numbers of points for models of thousands of faces.
    pub const QUICK: Effort = Effort {
        per_facet: 1,
        chords: 4,
        blends: 4,
    };
}

/// The sum of the weights of a random point, a power of two, so that its coordinates stay as short in binary as those
/// of the corners.
const WHOLE: u32 = 64;

/// Returns points of a polytope's hull: means, middles, and random ones on facets, segments and inside. The result
/// depends only on the polytope and the seed.
pub fn samples(polytope: &Polytope, effort: Effort, seed: u64) -> Vec<Blend> {
    let mut rng = Pcg64::seed_from_u64(seed);
    let points = &polytope.points;
    let mut out = vec![Blend::mean(points.iter().copied())];
    for facet in &polytope.facets {
        let corners: Vec<DVec3> = facet.corners.iter().map(|&c| points[c as usize]).collect();
        out.push(Blend::mean(corners.iter().copied()));
        for k in 0..corners.len() {
            let next = corners[(k + 1) % corners.len()];
            out.push(Blend::mean([corners[k], next]));
        }
        out.extend((0..effort.per_facet).map(|_| random_blend(&mut rng, &corners, 3)));
    }
    out.extend((0..effort.chords).map(|_| random_blend(&mut rng, points, 2)));
    out.extend((0..effort.blends).map(|_| random_blend(&mut rng, points, 4)));
    out
}

/// Returns a random combination of `count` of the points, perhaps with repetition.
fn random_blend(rng: &mut Pcg64, points: &[DVec3], count: usize) -> Blend {
    let mut rest = WHOLE;
    let mut parts: Vec<(u32, DVec3)> = (1..count)
        .map(|_| {
            let weight = rng.random_range(0..=rest);
            rest -= weight;
            (weight, points[rng.random_range(0..points.len())])
        })
        .collect();
    parts.push((rest, points[rng.random_range(0..points.len())]));
    Blend::new(parts)
}
