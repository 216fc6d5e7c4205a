//! Compares answers of [`Fast`] about chains of balls, whose hulls are capsules, with those of the other schedules.

use super::{BestFirst, Fast};
use crate::answer::{Answer, Limit, Outcome, Unresolved};
use crate::body::hull_tree::{Hull, HullNode, HullTree, PolygonList};
use crate::body::piece::ConvexCombination;
use crate::body::pieces::Pieces;
use crate::body::polytope::Polytope;
use crate::body::{Body, Solidity};
use crate::distance::oracle::{Claim, GiveUpReason};
use crate::engine::answer::EngineSchedule;
use crate::math::order::{greater, lesser};
use crate::motion::Motion;
use crate::motion::pose::Pose;
use crate::problem::Problem;
use crate::query::MovingBody;
use crate::schedule::Naive;
use crate::settings::{Settings, StartPolicy};
use crate::tests::oracle::{ConstantOracle, ExhaustiveOracle};
use crate::tests::scene::{
    MotionThroughPose, Pcg64, RngExt, random_direction, random_point_in_ball, random_power_of_ten,
    random_rotation, rng,
};
use glam::DVec3;

/// Creates a body of balls on a line, with a hull tree that splits them in halves. One tree in three has balls of
/// several sizes.
fn random_ball_row(rng: &mut Pcg64, count: usize) -> Body {
    let step = DVec3::from_array([(); 3].map(|()| f64::from(rng.random_range(-4..=4))));
    let step = if step == DVec3::ZERO { DVec3::X } else { step };
    let mixed = rng.random_bool(0.3);
    let mut at = 0.0;
    let balls: Vec<Polytope> = (0..count)
        .map(|_| {
            at += f64::from(rng.random_range(1..=8)) / 64.0;
            Polytope {
                points: vec![step * at],
                radius: if mixed {
                    rng.random_range(0.0..0.2)
                } else {
                    0.05
                },
                ..Polytope::default()
            }
        })
        .collect();
    let mut nodes = vec![HullNode::Leaf(0)];
    let mut stack = vec![(0, 0, count)];
    while let Some((node, first, end)) = stack.pop() {
        if end - first == 1 {
            nodes[node] = HullNode::Leaf(first as u32);
            continue;
        }
        let left = nodes.len();
        let ends = [first, end - 1].map(|k| balls[k].points[0]);
        let hull = Hull {
            points: ends.to_vec(),
            facets: PolygonList::default(),
        };
        nodes[node] = HullNode::Inner([left as u32, left as u32 + 1], hull);
        nodes.extend([HullNode::Leaf(0), HullNode::Leaf(0)]);
        let middle = first + (end - first) / 2;
        stack.extend([(left, first, middle), (left + 1, middle, end)]);
    }
    let pieces = Pieces::from_polytopes(&balls).unwrap();
    let tree = HullTree::new(&pieces, &nodes).unwrap();
    let body = Body::new(&pieces, Solidity::Surface).unwrap();
    body.with_hull_tree(tree).unwrap()
}

struct Scene {
    bodies: [Body; 2],
    motions: [Motion; 2],
    settings: Settings,
}

impl Scene {
    fn new(rng: &mut Pcg64) -> Self {
        let way = random_direction(rng);
        let (clock, near) = if rng.random_bool(0.4) {
            (0.0, rng.random_range(0.0..0.4))
        } else {
            (rng.random_range(0.0..1.0), rng.random_range(0.0..2.0))
        };
        let motion = |rng: &mut Pcg64, place: DVec3| {
            let passage = MotionThroughPose {
                clock,
                rotation: random_rotation(rng),
                place,
                middle: DVec3::ZERO,
                velocity: random_point_in_ball(rng, 8.0),
                spin: if rng.random_bool(0.3) {
                    DVec3::ZERO
                } else {
                    random_point_in_ball(rng, 9.0)
                },
                center: random_point_in_ball(rng, 1.0),
            };
            passage.motion()
        };
        let count = |rng: &mut Pcg64| rng.random_range(1..24);
        Scene {
            bodies: [(); 2].map(|()| {
                let count = count(rng);
                random_ball_row(rng, count)
            }),
            motions: [motion(rng, DVec3::ZERO), motion(rng, near * way)],
            settings: Settings {
                tolerance: random_power_of_ten(rng, -7.0, -2.0),
                margin: if rng.random_bool(0.2) { 0.1 } else { 0.0 },
                ..Settings::DEFAULT
            },
        }
    }

    fn problem(&self) -> Problem<'_> {
        let moving = |k: usize| MovingBody::from((&self.bodies[k], self.motions[k]));
        Problem::of_moving_bodies(moving(0), moving(1), 1.0, &self.settings).unwrap()
    }
}

fn solve(problem: &Problem<'_>) -> Answer {
    Fast::default().answer_first_contact(problem, &mut ExhaustiveOracle)
}

/// Returns the least distance of any two pieces at a clock.
fn distance(problem: &Problem<'_>, s: f64) -> f64 {
    let placed = [&problem.a, &problem.b].map(|side| {
        let frame = side.path.frame(s);
        let balls = side.body.pieces().iter();
        let placed = balls.map(|ball| (frame.transform_point(ball.points[0]), ball.radius));
        placed.collect::<Vec<_>>()
    });
    let [a, b] = &placed;
    let pairs = a
        .iter()
        .flat_map(|(p, r)| b.iter().map(move |(q, s)| p.distance(*q) - r - s));
    pairs.fold(f64::INFINITY, lesser)
}

/// Checks an answer at sampled times, and returns the time of contact; infinite without contact.
fn checked_contact_time(problem: &Problem<'_>, outcome: &Outcome) -> f64 {
    let holds_until = |end: f64, least: f64| {
        for k in 0..=128 {
            let near = distance(problem, end * f64::from(k) / 128.0);
            assert!(near >= least - problem.rounding, "{near:e} of {outcome:?}");
        }
    };
    let apart = problem.margin + problem.tolerance;
    match *outcome {
        Outcome::Contact { time, contact } => {
            assert!(contact.separation.upper <= apart);
            assert!(distance(problem, time) <= apart + problem.rounding);
            holds_until(time, problem.margin);
            time
        }
        Outcome::Free { proven_gap } => {
            holds_until(1.0, proven_gap);
            f64::INFINITY
        }
        Outcome::Touching { .. } => {
            assert!(distance(problem, 0.0) <= apart + problem.rounding);
            0.0
        }
        Outcome::Overlapping { .. } => {
            assert!(distance(problem, 0.0) <= problem.rounding);
            -1.0
        }
        _ => panic!("{outcome:?}"),
    }
}

#[test]
fn answers_are_right_and_those_of_the_other_schedules() {
    let mut rng = rng(21);
    let (mut hits, mut misses, mut starts) = (0, 0, 0);
    for number in 0..800 {
        let scene = Scene::new(&mut rng);
        let problem = scene.problem();
        let boxes = BestFirst::default().answer_first_contact(&problem, &mut ExhaustiveOracle);
        let twin = Naive::default().answer_first_contact(&problem, &mut ExhaustiveOracle);
        let time = checked_contact_time(&problem, &solve(&problem).outcome);
        // Every schedule that visits pieces at the start finds those within the tolerance there.
        let twin = checked_contact_time(&problem, &twin.outcome);
        assert_eq!(time <= 0.0, twin <= 0.0, "{number}");
        for other in [twin, checked_contact_time(&problem, &boxes.outcome)] {
            let kind = |time: f64| (time < 0.0, time <= 0.0, time.is_finite());
            // If they differ, the bodies graze each other: within the tolerance, but not within half of it.
            if kind(other) != kind(time) {
                let near = distance(&problem, greater(0.0, lesser(other, time)));
                let grazed = near >= problem.kept_gap() - problem.rounding;
                assert!(grazed, "{number}: {time} {other} {near:e}");
            }
        }
        match time {
            time if time <= 0.0 => starts += 1,
            time if time.is_finite() => hits += 1,
            _ => misses += 1,
        }
    }
    assert!(
        hits > 120 && misses > 120 && starts > 20,
        "{hits} {misses} {starts}"
    );
}

#[test]
fn trees_spare_most_pairs_of_pieces() {
    let mut rng = rng(22);
    let bodies = [400, 400].map(|count| random_ball_row(&mut rng, count));
    let far = Pose::at(2e3 * DVec3::Y).unwrap();
    let motion = Motion::new(far, -1e3 * DVec3::Y, DVec3::X).unwrap();
    let still = Motion::still(Pose::IDENTITY);
    let moving = |k: usize, motion| MovingBody::from((&bodies[k], motion));
    let config = Settings::DEFAULT;
    let problem =
        Problem::of_moving_bodies(moving(0, motion), moving(1, still), 1.5, &config).unwrap();
    let answer = solve(&problem);
    assert!(matches!(answer.outcome, Outcome::Free { .. }), "{answer:?}");
    assert!(answer.stats.oracle_calls < 100, "{:?}", answer.stats);
}

#[test]
fn a_brief_motion_splits_nothing_that_stays_apart() {
    let mut rng = rng(27);
    let bodies = [400, 400].map(|count| random_ball_row(&mut rng, count));
    let still = Motion::still(Pose::IDENTITY);
    let calls = |height: f64, speed: f64| {
        let pose = Pose::at(height * DVec3::Z).unwrap();
        let moving = MovingBody::from((
            &bodies[0],
            Motion::new(pose, -speed * DVec3::Z, 1e-3 * DVec3::X).unwrap(),
        ));
        let other = MovingBody::from((&bodies[1], still));
        let problem = Problem::of_moving_bodies(moving, other, 1.0, &Settings::DEFAULT).unwrap();
        let answer = solve(&problem);
        assert!(matches!(answer.outcome, Outcome::Free { .. }), "{answer:?}");
        answer.stats.oracle_calls
    };
    let size = bodies
        .iter()
        .map(|body| body.tree().radius())
        .fold(0.0, greater);
    // The bodies are far from each other for their size, but balls about them do not prove them apart.
    assert_eq!(calls(1.8 * f64::from(size), 1.0), 1);
}

#[test]
fn budgets_end_a_query_with_a_time_that_is_safe() {
    let mut rng = rng(23);
    let mut ended = 0;
    for _ in 0..200 {
        let scene = Scene::new(&mut rng);
        let answer = solve(&scene.problem());
        let time = match answer.outcome {
            Outcome::Contact { time, .. } => time,
            Outcome::Free { .. } => scene.problem().time_of_clock(1.0),
            _ => continue,
        };
        let mut last = 0.0;
        for budget in 0..answer.stats.iterations.min(40) {
            let mut problem = scene.problem();
            problem.budget = budget;
            let outcome = solve(&problem).outcome;
            let Outcome::Unresolved(Unresolved {
                safe_until,
                limit: reason,
                ..
            }) = outcome
            else {
                panic!("{outcome:?} within {budget} visits");
            };
            assert_eq!(reason, Limit::Budget);
            assert!(safe_until >= last && safe_until <= time);
            last = safe_until;
            ended += 1;
        }
    }
    assert!(ended > 1_000, "{ended}");
}

#[test]
fn false_claims_and_give_ups_never_make_it_late() {
    let mut rng = rng(24);
    for _ in 0..300 {
        let mut scene = Scene::new(&mut rng);
        scene.settings.budget = 5_000;
        let problem = scene.problem();
        if distance(&problem, 0.0) <= problem.margin + problem.tolerance + problem.rounding {
            continue;
        }
        let touch = (0..=256)
            .map(|k| f64::from(k) / 256.0)
            .find(|&s| distance(&problem, s) <= problem.margin);
        let lie = Claim {
            axis: random_direction(&mut rng),
            a: ConvexCombination::from_single_point(rng.random_range(0..3)),
            b: ConvexCombination::from_single_point(rng.random_range(0..3)),
        };
        let wrong = [
            ConstantOracle(Ok(lie)),
            ConstantOracle(Err(GiveUpReason::Cycle)),
        ];
        for mut oracle in wrong {
            match Fast::default()
                .answer_first_contact(&problem, &mut oracle)
                .outcome
            {
                Outcome::Unresolved(Unresolved {
                    safe_until: time, ..
                })
                | Outcome::Contact { time, .. } => {
                    assert!(touch.is_none_or(|touch| time <= touch));
                }
                Outcome::Free { .. } => assert!(touch.is_none()),
                outcome => panic!("{outcome:?} of bodies that begin apart"),
            }
        }
    }
}

#[test]
fn answers_do_not_depend_on_earlier_queries() {
    let mut rng = rng(25);
    let mut kept = Fast::default();
    for _ in 0..100 {
        let scene = Scene::new(&mut rng);
        let problem = scene.problem();
        let fresh = solve(&problem);
        assert_eq!(
            kept.answer_first_contact(&problem, &mut ExhaustiveOracle),
            fresh
        );
        assert_eq!(
            kept.answer_first_contact(&problem, &mut ExhaustiveOracle),
            fresh
        );
    }
}

#[test]
fn bodies_without_trees_are_searched_by_their_boxes() {
    let triangle = [DVec3::ZERO, DVec3::X, DVec3::Y];
    let soup = Pieces::from_triangles(
        &[triangle, triangle.map(|p| p + DVec3::Z)].concat(),
        &[[0, 1, 2], [3, 4, 5]],
        &[0, 1],
    );
    let soup = Body::new(&soup.unwrap(), Solidity::Surface).unwrap();
    let ball = Body::sphere(0.25).unwrap();
    let above = Pose::at(DVec3::new(0.25, 0.25, 2.25)).unwrap();
    let falling = Motion::new(above, -2.0 * DVec3::Z, DVec3::ZERO).unwrap();
    let problem = Problem::of_moving_bodies(
        MovingBody::from((&ball, falling)),
        MovingBody::from((&soup, Motion::still(Pose::IDENTITY))),
        1.0,
        &Settings::DEFAULT,
    )
    .unwrap();
    assert!(soup.hull_tree().is_none());
    let boxes = BestFirst::default().answer_first_contact(&problem, &mut ExhaustiveOracle);
    assert_eq!(solve(&problem), boxes);
    assert!(matches!(boxes.outcome, Outcome::Contact { .. }));
}

#[test]
fn contacts_at_the_start_are_reported_or_let_go() {
    let mut rng = rng(26);
    let bodies = [20, 20].map(|count| random_ball_row(&mut rng, count));
    let ball = Body::sphere(0.05).unwrap();
    let end = bodies[0]
        .pieces()
        .iter()
        .map(|piece| (piece.points[0], piece.radius));
    let (top, radius) = end.fold((DVec3::ZERO, 0.0), |best, next| {
        if next.0.length() > best.0.length() {
            next
        } else {
            best
        }
    });
    let way = top.normalize();
    let outcome = |speed: f64, start| {
        let place = top + (radius + 0.05 + 1e-5) * way;
        let pose = Pose::at(place).unwrap();
        let moving =
            MovingBody::from((&ball, Motion::new(pose, speed * way, DVec3::ZERO).unwrap()));
        let still = MovingBody::from((&bodies[0], Motion::still(Pose::IDENTITY)));
        let config = Settings {
            start_policy: start,
            ..Settings::DEFAULT
        };
        solve(&Problem::of_moving_bodies(moving, still, 1.0, &config).unwrap()).outcome
    };
    let touching = outcome(1.0, StartPolicy::Report);
    assert!(matches!(touching, Outcome::Touching { .. }), "{touching:?}");
    let parting = outcome(1.0, StartPolicy::Leave);
    assert!(matches!(parting, Outcome::Free { .. }), "{parting:?}");
    let approaching = outcome(-1.0, StartPolicy::Leave);
    let Outcome::Contact { time, .. } = approaching else {
        panic!("{approaching:?}");
    };
    assert!(time <= 1e-5 + 1e-12);
}
