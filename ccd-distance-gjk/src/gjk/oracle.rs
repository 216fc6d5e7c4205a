//! GJK as a distance oracle.

use super::minkowski::MinkowskiDifference;
use super::refine;
use super::search::{SearchResult, search};
use super::sharpen;
use super::simplex::Simplex;
use super::start::Cache;
use super::termination::{StopReason, gap_equals_distance};
use crate::tolerance::{CERTIFIED_ULPS, MAX_FEATURE_AXIS_ROUNDS, MIN_CERTIFIED_SHARE};
use ccd_core::glam::DVec3;
use ccd_core::{Claim, ConvexCombination, DistanceOracle, GiveUpReason, PiecePair};

/// An oracle for the distance of two hulls of any number of points, by GJK `[GJK88]`.
///
/// # Guarantee
/// For separated pieces of size s, both moved near the origin, the witnesses are within about 1e-13 s of the nearest
/// pair's distance. If that is less than 1e-7 s, the axis is computed from the features that contain them. The search
/// ends after at most about 300 steps with the best result so far. It never gives up on pieces with points, and claims
/// nothing for empty pieces.
///
/// # Complexity
/// About 3 to 10 steps, 1 to 2 from a warm [`Cache`], without allocation. Each step scans every
/// point once.
///
/// ```
/// use ccd_core::{DistanceOracle, Frame, Piece, PiecePair, glam::DVec3};
/// use ccd_distance_gjk::{Cache, Gjk};
/// let tetrahedron = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
/// let point = [DVec3::ONE];
/// let pair = PiecePair {
///     a: Piece::from_points(&tetrahedron),
///     b: Piece::from_points(&point),
///     b_to_a: Frame::IDENTITY,
/// };
/// let claim = Gjk::default().separation(&pair, &mut Cache::default()).unwrap();
/// let foot = claim.a.position(&tetrahedron).unwrap();
/// assert!(foot.distance(DVec3::ONE / 3.0) < 1e-15);
/// ```
#[derive(Clone, Copy, Debug, Default)]
pub struct Gjk;

impl DistanceOracle for Gjk {
    type Cache = Cache;

    fn separation(
        &mut self,
        pair: &PiecePair<'_>,
        cache: &mut Cache,
    ) -> Result<Claim, GiveUpReason> {
        let Some(difference) = MinkowskiDifference::new(pair) else {
            return Ok(EMPTY_CLAIM);
        };
        let found = solve_with_cache(&difference, cache);
        *cache = Cache::from_search_result(&found);
        Ok(claim(&found))
    }
}

/// The claim for a pair in which a piece has no points: no axis and no witnesses.
pub(crate) const EMPTY_CLAIM: Claim = Claim {
    axis: DVec3::ZERO,
    a: ConvexCombination::EMPTY,
    b: ConvexCombination::EMPTY,
};

/// Searches for the nearest point from the cached simplex, and again without the cache if the result is not certified.
///
/// A cached simplex may be degenerate at the new positions, so that no step gets nearer.
pub(crate) fn solve_with_cache(
    difference: &MinkowskiDifference<'_>,
    cache: &Cache,
) -> SearchResult {
    let found = solve(difference, cache.simplex(difference));
    if found.gap > 0.0 && !is_certified(&found) {
        found.combine_results(solve(difference, Cache::default().simplex(difference)))
    } else {
        found
    }
}

/// Searches for the nearest point, and again from other vertices if rounding stalls the search.
///
/// A search that stalls before its axis certifies the distance continues from the vertices found by axes of features.
pub(crate) fn solve(difference: &MinkowskiDifference<'_>, mut simplex: Simplex) -> SearchResult {
    let mut found = SearchResult::empty();
    for _ in 0..MAX_FEATURE_AXIS_ROUNDS {
        let before = found.squared_distance;
        let stop = search(difference, simplex, &mut found);
        if stop == StopReason::OriginEnclosed {
            sharpen::try_face_axes(difference, &mut found);
            break;
        }
        if stop == StopReason::Converged
            && found.gap >= MIN_CERTIFIED_SHARE * found.squared_distance.sqrt()
        {
            break;
        }
        refine::refine_witnesses(difference, found.simplex, &mut found);
        // Written so that NaN breaks.
        if is_certified(&found) || !(found.squared_distance < before) {
            break;
        }
        simplex = sharpen::try_feature_axes(difference, &mut found);
        refine::refine_witnesses(difference, simplex, &mut found);
        if is_certified(&found) {
            break;
        }
    }
    found
}

/// Returns whether the support gap along the axis equals the distance found, up to rounding.
pub(crate) fn is_certified(found: &SearchResult) -> bool {
    found.gap > 0.0
        && gap_equals_distance(
            found.gap,
            found.squared_distance,
            &found.simplex,
            CERTIFIED_ULPS,
        )
}

/// Converts the result of a search to a claim.
pub(crate) fn claim(found: &SearchResult) -> Claim {
    let mut out = Claim {
        axis: found.axis,
        ..EMPTY_CLAIM
    };
    for (vertex, weight) in found.simplex.vertices().iter().zip(found.weights) {
        out.a.add_weighted_point(vertex.a, weight);
        out.b.add_weighted_point(vertex.b, weight);
    }
    out
}
