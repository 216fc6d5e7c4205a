//! Tests proofs about pairs of links against random configurations.

use super::*;
use crate::robot::{Joint, Link, PositionRule};
use crate::test_robots::{least_distance_of_links, random_robot, with_symmetric_limits};
use ccd_core::{Facet, FacetOrigin, Pieces, Polytope, Solidity};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rigid_ccd::glam::DVec3;
use rigid_ccd::{Body, Pose, trajectory};

/// Tests random robots: no configuration contradicts a proof, and every witness is what it claims to be.
#[test]
fn no_configuration_contradicts_a_proof() {
    let mut random = Pcg64::seed_from_u64(21);
    let (mut never, mut always, mut sometimes, mut undecided) = (0, 0, 0, 0);
    for _ in 0..40 {
        let limit = [0.3, 1.2][random.random_range(0..2)];
        let robot = with_symmetric_limits(&random_robot(&mut random), limit);
        for (links, meeting) in classify(&robot, 3) {
            let distance = |at: &[f64]| least_distance_of_links(&robot, links, at);
            let samples = (0..60).map(|_| {
                let limits = robot.limits();
                let at: Vec<f64> = limits
                    .map(|[low, high]| random.random_range(low..=high))
                    .collect();
                distance(&at)
            });
            let samples: Vec<f64> = samples.collect();
            match meeting {
                LinkContactClass::Never => {
                    never += 1;
                    assert!(samples.iter().all(|&distance| distance > 0.0), "{links:?}");
                }
                LinkContactClass::Always | LinkContactClass::AlwaysAsEnclosed => {
                    always += 1;
                    assert!(
                        samples.iter().all(|&distance| distance <= 3e-9),
                        "{links:?}"
                    );
                }
                LinkContactClass::Sometimes {
                    touching_configuration: touching,
                    apart_configuration: apart,
                } => {
                    sometimes += 1;
                    assert!(
                        distance(&touching) <= 1e-9 && distance(&apart) > 0.0,
                        "{links:?}"
                    );
                }
                LinkContactClass::Undecided {
                    proven_apart_fraction,
                    undecided_fraction,
                    ..
                } => {
                    undecided += 1;
                    assert!((0.0..1.0).contains(&proven_apart_fraction));
                    assert!((0.0..=1.0 - proven_apart_fraction).contains(&undecided_fraction));
                }
            }
        }
    }
    let enough = never > 20 && always > 0 && sometimes > 40 && undecided > 5;
    assert!(enough, "{never} {always} {sometimes} {undecided}");
}

/// Tests a hinge whose leaf touches the frame beyond a known angle, with limits below and above it.
#[test]
fn limits_decide_whether_a_hinge_meets_its_stop() {
    // The rod extends from 0.1 to 0.9, and the post has radius 0.1 at (0, 0.8). They touch at a right angle, less the
    // angle that 0.15 subtends at distance 0.8.
    let meet = std::f64::consts::FRAC_PI_2 - (0.15f64 / 0.8).asin();
    let capsule = || Body::capsule(0.05, 0.35).unwrap();
    let door_with = |rod: Body, limit: f64, joint_limit: f64| {
        let lying = rigid_ccd::glam::DQuat::from_rotation_y(std::f64::consts::FRAC_PI_2);
        let links = vec![
            Link::named("frame").with_body(
                Body::capsule(0.1, 0.5).unwrap(),
                Pose::at([0.0, 0.8, 0.0]).unwrap(),
            ),
            Link::named("leaf").with_body(rod, Pose::new([0.5, 0.0, 0.0], lying).unwrap()),
        ];
        let hinge = trajectory::Joint::revolute(Pose::IDENTITY, [0.0, 0.0, 1.0]).unwrap();
        let joints = vec![Joint {
            name: "hinge".into(),
            parent: "frame".into(),
            child: "leaf".into(),
            geometry: hinge.with_limits(joint_limit..=limit),
            position_rule: PositionRule::Independent,
        }];
        let robot = Robot::new(links, joints).unwrap();
        classify(&robot, 10_000).remove(0).1
    };
    let door = |limit: f64, joint_limit: f64| door_with(capsule(), limit, joint_limit);
    assert_eq!(door(meet - 1e-4, 0.0), LinkContactClass::Never);
    // A body that exceeds its shape may give another class than the shape.
    let cylinder = Body::cylinder(0.05, 0.35).unwrap();
    assert!(cylinder.excess() > 0.0);
    assert!(matches!(
        door_with(cylinder, meet + 0.2, 0.0),
        LinkContactClass::Sometimes { .. }
    ));
    assert!(matches!(
        door(meet + 1e-2, 0.0),
        LinkContactClass::Sometimes { .. }
    ));
    // The limits allow a single position.
    assert_eq!(door(1.0, 1.0), LinkContactClass::Never);
    // Without limits the joint is searched over one turn.
    let turning = door(f64::INFINITY, f64::NEG_INFINITY);
    assert!(
        matches!(turning, LinkContactClass::Sometimes { .. }),
        "{turning:?}"
    );
}

/// Tests that two links containing the same point of their hinge's axis always touch, and that links which only
/// overlap in most configurations do not.
#[test]
fn links_that_hold_their_hinge_always_touch() {
    let meeting = |offset: f64| {
        let ball = || Body::sphere(0.3).unwrap();
        let at = Pose::at([offset, 0.0, 0.7]).unwrap();
        let links = vec![
            Link::named("base").with_body(ball(), at),
            Link::named("arm").with_body(ball(), at),
        ];
        let joints = vec![Joint {
            name: "hinge".into(),
            parent: "base".into(),
            child: "arm".into(),
            geometry: trajectory::Joint::revolute(Pose::IDENTITY, [0.0, 0.0, 1.0]).unwrap(),
            position_rule: PositionRule::Independent,
        }];
        let robot = Robot::new(links, joints).unwrap();
        classify(&robot, 2_000).remove(0).1
    };
    assert_eq!(meeting(0.29), LinkContactClass::Always);
    // After half a turn the centers of the balls are 0.62 apart.
    assert!(matches!(meeting(0.31), LinkContactClass::Sometimes { .. }));
}

/// Classifies all pairs of a robot's links, with the given number of boxes for each pair.
pub(crate) fn classify(robot: &Robot, max_boxes: usize) -> Vec<([usize; 2], LinkContactClass)> {
    let settings = LinkContactSettings {
        max_boxes,
        ..LinkContactSettings::DEFAULT
    };
    robot.classify_link_contacts(&settings, |_, _| ()).unwrap()
}

/// Tests that the stop flag ends the search at once with all pairs undecided, and that progress counts the decided
/// pairs.
#[test]
fn a_search_can_be_stopped_and_watched() {
    let robot = random_robot(&mut Pcg64::seed_from_u64(3));
    let search = |stop: bool| {
        let most = AtomicUsize::new(0);
        let settings = LinkContactSettings {
            max_boxes: 1_000,
            stop: Some(Arc::new(AtomicBool::new(stop))),
            ..LinkContactSettings::DEFAULT
        };
        let classes = robot.classify_link_contacts(&settings, |decided, all| {
            assert!(decided <= all && all > 3);
            most.fetch_max(decided, Ordering::Relaxed);
        });
        let classes = classes.unwrap();
        let decided = classes.iter().filter(|(_, class)| class.is_decided());
        assert_eq!(decided.count(), most.into_inner());
        classes
    };
    let (found, stopped) = (search(false), search(true));
    assert!(found.iter().any(|(_, class)| class.is_decided()));
    assert!(!stopped.iter().any(|(_, class)| class.is_decided()));
    let pairs = |classes: Vec<([usize; 2], LinkContactClass)>| {
        classes
            .into_iter()
            .map(|(pair, _)| pair)
            .collect::<Vec<_>>()
    };
    assert_eq!(pairs(found), pairs(stopped));
}

/// Tests that the search for a slide that always touches its rail ends early, and that a pair that touches without
/// overlapping gets no extra boxes.
#[test]
fn a_slide_on_a_rail_takes_no_share_of_others() {
    let cuboid =
        |half: [f64; 3], at: [f64; 3]| (Body::cuboid(half).unwrap(), Pose::at(at).unwrap());
    let robot = |blocks: &[[f64; 3]]| {
        let (rail, at) = cuboid([4.0, 1.0, 0.5], [0.0, 0.0, -0.5]);
        let mut base = Link::named("rail").with_body(rail, at);
        for &place in blocks {
            let (block, at) = cuboid([0.5, 0.5, 0.5], place);
            base = base.with_body(block, at);
        }
        let (carriage, at) = cuboid([0.25, 0.25, 0.25], [0.0, 0.0, 0.25]);
        let links = vec![base, Link::named("carriage").with_body(carriage, at)];
        let slides = trajectory::Joint::prismatic(Pose::IDENTITY, [1.0, 0.0, 0.0]).unwrap();
        let joints = vec![Joint {
            name: "slide".into(),
            parent: "rail".into(),
            child: "carriage".into(),
            geometry: slides.with_limits(0.0..=2.0),
            position_rule: PositionRule::Independent,
        }];
        Robot::new(links, joints).unwrap()
    };
    let search = |robot: &Robot, max_boxes: usize| {
        let cell = Cell::new(robot.clone(), LinkPairs::from_robot(robot));
        let end = SearchEnd::starting_now(&LinkContactSettings::DEFAULT);
        let mut record = LinkPairRecord::new([0, 1]);
        let mut search = LinkPairSearch::new(&cell, end);
        search.search(&mut record, max_boxes).unwrap();
        assert!(!record.is_decided());
        record
    };
    let sliding = search(&robot(&[]), 20_000);
    assert!(
        sliding.is_exhausted && sliding.boxes <= 4_000,
        "{sliding:?}"
    );
    let sinking = search(&robot(&[[2.0, 0.0, 0.4]]), 2_000);
    assert!(
        !sinking.is_exhausted && sinking.boxes == 2_000,
        "{sinking:?}"
    );
    assert_eq!(
        [9_000, 500].map(|limit| sinking.quota(limit, 1_000)),
        [1_000, 500]
    );
    // An undecided pair gets the boxes that other pairs leave.
    assert_eq!(LinkPairRecord::new([0, 1]).quota(9_000, 1_000), 9_000);
}

/// Tests random planar arms of two links. The ball on the last link touches the ball on the base if the elbow's angle
/// exceeds a known one.
#[test]
fn planar_arms_touch_where_the_law_of_cosines_says() {
    let mut random = Pcg64::seed_from_u64(8);
    let (mut never, mut always, mut sometimes) = (0, 0, 0);
    for _ in 0..60 {
        let [upper, fore, reach] =
            [0.5..1.0, 0.5..1.0, 0.3..0.8].map(|range| random.random_range(range));
        // |upper + fore e^(iq)| = reach
        let cosine = (reach * reach - upper * upper - fore * fore) / (2.0 * upper * fore);
        if !(-0.95..0.95).contains(&cosine) {
            continue;
        }
        let border = f64::acos(cosine);
        let (ranges, gap) = (
            [[0.0, border], [border, 3.1], [0.0, 3.1]],
            [1e-3, 0.02, 0.2][random.random_range(0..3)],
        );
        for (kind, [low, high]) in ranges.into_iter().enumerate() {
            let (low, high) = [(low, high - gap), (low + gap, high), (low, high)][kind];
            let ball = |radius: f64, x: f64| {
                (
                    Body::sphere(radius).unwrap(),
                    Pose::at([x, 0.0, 0.0]).unwrap(),
                )
            };
            let ((hub, at_hub), (tip, at_tip)) = (ball(0.4 * reach, 0.0), ball(0.6 * reach, fore));
            let links = vec![
                Link::named("hub").with_body(hub, at_hub),
                Link::named("upper"),
                Link::named("fore").with_body(tip, at_tip),
            ];
            let turns = |x: f64| {
                let origin = Pose::at([x, 0.0, 0.0]).unwrap();
                trajectory::Joint::revolute(origin, [0.0, 0.0, 1.0]).unwrap()
            };
            let joint = |name: &str, parent: &str, child: &str, geometry| Joint {
                name: name.into(),
                parent: parent.into(),
                child: child.into(),
                geometry,
                position_rule: PositionRule::Independent,
            };
            let joints = vec![
                joint(
                    "shoulder",
                    "hub",
                    "upper",
                    turns(0.0).with_limits(-3.0..=3.0),
                ),
                joint(
                    "elbow",
                    "upper",
                    "fore",
                    turns(upper).with_limits(low..=high),
                ),
            ];
            let robot = Robot::new(links, joints).unwrap();
            match (kind, &classify(&robot, 2_000)[0].1) {
                (0, LinkContactClass::Never) => never += 1,
                (1, LinkContactClass::Always) => always += 1,
                (
                    2,
                    LinkContactClass::Sometimes {
                        touching_configuration: touching,
                        apart_configuration: apart,
                    },
                ) => {
                    assert!(touching[1] >= border - 1e-9 && apart[1] <= border + 1e-9);
                    sometimes += 1;
                }
                (_, class) => panic!("{kind} {gap} {class:?}"),
            }
        }
    }
    assert!(never > 30 && always > 30 && sometimes > 30);
}

/// Tests an arm of seven joints with many corners: a small budget decides all pairs, and each run gives the same
/// result.
#[test]
fn a_small_budget_decides_about_an_arm() {
    let robot = arm_of_prisms();
    let classes = classify(&robot, 1_000);
    assert_eq!(classes.len(), 28);
    // One pair comes as near as 3 mm without touching.
    let decided = classes.iter().filter(|(_, class)| class.is_decided());
    assert!(decided.count() >= 27, "{classes:?}");
    assert_eq!(classes, classify(&robot, 1_000));
    for (links, class) in classes {
        if let LinkContactClass::Sometimes {
            touching_configuration: touching,
            apart_configuration: apart,
        } = class
        {
            assert!(least_distance_of_links(&robot, links, &touching) <= 0.0);
            assert!(least_distance_of_links(&robot, links, &apart) > 0.0);
        }
    }
}

/// Returns an arm of eight twelve-sided prisms. Its seven joints alternate between rotation about the link's length
/// and across it.
fn arm_of_prisms() -> Robot {
    let prism = || {
        let corners = (0..24).map(|k| {
            let (sine, cosine) = (f64::from(k / 2) * std::f64::consts::TAU / 12.0).sin_cos();
            DVec3::new(
                0.06 * cosine,
                0.06 * sine,
                if k % 2 == 0 { 0.09 } else { -0.09 },
            )
        });
        let hull = ccd_decomp::convex_hull(&corners.collect::<Vec<_>>()).unwrap();
        let facets = hull.facets.iter().map(|corners| Facet {
            origin: FacetOrigin::Virtual,
            corners: corners.to_vec(),
        });
        let polytope = Polytope {
            facets: facets.collect(),
            points: hull.points,
            ..Polytope::default()
        };
        let pieces = Pieces::from_polytopes(&[polytope]).unwrap();
        Body::new(&pieces, Solidity::Solid).unwrap()
    };
    let name = |k: usize| format!("link{k}");
    let links = (0..8).map(|k| {
        let at = Pose::at([0.0, 0.0, 0.1]).unwrap();
        Link::named(name(k)).with_body(prism(), at)
    });
    let joints = (0..7).map(|k| {
        let at = Pose::at([0.0, 0.0, 0.2]).unwrap();
        let (axis, limit) = if k % 2 == 0 {
            ([0.0, 0.0, 1.0], 2.96)
        } else {
            ([0.0, 1.0, 0.0], 2.09)
        };
        let turns = trajectory::Joint::revolute(at, axis).unwrap();
        Joint {
            name: format!("joint{k}"),
            parent: name(k),
            child: name(k + 1),
            geometry: turns.with_limits(-limit..=limit),
            position_rule: PositionRule::Independent,
        }
    });
    Robot::new(links.collect(), joints.collect()).unwrap()
}
