//! Tests the closest approach of bodies that exceed their shapes: upper bounds hold for the shapes, and a clearance
//! counts as violated only if the shapes violate it.

use super::*;
use crate::tests::scene::Scene;

/// Returns the scene with an excess of half of `excess` on each body.
fn scene_with_excess(mut scene: Scene, excess: f64) -> Scene {
    scene.bodies = scene
        .bodies
        .map(|body| body.with_excess(0.5 * excess).unwrap());
    scene
}

#[test]
fn upper_bounds_have_the_excess_added_once() {
    let mut rng = rng(21);
    let (mut apart, mut overlapping) = (0, 0);
    for number in 0..400 {
        let scene = scene(&mut rng, SCENE_KINDS[number % 4], 12);
        let known = closest_approach_answer(&scene.problem());
        let size = scene.bodies[0].bounding_radius() + scene.bodies[1].bounding_radius();
        let excess = size * random_power_of_ten(&mut rng, -6.0, -1.0);
        let scene = scene_with_excess(scene, excess);
        let found = closest_approach_answer(&scene.problem());
        let (outcome, upper) = (found.outcome, known.outcome.upper() + excess);
        assert_eq!(outcome.lower(), known.outcome.lower());
        assert_eq!(outcome.time(), known.outcome.time());
        assert!(
            outcome.upper() >= upper && outcome.upper() <= upper * (1.0 + 1e-15),
            "{number}: {outcome:?} of {known:?}"
        );
        assert!(
            found.tolerance >= outcome.least_distance_bracket_width(),
            "{number}: {found:?}"
        );
        match outcome {
            Outcome::Overlapping { upper, .. } => {
                overlapping += 1;
                assert!(upper >= excess);
            }
            _ => apart += 1,
        }
    }
    assert!(
        apart > 200 && overlapping > 0,
        "{apart} apart, {overlapping} not"
    );
}

/// Tests that a required clearance is reported as violated only if the distance is smaller by more than the bodies'
/// excess over the shapes.
#[test]
fn a_clearance_is_violated_by_more_than_the_excess_only() {
    let mut rng = rng(22);
    let (mut kept, mut violated, mut between) = (0, 0, 0);
    for number in 0..500 {
        let mut scene = scene(&mut rng, SCENE_KINDS[number % 4], 12);
        let known = closest_approach_answer(&scene.problem()).outcome;
        let Some((lower, upper)) = known
            .nearest_contact()
            .map(|_| (known.lower(), known.upper()))
        else {
            continue;
        };
        let tolerance = scene.problem().tolerance;
        let size = scene.bodies[0].bounding_radius() + scene.bodies[1].bounding_radius();
        let excess = greater(
            8.0 * tolerance,
            size * random_power_of_ten(&mut rng, -6.0, -1.0),
        );
        scene = scene_with_excess(scene, excess);
        for required in [
            lower - 2.0 * tolerance,
            upper + 0.3 * excess,
            lower + 0.9 * excess,
            upper + excess + 3.0 * tolerance,
        ] {
            if !(required > 0.0) {
                continue;
            }
            scene.settings.clearance = Some(required);
            let outcome = closest_approach_answer(&scene.problem()).outcome;
            assert!(outcome.lower() <= upper, "{number}: {outcome:?}");
            match outcome.clearance_verdict(required) {
                ClearanceVerdict::Kept => {
                    kept += 1;
                    assert!(required <= upper, "{number}: {required:e} of {known:?}");
                }
                ClearanceVerdict::Violated => {
                    violated += 1;
                    assert!(
                        required > lower + excess,
                        "{number}: {required:e} of {known:?} and {excess:e}: {outcome:?}"
                    );
                }
                ClearanceVerdict::Unverified => {
                    between += 1;
                    assert!(
                        required > lower - 1.1 * tolerance
                            && required < upper + excess + 1.1 * tolerance,
                        "{number}: {required:e} of {known:?} and {excess:e}: {outcome:?}"
                    );
                }
            }
        }
    }
    assert!(
        kept > 100 && violated > 100 && between > 100,
        "{kept} {violated} {between}"
    );
}
