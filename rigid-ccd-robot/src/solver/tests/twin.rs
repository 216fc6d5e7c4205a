//! Tests random changes of cells against a twin. The twin queries the engine pair by pair, and keeps its own list of
//! allowed contacts.

use super::*;
use rigid_ccd::trajectory::Chain;
use rigid_ccd::{Outcome, StartPolicy};
use std::collections::BTreeSet;

/// The twin's own record of a cell.
struct Twin {
    robot: Robot,
    /// The bodies: the name of the item, the index of its link (the base for an obstacle), the body, and its pose on
    /// the link.
    bodies: Vec<(String, usize, Body, Pose)>,
    obstacles: BTreeSet<String>,
    attached: BTreeSet<String>,
    /// Pairs of names that are allowed to touch, in both orders.
    allowed: BTreeSet<(String, String)>,
}

impl Twin {
    fn of_robot(robot: &Robot) -> Self {
        let links = robot.links().iter().enumerate();
        let bodies = links.flat_map(|(number, link)| {
            let bodies = link.bodies.iter();
            bodies.map(move |link_body| {
                (
                    link.name.clone(),
                    number,
                    Body::clone(&link_body.body),
                    link_body.pose,
                )
            })
        });
        Twin {
            bodies: bodies.collect(),
            robot: robot.clone(),
            obstacles: BTreeSet::new(),
            attached: BTreeSet::new(),
            allowed: BTreeSet::new(),
        }
    }

    fn is_link(&self, name: &str) -> bool {
        !self.obstacles.contains(name) && !self.attached.contains(name)
    }

    fn set_allowed(&mut self, a: &str, b: &str, is_allowed: bool) {
        for pair in [(a, b), (b, a)] {
            let pair = (pair.0.to_owned(), pair.1.to_owned());
            if is_allowed {
                self.allowed.insert(pair);
            } else {
                self.allowed.remove(&pair);
            }
        }
    }

    fn remove(&mut self, name: &str) {
        self.bodies.retain(|(own, ..)| own != name);
        self.allowed.retain(|(a, b)| a != name && b != name);
        self.obstacles.remove(name);
        self.attached.remove(name);
    }

    /// Returns the pairs of bodies to check. `included` are the pairs of links that a clearance or a call includes.
    fn pairs(&self, included: &BTreeSet<(String, String)>) -> Vec<[usize; 2]> {
        let count = self.bodies.len();
        let all = (0..count).flat_map(|a| (0..a).map(move |b| [a, b]));
        let compared = all.filter(|&[a, b]| {
            let [(one, link, ..), (other, with, ..)] = [&self.bodies[a], &self.bodies[b]];
            let key = (one.clone(), other.clone());
            let rigid = self.robot.are_rigidly_connected(*link, *with);
            let links = self.is_link(one) && self.is_link(other);
            let is_near = links && self.robot.are_neighbours(*link, *with);
            !rigid && !self.allowed.contains(&key) && (!is_near || included.contains(&key))
        });
        compared.collect()
    }

    /// Returns the chain that moves the first body of a pair relative to the second one, and its positions at both
    /// ends.
    fn chain(&self, [a, b]: [usize; 2], ends: [&[f64]; 2]) -> (Chain, [Vec<f64>; 2]) {
        let [(_, link, _, pose), (_, with, _, at)] = [&self.bodies[a], &self.bodies[b]];
        let between = self.robot.chain_between(*with, *link);
        let positions = |configuration: &[f64]| {
            let mut positions = between.positions(&self.robot, configuration).unwrap();
            positions.push(0.0);
            positions
        };
        let free = |joint: &trajectory::Joint| {
            joint.clone().with_limits(f64::NEG_INFINITY..=f64::INFINITY)
        };
        let joints = between.chain().joints().iter().map(free);
        let last = trajectory::Joint::fixed(*pose);
        let joints = joints.chain([last]).collect();
        (Chain::new(at.inverse(), joints), ends.map(positions))
    }

    /// Returns the engine's answer for a pair, or its distances along the edge if it starts within its margin under
    /// the policy `leave`.
    fn ask(&self, pair: [usize; 2], ends: [&[f64]; 2], settings: &Settings) -> Known {
        let (chain, [from, to]) = self.chain(pair, ends);
        let link = chain.link(from.len(), &from, &to, 1.0).unwrap();
        let [body, other] = pair.map(|number| &self.bodies[number].2);
        let mut solver = Solver::new();
        let mut outcome_at = |time: f64| {
            let pose = rigid_ccd::trajectory::Trajectory::pose(&link, time).unwrap();
            solver
                .distance((body, pose), (other, Pose::IDENTITY))
                .unwrap()
                .outcome
        };
        let start = outcome_at(0.0);
        let gap = start.lower() - settings.margin;
        let overlaps = matches!(start, Outcome::Overlapping { .. });
        let is_start_contact =
            settings.start_policy == StartPolicy::Leave && !overlaps && gap <= settings.tolerance;
        if is_start_contact && gap < 1e-6 {
            let times = (0..=20).map(|k| f64::from(k) / 20.0);
            return Known::Distances(times.map(|time| (time, outcome_at(time).lower())).collect());
        }
        let settings = Settings {
            start_policy: StartPolicy::Report,
            // A pair with a gap must keep half of it.
            tolerance: if is_start_contact {
                0.5 * gap
            } else {
                settings.tolerance
            },
            ..settings.clone()
        };
        let mut solver = Solver::new().with_settings(settings);
        let outcome = solver.first_contact((body, &link), (other, Pose::IDENTITY), 1.0);
        Known::Answer(Box::new(outcome.unwrap().outcome), is_start_contact)
    }
}

/// The twin's answer for a pair on an edge.
enum Known {
    /// The first contact, and whether the pair is in contact at the start.
    Answer(Box<Outcome>, bool),
    /// Times, with distances.
    Distances(Vec<(f64, f64)>),
}

/// A cell and its twin, which are changed together.
struct Both {
    cell: Cell,
    twin: Twin,
    included: BTreeSet<(String, String)>,
    count: usize,
}

impl Both {
    fn new(random: &mut Pcg64) -> Self {
        let robot = random_robot(random);
        let pairs = LinkPairs::from_robot(&robot);
        Both {
            twin: Twin::of_robot(&robot),
            cell: Cell::new(robot, pairs),
            included: BTreeSet::new(),
            count: 0,
        }
    }

    fn some_name(&self, random: &mut Pcg64) -> String {
        let names: BTreeSet<&String> = self.twin.bodies.iter().map(|(name, ..)| name).collect();
        let index = random.random_range(0..names.len());
        names.into_iter().nth(index).unwrap().clone()
    }

    /// Applies a random change to both.
    fn change(&mut self, random: &mut Pcg64) {
        self.count += 1;
        let name = format!("thing{}", self.count);
        let base = self.cell.robot().base();
        match random.random_range(0..9) {
            0..3 => {
                let (body, pose) = (random_body(random), random_pose(random, 1.5));
                self.cell.add_obstacle(&name, body.clone(), pose).unwrap();
                self.twin.obstacles.insert(name.clone());
                self.twin.bodies.push((name, base, body, pose));
            }
            3..5 => {
                let link = random.random_range(0..self.cell.robot().links().len());
                let may_touch: Vec<String> = (0..random.random_range(0..3))
                    .map(|_| self.some_name(random))
                    .collect();
                let (body, pose) = (random_body(random), random_pose(random, 0.3));
                let names: Vec<&str> = may_touch.iter().map(String::as_str).collect();
                let link_name = self.cell.robot().links()[link].name.clone();
                self.cell
                    .attach(&name, body.clone(), (&link_name, pose), &names)
                    .unwrap();
                for other in &may_touch {
                    self.twin.set_allowed(&name, other, true);
                }
                self.twin.attached.insert(name.clone());
                self.twin.bodies.push((name, link, body, pose));
            }
            5 => {
                let name = self.some_name(random);
                if self.twin.obstacles.contains(&name) {
                    self.cell.remove_obstacle(&name).unwrap();
                    self.twin.remove(&name);
                } else if self.twin.attached.contains(&name) {
                    self.cell.detach(&name).unwrap();
                    self.twin.remove(&name);
                }
            }
            6 => {
                let name = self.some_name(random);
                if self.twin.obstacles.contains(&name) {
                    let pose = random_pose(random, 1.5);
                    self.cell.move_obstacle(&name, pose).unwrap();
                    let own = self.twin.bodies.iter_mut().find(|(own, ..)| *own == name);
                    own.unwrap().3 = pose;
                }
            }
            kind => {
                let [a, b] = [(); 2].map(|()| self.some_name(random));
                let pair = [&a, &b].map(|name| self.cell.item_named(name).unwrap());
                let is_allowed = kind == 7;
                let changed = if is_allowed {
                    self.cell.allow_contact(pair)
                } else {
                    self.cell.forbid_contact(pair)
                };
                if changed.is_ok() {
                    self.twin.set_allowed(&a, &b, is_allowed);
                    if !is_allowed && self.twin.is_link(&a) && self.twin.is_link(&b) {
                        self.included.extend([(a.clone(), b.clone()), (b, a)]);
                    }
                }
            }
        }
    }
}

/// Counts of the answers of a run.
#[derive(Debug, Default)]
struct Counts {
    free: usize,
    contacts: usize,
    near_misses: usize,
    let_go: usize,
    nothing: usize,
}

/// Compares the answer about an edge with the twin's.
fn compare(both: &Both, [from, to]: [&[f64]; 2], settings: &Settings, counts: &mut Counts) {
    let pairs = both.twin.pairs(&both.included);
    let compared = both.cell.compared_pairs(0.0).count();
    let moves = |&[a, b]: &[usize; 2]| {
        let links = [a, b].map(|body| both.twin.bodies[body].1);
        !both.twin.robot.are_rigidly_connected(links[0], links[1])
    };
    assert_eq!(compared, pairs.iter().filter(|pair| moves(pair)).count());
    let mut solver = both.cell.solver().with_settings(settings.clone());
    let found = match solver.first_contact(&[from, to]) {
        Ok(answer) => answer.outcome,
        Err(PathError::NothingCompared(_)) => {
            counts.nothing += 1;
            return assert_eq!(compared, 0);
        }
        Err(error) => panic!("{error}"),
    };
    assert_eq!(
        solver.is_free(&[from, to]).unwrap(),
        found == PathOutcome::Free
    );
    let until = match &found {
        PathOutcome::Free => f64::INFINITY,
        PathOutcome::Contact(contact) => contact.at.fraction,
        _ => panic!("{found:?}"),
    };
    let mut is_confirmed = false;
    for pair in pairs {
        let names = pair.map(|body| both.twin.bodies[body].0.as_str());
        let is_named = matches!(&found, PathOutcome::Contact(contact)
            if contact.items.iter().all(|item| names.contains(&item.name())));
        match both.twin.ask(pair, [from, to], settings) {
            Known::Distances(distances) => {
                counts.let_go += 1;
                is_confirmed |= is_named;
                let least = lesser(distances[0].1, settings.margin);
                for (time, distance) in distances {
                    let is_kept = time >= until || distance >= least - 1e-6;
                    assert!(is_kept, "{names:?}: {distance} at {time} of {until}");
                }
            }
            Known::Answer(outcome, is_start_contact) => {
                counts.let_go += usize::from(is_start_contact);
                let Some(hit) = outcome.hit().unwrap() else {
                    continue;
                };
                // Between the margin and margin + tolerance, either may report a contact.
                if hit.time < until - 1e-2 {
                    let distance = hit.witness_a().distance(hit.witness_b());
                    let text = format!("{names:?}: {} before {until}, {distance}", hit.time);
                    assert!(
                        hit.contact().is_some() && distance > settings.margin,
                        "{text}"
                    );
                    counts.near_misses += 1;
                }
                is_confirmed |= is_named;
            }
        }
    }
    match found {
        PathOutcome::Free => counts.free += 1,
        PathOutcome::Contact(contact) => {
            counts.contacts += 1;
            let [lower, upper] = contact.distance_bounds;
            assert!(
                lower <= settings.margin + settings.tolerance + 1e-9,
                "{contact:?}"
            );
            // The twin must find the contact as well, unless it is only within the tolerance.
            assert!(is_confirmed || upper > settings.margin, "{contact:?}");
        }
        _ => {}
    }
}

/// Tests random cells after each of many changes, under both start policies.
#[test]
fn each_answer_is_that_of_the_pairs_alone() {
    let mut random = Pcg64::seed_from_u64(80);
    let mut counts = Counts::default();
    for _ in 0..60 {
        let mut both = Both::new(&mut random);
        for _ in 0..10 {
            both.change(&mut random);
            let robot = both.cell.robot().clone();
            let from = random_configuration(&mut random, &robot);
            let far = random_configuration(&mut random, &robot);
            let reach = [0.02, 0.1, 0.4][random.random_range(0..3)];
            let to = configuration_between(&from, &far, reach);
            let start_policy = [StartPolicy::Report, StartPolicy::Leave][random.random_range(0..2)];
            // With a large tolerance, some pairs in contact at the start have gaps.
            let tolerance = match start_policy {
                StartPolicy::Leave => [1e-3, 0.1][random.random_range(0..2)],
                StartPolicy::Report => 1e-3,
            };
            let settings = Settings {
                start_policy,
                tolerance,
                margin: [0.0, 0.02][random.random_range(0..2)],
                ..Settings::DEFAULT
            };
            compare(&both, [&from, &to], &settings, &mut counts);
        }
    }
    let Counts {
        free,
        contacts,
        let_go,
        ..
    } = counts;
    assert!(free > 200 && contacts > 80 && let_go > 30, "{counts:?}");
}
