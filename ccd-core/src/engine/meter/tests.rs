//! Tests the limits of a query: work and time.

use super::*;
use crate::body::Body;
use crate::motion::Motion;
use crate::settings::Settings;
use crate::tuning::EVALUATIONS_WORTH_A_VISIT;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

/// Creates the problem of two equal balls at rest, with limits.
fn limited_problem<'a>(ball: &'a Body, settings: &'a Settings) -> Problem<'a> {
    let still = (ball, Motion::STILL);
    Problem::of_moving_bodies(still, still, 1.0, settings).unwrap()
}

fn ball() -> Body {
    Body::sphere(1.0).unwrap()
}

fn settings_with_deadline(deadline: Duration) -> Settings {
    Settings {
        deadline: Some(deadline),
        ..Settings::DEFAULT
    }
}

#[test]
fn visits_and_looks_at_points_spend_the_same_budget() {
    let config = Settings {
        budget: 5,
        ..Settings::DEFAULT
    };
    let ball = ball();
    let problem = limited_problem(&ball, &config);
    let mut meter = Meter::new(&problem);
    assert_eq!(meter.count_visit_and_check_limits(&problem), Ok(()));
    meter.stats.point_evaluations += 3 * EVALUATIONS_WORTH_A_VISIT;
    assert_eq!(meter.count_visit_and_check_limits(&problem), Ok(()));
    assert_eq!(meter.stats.budgeted_work(), 5);
    assert_eq!(
        meter.count_visit_and_check_limits(&problem),
        Err(Limit::Budget)
    );
}

#[test]
fn a_deadline_that_is_past_ends_the_first_visit() {
    let ball = ball();
    let settings = settings_with_deadline(Duration::ZERO);
    let problem = limited_problem(&ball, &settings);
    assert_eq!(
        Meter::new(&problem).count_visit_and_check_limits(&problem),
        Err(Limit::Deadline)
    );
}

#[test]
fn a_deadline_is_seen_within_the_work_between_two_looks() {
    let ball = ball();
    let settings = settings_with_deadline(Duration::from_millis(1));
    let problem = limited_problem(&ball, &settings);
    let mut meter = Meter::new(&problem);
    assert_eq!(meter.count_visit_and_check_limits(&problem), Ok(()));
    std::thread::sleep(Duration::from_millis(2));
    let mut visits = 0;
    while meter.count_visit_and_check_limits(&problem) == Ok(()) {
        visits += 1;
    }
    assert!(visits < WORK_BETWEEN_CLOCK_READS, "{visits}");
    // Equal costs count equally.
    let mut meter = Meter::new(&problem);
    assert_eq!(meter.count_visit_and_check_limits(&problem), Ok(()));
    std::thread::sleep(Duration::from_millis(2));
    meter.stats.point_evaluations += WORK_BETWEEN_CLOCK_READS * EVALUATIONS_WORTH_A_VISIT;
    assert_eq!(
        meter.count_visit_and_check_limits(&problem),
        Err(Limit::Deadline)
    );
}

#[test]
fn a_flag_that_another_thread_sets_ends_the_query_within_the_work_between_two_looks() {
    let (ball, stop) = (ball(), Arc::new(AtomicBool::new(false)));
    let settings = Settings {
        stop: Some(Arc::clone(&stop)),
        ..Settings::DEFAULT
    };
    let problem = limited_problem(&ball, &settings);
    let mut meter = Meter::new(&problem);
    assert!((0..10_000).all(|_| meter.count_visit_and_check_limits(&problem) == Ok(())));
    std::thread::scope(|scope| {
        scope.spawn(|| stop.store(true, Ordering::Relaxed));
    });
    let visits = (0..)
        .take_while(|_| meter.count_visit_and_check_limits(&problem) == Ok(()))
        .count();
    assert!(visits < WORK_BETWEEN_CLOCK_READS as usize, "{visits}");
    assert_eq!(
        Meter::new(&problem).count_visit_and_check_limits(&problem),
        Err(Limit::Stopped)
    );
}

#[test]
fn an_unreachable_deadline_counts_as_none() {
    let ball = ball();
    let settings = settings_with_deadline(Duration::MAX);
    let problem = limited_problem(&ball, &settings);
    let mut meter = Meter::new(&problem);
    assert!((0..10_000).all(|_| meter.count_visit_and_check_limits(&problem) == Ok(())));
}
