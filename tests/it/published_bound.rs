//! Tests that answers with the paper's velocity bound, which uses only the current pose, are late for rotating arms,
//! and that answers with the sound bound are not.

use ccd_core::VelocityBound;
use ccd_core::glam::{DQuat, DVec3};
use ccd_core::schedule::{Fast, Naive};
use ccd_core::{Answer, Motion, Outcome, Pose, Schedule, Settings};
use ccd_distance_gjk::Gjk;
use ccd_tests::analytic::{ExpectedOutcome, scenes_with_name_prefix};
use ccd_tests::models::{PieceKind, cuboid};
use ccd_tests::query::{Bodies, MovingShape, Query};
use ccd_tests::referee::{Finding, Referee};
use rand::RngExt;
use rand_pcg::Pcg64;

/// Returns the two schedules of the paper, `Fast` and `Naive`, with the given velocity bound.
fn schedules(bound: VelocityBound) -> [Box<dyn Schedule<Gjk>>; 2] {
    [Box::new(Fast::new(bound)), Box::new(Naive::new(bound))]
}

fn solve_by_both_schedules(problem: &ccd_core::Query<'_>, bound: VelocityBound) -> [Answer; 2] {
    schedules(bound).map(|mut schedule| schedule.first_contact(problem, &mut Gjk).unwrap())
}

/// Returns how late an answer is after the true contact; infinity if it misses the contact.
fn delay_after_contact(answer: &Answer, contact: f64) -> f64 {
    match answer.outcome {
        Outcome::Contact { time, .. } => time - contact,
        Outcome::Free { .. } => f64::INFINITY,
        outcome => panic!("{outcome:?}"),
    }
}

fn bodies(query: &Query) -> Bodies {
    let kind = |actor: &MovingShape| {
        let kinds: Vec<PieceKind> = actor.shape.piece_kinds().collect();
        *[PieceKind::Patches, PieceKind::ConvexParts]
            .iter()
            .find(|kind| kinds.contains(kind))
            .expect("convex pieces")
    };
    query.bodies([kind(&query.a), kind(&query.b)])
}

#[test]
fn the_mace_passes_the_wall_with_the_published_bound_and_stops_with_the_sound_one() {
    let scenes = scenes_with_name_prefix("T9 ");
    let ExpectedOutcome::Hit {
        latest_time: latest,
        ..
    } = scenes[0].expected
    else {
        panic!("the mace meets the wall");
    };
    let bodies = bodies(&scenes[0].query);
    let problem = scenes[0].query.problem(&bodies, &Settings::DEFAULT);
    for answer in solve_by_both_schedules(&problem, VelocityBound::Published) {
        assert!(delay_after_contact(&answer, latest) > 0.1, "{answer:?}");
    }
    for answer in solve_by_both_schedules(&problem, VelocityBound::Sound) {
        let late = delay_after_contact(&answer, latest);
        assert!((-1e-3..=1e-12).contains(&late), "{late}: {answer:?}");
    }
}

/// Returns a query of two thin rods in random orientations, of which one flies at the other and rotates.
fn random_rod_query(rng: &mut Pcg64) -> Query {
    let mut vector = |size: f64| {
        let mut coordinate = || rng.random_range(-size..size);
        DVec3::new(coordinate(), coordinate(), coordinate())
    };
    let mut rod = |position: DVec3, velocity: DVec3, turns: f64| MovingShape {
        shape: cuboid(DVec3::new(1.0, 0.05, 0.05)),
        motion: Motion::new(
            Pose::new(position, DQuat::from_scaled_axis(vector(3.0))).expect("a pose"),
            velocity,
            vector(1.0).normalize() * turns * std::f64::consts::TAU,
        )
        .expect("finite velocities"),
    };
    Query::new(
        rod(DVec3::new(-2.5, 0.2, 0.1), 5.0 * DVec3::X, 3.0),
        rod(DVec3::ZERO, DVec3::ZERO, 0.0),
    )
}

#[test]
fn some_fast_rods_are_late_with_the_published_bound_and_none_with_the_sound_one() {
    let mut rng = Pcg64::new(9, 0);
    let (mut hits, mut late) = (0, [0; 2]);
    for _ in 0..300 {
        let query = random_rod_query(&mut rng);
        let Finding::Hit { hi, .. } = Referee::new(&query).finding() else {
            continue;
        };
        hits += 1;
        let bodies = bodies(&query);
        let problem = query.problem(&bodies, &Settings::DEFAULT);
        for answer in solve_by_both_schedules(&problem, VelocityBound::Sound) {
            assert!(
                delay_after_contact(&answer, hi) <= 1e-9,
                "{answer:?}: {query:?}"
            );
        }
        for (late, answer) in late
            .iter_mut()
            .zip(solve_by_both_schedules(&problem, VelocityBound::Published))
        {
            *late += usize::from(delay_after_contact(&answer, hi) > 1e-4);
        }
    }
    assert!(
        hits > 75 && late.iter().all(|&late| late > 0),
        "{late:?} of {hits}"
    );
}
