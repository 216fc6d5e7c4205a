//! Tests that a budget limits a whole question, and that answers at a limit are correct.

use super::*;
use rigid_ccd::answer::{ClearanceVerdict, Limit};
use std::time::Duration;

/// A tree of links among obstacles, all with many pieces. Each pair alone may use a budget.
fn crowded_cell(random: &mut Pcg64) -> Cell {
    let robot = random_robot(random);
    let pairs = LinkPairs::from_robot(&robot);
    let mut cell = Cell::new(robot, pairs);
    for k in 0..30 {
        let corners: Vec<DVec3> = (0..60)
            .map(|_| DVec3::from_array([(); 3].map(|()| random.random_range(-0.2..0.2))))
            .collect();
        let faces: Vec<[u32; 3]> = (0..20).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]).collect();
        let labels: Vec<u32> = (0..20).collect();
        let pieces = Pieces::from_triangles(&corners, &faces, &labels).unwrap();
        let body = Body::new(&pieces, Solidity::Surface).unwrap();
        let pose = random_pose(random, 1.2);
        cell.add_obstacle(format!("obstacle{k}"), body, pose)
            .unwrap();
    }
    cell
}

/// Tests that all pairs together use little more than the budget, and that the answer at the limit is correct.
#[test]
fn a_budget_is_for_a_whole_question() {
    let mut random = Pcg64::seed_from_u64(31);
    let (mut unresolved, mut measured_bounds, mut largest) = (0, 0, 0.0);
    for number in 0..40 {
        let cell = crowded_cell(&mut random);
        let budget = [1, 10, 100][number % 3];
        let settings = Settings {
            budget,
            tolerance: 1e-6,
            ..Settings::DEFAULT
        };
        let mut solver = cell.solver().with_settings(settings);
        let count = random.random_range(2..5);
        let path: Vec<_> = (0..count)
            .map(|_| random_configuration(&mut random, cell.robot()))
            .collect();
        // The interval at which the limit is reached is still completed, and a least distance may use half as much
        // again.
        let most = 12 * budget * (count - 1) + solver.search.pairs.count() as u64;
        let check_work = |solver: &CellSolver<'_>| {
            let work = solver.search.stop_condition.work();
            assert!(work <= most, "{work} of {most}");
            work as f64 / most as f64
        };
        let samples = |until: f64| {
            let fractions = (0..=20).map(move |k| until * f64::from(k) / 20.0);
            let at = |time: f64| {
                let segment = (time as usize).min(path.len() - 2);
                let fraction = time - segment as f64;
                configuration_between(&path[segment], &path[segment + 1], fraction)
            };
            let distances = fractions.map(|time| least_distance(&cell, &at(time)));
            distances.fold(f64::INFINITY, lesser)
        };
        let answer = solver.first_contact(&path).unwrap();
        let free_until = answer.free_until.time();
        match answer.outcome {
            PathOutcome::Free => assert_eq!(free_until, (count - 1) as f64),
            PathOutcome::Contact(contact) => assert_eq!(contact.at, answer.free_until),
            outcome => {
                unresolved += 1;
                assert_eq!(outcome.limit(), Some(Limit::Budget));
            }
        }
        largest = greater(largest, check_work(&solver));
        assert!(free_until == 0.0 || samples(free_until * (1.0 - 1e-9)) > 0.0);
        let closest = solver.closest_approach(&path).unwrap().outcome;
        largest = greater(largest, check_work(&solver));
        let least = samples((count - 1) as f64);
        assert!(closest.lower() <= least, "{closest:?} {least}");
        assert!(closest.limit().is_none_or(|limit| limit == Limit::Budget));
        measured_bounds += usize::from(closest.limit().is_some());
        let _ = solver.is_free(&path);
        check_work(&solver);
    }
    assert!(
        unresolved > 10 && measured_bounds > 10 && largest > 0.3,
        "{unresolved} {measured_bounds} {largest}"
    );
}

/// Tests that a limit never claims more than what all pairs have been searched for: neither a contact that is found nor
/// one that is still unknown lies before the proven point.
#[test]
fn a_limit_proves_nothing_beyond_the_first_contact() {
    let mut random = Pcg64::seed_from_u64(33);
    let (mut unresolved, mut in_part) = (0, 0);
    for _ in 0..30 {
        let cell = crowded_cell(&mut random);
        let path = [(); 3].map(|()| random_configuration(&mut random, cell.robot()));
        let first_contact = |budget: u64, tolerance: f64| {
            let settings = Settings {
                budget,
                tolerance,
                ..Settings::DEFAULT
            };
            let mut solver = cell.solver().with_settings(settings);
            let answer = solver.first_contact(&path).unwrap();
            (answer.free_until.time(), answer.outcome.limit())
        };
        let (end, limit) = first_contact(Settings::DEFAULT.budget, 1e-9);
        assert_eq!(limit, None);
        // The contact may come this much later, if the bodies approach more slowly than a thousandth of a unit.
        let end = end + 1e-6;
        for budget in [1, 2, 3, 5, 8, 13, 21, 34, 55, 89] {
            let (free_until, limit) = first_contact(budget, 1e-6);
            assert!(free_until <= end, "{free_until} {end}");
            unresolved += usize::from(limit.is_some());
            in_part += usize::from(limit.is_some() && free_until > 0.0);
        }
    }
    assert!(unresolved > 30 && in_part > 10, "{unresolved} {in_part}");
}

/// Tests that no question starts a search after the deadline.
#[test]
fn a_deadline_of_no_time_ends_all_questions() {
    let mut random = Pcg64::seed_from_u64(32);
    let settings = Settings {
        deadline: Some(Duration::ZERO),
        ..Settings::DEFAULT
    };
    for _ in 0..5 {
        let cell = crowded_cell(&mut random);
        let path: Vec<_> = (0..50)
            .map(|_| random_configuration(&mut random, cell.robot()))
            .collect();
        let mut solver = cell.solver().with_settings(settings.clone());
        let answer = solver.first_contact(&path).unwrap();
        let limit = Some(Limit::Deadline);
        assert_eq!(
            (answer.free_until.time(), answer.outcome.limit()),
            (0.0, limit)
        );
        assert!(solver.is_free(&path).is_err());
        assert_eq!(solver.search.stop_condition.work(), 0);
        let closest = solver.closest_approach(&path).unwrap().outcome;
        assert_eq!(
            (closest.lower(), closest.limit()),
            (0.0, Some(Limit::Deadline))
        );
        let ranges = solver
            .clearance_ranges(&path, RangeSettings::DEFAULT)
            .unwrap();
        let [range] = ranges[..] else {
            panic!("{ranges:?}");
        };
        assert_eq!(range.verdict, ClearanceVerdict::Unverified);
        let curve = solver.distance_curve(&path, 2).unwrap();
        let is_ended = |range: &DistanceRange<'_>| range.closest.limit() == Some(Limit::Deadline);
        assert!(curve.len() == 49 * 4 && curve.iter().all(is_ended));
        assert_eq!(solver.search.stop_condition.work(), 0);
    }
}
