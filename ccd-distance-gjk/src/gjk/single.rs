//! GJK that searches in f32 and finishes in f64.

use super::minkowski::Exact;
use super::oracle::{NOTHING, claim, solve};
use super::rounded::Rounded;
use super::search::{Found, search};
use super::start::Cache;
use crate::tolerance::SCANNED_POINTS;
use ccd_core::{Claim, DistanceOracle, GiveUp, Piece, PiecePair};

/// The distance of two hulls of any number of points, by GJK that searches in f32 and finishes in
/// f64.
///
/// The search runs on the points less each piece's first one, scaled to about one and rounded; its
/// last simplex is where [`Gjk`](crate::Gjk) starts from on the pieces as they are. Pieces of many
/// points, all of which it would have to round, are left to that alone.
///
/// # Guarantee
/// As [`Gjk`](crate::Gjk): witnesses and axis come out of its f64 steps.
///
/// # Complexity
/// One pass over the points to round them, the search's steps in f32, then 1 to 3 in f64. Its
/// memory grows to that of the largest piece seen, and stays.
#[derive(Clone, Debug, Default)]
pub struct GjkF32 {
    rounded: Rounded,
}

impl DistanceOracle for GjkF32 {
    type Cache = Cache;

    fn separation(&mut self, pair: &PiecePair<'_>, cache: &mut Cache) -> Result<Claim, GiveUp> {
        let Some(exact) = Exact::new(pair) else {
            return Ok(NOTHING);
        };
        let many = |piece: &Piece<'_>| piece.points.len() > SCANNED_POINTS;
        let start = match many(&pair.a) || many(&pair.b) {
            true => cache.simplex(&exact),
            false => {
                self.rounded.set(&exact);
                let mut coarse = Found::nothing();
                search(&self.rounded, cache.simplex(&self.rounded), &mut coarse);
                Cache::of(&coarse).simplex(&exact)
            }
        };
        let found = solve(&exact, start);
        *cache = Cache::of(&found);
        Ok(claim(&found))
    }
}
