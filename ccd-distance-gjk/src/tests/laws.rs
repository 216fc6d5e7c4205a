//! Properties that every backend must have. Each function checks one property on a pair of pieces.

use super::scene::Scene;
use super::twin;
use ccd_core::glam::DVec3;
use ccd_core::order::{greater, lesser};
use ccd_core::{Claim, ConvexCombination, DistanceOracle};

/// The numbers of a claim that can be checked: the distance of its points, and the support gap of its axis.
#[derive(Clone, Copy, Debug)]
pub(super) struct MeasuredClaim {
    pub(super) distance: f64,
    pub(super) gap: f64,
}

/// Returns the claim of a new oracle with an empty cache.
pub(super) fn claim_with_empty_cache<O: DistanceOracle + Default>(scene: &Scene) -> Claim {
    ask(&mut O::default(), scene, &mut O::Cache::default())
}

pub(super) fn ask<O: DistanceOracle>(o: &mut O, scene: &Scene, cache: &mut O::Cache) -> Claim {
    match o.separation(&scene.pair(), cache) {
        Ok(claim) => claim,
        Err(why) => panic!("{why:?} on {scene:?}"),
    }
}

pub(super) fn measure_claim(scene: &Scene, claim: &Claim) -> MeasuredClaim {
    let (a, b) = scene.local_points();
    let place = |combination: &ConvexCombination, points: &[DVec3]| {
        combination
            .position(points)
            .unwrap_or_else(|| panic!("{claim:?} names no point of {scene:?}"))
    };
    let n = claim.axis.try_normalize();
    let n = n.unwrap_or_else(|| panic!("the axis of {claim:?} for {scene:?} is no direction"));
    let low = b.iter().map(|y| n.dot(*y)).fold(f64::INFINITY, lesser);
    let high = a.iter().map(|x| n.dot(*x)).fold(f64::NEG_INFINITY, greater);
    MeasuredClaim {
        distance: place(&claim.a, &a).distance(place(&claim.b, &b)),
        gap: low - high,
    }
}

/// Checks that the axis certifies the distance of separate pieces: up to rounding if they are well apart, else at least
/// half of it.
pub(super) fn check_separation<O: DistanceOracle + Default>(scene: &Scene) -> MeasuredClaim {
    let checked = measure_claim(scene, &claim_with_empty_cache::<O>(scene));
    let MeasuredClaim { distance, gap } = checked;
    assert!(
        gap <= distance + 1e-14 * scene.size,
        "{checked:?} crosses in {scene:?}"
    );
    assert!(gap >= 0.5 * distance, "{checked:?} of {scene:?}");
    if distance > 1e-3 * scene.size {
        assert!(
            gap >= distance - 1e-12 * scene.size,
            "{checked:?} of {scene:?}"
        );
    }
    checked
}

/// Checks that the nearest points of separate pieces are as near as by brute force.
pub(super) fn check_against_brute_force<O: DistanceOracle + Default>(scene: &Scene) {
    let checked = measure_claim(scene, &claim_with_empty_cache::<O>(scene));
    let (a, b) = scene.local_points();
    let truth = twin::distance(&a, &b);
    let error = (checked.distance - truth).abs();
    assert!(
        error <= 1e-13 * scene.size,
        "{checked:?}, not {truth:e}, of {scene:?}"
    );
}

/// Checks that the two claimed points of intersecting pieces coincide, up to the fraction `within` of the size.
pub(super) fn check_common_point<O: DistanceOracle + Default>(scene: &Scene, within: f64) {
    let checked = measure_claim(scene, &claim_with_empty_cache::<O>(scene));
    assert!(
        checked.distance <= within * scene.size,
        "{checked:?} of {scene:?}"
    );
}

/// Checks that pieces that only touch get a common point, and an axis that separates their interiors.
pub(super) fn check_touching_pieces<O: DistanceOracle + Default>(scene: &Scene) {
    let checked = measure_claim(scene, &claim_with_empty_cache::<O>(scene));
    assert!(
        checked.distance <= 1e-12 * scene.size,
        "{checked:?} of {scene:?}"
    );
    assert!(
        checked.gap >= -1e-14 * scene.size,
        "{checked:?} of {scene:?}"
    );
}

/// Checks that the claimed points of a pair and of the exchanged pair have the same distance.
pub(super) fn check_symmetry<O: DistanceOracle + Default>(scene: &Scene) {
    let one = measure_claim(scene, &claim_with_empty_cache::<O>(scene));
    let swapped = scene.swapped();
    let other = measure_claim(&swapped, &claim_with_empty_cache::<O>(&swapped));
    let error = (one.distance - other.distance).abs();
    assert!(
        error <= 1e-12 * scene.size,
        "{one:?} and {other:?} of {scene:?}"
    );
}

/// Checks that a claim with a used cache is as good as with an empty cache, and that a used oracle gives the same claim
/// as a new oracle if both caches are empty.
pub(super) fn check_independence_of_history<O: DistanceOracle + Default>(scenes: &[Scene]) {
    let (mut used, mut cache) = (O::default(), O::Cache::default());
    for scene in scenes {
        let fresh = claim_with_empty_cache::<O>(scene);
        let warm = ask(&mut used, scene, &mut cache);
        let again = ask(&mut used, scene, &mut cache);
        let unread = ask(&mut used, scene, &mut O::Cache::default());
        assert_eq!(fresh, unread, "{scene:?}");
        let fresh = measure_claim(scene, &fresh);
        for other in [measure_claim(scene, &warm), measure_claim(scene, &again)] {
            let error = (fresh.distance - other.distance).abs();
            assert!(
                error <= 1e-12 * scene.size,
                "{fresh:?} and {other:?} of {scene:?}"
            );
            let worth = lesser(fresh.gap, 0.5 * fresh.distance) - 1e-12 * scene.size;
            assert!(
                fresh.gap < 0.0 || other.gap >= worth,
                "{fresh:?}, {other:?} of {scene:?}"
            );
        }
    }
}

/// Checks that on any finite input the claimed points have a finite distance, which is at least the gap along the
/// claimed axis, up to rounding.
pub(super) fn check_finite_distance_and_gap<O: DistanceOracle + Default>(scene: &Scene) {
    let checked = measure_claim(scene, &claim_with_empty_cache::<O>(scene));
    let sound = checked.gap <= checked.distance + 1e-13 * scene.size;
    assert!(
        sound && checked.distance.is_finite(),
        "{checked:?} of {scene:?}"
    );
}
