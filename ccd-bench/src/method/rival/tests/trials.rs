//! Tests that all rivals share: scenes with exact answers, and shots checked by brute force.

use crate::method::rival::patience::WorkLimit;
use crate::method::rival::triangles_apart::{Triangle, nearest_points};
use crate::method::rival::{Placement, RivalMotion};
use crate::method::solver::{ContactClaim, Solver};
use crate::scene::model::Model;
use crate::scene::tests::shots::ShotGenerator;
use ccd_core::glam::{DMat3, DQuat, DVec3};
use ccd_core::order::{greater, lesser};
use ccd_core::{Motion, Pose};
use ccd_decomp::TriangleMesh;
use ccd_tables::motions::Motions;
use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_4, PI, SQRT_2};

/// A test case: two bodies, their motions, and the exact first contact.
struct ExactCase {
    name: &'static str,
    a: TriangleMesh,
    b: TriangleMesh,
    query: Motions,
    contact_time: f64,
    /// The closing speed at the contact point, in units of length per unit of time.
    closing_speed: f64,
}

pub(in crate::method::rival) fn knot_216() -> TriangleMesh {
    Model::Knot216.generate().unwrap()
}

fn box_mesh(half: DVec3) -> TriangleMesh {
    rotated_box_mesh(half, DMat3::IDENTITY)
}

fn rotated_box_mesh(half: DVec3, turn: DMat3) -> TriangleMesh {
    let corner = |k: u32| {
        let side = |bit: u32| if k >> bit & 1 == 1 { 1.0 } else { -1.0 };
        turn * (half * DVec3::new(side(0), side(1), side(2)))
    };
    let faces = [
        [0, 2, 1],
        [1, 2, 3],
        [4, 5, 6],
        [5, 7, 6],
        [0, 1, 4],
        [1, 5, 4],
        [2, 6, 3],
        [3, 6, 7],
        [0, 4, 2],
        [2, 4, 6],
        [1, 3, 5],
        [3, 7, 5],
    ];
    TriangleMesh::new((0..8).map(corner).collect(), &faces).unwrap()
}

fn motion_from_unrotated_pose(at: DVec3, velocity: DVec3, spin: DVec3) -> Motion {
    Motion::new(Pose::at(at).unwrap(), velocity, spin).unwrap()
}

fn resting_motion_at(at: DVec3) -> Motion {
    Motion::still(Pose::at(at).unwrap())
}

fn query(a: Motion, b: Motion) -> Motions {
    Motions {
        id: String::new(),
        a,
        b,
        duration: 1.0,
    }
}

/// The half extents of a slab onto which bodies fall. Its near face is at the origin's height if it is lowered by its
/// third half extent.
const SLAB_HALF_EXTENTS: DVec3 = DVec3::new(10.0, 10.0, 1.0);

/// The position of the slab, at which its top is at height 0.
const SLAB_POSITION: DVec3 = DVec3::new(0.0, 0.0, -1.0);

fn falling_box_cases() -> Vec<ExactCase> {
    let fall = |name, a, b, at_b, time| ExactCase {
        name,
        a,
        b,
        query: query(
            motion_from_unrotated_pose(3.0 * DVec3::Z, -4.0 * DVec3::Z, DVec3::ZERO),
            resting_motion_at(at_b),
        ),
        contact_time: time,
        closing_speed: 4.0,
    };
    let cube = DVec3::splat(0.5);
    let upright = DQuat::from_rotation_arc(DVec3::ONE.normalize(), DVec3::NEG_Z);
    vec![
        fall(
            "cube on slab",
            box_mesh(cube),
            box_mesh(SLAB_HALF_EXTENTS),
            SLAB_POSITION,
            0.625,
        ),
        fall(
            "edge on edge",
            rotated_box_mesh(cube, DMat3::from_rotation_x(FRAC_PI_4)),
            rotated_box_mesh(cube, DMat3::from_rotation_y(FRAC_PI_4)),
            DVec3::ZERO,
            (3.0 - SQRT_2) / 4.0,
        ),
        fall(
            "corner on slab",
            rotated_box_mesh(cube, DMat3::from_quat(upright)),
            box_mesh(SLAB_HALF_EXTENTS),
            SLAB_POSITION,
            (3.0 - 0.75_f64.sqrt()) / 4.0,
        ),
    ]
}

/// Returns cases of rotating rods that meet a slab, a wall, another rod, or a post.
fn turning_rod_cases() -> Vec<ExactCase> {
    let (length, width, height) = (2.0_f64, 0.05_f64, 1.2);
    let radius = length.hypot(width);
    let angle = |height: f64| (height / radius).asin() - width.atan2(length);
    // A corner at the radius rises as fast as its distance along.
    let rise = |height: f64| (radius * radius - height * height).sqrt();
    let mut scenes = vec![ExactCase {
        name: "rod on slab",
        a: box_mesh(DVec3::new(length, 0.3, width)),
        b: box_mesh(SLAB_HALF_EXTENTS),
        query: query(
            motion_from_unrotated_pose(height * DVec3::Z, DVec3::ZERO, PI * DVec3::Y),
            resting_motion_at(SLAB_POSITION),
        ),
        contact_time: angle(height) / PI,
        closing_speed: PI * rise(height),
    }];
    for turns in [1.0, 1.9] {
        scenes.push(ExactCase {
            name: "rod on wall",
            a: box_mesh(DVec3::new(width, 0.3, length)),
            b: box_mesh(DVec3::new(1.0, 10.0, 10.0)),
            query: query(
                motion_from_unrotated_pose(DVec3::ZERO, DVec3::ZERO, turns * PI * DVec3::Y),
                resting_motion_at((height + 1.0) * DVec3::X),
            ),
            contact_time: angle(height) / (turns * PI),
            closing_speed: turns * PI * rise(height),
        });
    }
    let (apart, speed) = (3.0, 2.0);
    let rod = || box_mesh(DVec3::new(width, 0.3, length));
    scenes.push(ExactCase {
        name: "rod on rod",
        a: rod(),
        b: rod(),
        query: query(
            motion_from_unrotated_pose(DVec3::ZERO, DVec3::ZERO, speed * DVec3::Y),
            motion_from_unrotated_pose(apart * DVec3::X, DVec3::ZERO, -speed * DVec3::Y),
        ),
        contact_time: angle(0.5 * apart) / speed,
        closing_speed: 2.0 * speed * rise(0.5 * apart),
    });
    scenes.push(rod_on_post());
    scenes
}

/// Returns the case of a rod that rotates about z until its side meets an upright edge of a post.
fn rod_on_post() -> ExactCase {
    let (length, width, distance, at) = (2.0, 0.05_f64, 1.3, 1.0_f64);
    let near = DVec3::new(at.cos(), at.sin(), 0.0);
    let outward = DMat3::from_rotation_z(at + FRAC_PI_4);
    // The edge of the post faces the rod: its diagonal points against the rod's velocity.
    let facing = DVec3::new(-at.sin(), at.cos(), 0.0);
    ExactCase {
        name: "rod on post",
        a: box_mesh(DVec3::new(length, width, 0.1)),
        b: rotated_box_mesh(DVec3::new(0.1, 0.1, 0.5), outward),
        query: query(
            motion_from_unrotated_pose(DVec3::ZERO, DVec3::ZERO, 1.5 * DVec3::Z),
            resting_motion_at(distance * near + 0.1 * SQRT_2 * facing),
        ),
        contact_time: (at - (width / distance).asin()) / 1.5,
        closing_speed: 1.5 * (distance * distance - width * width).sqrt(),
    }
}

/// Asserts that a rival's contact times are never late, and early by at most the time to close the tolerance at half
/// the closing speed.
pub(in crate::method::rival) fn assert_contact_times_within_tolerance<C: Solver>(
    tolerance: f64,
    rival: impl Fn(&TriangleMesh, &TriangleMesh) -> C,
) {
    /// The allowed lateness due to rounding, as a fraction of the duration.
    const MAX_ROUNDING_LATENESS: f64 = 1e-12;

    for scene in falling_box_cases().into_iter().chain(turning_rod_cases()) {
        let reply = rival(&scene.a, &scene.b).answer(&scene.query, tolerance);
        let ContactClaim::Contact { time } = reply.claim else {
            panic!("{}: {reply:?}, not {}", scene.name, scene.contact_time);
        };
        let early = scene.contact_time - time;
        let most = 2.0 * tolerance / scene.closing_speed;
        assert!(
            early >= -MAX_ROUNDING_LATENESS,
            "{} at {tolerance:e}: late by {}",
            scene.name,
            -early
        );
        assert!(
            early <= most + MAX_ROUNDING_LATENESS,
            "{} at {tolerance:e}: early by {early}",
            scene.name
        );
    }
}

/// The triangles of a mesh, to compute its distance from a moved copy of itself over all pairs of triangles.
struct BruteForceDistance {
    triangles: Vec<Triangle>,
    bounding_balls: Vec<(DVec3, f64)>,
}

impl BruteForceDistance {
    fn new(mesh: &TriangleMesh) -> Self {
        let corner = |v: u32| mesh.vertices()[v as usize];
        let triangles: Vec<Triangle> = mesh.faces().iter().map(|face| face.map(corner)).collect();
        let ball = |t: &Triangle| {
            let center = (t[0] + t[1] + t[2]) / 3.0;
            (
                center,
                t.map(|p| p.distance(center)).into_iter().fold(0.0, greater),
            )
        };
        BruteForceDistance {
            bounding_balls: triangles.iter().map(ball).collect(),
            triangles,
        }
    }

    fn distance(&self, placement: &Placement) -> f64 {
        let moved: Vec<Triangle> = self
            .triangles
            .iter()
            .map(|t| t.map(|p| placement.apply(p)))
            .collect();
        let balls: Vec<_> = self
            .bounding_balls
            .iter()
            .map(|&(p, r)| (placement.apply(p), r))
            .collect();
        let mut least = f64::INFINITY;
        for (a, (p, r)) in self.triangles.iter().zip(&self.bounding_balls) {
            for (b, (q, s)) in moved.iter().zip(&balls) {
                if p.distance(*q) - r - s < least {
                    least = lesser(least, nearest_points(a, b).vector_from_a_to_b().length());
                }
            }
        }
        least
    }
}

/// Asserts for shots of small knots that the bodies do not touch before the reported time, and are within the tolerance
/// at that time.
pub(in crate::method::rival) fn assert_shots_are_conservative(
    tolerance: f64,
    rival: &mut impl Solver,
) {
    /// The least time between samples, as a fraction of the duration; bodies that are far apart are sampled less often.
    const MIN_SAMPLE_SPACING: f64 = 5e-4;

    let shots = ShotGenerator {
        count: 60,
        translation_count: 20,
        start_distances: 3.0..3.8,
        max_offset: 2.3,
        seed: 5,
    };
    let brute_force = BruteForceDistance::new(&knot_216());
    // Knots turn about their origin.
    let corners = brute_force.triangles.iter().flatten();
    let reach = corners.map(|p| p.length()).fold(0.0, greater);
    let (mut hits, mut free) = (0, 0);
    for query in shots.queries().unwrap() {
        let (a, b) = (RivalMotion::new(&query.a), RivalMotion::new(&query.b));
        let apart = |time: f64| {
            brute_force.distance(&b.placement_at(time).relative_to(&a.placement_at(time)))
        };
        let until = match rival.answer(&query, tolerance).claim {
            ContactClaim::Contact { time } => {
                let distance = apart(time);
                assert!(
                    distance <= 1.000_001 * tolerance,
                    "{}: early, {distance}",
                    query.id
                );
                hits += 1;
                time
            }
            ContactClaim::NoContact => {
                free += 1;
                query.duration
            }
            claim => panic!("{}: {claim:?}", query.id),
        };
        let speed = a.velocity.length() + reach * a.angular_speed;
        let mut time = 0.0;
        while time < until {
            let distance = apart(time);
            assert!(
                distance > 0.0,
                "{}: touching at {time} before {until}",
                query.id
            );
            time += greater(distance / speed, MIN_SAMPLE_SPACING * query.duration);
        }
    }
    assert!(hits >= 20 && free >= 10, "{hits} hits, {free} free");
}

/// Asserts that a rival that reaches its limit of steps, or of pairs, reports a time until which it found no contact.
pub(in crate::method::rival) fn assert_stops_at_work_limit<C: Solver>(
    rival: impl Fn(&TriangleMesh, &TriangleMesh) -> C,
    give: impl Fn(&mut C, WorkLimit),
) {
    let (a, b, query) = box_rotating_past_box();
    let mut rival = rival(&a, &b);
    assert_eq!(rival.answer(&query, 1e-6).claim, ContactClaim::NoContact);
    let short = [
        WorkLimit {
            max_steps: 20,
            ..WorkLimit::default()
        },
        WorkLimit {
            max_pairs: 1_000,
            ..WorkLimit::default()
        },
    ];
    for patience in short {
        give(&mut rival, patience);
        let ContactClaim::Unresolved { safe_until } = rival.answer(&query, 1e-6).claim else {
            panic!("{patience:?} was enough");
        };
        let within = 0.0 < safe_until && safe_until < query.duration;
        assert!(within, "{safe_until}");
    }
}

/// Returns two boxes that rotate past each other without contact, so close that the decision takes many steps.
pub(in crate::method::rival) fn box_rotating_past_box() -> (TriangleMesh, TriangleMesh, Motions) {
    // Its upright edges are at a distance of 1 from its axis.
    let turning = box_mesh(DVec3::new(FRAC_1_SQRT_2, FRAC_1_SQRT_2, 0.5));
    let query = query(
        motion_from_unrotated_pose(DVec3::ZERO, DVec3::ZERO, 6.0 * DVec3::Z),
        resting_motion_at(1.51 * DVec3::X),
    );
    (turning, box_mesh(DVec3::splat(0.5)), query)
}
