//! GJK that searches in f32 and finishes in f64.

use super::minkowski::{Exact, Rounded};
use super::oracle::{NOTHING, claim, solve};
use super::search::{Found, search};
use super::start::Cache;
use ccd_core::glam::Vec3A;
use ccd_core::{Claim, DistanceOracle, GiveUp, PiecePair};

/// The distance of two hulls of any number of points, by GJK that searches in f32 and finishes in
/// f64.
///
/// The search runs on the points less each piece's first one, scaled to about one and rounded; its
/// last simplex is where [`Gjk`](crate::Gjk) starts from on the pieces as they are.
///
/// # Guarantee
/// As [`Gjk`](crate::Gjk): witnesses and axis come out of its f64 steps.
///
/// # Complexity
/// One pass over the points to round them, the search's steps in f32, then 1 to 3 in f64. Its
/// buffers grow to the largest piece seen and stay.
#[derive(Clone, Debug, Default)]
pub struct GjkF32 {
    buffers: [Vec<Vec3A>; 2],
}

impl DistanceOracle for GjkF32 {
    type Cache = Cache;

    fn separation(&mut self, pair: &PiecePair<'_>, cache: &mut Cache) -> Result<Claim, GiveUp> {
        let Some(exact) = Exact::new(pair) else {
            return Ok(NOTHING);
        };
        let rounded = Rounded::new(&exact, &mut self.buffers);
        let mut coarse = Found::nothing();
        search(&rounded, cache.simplex(&rounded), &mut coarse);
        let found = solve(&exact, Cache::of(&coarse).simplex(&exact));
        *cache = Cache::of(&found);
        Ok(claim(&found))
    }
}
