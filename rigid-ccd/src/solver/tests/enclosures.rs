//! Tests that bounds of distances hold for the true shapes when bodies exceed these shapes.

use super::ballistic_trajectory;
use crate::{Body, Motion, Pose, Settings, Solver};
use ccd_core::ClearanceVerdict;
use ccd_core::Outcome;
use ccd_core::glam::DQuat;
use ccd_core::{Answer, SolidOfRevolution};

/// The radius of both cylinders.
const CYLINDER_RADIUS: f64 = 1.0;

/// The allowed excess of the polytope that encloses a cylinder; its polygons have some twenty corners.
const MAX_EXCESS: f64 = 0.01;

/// A test scene of two cylinders side by side, each rotated about its axis; the first moves past the second. The
/// surfaces of the true cylinders are never nearer than `least`.
struct CylinderScene {
    body: Body,
    /// The poses of the first cylinder at times 0 and 1, and that of the second.
    poses: [Pose; 3],
    least_distance: f64,
}

impl CylinderScene {
    /// Creates the scene; `number` determines the rotations of the cylinders and the distance of their axes.
    fn new(number: u32) -> Self {
        let round = SolidOfRevolution::cylinder(CYLINDER_RADIUS, 2.0).unwrap();
        let apart = 2.05 + 0.03 * f64::from(number % 9);
        let turned = |angle: f64, place: [f64; 3]| {
            let rotation = DQuat::from_rotation_z(angle);
            Pose::new(place, rotation).unwrap()
        };
        let angle = 0.037 * f64::from(number);
        CylinderScene {
            body: round
                .enclosing_polytope(MAX_EXCESS)
                .unwrap()
                .body()
                .unwrap(),
            poses: [
                turned(angle, [0.0, -1.0, 0.0]),
                turned(angle, [0.0, 1.0, 0.0]),
                turned(1.7 * angle + 0.1, [apart, 0.0, 0.5]),
            ],
            least_distance: apart - 2.0 * CYLINDER_RADIUS,
        }
    }

    /// Returns the motion of the first cylinder, which passes the second, and that of the second, which is at rest.
    fn motions(&self) -> [Motion; 2] {
        let passes = Motion::new(self.poses[0], [0.0, 2.0, 0.0], [0.0; 3]).unwrap();
        [passes, Motion::still(self.poses[2])]
    }

    /// Returns the least distance of the cylinders for motions, for an accelerated trajectory along the same line, and
    /// at rest where their axes are nearest.
    fn closest_approach_answers(&self, solver: &mut Solver) -> [Answer; 3] {
        let [passes, stands] = self.motions();
        let (a, b) = (&self.body, &self.body);
        let rotation = self.poses[0].rotation();
        let start = Pose::new([0.0, -1.0, 0.0], rotation).unwrap();
        let start = Motion::new(start, [0.0, 1.0, 0.0], [0.0; 3]).unwrap();
        let speeds_up = crate::trajectory::Ballistic::new(start, [0.0, 2.0, 0.0]).unwrap();
        let between = Pose::new([0.0; 3], rotation).unwrap();
        [
            solver.closest_approach((a, passes), (b, stands), 1.0),
            solver.closest_approach((a, &speeds_up), (b, &stands), 1.0),
            solver.distance((a, between), (b, self.poses[2])),
        ]
        .map(|answer| answer.expect("in range"))
    }
}

#[test]
fn bounds_hold_the_distance_of_cylinders() {
    let mut solver = Solver::new().with_settings(Settings {
        tolerance: 1e-6,
        ..Settings::DEFAULT
    });
    let mut false_of_bodies = 0;
    for number in 0..60 {
        let pair = CylinderScene::new(number);
        let excess = 2.0 * pair.body.excess();
        for answer in pair.closest_approach_answers(&mut solver) {
            let (lower, upper) = (answer.outcome.lower(), answer.outcome.upper());
            assert!(
                lower <= pair.least_distance + 1e-12 && pair.least_distance <= upper,
                "{number}: {answer:?}, not {}",
                pair.least_distance
            );
            assert!(upper - lower <= excess + 2e-6 && upper - lower <= answer.tolerance);
            false_of_bodies += u32::from(upper - excess < pair.least_distance - 1e-5);
        }
    }
    assert!(false_of_bodies > 100, "{false_of_bodies}");
}

#[test]
fn a_clearance_that_cylinders_keep_is_never_violated() {
    let mut between = 0;
    for number in 0..60 {
        let pair = CylinderScene::new(number);
        // The polygons may be nearest before or after the axes are.
        let bodies = pair.closest_approach_answers(&mut Solver::new())[0]
            .outcome
            .lower();
        let most = pair.least_distance + 2.0 * pair.body.excess();
        for (required, expected) in [
            (bodies - 1e-3, Some(ClearanceVerdict::Kept)),
            // The cylinders keep this clearance, but the bodies do not.
            (0.5 * (bodies + pair.least_distance), None),
            (pair.least_distance, None),
            (most + 1e-3, Some(ClearanceVerdict::Violated)),
        ] {
            let mut solver = Solver::new().with_settings(Settings {
                tolerance: 1e-5,
                clearance: Some(required),
                ..Settings::DEFAULT
            });
            for answer in pair.closest_approach_answers(&mut solver) {
                let found = answer.outcome.clearance_verdict(required);
                let is_right = match expected {
                    Some(expected) => found == expected,
                    None => found != ClearanceVerdict::Violated,
                };
                assert!(
                    is_right,
                    "{number}: {required} of {}: {answer:?}",
                    pair.least_distance
                );
                between += u32::from(found == ClearanceVerdict::Unverified);
                let upper = answer.outcome.upper();
                assert!(upper >= pair.least_distance, "{number}: {answer:?}");
                // The bounds for an unverified clearance differ by the excess.
                if found == ClearanceVerdict::Unverified {
                    let lower = answer.outcome.lower();
                    assert!(upper - lower <= answer.tolerance && lower <= required);
                    assert!(lower > 0.0 || required <= 2.0 * pair.body.excess());
                }
            }
        }
    }
    assert!(between > 200, "{between}");
}

/// Tests that for overlapping enclosures a clearance up to their excess is unverified, and a larger one is violated.
#[test]
fn overlapping_enclosures_violate_no_clearance_within_the_excess() {
    let pair = CylinderScene::new(0);
    let beside = Pose::at([2.0 * CYLINDER_RADIUS - 1e-3, 0.0, 0.0]).unwrap();
    for (required, expected) in [
        (0.0, ClearanceVerdict::Unverified),
        (pair.body.excess(), ClearanceVerdict::Unverified),
        (2.1 * pair.body.excess(), ClearanceVerdict::Violated),
    ] {
        let mut solver = Solver::new().with_settings(Settings {
            clearance: Some(required),
            ..Settings::DEFAULT
        });
        let (a, b) = (&pair.body, &pair.body);
        let still = solver.distance((a, beside), (b, Pose::IDENTITY)).unwrap();
        let leaves = Motion::new(beside, [1.0, 0.0, 0.0], [0.0; 3]).unwrap();
        let moving = solver.closest_approach((a, leaves), (b, Motion::STILL), 1.0);
        let thrown = ballistic_trajectory(
            [beside.translation().x, 0.0, 0.0],
            [1.0, 0.0, 0.0],
            [1.0; 3],
        );
        let along = solver.closest_approach((a, &thrown), (b, &Motion::STILL), 1.0);
        for answer in [still, moving.unwrap(), along.unwrap()] {
            let Outcome::Overlapping { upper, .. } = answer.outcome else {
                panic!("{answer:?}")
            };
            assert!(upper >= 2.0 * pair.body.excess() && upper == answer.outcome.upper());
            assert_eq!(
                answer.outcome.clearance_verdict(required),
                expected,
                "{required}"
            );
        }
    }
}

/// Tests that no clearance is reported as violated for a ball in a slot that is so far from the mesh, but not from its
/// hull, which fills the slot.
#[cfg(feature = "meshes")]
#[test]
fn approximate_hulls_violate_no_clearance_that_the_mesh_keeps() {
    use ccd_decomp::{Format, PieceChoice, StoredBodyContent, TriangleMesh, body_from_mesh};
    let mut block = String::new();
    let outline = [
        [-2, -2],
        [2, -2],
        [2, 2],
        [1, 2],
        [1, 1],
        [-1, 1],
        [-1, 2],
        [-2, 2],
    ];
    for y in [-2, 2] {
        for [x, z] in outline {
            block += &format!("v {x} {y} {z}\n");
        }
    }
    block += "f 1 2 3 4 5 6 7 8\nf 16 15 14 13 12 11 10 9\n";
    for k in 1..=8 {
        let next = k % 8 + 1;
        block += &format!("f {k} {} {} {next}\n", k + 8, next + 8);
    }
    let mesh = TriangleMesh::from_reader(Format::Obj, block.as_bytes()).unwrap();
    let prepared = body_from_mesh(&mesh, PieceChoice::OuterHull).unwrap();
    let body = &prepared.body;
    assert!(body.excess() == prepared.report.excess && body.excess() >= 1.0);
    let again = StoredBodyContent::from_body(body).unwrap().body().unwrap();
    assert_eq!(again.excess(), body.excess());
    let radius = 0.3;
    let ball = super::ball(radius);
    let edge = |height: f64| f64::hypot(1.0, height) - radius;
    // The ball is nearest to the floor in the slot, and to the edges above it.
    for (height, least) in [(1.5, 0.5 - radius), (2.5, edge(0.5)), (2.35, edge(0.35))] {
        let start = Pose::at([0.0, -1.0, height]).unwrap();
        let passes = Motion::new(start, [0.0, 2.0, 0.0], [0.0; 3]).unwrap();
        for (required, expected) in [
            (None, ClearanceVerdict::Unverified),
            (Some(0.99 * least), ClearanceVerdict::Unverified),
            (Some(3.0), ClearanceVerdict::Violated),
        ] {
            let mut solver = Solver::new().with_settings(Settings {
                clearance: required,
                ..Settings::DEFAULT
            });
            let found = solver.closest_approach((&ball, passes), (body, Motion::STILL), 1.0);
            let found = found.unwrap().outcome;
            assert!(
                found.lower() <= least && least <= found.upper(),
                "{found:?}, not {least}"
            );
            let compared = found.clearance_verdict(required.unwrap_or(0.99 * least));
            assert_eq!(compared, expected, "{required:?}: {found:?}");
        }
    }
}
