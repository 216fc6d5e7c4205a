//! Tests questions about paths and curves against sampled configurations.

use super::*;
use crate::joint_curve::JointCurve;
use crate::path::PathSource;
use crate::path::joint_path::JointPath;
use rigid_ccd::answer::Limit;
use std::time::Duration;

/// A path through configurations, or a curve.
enum TestPath {
    Configurations(Vec<Vec<f64>>),
    Curve(JointCurve),
}

impl TestPath {
    /// Returns a path of a few nearby configurations, or a cubic or quintic curve through them.
    fn random(random: &mut Pcg64, robot: &Robot) -> Self {
        let mut path = vec![random_configuration(random, robot)];
        for _ in 0..random.random_range(0..9) {
            let next = random_configuration(random, robot);
            let step = [0.01, 0.2, 0.7][random.random_range(0..3)];
            path.push(configuration_between(path.last().unwrap(), &next, step));
        }
        if path.len() == 1 || random.random_range(0..2) == 0 {
            return TestPath::Configurations(path);
        }
        let mut times = vec![random.random_range(-1.0..1.0)];
        for _ in 1..path.len() {
            times.push(times[times.len() - 1] + random.random_range(0.1..1.0));
        }
        let mut rates = || {
            let size = [0.0, 0.1, 3.0][random.random_range(0..3)];
            let mut row = || random_configuration(random, robot).into_iter();
            let rows = path.iter().map(|_| row().map(|rate| size * rate).collect());
            rows.collect::<Vec<Vec<f64>>>()
        };
        let (velocities, accelerations) = (rates(), rates());
        TestPath::Curve(match path.len() % 2 {
            0 => JointCurve::cubic_hermite(&times, &path, &velocities).unwrap(),
            _ => JointCurve::quintic_hermite(&times, &path, &velocities, &accelerations).unwrap(),
        })
    }

    /// Returns the configuration at a point.
    fn at(&self, at: PathPoint) -> Vec<f64> {
        match self {
            TestPath::Configurations(path) => match path.get(at.segment + 1) {
                Some(next) => configuration_between(&path[at.segment], next, at.fraction),
                None => path[at.segment].clone(),
            },
            TestPath::Curve(curve) => curve.positions(curve.time(at)),
        }
    }

    /// Returns points of the path, some in each segment.
    fn sampled_points(&self) -> Vec<PathPoint> {
        let segments = 0..self.segment_count().max(1);
        let fractions = |segment| (0..=8).map(move |k| (segment, f64::from(k) / 8.0));
        let points = segments.flat_map(fractions);
        points
            .map(|(segment, fraction)| PathPoint { segment, fraction })
            .collect()
    }
}

impl Path for TestPath {
    fn segment_count(&self) -> usize {
        match self {
            TestPath::Configurations(path) => path.segment_count(),
            TestPath::Curve(curve) => curve.segment_count(),
        }
    }
}

impl PathSource for TestPath {
    fn write_to(&self, cell: &Cell, path: &mut JointPath) -> Result<(), PathError> {
        match self {
            TestPath::Configurations(configurations) => configurations.write_to(cell, path),
            TestPath::Curve(curve) => curve.write_to(cell, path),
        }
    }
}

/// Tests that no sampled configuration before a first contact is within the margin, and that the reported pair is
/// within margin + tolerance at the contact.
#[test]
fn nothing_touches_before_a_first_contact() {
    let mut random = Pcg64::seed_from_u64(11);
    let (mut free, mut contacts, mut late_segments) = (0, 0, 0);
    for _ in 0..250 {
        let cell = random_cell(&mut random);
        let margin = [0.0, 0.03][random.random_range(0..2)];
        let settings = Settings {
            margin,
            tolerance: 1e-4,
            ..Settings::DEFAULT
        };
        let mut solver = cell.solver().with_settings(settings);
        let path = TestPath::random(&mut random, cell.robot());
        let outcome = solver.first_contact(&path).unwrap().outcome;
        let any = solver.any_contact(&path).unwrap().contact().unwrap();
        let end = match outcome {
            PathOutcome::Free => {
                free += 1;
                assert_eq!(any, None);
                None
            }
            PathOutcome::Contact(contact) => {
                contacts += 1;
                late_segments += usize::from(contact.at.segment > 0);
                let there = least_distance(&cell, &path.at(contact.at));
                assert!(there <= margin + 1e-4 + 1e-9, "{there} in {contact:?}");
                let [a, b] = contact.witnesses.unwrap();
                let is_near = a.distance(b) <= margin + 1e-4 + 1e-9;
                assert!(is_near || there == 0.0, "{contact:?}");
                Some(contact.at)
            }
            _ => panic!("{outcome:?}"),
        };
        for at in path.sampled_points() {
            if end.is_none_or(|end| at < end) {
                let distance = least_distance(&cell, &path.at(at));
                assert!(distance > margin, "{distance} at {at:?} before {end:?}");
            }
        }
    }
    let enough = free > 40 && contacts > 40 && late_segments > 15;
    assert!(enough, "{free} {contacts} {late_segments}");
}

/// Tests that no sampled distance is below the lower bound of the closest approach, that the bounds are within the
/// tolerance, and that the reported pair is as near as the upper bound.
#[test]
fn the_closest_approach_brackets_sampled_distances() {
    let mut random = Pcg64::seed_from_u64(12);
    let (mut apart, mut touching, mut narrowest) = (0, 0, f64::INFINITY);
    for _ in 0..200 {
        let cell = random_cell(&mut random);
        let settings = Settings {
            tolerance: 1e-4,
            ..Settings::DEFAULT
        };
        let mut solver = cell.solver().with_settings(settings);
        let path = TestPath::random(&mut random, cell.robot());
        let found = solver.closest_approach(&path).unwrap().outcome;
        assert_eq!(found.limit(), None);
        assert!(found.upper() - found.lower() <= 1e-4 + 1e-9, "{found:?}");
        let nearest = found.nearest().expect("links are checked");
        let [a, b] = nearest.witnesses.unwrap();
        let is_near = a.distance(b) <= found.upper() + 1e-9;
        assert!(is_near || found.upper() <= 1e-9, "{found:?}");
        let least = path
            .sampled_points()
            .into_iter()
            .map(|at| least_distance(&cell, &path.at(at)))
            .fold(f64::INFINITY, lesser);
        assert!(least >= found.lower(), "{least} below {found:?}");
        narrowest = lesser(narrowest, least - found.lower());
        if found.upper() > 1e-4 {
            apart += 1;
        } else {
            touching += 1;
        }
    }
    let enough = apart > 40 && touching > 20 && narrowest < 1e-3;
    assert!(enough, "{apart} {touching} {narrowest}");
}

/// Tests that dividing an edge into many segments does not change the answers.
#[test]
fn a_cut_edge_is_the_same_edge() {
    let mut random = Pcg64::seed_from_u64(13);
    let (mut free, mut contacts) = (0, 0);
    for _ in 0..60 {
        let cell = random_cell(&mut random);
        let mut solver = cell.solver();
        let ends = [(); 2].map(|()| random_configuration(&mut random, cell.robot()));
        let cut: Vec<Vec<f64>> = (0..=64)
            .map(|k| configuration_between(&ends[0], &ends[1], f64::from(k) / 64.0))
            .collect();
        let whole = solver.closest_approach(&ends).unwrap().outcome;
        let parts = solver.closest_approach(&cut).unwrap().outcome;
        assert!(
            whole.lower() <= parts.upper() + 1e-9 && parts.lower() <= whole.upper() + 1e-9,
            "{whole:?} {parts:?}"
        );
        // Within the tolerance, both answers are correct.
        if whole.lower() > 0.0 {
            free += 1;
            assert!(solver.is_free(&ends).unwrap() && solver.is_free(&cut).unwrap());
        } else if whole.upper() <= 0.0 {
            contacts += 1;
            assert!(!solver.is_free(&ends).unwrap() && !solver.is_free(&cut).unwrap());
        }
    }
    assert!(free > 20 && contacts > 10, "{free} {contacts}");
}

/// Tests that a solver allocates no memory for questions like those it has answered.
#[test]
fn a_solver_keeps_its_memory() {
    let mut random = Pcg64::seed_from_u64(14);
    let (mut free, mut engine) = (0, 0);
    for _ in 0..20 {
        let cell = random_cell(&mut random);
        let mut solver = cell.solver();
        let path = TestPath::random(&mut random, cell.robot());
        let ask = |solver: &mut CellSolver<'_>| {
            let is_free = solver.is_free(&path).unwrap();
            let first = solver.first_contact(&path).unwrap().outcome;
            assert_eq!(is_free, first == PathOutcome::Free);
            is_free
        };
        free += usize::from(ask(&mut solver));
        engine += usize::from(solver.search.engine_candidates.earliest_start() < f64::INFINITY);
        let allocated = allocation_counter::measure(|| {
            ask(&mut solver);
        });
        assert_eq!(allocated.count_total, 0, "{allocated:?}");
    }
    assert!(free > 2 && free < 18 && engine > 2, "{free} {engine}");
}

/// Tests that a path is unresolved if its deadline passes, and free up to the reported point.
#[test]
fn a_deadline_leaves_a_free_start() {
    let mut random = Pcg64::seed_from_u64(14);
    let mut unresolved = 0;
    for nanos in [0, 3_000, 10_000, 20_000, 50_000, 100_000].repeat(25) {
        let cell = random_cell(&mut random);
        let settings = Settings {
            deadline: Some(Duration::from_nanos(nanos)),
            ..Settings::DEFAULT
        };
        let path = TestPath::random(&mut random, cell.robot());
        let mut solver = cell.solver().with_settings(settings);
        let answer = solver.first_contact(&path).unwrap();
        if let PathOutcome::Unresolved(known) = answer.outcome {
            let free_until = answer.free_until;
            unresolved += 1;
            assert_eq!(known.limit, Limit::Deadline);
            for at in path.sampled_points() {
                let distance = || least_distance(&cell, &path.at(at));
                assert!(
                    at >= free_until || distance() > 0.0,
                    "{at:?} {free_until:?}"
                );
            }
            if nanos == 0 {
                assert_eq!(solver.closest_approach(&path).unwrap().outcome.lower(), 0.0);
                assert!(solver.is_free(&path).is_err());
            }
        }
    }
    assert!(unresolved >= 15, "{unresolved}");
}

/// Tests that a spent budget is an outcome, not an error, and that the path is free up to the reported point.
#[test]
fn a_budget_leaves_a_free_start() {
    let mut random = Pcg64::seed_from_u64(16);
    let mut unresolved = 0;
    for _ in 0..150 {
        let cell = random_cell(&mut random);
        let settings = Settings {
            budget: 1,
            ..Settings::DEFAULT
        };
        let path = TestPath::random(&mut random, cell.robot());
        let mut solver = cell.solver().with_settings(settings);
        let answer = solver.first_contact(&path).unwrap();
        let is_free = matches!(answer.outcome, PathOutcome::Free);
        let end = (!is_free).then_some(answer.free_until);
        if let Some(limit) = answer.outcome.limit() {
            unresolved += 1;
            assert_eq!(limit, Limit::Budget);
        }
        for at in path.sampled_points() {
            let distance = || least_distance(&cell, &path.at(at));
            let is_before = end.is_none_or(|end| at < end);
            assert!(!is_before || distance() > 0.0, "{at:?} {end:?}");
        }
        let closest = solver.closest_approach(&path).unwrap().outcome;
        let least = least_distance(&cell, &path.at(PathPoint::START));
        assert!(closest.lower() <= least && closest.lower() <= closest.upper());
    }
    assert!(unresolved > 5, "{unresolved}");
}

/// Tests a path of one configuration, and that an empty path is refused.
#[test]
fn a_configuration_is_a_path() {
    let mut random = Pcg64::seed_from_u64(15);
    for _ in 0..40 {
        let cell = random_cell(&mut random);
        let configuration = random_configuration(&mut random, cell.robot());
        let mut solver = cell.solver();
        let found = solver.closest_approach(&[&configuration]).unwrap().outcome;
        let least = least_distance(&cell, &configuration);
        assert!(
            found.lower() <= least + 1e-9 && found.upper() >= least - 1e-9,
            "{found:?} {least}"
        );
        assert!(matches!(
            solver.is_free(&[] as &[Vec<f64>]),
            Err(PathError::EmptyPath)
        ));
    }
}

/// Tests that both bounds hold for a cylinder that a polytope encloses.
#[test]
fn bounds_hold_for_the_shapes_that_bodies_enclose() {
    let slide = trajectory::Joint::prismatic(Pose::IDENTITY, [1.0, 0.0, 0.0]).unwrap();
    let cylinder = Body::cylinder(0.1, 0.5).unwrap();
    assert!(cylinder.excess() > 1e-6);
    let links = vec![
        Link::named("base"),
        Link::named("rod").with_body(cylinder, Pose::IDENTITY),
    ];
    let joint = Joint {
        name: "rail".into(),
        parent: "base".into(),
        child: "rod".into(),
        geometry: slide,
        position_rule: PositionRule::Independent,
    };
    let robot = Robot::new(links, vec![joint]).unwrap();
    let pairs = LinkPairs::from_robot(&robot);
    for k in 0..60 {
        let angle = f64::from(k) / 60.0 * std::f64::consts::FRAC_PI_2;
        let at = DVec3::new(0.3 * angle.cos(), 0.3 * angle.sin(), 0.0);
        let mut cell = Cell::new(robot.clone(), pairs.clone());
        let ball = Body::sphere(0.05).unwrap();
        cell.add_obstacle("ball", ball, Pose::at(at).unwrap())
            .unwrap();
        for tolerance in [1e-6, 1e-9] {
            let settings = Settings {
                tolerance,
                ..Settings::DEFAULT
            };
            let mut solver = cell.solver().with_settings(settings);
            for path in [&[[-0.9], [0.0]][..], &[[0.0]], &[[-1.1], [0.7]]] {
                let nearest = at.x.clamp(path[0][0], path[path.len() - 1][0]);
                let exact = (at.x - nearest).hypot(at.y) - 0.15;
                let found = solver.closest_approach(path).unwrap().outcome;
                let is_bracketed = found.lower() <= exact + 1e-12 && found.upper() >= exact - 1e-12;
                assert!(exact < 1e-3 || is_bracketed, "{found:?} {exact}");
            }
        }
    }
}
