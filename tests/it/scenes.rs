//! Tests every scene with an answer in closed form, for every setup and tolerance, and with the bodies swapped.

use ccd_core::order::lesser;
use ccd_core::{Answer, Outcome, Settings};
use ccd_tests::analytic::{ExpectedOutcome, Scene, scenes_with_name_prefix};
use ccd_tests::backends::for_each_setup;
use ccd_tests::checks::{CheckResult, Judge, check_contact};
use ccd_tests::query::Bodies;
use ccd_tests::questions::{TrajectoryAnswers, for_each_trajectory_answer_set};
use ccd_tests::referee::Finding;
use ccd_tests::tolerance::MAX_LATENESS_FRACTION;
use std::fmt::Debug;

/// Defines one test for each group of scenes, whose names begin alike.
macro_rules! groups {
    ($($test:ident: $prefix:literal,)*) => {$(
        #[test]
        fn $test() {
            check_group($prefix);
        }
    )*};
}

groups! {
    t01_falling_cube: "T1 ",
    t02_rod_on_slab: "T2 ",
    t03_pre_rotated_rod: "T3 ",
    t04_rod_by_any_turn: "T4 ",
    t05_grazing_hit: "T5 ",
    t06_grazing_miss: "T6 ",
    t07_parallel_edges: "T7 ",
    t08_edge_on_edge: "T8 ",
    t09_mace: "T9 ",
    t10_sliding: "T10 ",
    t12_peg_in_hole: "T12 ",
    t13_bullet: "T13 ",
    t14_two_rods: "T14 ",
    t15_hooks: "T15 ",
    t16_slit: "T16 ",
    t17_linked_tori: "T17 ",
    t18_screw: "T18 ",
    t19_combs: "T19 ",
    t20_far_and_scaled: "T20 ",
    t21_degenerate: "T21 ",
    t22_icosphere: "T22 ",
    t24_overlap: "T24 ",
    t25_hardly_moving: "T25 ",
    t26_coordinates_of_thousands: "T26 ",
    plates: "plates",
    turntable: "turntable",
    balls: "ball",
    capsule: "capsule",
    rounded_box: "rounded",
}

fn check_group(prefix: &str) {
    let scenes = scenes_with_name_prefix(prefix);
    assert!(!scenes.is_empty(), "no scene is called {prefix}");
    for scene in &scenes {
        let mut judge = Judge::new(&scene.query, &Settings::DEFAULT);
        if !scene.query.a.shape.mesh.faces.is_empty() {
            check_finding(scene, &judge);
        }
        for tolerance in [1e-3, 1e-9] {
            judge = judge.with_tolerance(tolerance * tolerance_scale(scene));
            check_setups(&judge, scene, &scene.expected);
            check_trajectory_setups(&judge, scene, &scene.expected);
        }
        let swapped = Scene {
            name: format!("{}, swapped", scene.name),
            query: scene.query.swapped(),
            expected: ExpectedOutcome::Unknown,
        };
        // The effect of the order depends neither on the tolerance nor on the form of the motions.
        let judge = Judge::new(&swapped.query, &Settings::DEFAULT);
        let judge = judge.with_tolerance(1e-3 * tolerance_scale(scene));
        check_setups(&judge, &swapped, &scene.expected);
    }
}

/// Returns the length to which a scene's tolerances are proportional: its size, but at most 1.
fn tolerance_scale(scene: &Scene) -> f64 {
    lesser(1.0, scene.query.a.reach(0.0))
}

/// Checks the referee's finding against the scene's closed form.
fn check_finding(
    Scene {
        name,
        query,
        expected: expect,
    }: &Scene,
    judge: &Judge<'_>,
) {
    match (expect, judge.finding()) {
        (
            ExpectedOutcome::Hit {
                first_time_within_distance: earliest,
                latest_time: latest,
            },
            Finding::Hit { lo, hi },
        ) => {
            assert!(lo <= latest + 1e-12, "{name}: {lo} > {latest}");
            let earliest = earliest(0.0);
            assert!(hi >= earliest - 1e-12, "{name}: {hi} < {earliest}");
            assert!(hi - lo <= 1e-4, "{name}: {lo} to {hi}");
        }
        (ExpectedOutcome::Free { gap }, Finding::Free { gap: seen }) => {
            assert!(seen >= gap - query.rounding(), "{name}: {seen} < {gap}");
        }
        // The distance is below that at which the referee can exclude touching.
        (ExpectedOutcome::Free { gap }, Finding::Graze { .. }) => assert!(*gap <= 2e-9, "{name}"),
        // Sliding at a small distance takes the referee more steps than its limit.
        (ExpectedOutcome::Free { gap }, Finding::Undecided { .. }) => {
            assert!(*gap < 2e-6, "{name}");
        }
        // The contact is so brief that no intersection is sampled.
        (
            ExpectedOutcome::Hit {
                latest_time: latest,
                ..
            },
            Finding::Graze { lo },
        ) => {
            assert!(lo <= latest + 1e-12, "{name}: {lo} > {latest}");
        }
        // A screw turns freely in its nut by its own pitch only.
        (ExpectedOutcome::Unknown, finding) if name.starts_with("T18") => {
            let free = matches!(finding, Finding::Free { .. });
            assert_eq!(free, name.contains("right"), "{name}: {finding:?}");
        }
        (ExpectedOutcome::Overlap, Finding::ContactAtStart) | (ExpectedOutcome::Unknown, _) => {}
        (ExpectedOutcome::Overlap, finding) => assert!(judge.are_nested(), "{name}: {finding:?}"),
        (_, finding) => panic!("{name}: {finding:?}"),
    }
}

fn check_setups(judge: &Judge<'_>, scene: &Scene, expect: &ExpectedOutcome) {
    for_each_setup(&scene.query, &judge.config(), |bodies, setup, answer| {
        if let Err(why) = check_answer(judge, scene, expect, (bodies, &answer)) {
            fail(scene, &setup, &answer, &why);
        }
    });
}

fn check_trajectory_setups(judge: &Judge<'_>, scene: &Scene, expect: &ExpectedOutcome) {
    for_each_trajectory_answer_set(&scene.query, &judge.config(), |bodies, asked, answers| {
        if let Err(why) = check_trajectory_answers(judge, scene, expect, (bodies, &answers)) {
            fail(scene, &asked, &answers, &why);
        }
    });
}

fn fail(scene: &Scene, setup: &dyn Debug, answer: &dyn Debug, why: &str) -> ! {
    let (a, b) = (&scene.query.a.motion, &scene.query.b.motion);
    panic!("{}: {why}\n{setup:?}\n{answer:?}\n{a:?}\n{b:?}", scene.name);
}

fn check_answer(
    judge: &Judge<'_>,
    scene: &Scene,
    expect: &ExpectedOutcome,
    (bodies, answer): (&Bodies, &Answer),
) -> CheckResult {
    let meshed = !scene.query.a.shape.mesh.faces.is_empty();
    if meshed {
        judge.check(answer, bodies)?;
    } else if let Outcome::Contact { time, contact } = &answer.outcome {
        let reach = answer.tolerance + scene.query.rounding();
        check_contact(&scene.query, *time, contact, bodies, reach)?;
    }
    let (duration, rounding) = (scene.query.duration, scene.query.rounding());
    match (expect, &answer.outcome) {
        (
            ExpectedOutcome::Hit {
                first_time_within_distance: earliest,
                latest_time: latest,
            },
            Outcome::Contact { time, .. },
        ) => {
            if *time > latest + MAX_LATENESS_FRACTION * duration {
                return Err(format!("late: {time} > {latest}"));
            }
            let earliest = earliest(answer.tolerance + rounding) - MAX_LATENESS_FRACTION * duration;
            if *time < earliest {
                return Err(format!("loose: {time} < {earliest}"));
            }
        }
        (ExpectedOutcome::Free { gap }, Outcome::Free { proven_gap }) => {
            if *proven_gap > gap + rounding {
                return Err(format!(
                    "a proven gap of {proven_gap} at a distance of {gap}"
                ));
            }
        }
        // Contact is right at a distance below the tolerance.
        (ExpectedOutcome::Free { gap }, Outcome::Contact { .. } | Outcome::Touching { .. })
            if *gap <= answer.tolerance + rounding => {}
        (ExpectedOutcome::Overlap, Outcome::Overlapping { .. }) | (ExpectedOutcome::Unknown, _) => {
        }
        (
            ExpectedOutcome::Hit {
                latest_time: latest,
                ..
            },
            _,
        ) => return Err(format!("there is a hit at {latest}")),
        (ExpectedOutcome::Free { gap }, _) => return Err(format!("the bodies stay {gap} apart")),
        (ExpectedOutcome::Overlap, _) => return Err("the bodies overlap".into()),
    }
    Ok(())
}

/// Checks the answers about a scene whose motions are given as user-defined trajectories against its closed form.
fn check_trajectory_answers(
    judge: &Judge<'_>,
    scene: &Scene,
    expect: &ExpectedOutcome,
    (bodies, answers): (&Bodies, &TrajectoryAnswers),
) -> CheckResult {
    check_answer(judge, scene, expect, (bodies, &answers.first_contact))?;
    let TrajectoryAnswers {
        any_contact: any,
        closest_approach: closest,
        contact_interval: interval,
        ..
    } = answers;
    if !scene.query.a.shape.mesh.faces.is_empty() {
        judge.check_any_contact(any, bodies)?;
        judge.check_closest_approach(closest, bodies)?;
        judge.check_contact_interval(interval, bodies)?;
    }
    let (lower, upper) = (closest.outcome.lower(), closest.outcome.upper());
    let rounding = scene.query.rounding();
    let (least, is_free) = match expect {
        ExpectedOutcome::Hit { .. } | ExpectedOutcome::Overlap => (0.0, false),
        ExpectedOutcome::Free { gap } => (*gap, *gap > any.tolerance),
        ExpectedOutcome::Unknown => return Ok(()),
    };
    if lower > least + rounding || upper < least - rounding {
        return Err(format!(
            "the least distance {least} is not from {lower} to {upper}"
        ));
    }
    match &any.outcome {
        Outcome::Free { .. } if !is_free && least == 0.0 => Err("missed by any contact".into()),
        Outcome::Contact { .. } if is_free => Err("a false contact".into()),
        _ => Ok(()),
    }
}
