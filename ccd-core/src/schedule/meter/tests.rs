//! The limits of a query: work and time.

use super::*;
use crate::body::Body;
use crate::config::Config;
use crate::motion::Motion;
use crate::motion::pose::Pose;
use crate::problem::Moving;
use crate::tolerance::LOOKS_PER_VISIT;
use std::time::Duration;

fn meter(config: &Config) -> Meter {
    let ball = Body::ball(1.0).unwrap();
    let still = Moving {
        body: &ball,
        motion: Motion::still(Pose::IDENTITY),
    };
    Meter::new(&Problem::new(still, still, 1.0, config).unwrap())
}

fn with_deadline(deadline: Duration) -> Meter {
    meter(&Config {
        deadline: Some(deadline),
        ..Config::default()
    })
}

#[test]
fn visits_and_looks_at_points_spend_the_same_budget() {
    let config = Config {
        budget: 5,
        ..Config::default()
    };
    let mut meter = meter(&config);
    assert_eq!(meter.visit(), Ok(()));
    meter.stats.point_looks += 3 * LOOKS_PER_VISIT;
    assert_eq!(meter.visit(), Ok(()));
    assert_eq!(meter.stats.work(), 5);
    assert_eq!(meter.visit(), Err(Limit::Budget));
}

#[test]
fn a_deadline_that_is_past_ends_the_first_visit() {
    assert_eq!(with_deadline(Duration::ZERO).visit(), Err(Limit::Deadline));
}

#[test]
fn a_deadline_is_seen_within_the_work_between_two_looks() {
    let mut meter = with_deadline(Duration::from_millis(1));
    assert_eq!(meter.visit(), Ok(()));
    std::thread::sleep(Duration::from_millis(2));
    let mut visits = 0;
    while meter.visit() == Ok(()) {
        visits += 1;
    }
    assert!(visits < WORK_BETWEEN_LOOKS, "{visits}");
    // Equal costs count equally.
    let mut meter = with_deadline(Duration::from_millis(1));
    assert_eq!(meter.visit(), Ok(()));
    std::thread::sleep(Duration::from_millis(2));
    meter.stats.point_looks += WORK_BETWEEN_LOOKS * LOOKS_PER_VISIT;
    assert_eq!(meter.visit(), Err(Limit::Deadline));
}

#[test]
fn a_flag_that_another_thread_sets_ends_the_query_within_the_work_between_two_looks() {
    let ball = Body::ball(1.0).unwrap();
    let still = (&ball, Motion::STILL);
    let stop = Arc::new(AtomicBool::new(false));
    let problem = Problem::new(still, still, 1.0, &Config::default()).unwrap();
    let problem = problem.stopped_by(&stop);
    let mut meter = Meter::new(&problem);
    assert!((0..10_000).all(|_| meter.visit() == Ok(())));
    std::thread::scope(|scope| {
        scope.spawn(|| stop.store(true, Ordering::Relaxed));
    });
    let visits = (0..).take_while(|_| meter.visit() == Ok(())).count();
    assert!(visits < WORK_BETWEEN_LOOKS as usize, "{visits}");
    assert_eq!(Meter::new(&problem).visit(), Err(Limit::Stopped));
}

#[test]
fn an_unreachable_deadline_counts_as_none() {
    let mut meter = with_deadline(Duration::MAX);
    assert!((0..10_000).all(|_| meter.visit() == Ok(())));
}
