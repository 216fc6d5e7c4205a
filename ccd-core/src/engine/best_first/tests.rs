//! Compares answers with samples and with the naive schedule, also with tiny budgets and with a million waiting pairs.

use super::*;
use crate::answer::Unresolved;
use crate::answer::{Contact, Stats};
use crate::body::hierarchy::{Hierarchy, HierarchyNode};
use crate::body::piece::ConvexCombination;
use crate::body::{Body, Solidity};
use crate::distance::oracle::{Claim, GiveUpReason};
use crate::math::order::{greater, lesser};
use crate::motion::Motion;
use crate::motion::pose::Pose;
use crate::problem::BodyWithPath;
use crate::query::MovingBody;
use crate::schedule::Naive;
use crate::settings::{Settings, StartPolicy};
use crate::tests::nearest::{Triangle, nearest_points};
use crate::tests::oracle::{ConstantOracle, ExhaustiveOracle};
use crate::tests::scene::{
    Pcg64, RngExt, Scene, SceneKind, body, distance, pieces, random_direction, rng, scene,
};
use glam::DVec3;
use rand::seq::SliceRandom;

fn solve(problem: &Problem<'_>) -> Answer {
    BestFirst::default().answer_first_contact(problem, &mut ExhaustiveOracle)
}

/// Draws a scene that does not begin in contact.
fn scene_apart_at_start(rng: &mut Pcg64) -> Scene {
    loop {
        let kind = [
            SceneKind::RandomMotion,
            SceneKind::Sliding,
            SceneKind::NearRim,
        ][rng.random_range(0..3)];
        let scene = scene(rng, kind, 12);
        let problem = scene.problem();
        if distance(&problem, 0.0) > 2.0 * problem.tolerance {
            return scene;
        }
    }
}

#[test]
fn answers_hold_at_sampled_times_and_are_those_of_the_naive_twin() {
    let mut rng = rng(1);
    let (mut hits, mut misses, mut grazes) = (0, 0, 0);
    for number in 0..1_600 {
        let scene = scene_apart_at_start(&mut rng);
        let problem = scene.problem();
        let (margin, tolerance) = (problem.margin, problem.tolerance);
        let answer = solve(&problem);
        let twin = Naive::default().answer_first_contact(&problem, &mut ExhaustiveOracle);
        let (until, least) = match (answer.outcome, twin.outcome) {
            (Outcome::Contact { time, contact }, Outcome::Contact { time: other, .. }) => {
                hits += 1;
                let near = distance(&problem, time);
                assert!(
                    near <= margin + tolerance + problem.rounding,
                    "{number}: {near:e}"
                );
                check_contact_bounds(&problem, time, &contact);
                // Both searches stop within the tolerance of one contact: neither is much earlier than the other.
                let (first, last) = (lesser(time, other), greater(time, other));
                assert!(distance(&problem, first) <= margin + tolerance + problem.rounding);
                assert!(distance(&problem, last) <= margin + tolerance + problem.rounding);
                (time, margin)
            }
            (Outcome::Free { proven_gap }, Outcome::Free { .. }) => {
                misses += 1;
                (1.0, proven_gap)
            }
            // The least distance is within the tolerance, but not within half of it: both answers are right.
            (Outcome::Contact { time, .. }, Outcome::Free { .. })
            | (Outcome::Free { .. }, Outcome::Contact { time, .. }) => {
                grazes += 1;
                let near = distance(&problem, time);
                assert!(near >= margin + 0.5 * tolerance - problem.rounding);
                (time, margin)
            }
            (outcome, other) => panic!("{number}: {outcome:?}, {other:?}"),
        };
        for k in 0..64 {
            let found = distance(&problem, until * f64::from(k) / 64.0);
            assert!(
                found >= least - problem.rounding,
                "{number}: {found:e} before {until}"
            );
        }
    }
    assert!(hits > 80 && misses > 80, "{hits} {misses}");
    assert!(grazes < 4, "{grazes}");
}

#[test]
fn answers_hold_at_sampled_times_where_bodies_accelerate() {
    let mut rng = rng(11);
    let (mut hits, mut misses, mut later) = (0, 0, 0);
    for number in 0..800 {
        let scene = scene_apart_at_start(&mut rng).with_accelerations(&mut rng);
        let problem = scene.problem();
        if distance(&problem, 0.0) <= 2.0 * problem.tolerance {
            continue;
        }
        let within = problem.contact_distance() + problem.rounding;
        let (until, least) = match solve(&problem).outcome {
            Outcome::Contact { time, contact } => {
                hits += 1;
                assert!(distance(&problem, time) <= within, "{number}");
                check_contact_bounds(&problem, time, &contact);
                (time, problem.margin)
            }
            Outcome::Free { proven_gap } => {
                misses += 1;
                (1.0, proven_gap)
            }
            outcome => panic!("{number}: {outcome:?}"),
        };
        for k in 0..64 {
            let found = distance(&problem, until * f64::from(k) / 64.0);
            assert!(
                found >= least - problem.rounding,
                "{number}: {found:e} before {until}"
            );
        }
        // Straight motions with the velocities of the start give another answer.
        let straight = Scene {
            accelerations: [DVec3::ZERO; 2],
            ..scene
        };
        let other = match solve(&straight.problem()).outcome {
            Outcome::Contact { time, .. } => time,
            _ => 1.0,
        };
        later += usize::from((until - other).abs() > 0.1);
    }
    assert!(hits > 40 && misses > 120, "{hits} {misses}");
    assert!(later > 12, "{later}");
}

/// Checks that the bounds and witnesses of a contact agree with the distance of its pieces.
fn check_contact_bounds(problem: &Problem<'_>, s: f64, contact: &Contact) {
    let placed = |side: &BodyWithPath<'_>, piece: u32| {
        let frame = side.path.frame(s);
        side.body
            .pieces()
            .triangle(piece as usize)
            .map(|p| frame.transform_point(p))
    };
    let (a, b) = (
        placed(&problem.a, contact.piece_a),
        placed(&problem.b, contact.piece_b),
    );
    let found = nearest_points(&a, &b).distance;
    let separation = &contact.separation;
    assert!(
        separation.lower <= found + problem.rounding,
        "{found:e} {contact:?}"
    );
    assert!(
        separation.upper >= found - problem.rounding,
        "{found:e} {contact:?}"
    );
    let way = separation.witness_b.distance(separation.witness_a);
    // Witnesses are rounded once more in the world's coordinates.
    let world = f64::EPSILON * (separation.witness_a.length() + separation.witness_b.length());
    assert!(way <= separation.upper + problem.rounding + world);
    assert!((separation.normal.length() - 1.0).abs() < 1e-15);
}

/// Tests that the search for two bodies of one piece each begins with their distance: no bound of boxes comes before it.
#[test]
fn two_single_triangles_are_measured_at_each_visit() {
    let triangle = |z| [DVec3::new(0.0, 0.0, z), DVec3::X, DVec3::Y];
    let body = |z| Body::new(&pieces(&[triangle(z)]), Solidity::Surface).unwrap();
    let (a, b) = (body(0.0), body(0.5));
    let towards = |speed: f64| {
        let start = Pose::at(0.2 * DVec3::Z).unwrap();
        Motion::new(start, -speed * DVec3::Z, 0.01 * DVec3::X).unwrap()
    };
    for (speed, meets) in [(4.0, true), (0.05, false)] {
        let problem = Problem::new(
            [(&a, Motion::STILL), (&b, towards(speed))],
            1.0,
            &Settings::DEFAULT.to_query_settings(),
        );
        let answer = solve(&problem.unwrap());
        let met = matches!(answer.outcome, Outcome::Contact { .. });
        assert_eq!(met, meets, "{:?}", answer.outcome);
        let Stats {
            iterations,
            oracle_calls,
            ..
        } = answer.stats;
        assert!(
            iterations > 0 && iterations == oracle_calls,
            "{:?}",
            answer.stats
        );
    }
}

#[test]
fn budgets_end_a_query_with_a_time_that_is_safe_and_grows() {
    let mut rng = rng(2);
    let mut ended = 0;
    for number in 0..150 {
        let mut scene = scene_apart_at_start(&mut rng);
        let (contact, visits, work) = {
            let answer = solve(&scene.problem());
            let time = match answer.outcome {
                Outcome::Contact { time, .. } => time,
                _ => 1.0,
            };
            (time, answer.stats.iterations, answer.stats.budgeted_work())
        };
        let mut last = 0.0;
        for budget in 0..visits.min(60) {
            scene.settings.budget = budget;
            let answer = solve(&scene.problem());
            let Outcome::Unresolved(Unresolved {
                safe_until,
                limit: reason,
                ..
            }) = answer.outcome
            else {
                panic!("{number}: {:?} for {budget} of {visits}", answer.outcome);
            };
            assert_eq!(reason, Limit::Budget);
            assert!(
                safe_until >= last && safe_until <= contact,
                "{number}: {safe_until}"
            );
            last = safe_until;
            ended += 1;
        }
        scene.settings.budget = work;
        assert!(!matches!(
            solve(&scene.problem()).outcome,
            Outcome::Unresolved(_)
        ));
    }
    assert!(ended > 1_000, "{ended}");
}

#[test]
fn answers_do_not_depend_on_earlier_queries() {
    let mut rng = rng(3);
    let mut kept = BestFirst::default();
    for _ in 0..200 {
        let scene = scene_apart_at_start(&mut rng);
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
fn false_claims_and_give_ups_never_make_an_answer_late() {
    let mut rng = rng(4);
    let (mut unresolved, mut others) = (0, 0);
    for _ in 0..300 {
        let mut scene = scene_apart_at_start(&mut rng);
        scene.settings.budget = 20_000;
        let problem = scene.problem();
        let truth = match solve(&problem).outcome {
            Outcome::Contact { time, .. } => time,
            _ => 1.0,
        };
        // A contact may be reported earlier than it happens, within the tolerance, but never later.
        let touch = (0..=64)
            .map(|k| truth + (1.0 - truth) * f64::from(k) / 64.0)
            .find(|&s| distance(&problem, s) <= problem.margin);
        let lie = Claim {
            axis: random_direction(&mut rng),
            a: ConvexCombination::from_single_point(rng.random_range(0..5)),
            b: ConvexCombination::from_single_point(rng.random_range(0..5)),
        };
        for oracle in [
            ConstantOracle(Ok(lie)),
            ConstantOracle(Err(GiveUpReason::Cycle)),
        ] {
            let answer = BestFirst::default().answer_first_contact(&problem, &mut { oracle });
            match answer.outcome {
                Outcome::Unresolved(Unresolved { safe_until, .. }) => {
                    unresolved += 1;
                    assert!(touch.is_none_or(|touch| safe_until <= touch));
                }
                Outcome::Contact { time, .. } => {
                    others += 1;
                    assert!(touch.is_none_or(|touch| time <= touch));
                }
                Outcome::Free { .. } => {
                    others += 1;
                    assert!(touch.is_none());
                }
                outcome => panic!("{outcome:?} of bodies that begin apart"),
            }
        }
    }
    assert!(unresolved > 50 && others > 50, "{unresolved} {others}");
}

#[test]
fn touching_and_overlapping_at_the_start_are_reported_and_let_go() {
    let flat = body(&[[DVec3::ZERO, DVec3::X, DVec3::Y]]);
    let spike = body(&[[
        DVec3::ZERO,
        DVec3::new(-0.1, 0.0, 1.0),
        DVec3::new(0.1, 0.0, 1.0),
    ]]);
    let outcome = |height: f64, speed: f64, start: StartPolicy| {
        let at = Pose::at(DVec3::new(0.3, 0.3, height)).unwrap();
        let moving = |body, motion| MovingBody::from((body, motion));
        let config = Settings {
            start_policy: start,
            ..Settings::DEFAULT
        };
        let motion = Motion::new(at, speed * DVec3::Z, DVec3::ZERO).unwrap();
        let still = Motion::still(Pose::IDENTITY);
        let problem =
            Problem::of_moving_bodies(moving(&spike, motion), moving(&flat, still), 1.0, &config);
        solve(&problem.unwrap()).outcome
    };
    for height in [0.0, 1e-8, 1e-4, 9e-4] {
        let report = outcome(height, 1.0, StartPolicy::Report);
        assert!(matches!(report, Outcome::Touching { .. }), "{report:?}");
        let parting = outcome(height, 1.0, StartPolicy::Leave);
        assert!(matches!(parting, Outcome::Free { .. }), "{parting:?}");
        let resting = outcome(height, 0.0, StartPolicy::Leave);
        assert!(matches!(resting, Outcome::Free { .. }), "{resting:?}");
        let approaching = outcome(height, -1.0, StartPolicy::Leave);
        let Outcome::Contact { time, .. } = approaching else {
            panic!("{approaching:?}");
        };
        assert!(time <= height + 1e-12);
    }
    for start in [StartPolicy::Report, StartPolicy::Leave] {
        let inside = outcome(-0.5, 1.0, start);
        let Outcome::Overlapping {
            overlap: crate::Overlap::Pieces(contact),
            ..
        } = inside
        else {
            panic!("{inside:?}");
        };
        assert!(contact.separation.lower < 0.0);
    }
}

/// Creates large level plates at equal steps of height, in a random hierarchy. Below every node there are plates of all
/// heights, so that only single plates are apart.
fn body_of_level_plates(rng: &mut Pcg64, count: usize, lowest: f64, step: f64) -> Body {
    let plate = |k: usize| {
        let height = (lowest + step * k as f64) * DVec3::Z;
        [
            DVec3::new(-1.0, -1.0, 0.0),
            DVec3::new(1.0, -1.0, 0.0),
            DVec3::new(0.0, 1.0, 0.0),
        ]
        .map(|p| p + height)
    };
    let mut order: Vec<u32> = (0..count as u32).collect();
    order.shuffle(rng);
    let mut nodes = vec![HierarchyNode::Leaf(0)];
    let mut stack = vec![(0, &order[..])];
    while let Some((at, range)) = stack.pop() {
        if let [piece] = range {
            nodes[at] = HierarchyNode::Leaf(*piece);
            continue;
        }
        let left = nodes.len();
        nodes.extend([HierarchyNode::Leaf(0); 2]);
        nodes[at] = HierarchyNode::Inner(left as u32, left as u32 + 1);
        let (first, second) = range.split_at(range.len() / 2);
        stack.extend([(left, first), (left + 1, second)]);
    }
    let pieces = pieces(&(0..count).map(plate).collect::<Vec<_>>());
    let hierarchy = Hierarchy::new(nodes, count).unwrap();
    Body::with_hierarchy(&pieces, &hierarchy, Solidity::Surface).unwrap()
}

/// Tests that a search finds the first contact of two stacks with alternating plates, or reports that its budget is
/// used up. All ten million pairs have to be proven apart at the start, and wait for their clocks.
#[test]
fn a_million_groups_of_pairs_wait_at_once() {
    const PLATE_COUNT: usize = 3_200;
    let mut rng = rng(5);
    let step = 1.0 / PLATE_COUNT as f64;
    let bodies =
        [0.0, 0.5 * step].map(|lowest| body_of_level_plates(&mut rng, PLATE_COUNT, lowest, step));
    let answer = |budget: u64| {
        let config = Settings {
            tolerance: 1e-5,
            budget,
            ..Settings::DEFAULT
        };
        let rising = Motion::new(Pose::IDENTITY, DVec3::Z, DVec3::ZERO).unwrap();
        let motions = [rising, Motion::still(Pose::IDENTITY)];
        let moving = |k: usize| MovingBody::from((&bodies[k], motions[k]));
        solve(&Problem::of_moving_bodies(moving(0), moving(1), 1.0, &config).unwrap())
    };
    // Every plate meets the one above it at once.
    let exact = 0.5 * step;
    let all = answer(1 << 24);
    assert!(all.stats.peak_front > 1 << 20, "{:?}", all.stats);
    let Outcome::Contact { time, .. } = all.outcome else {
        panic!("{all:?}");
    };
    assert!(
        time <= exact && time >= exact - all.tolerance,
        "{time} of {exact}"
    );
    // The visits do not suffice for all: the certified time is then not later.
    let some = answer(1_000_000);
    let Outcome::Unresolved(Unresolved {
        safe_until,
        limit: reason,
        ..
    }) = some.outcome
    else {
        panic!("a million visits are not enough: {some:?}");
    };
    assert_eq!(reason, Limit::Budget);
    assert!(safe_until <= time);
}

/// Tests that a triangle of size 200 turns past a thousand small ones in fewer than 512 visits. Planes that turn with
/// it keep pairs of nodes apart for a while, without splits.
#[test]
fn a_large_piece_turns_past_many_small_ones_at_little_cost() {
    let small = |k: u32| {
        let (x, y) = (
            f64::from(k % 32) / 32.0 - 0.5,
            f64::from(k / 32) / 32.0 - 0.5,
        );
        let corner = DVec3::new(x, y, 0.6);
        [corner, corner + 0.03 * DVec3::X, corner + 0.03 * DVec3::Y]
    };
    let field = body(&(0..1024).map(small).collect::<Vec<Triangle>>());
    let corner = |x: f64, y: f64| DVec3::new(x, y, 0.0);
    let large = body(&[[
        corner(-200.0, -100.0),
        corner(200.0, -100.0),
        corner(0.0, 200.0),
    ]]);
    let spin = Motion::new(Pose::IDENTITY, DVec3::ZERO, 0.4 * DVec3::Y).unwrap();
    let moving = |body, motion| MovingBody::from((body, motion));
    let (large, field) = (
        moving(&large, spin),
        moving(&field, Motion::still(Pose::IDENTITY)),
    );
    for (a, b) in [(large, field), (field, large)] {
        let problem = Problem::of_moving_bodies(a, b, 1.0, &Settings::DEFAULT).unwrap();
        let answer = solve(&problem);
        assert!(matches!(answer.outcome, Outcome::Free { .. }), "{answer:?}");
        let Stats {
            iterations,
            oracle_calls,
            ..
        } = answer.stats;
        assert!(iterations < 512 && oracle_calls < 10, "{answer:?}");
    }
}

mod many_near;
