//! Tests required, greatest and least distances along trajectories, and bounds after a limit.

use super::*;
use crate::answer::Clearance;
use crate::answer::Limit;
use crate::answer::Unresolved;

/// Returns the least and the greatest distance at equal time steps, so short that distances in between hardly differ.
fn sampled(swings: &Swings) -> [f64; 2] {
    let distances = (0..=200).map(|k| swings.distance(f64::from(k) / 200.0));
    distances.fold([f64::INFINITY, 0.0], |[least, most], found| {
        [
            lesser(least, found),
            crate::math::order::greater(most, found),
        ]
    })
}

#[test]
fn a_required_distance_is_kept_or_not_on_either_side_of_the_least() {
    let mut rng = rng(21);
    let (mut kept, mut violated, mut between) = (0, 0, 0);
    for number in 0..200 {
        let mut swings = Swings::draw(&mut rng);
        let tolerance = swings.config.tolerance;
        let [least, _] = sampled(&swings);
        let ask = |swings: &Swings| {
            let query = swings.query();
            let answer = DepthFirst::default().closest_approach(&query, &mut Exhaustive);
            answer.unwrap().outcome
        };
        let known = ask(&swings);
        if known.nearest().is_none() {
            continue;
        }
        let (lower, upper) = (known.lower(), known.upper());
        for required in [
            0.5 * lower,
            lower - 2.0 * tolerance,
            0.5 * (lower + upper),
            upper + 2.0 * tolerance,
            upper + 0.2,
        ] {
            if !(required >= 0.0) {
                continue;
            }
            swings.config.clearance = Some(required);
            let outcome = ask(&swings);
            assert!(
                outcome.lower() <= least + ROUNDING,
                "{number}: {outcome:?}, {least:e}"
            );
            match outcome.clearance(required) {
                Clearance::Kept => kept += 1,
                Clearance::Violated => {
                    violated += 1;
                    let near = swings.distance(outcome.time().unwrap());
                    assert!(
                        near <= outcome.upper() + ROUNDING,
                        "{number}: {outcome:?}, {near:e}"
                    );
                }
                Clearance::Unverified => {
                    between += 1;
                    assert!(
                        required <= upper + 1.1 * tolerance && required >= lower - 1.1 * tolerance,
                        "{number}: {required:e} beside {known:?}: {outcome:?}"
                    );
                }
            }
        }
    }
    assert!(
        kept > 60 && violated > 100 && between > 40,
        "{kept} {violated} {between}"
    );
}

#[test]
fn budgets_end_a_search_with_bounds_that_hold() {
    let mut rng = rng(22);
    let (mut ended, mut proven) = (0, 0);
    for number in 0..100 {
        let mut swings = Swings::draw(&mut rng);
        let [least, most] = sampled(&swings);
        let query = swings.query();
        let whole = DepthFirst::default().closest_approach(&query, &mut Exhaustive);
        let work = whole.unwrap().stats.work();
        for share in [0.1, 0.5, 0.9] {
            swings.config.budget = (share * work as f64) as u64 + 1;
            let query = swings.query();
            let answer = DepthFirst::default().closest_approach(&query, &mut Exhaustive);
            let outcome = answer.unwrap().outcome;
            assert!(
                outcome.lower() <= least + ROUNDING,
                "{number}: {outcome:?}, {least:e}"
            );
            if let Outcome::Unresolved(Unresolved {
                lower,
                limit: reason,
                ..
            }) = outcome
            {
                assert_eq!(reason, Limit::Budget);
                ended += 1;
                proven += u32::from(lower > 0.0);
            }
            let far = DepthFirst::default().greatest_distance(&query, &mut Exhaustive);
            let far = far.unwrap().outcome;
            assert!(
                far.upper() >= most - ROUNDING,
                "{number}: {far:?}, {most:e}"
            );
            if let Some(time) = far.time() {
                assert!(
                    swings.distance(time) >= far.lower() - ROUNDING,
                    "{number}: {far:?}"
                );
            }
        }
    }
    assert!(ended > 60 && 4 * proven > ended, "{proven} of {ended}");
}

#[test]
fn greatest_distances_hold_at_sampled_times_and_are_narrow() {
    let mut rng = rng(23);
    let (mut apart, mut within) = (0, 0);
    for number in 0..150 {
        let mut swings = Swings::draw(&mut rng);
        swings.config.tolerance = magnitude(&mut rng, -4.0, -1.0);
        let [_, most] = sampled(&swings);
        let query = swings.query();
        let answer = DepthFirst::default().greatest_distance(&query, &mut Exhaustive);
        let answer = answer.unwrap();
        let outcome = answer.outcome;
        assert!(
            matches!(outcome, Outcome::Measured { .. }),
            "{number}: {answer:?}"
        );
        assert!(
            most <= outcome.upper() + ROUNDING,
            "{number}: {most:e} {answer:?}"
        );
        let width = outcome.upper() - outcome.lower();
        assert!(width <= swings.config.tolerance, "{number}: {answer:?}");
        match outcome.time() {
            Some(time) => {
                apart += 1;
                let there = swings.distance(time);
                assert!(
                    there >= outcome.lower() - ROUNDING,
                    "{number}: {there:e} {answer:?}"
                );
                within += u32::from((0.01..0.99).contains(&time));
            }
            None => assert!(most <= swings.config.tolerance + ROUNDING),
        }
    }
    assert!(apart > 100 && within > 20, "{apart} {within}");
}

/// A body on a circle whose accelerations are said to be bounded by something that is no number.
struct WithoutBound;

impl Smooth for WithoutBound {
    fn tangent(&self, t: f64) -> Result<Motion, InputError> {
        let angle = std::f64::consts::TAU * t;
        let start = crate::Pose::at(DVec3::new(2.0 + 3.0 * angle.sin(), 0.0, 0.0))?;
        let velocity = 3.0 * std::f64::consts::TAU * angle.cos();
        Motion::new(start, velocity * DVec3::X, DVec3::ZERO)
    }

    fn accelerations(&self, _: f64, _: f64) -> Accelerations {
        Accelerations {
            linear: f64::NAN,
            angular: 0.0,
        }
    }
}

#[test]
fn a_deviation_that_is_no_number_bounds_no_greatest_distance() {
    let ball = Body::sphere(0.2).unwrap();
    let far = Motion::still(crate::Pose::at(-10.0 * DVec3::X).unwrap());
    let config = Settings {
        budget: 1_000,
        ..Settings::DEFAULT
    };
    let query = Query::new((&ball, &WithoutBound), (&ball, far), 1.0, &config).unwrap();
    let answer = DepthFirst::default().greatest_distance(&query, &mut Exhaustive);
    // The greatest distance is 14.6.
    if let Ok(answer) = answer {
        assert!(answer.outcome.upper() >= 14.6, "{answer:?}");
    }
}
