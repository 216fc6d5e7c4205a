//! Tests queries along trajectories that run out of budget. Each part between two corners has its own budget.

use super::*;
use crate::answer::Limit;
use crate::answer::Unresolved;
use crate::body::Body;
use crate::error::InputError;
use crate::motion::trajectory::Trajectory;
use crate::motion::trajectory::{DeviationBound, Stretch};
use crate::query::Query;
use crate::settings::Settings;

#[test]
fn budgets_end_a_search_with_a_time_that_is_safe() {
    let mut rng = rng(6);
    let mut ended = 0;
    for number in 0..60 {
        let mut swings = SwingingBodies::draw(&mut rng);
        let until = match swings.first() {
            Outcome::Contact { time, .. } => time,
            Outcome::Free { .. } => 1.0,
            _ => continue,
        };
        for budget in 1..60 {
            swings.settings.budget = budget;
            match swings.first() {
                Outcome::Unresolved(Unresolved {
                    safe_until,
                    limit: reason,
                    ..
                }) => {
                    assert_eq!(reason, Limit::Budget);
                    assert!(safe_until <= until, "{number}: {safe_until} of {until}");
                    ended += 1;
                }
                _ => break,
            }
        }
    }
    assert!(ended > 300, "{ended}");
}

/// A trajectory that goes back and forth along x past the origin, with a corner at each reversal.
struct ShuttleTrajectory {
    laps: u32,
    lateral_offset: f64,
}

impl ShuttleTrajectory {
    fn position_at(&self, time: f64) -> DVec3 {
        let way = time * f64::from(self.laps);
        let lap = way.floor();
        let x = if lap % 2.0 == 0.0 {
            way - lap
        } else {
            lap + 1.0 - way
        };
        DVec3::new(2.0 * x - 1.0, self.lateral_offset, 0.0)
    }
}

impl Trajectory for ShuttleTrajectory {
    fn stretch_between(&self, from: f64, to: f64) -> Result<Stretch, InputError> {
        let [start, end] = [from, to].map(|time| self.position_at(time));
        let velocity = if to > from {
            (end - start) / (to - from)
        } else {
            DVec3::ZERO
        };
        let shift = if self.velocity_jump_time(from, to).is_some() {
            2.0
        } else {
            1e-14
        };
        let motion = Motion::new(crate::Pose::at(start)?, velocity, DVec3::ZERO)?;
        Ok(Stretch {
            deviation_bound: DeviationBound {
                center_deviation: shift,
                max_deviation_angle: 0.0,
            },
            ..Stretch::exact(motion)
        })
    }

    fn velocity_jump_time(&self, from: f64, to: f64) -> Option<f64> {
        let laps = f64::from(self.laps);
        let corner = (0.5 * (from + to) * laps).round() / laps;
        (from < corner && corner < to).then_some(corner)
    }
}

#[test]
fn each_part_between_two_corners_has_a_budget() {
    let mut rng = rng(9);
    let soup = random_triangle_soup(&mut rng, SoupKind::WellShaped, 40, 1.0);
    let (body, ball) = (body(&soup), Body::sphere(0.5).unwrap());
    let ask = |laps: u32, beside: f64, budget: u64| {
        let config = Settings {
            tolerance: 1e-6,
            budget,
            ..Settings::DEFAULT
        };
        let shuttle = ShuttleTrajectory {
            laps,
            lateral_offset: beside,
        };
        let query = Query::new((&ball, &shuttle), (&body, &Motion::STILL), 1.0, &config);
        let query = query.unwrap();
        let first = BestFirst::default().first_contact(&query, &mut ExhaustiveOracle);
        let any = DepthFirst::default().any_contact(&query, &mut ExhaustiveOracle);
        let closest = DepthFirst::default().closest_approach(&query, &mut ExhaustiveOracle);
        let interval = BestFirst::default().contact_interval(&query, &mut ExhaustiveOracle);
        (
            first.unwrap(),
            any.unwrap(),
            closest.unwrap(),
            interval.unwrap(),
        )
    };
    let free = |beside: f64| matches!(ask(1, beside, u64::MAX).0.outcome, Outcome::Free { .. });
    // The nearest time is found by halving.
    let (mut near, mut far) = (0.0, 9.0);
    while far - near > 1e-5 {
        let middle = 0.5 * (near + far);
        if free(middle) {
            far = middle;
        } else {
            near = middle;
        }
    }
    let (first, any, closest, _) = ask(1, far, u64::MAX);
    let works = [
        first.stats.budgeted_work(),
        any.stats.budgeted_work(),
        closest.stats.budgeted_work(),
    ];
    let budget = 4 * works.into_iter().max().unwrap();
    let laps = 64;
    let (first, any, closest, interval) = ask(laps, far, budget);
    assert!(
        first.stats.budgeted_work() > budget,
        "{first:?} within {budget}"
    );
    assert!(matches!(first.outcome, Outcome::Free { .. }), "{first:?}");
    assert!(matches!(any.outcome, Outcome::Free { .. }), "{any:?}");
    assert!(
        matches!(closest.outcome, Outcome::LeastDistance { .. }),
        "{closest:?}"
    );
    assert!(
        matches!(interval.outcome, Outcome::Free { .. }),
        "{interval:?}"
    );
    // The budget is nevertheless a limit.
    let (first, any, closest, interval) = ask(laps, far, 2);
    assert!(matches!(
        first.outcome,
        Outcome::Unresolved(Unresolved {
            limit: Limit::Budget,
            ..
        })
    ));
    assert!(matches!(
        any.outcome,
        Outcome::Unresolved(Unresolved {
            limit: Limit::Budget,
            ..
        })
    ));
    assert!(matches!(
        closest.outcome,
        Outcome::Unresolved(Unresolved {
            limit: Limit::Budget,
            ..
        })
    ));
    assert!(matches!(
        interval.outcome,
        Outcome::Unresolved(Unresolved {
            limit: Limit::Budget,
            ..
        })
    ));
    assert!(
        first.stats.budgeted_work() <= 4 * u64::from(laps) * 2,
        "{first:?}"
    );
}

/// A trajectory with unbounded deviations, with a corner near the end of every stretch, or with invalid bounds.
struct HostileTrajectory {
    deviation_bound: DeviationBound,
    step: f64,
}

impl Trajectory for HostileTrajectory {
    fn stretch_between(&self, _: f64, _: f64) -> Result<Stretch, InputError> {
        Ok(Stretch {
            deviation_bound: self.deviation_bound,
            ..Stretch::exact(Motion::STILL)
        })
    }

    fn velocity_jump_time(&self, _: f64, to: f64) -> Option<f64> {
        Some(to - self.step)
    }
}

#[test]
fn budgets_end_cuts_where_there_is_no_bound() {
    let ball = Body::sphere(0.5).unwrap();
    let far = Motion::still(crate::Pose::at(9.0 * DVec3::X).unwrap());
    let ask = |shift: f64, turn: f64, step: f64| {
        let hostile = HostileTrajectory {
            deviation_bound: DeviationBound {
                center_deviation: shift,
                max_deviation_angle: turn,
            },
            step,
        };
        let config = Settings {
            budget: 1_000,
            ..Settings::DEFAULT
        };
        let query = Query::new((&ball, &hostile), (&ball, &far), 1.0, &config).unwrap();
        BestFirst::default().first_contact(&query, &mut ExhaustiveOracle)
    };
    let unresolved = Outcome::unresolved(0.0, Limit::Budget);
    assert_eq!(ask(f64::INFINITY, 0.0, 1e-9).unwrap().outcome, unresolved);
    for no_bound in [f64::NAN, -1.0] {
        assert_eq!(ask(no_bound, 0.0, 2.0).unwrap().outcome, unresolved);
        assert_eq!(ask(0.0, no_bound, 2.0).unwrap().outcome, unresolved);
    }
    let free = ask(0.1, 0.1, 2.0).unwrap().outcome;
    assert!(matches!(free, Outcome::Free { proven_gap } if proven_gap > 0.0));
}
