//! Tests contacts at the start, which are reported, or ignored as long as the bodies do not approach.

use ccd_core::glam::{DQuat, DVec3, dvec3};
use ccd_core::rounding::MIN_APPROACH_PER_ROUNDING;
use ccd_core::schedule::{BestFirst, Schedule};
use ccd_core::{
    Body, Claim, DistanceOracle, GiveUpReason, Motion, Outcome, PiecePair, Pieces, Pose, Settings,
    Solidity, StartPolicy,
};
use ccd_distance_gjk::ClosedForm;
use ccd_tests::analytic::sliding_cube;
use ccd_tests::backends::for_each_setup;
use ccd_tests::checks::Judge;
use ccd_tests::models::{Mesh, Shape, cuboid};
use ccd_tests::query::{MovingShape, Query};
use ccd_tests::strategies::{cases, check_cases};
use std::cell::Cell;
use std::f64::consts::FRAC_1_SQRT_2;

fn settings_with_leave(tolerance: f64) -> Settings {
    Settings {
        start_policy: StartPolicy::Leave,
        ..settings_with_tolerance(tolerance)
    }
}

fn settings_with_tolerance(tolerance: f64) -> Settings {
    Settings {
        tolerance,
        ..Settings::DEFAULT
    }
}

/// Calls `check` with the outcome of every setup, for the query and for the query with the bodies swapped.
fn check_outcomes(query: &Query, config: &Settings, check: impl Fn(Outcome) -> bool) {
    for query in [query.clone(), query.swapped()] {
        for_each_setup(&query, config, |_, setup, answer| {
            assert!(check(answer.outcome), "{config:?}\n{setup:?}\n{answer:?}");
        });
    }
}

fn is_free(outcome: Outcome) -> bool {
    matches!(outcome, Outcome::Free { .. })
}

fn is_touching(outcome: Outcome) -> bool {
    matches!(outcome, Outcome::Touching { .. })
}

/// Tests T10: a body that slides at a gap within the tolerance is touching at the start, and free under
/// `StartPolicy::Leave`. It slides along the diagonal on which the slab's two triangles meet, so that no triangle
/// passes onto another.
#[test]
fn sliding_within_the_tolerance_is_free() {
    for gap in [1e-6, 1e-9, 0.0] {
        let query = sliding_cube(gap, DVec3::new(1.0, 1.0, 0.0)).query;
        check_outcomes(&query, &settings_with_tolerance(1e-3), is_touching);
        check_outcomes(&query, &settings_with_leave(1e-3), is_free);
    }
    check_outcomes(
        &sliding_cube(1e-6, -DVec3::X).query,
        &settings_with_tolerance(1e-8),
        is_free,
    );
    check_outcomes(
        &sliding_cube(1e-6, -DVec3::X).query,
        &settings_with_leave(1e-8),
        is_free,
    );
}

/// Tests T10: a body that slides from one triangle of the slab onto another is free under `StartPolicy::Leave`. The
/// edge of the next triangle is flat ground as well.
#[test]
fn sliding_onto_another_piece_is_free() {
    for gap in [1e-6, 1e-9, 0.0] {
        check_outcomes(
            &sliding_cube(gap, -DVec3::X).query,
            &settings_with_leave(1e-3),
            is_free,
        );
    }
}

/// Tests T11: bodies that touch at the start and then separate are free under `StartPolicy::Leave`.
#[test]
fn touching_and_parting_is_free() {
    for gap in [1e-6, 0.0] {
        check_outcomes(
            &sliding_cube(gap, DVec3::Z).query,
            &settings_with_leave(1e-3),
            is_free,
        );
        check_outcomes(
            &sliding_cube(gap, DVec3::new(2.0, 0.0, 1.0)).query,
            &settings_with_leave(1e-3),
            is_free,
        );
        check_outcomes(
            &sliding_cube(gap, DVec3::Z).query,
            &settings_with_tolerance(1e-3),
            is_touching,
        );
    }
}

/// Tests T11: bodies that touch at the start and then approach are in contact at once under `StartPolicy::Leave`.
#[test]
fn touching_and_approaching_is_a_contact_at_once() {
    for gap in [1e-6, 0.0] {
        let query = sliding_cube(gap, -DVec3::Z).query;
        check_outcomes(&query, &settings_with_tolerance(1e-3), is_touching);
        check_outcomes(
            &query,
            &settings_with_leave(1e-3),
            |outcome| match outcome {
                // An approach at speed 1 is visible once the distance has decreased by more than rounding.
                Outcome::Contact { time, .. } => {
                    (0.0..=gap + MIN_APPROACH_PER_ROUNDING * query.rounding()).contains(&time)
                }
                _ => false,
            },
        );
    }
}

/// Tests that two solids with a common face that move into each other are in contact at once under
/// `StartPolicy::Leave`.
#[test]
fn flush_solids_that_dive_into_each_other_are_in_contact_at_once() {
    let cube = || cuboid(DVec3::splat(0.5));
    for side in [DVec3::X, DVec3::Y, DVec3::Z] {
        let dive = |velocity: DVec3| {
            Query::new(
                MovingShape::still(cube(), DVec3::ZERO),
                MovingShape::translating_shape(cube(), side, velocity),
            )
        };
        for velocity in [-side, -side + 0.5 * DVec3::new(side.y, side.z, side.x)] {
            let query = dive(0.5 * velocity);
            check_outcomes(
                &query,
                &settings_with_leave(1e-3),
                |outcome| match outcome {
                    Outcome::Contact { time, .. } => time <= 1e-11,
                    _ => false,
                },
            );
        }
        // Away from each other, they are free.
        check_outcomes(&dive(0.5 * side), &settings_with_leave(1e-3), is_free);
    }
}

/// Tests that a very slow approach from touching is a contact within the allowance for rounding, after few distance
/// computations.
#[test]
fn a_very_slow_approach_takes_few_steps() {
    for approach in [1e-5, 1e-7, 1e-9, 1e-11] {
        let query = sliding_cube(0.0, -approach * DVec3::Z).query;
        for_each_setup(&query, &settings_with_leave(1e-3), |_, setup, answer| {
            let Outcome::Contact { time, .. } = answer.outcome else {
                panic!("{approach:e} {setup:?}\n{answer:?}");
            };
            // Half of the least tolerance is the allowance for rounding of a resting contact.
            assert!(time * approach <= 0.5 * answer.tolerance, "{time:e}");
            let calls = answer.stats.oracle_calls;
            assert!(calls < 5_000, "{approach:e}: {calls} {setup:?}");
        });
    }
}

/// Tests that a box within the margin of a large floor is in contact at once if it approaches the floor, and has an
/// answer if it slides. Across so small a gap, the direction of the nearest points is not exact enough to distinguish
/// sliding from approaching. The features' normals are.
#[test]
fn inside_the_margin_sliding_is_free_and_approaching_is_a_contact() {
    let floor = cuboid(DVec3::new(8.0, 8.0, 0.5)).moved(-0.5 * DVec3::Z);
    let half = DVec3::new(0.11, 0.06, 0.05);
    let config = |margin: f64| Settings {
        margin,
        ..settings_with_leave(4e-8)
    };
    for margin in [3.4e-3, 0.1] {
        for fraction in [1.0, 0.5, 1e-3, 0.0] {
            let gap = fraction * margin;
            let at = |velocity: DVec3| {
                Query::new(
                    MovingShape::still(floor.clone(), DVec3::ZERO),
                    MovingShape::translating_shape(
                        cuboid(half),
                        DVec3::new(0.25, -0.97, half.z + gap),
                        velocity,
                    ),
                )
            };
            let across = DVec3::new(-1.12, 0.63, 0.0);
            let query = at(across);
            for_each_setup(&query, &config(margin), |_, setup, answer| {
                let expected = matches!(
                    answer.outcome,
                    Outcome::Free { .. } | Outcome::Contact { .. }
                );
                assert!(expected, "{gap} {setup:?}\n{answer:?}");
            });
            let query = at(across - 0.01 * DVec3::Z);
            let allowed = 2.0 * MIN_APPROACH_PER_ROUNDING * query.rounding() / 0.01;
            check_outcomes(&query, &config(margin), |outcome| match outcome {
                Outcome::Contact { time, .. } => time <= allowed,
                _ => false,
            });
        }
    }
}

/// Tests that bodies that touch and approach are not reported free if the oracle claims a wrong axis.
#[test]
fn a_liar_cannot_release_a_pair() {
    let spike = Shape::from_open_mesh(Mesh {
        vertices: vec![
            DVec3::ZERO,
            DVec3::new(0.1, 0.0, 1.0),
            DVec3::new(0.0, 0.1, 1.0),
        ],
        faces: vec![[0, 1, 2]],
    });
    let floor = Shape::from_open_mesh(Mesh {
        vertices: vec![
            DVec3::new(-4.0, -4.0, 0.0),
            DVec3::new(4.0, -4.0, 0.0),
            DVec3::new(0.0, 4.0, 0.0),
        ],
        faces: vec![[0, 1, 2]],
    });
    let query = Query::new(
        MovingShape::still(floor, DVec3::ZERO),
        MovingShape::translating_shape(spike, DVec3::ZERO, -DVec3::Z),
    );
    let bodies = query.bodies_of_triangles();
    let settings = settings_with_leave(1e-3);
    let problem = query.problem(&bodies, &settings);
    for axis in [DVec3::X, DVec3::Y, -DVec3::Y, -DVec3::Z, DVec3::NAN] {
        let answer = BestFirst::default()
            .first_contact(&problem, &mut WrongAxisOracle(axis, ClosedForm::default()))
            .unwrap();
        assert!(!is_free(answer.outcome), "{axis} {answer:?}");
    }
}

/// An oracle that returns the right nearest points with a wrong axis.
struct WrongAxisOracle(DVec3, ClosedForm);

impl DistanceOracle for WrongAxisOracle {
    type Cache = <ClosedForm as DistanceOracle>::Cache;

    fn separation(
        &mut self,
        pair: &PiecePair<'_>,
        cache: &mut Self::Cache,
    ) -> Result<Claim, GiveUpReason> {
        let claim = self.1.separation(pair, cache)?;
        Ok(Claim {
            axis: self.0,
            ..claim
        })
    }
}

#[test]
fn a_released_contact_may_come_back() {
    // It slides off to the side, against a post a unit away.
    let post = cuboid(DVec3::new(0.1, 1.0, 1.0)).moved(DVec3::new(-1.6, 0.0, 0.5));
    let slab = cuboid(DVec3::new(3.0, 3.0, 0.5)).moved(-0.5 * DVec3::Z);
    let query = Query::new(
        MovingShape::translating_shape(cuboid(DVec3::splat(0.5)), 0.5 * DVec3::Z, -2.0 * DVec3::X),
        MovingShape::still(Shape::union([slab, post]), DVec3::ZERO),
    );
    check_outcomes(
        &query,
        &settings_with_leave(1e-3),
        |outcome| match outcome {
            Outcome::Contact { time, .. } => (0.4995..=0.5).contains(&time),
            _ => false,
        },
    );
}

#[test]
fn without_contact_at_the_start_both_policies_agree() {
    let (hits, misses) = (Cell::new(0), Cell::new(0));
    check_cases(120, cases(), |case| {
        let query = case.query();
        let config = Settings {
            start_policy: StartPolicy::Leave,
            ..case.config()
        };
        let judge = Judge::new(&query, &config);
        let mut law = Ok(());
        for_each_setup(&query, &case.config(), |bodies, setup, reported| {
            let problem = query.problem(bodies, &config);
            let left = setup.backend.solve(&problem);
            let at_start = matches!(
                reported.outcome,
                Outcome::Touching { .. } | Outcome::Overlapping { .. }
            );
            if at_start {
                return;
            }
            let same =
                std::mem::discriminant(&reported.outcome) == std::mem::discriminant(&left.outcome);
            if !same {
                law = Err(format!("{setup:?}\n{reported:?}\n{left:?}"));
            }
            let count = match reported.outcome {
                Outcome::Contact { .. } => &hits,
                _ => &misses,
            };
            count.set(count.get() + 1);
            if let Err(why) = judge.check(&left, bodies) {
                law = Err(format!("{why}\n{setup:?}\n{reported:?}\n{left:?}"));
            }
        });
        law
    });
    assert!(
        hits.get() > 120 && misses.get() > 120,
        "{hits:?} {misses:?}"
    );
}

/// Creates two triangles for [`a_contact_that_came_back_is_within_the_tolerance_of_its_answer`], in contact at its
/// poses.
fn two_triangles() -> [Body; 2] {
    let triangle = |corners: [DVec3; 3]| {
        let pieces = Pieces::from_triangles(&corners, &[[0, 1, 2]], &[0]).unwrap();
        Body::new(&pieces, Solidity::Surface).unwrap()
    };
    let a = [
        dvec3(0.029279379471886524, 2.0151645759136314, 2.093708330440966),
        dvec3(0.49437779244315594, 1.685502073259312, 1.0310849589058126),
        dvec3(-0.8373660370339285, 2.710345564957067, 2.398562132033235),
    ];
    let b = [
        dvec3(
            0.10744495311621308,
            0.03256789623258283,
            0.10856365144018956,
        ),
        dvec3(
            0.05600802251563977,
            -0.00565033696736722,
            0.04834691529652721,
        ),
        dvec3(
            0.09144446912907266,
            0.020679353899182573,
            0.0898320190119848,
        ),
    ];
    [triangle(a), triangle(b)]
}

/// Tests that two triangles that start in contact and approach have a contact within the answer's tolerance. The
/// accuracy of their distance depends on the last digits of their positions.
#[test]
fn a_contact_that_came_back_is_within_the_tolerance_of_its_answer() {
    let [a, b] = two_triangles();
    let quarter = DQuat::from_xyzw(FRAC_1_SQRT_2, 0.0, 0.0, FRAC_1_SQRT_2);
    let velocity = dvec3(
        0.08858249309916147,
        -0.18564792545337397,
        -0.023889591860946035,
    );
    let of_b = Motion::new(
        Pose::new(DVec3::ZERO, quarter).unwrap(),
        velocity,
        DVec3::ZERO,
    )
    .unwrap();
    let mut contacts = 0;
    for k in 0..400 {
        let x = 0.9288105061630012 + f64::from(k) * 1.2e-14 - 2.4e-12;
        let start = Pose::at(dvec3(x, -2.800177583969052, -2.3778827781340524)).unwrap();
        let velocity = dvec3(-5.659310496272526, -10.04365391655141, -3.959265248611295);
        let spin = dvec3(
            0.010600519536307652,
            0.03702523082603338,
            0.018210892309690595,
        );
        let of_a = Motion::new(start, velocity, spin).unwrap();
        let settings = settings_with_leave(1e-3);
        let problem = ccd_core::Query::new((&a, of_a), (&b, of_b), 1.0, &settings).unwrap();
        let answer = BestFirst::default()
            .first_contact(&problem, &mut ClosedForm::default())
            .unwrap();
        if let Outcome::Contact { contact, .. } = answer.outcome {
            contacts += 1;
            let upper = contact.separation.upper;
            assert!(
                upper <= answer.tolerance && answer.tolerance < 1e-11,
                "{answer:?}"
            );
        }
    }
    assert!(contacts > 100, "{contacts}");
}
