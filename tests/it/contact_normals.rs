//! Tests that the normal of a contact is in the normal cones of both surfaces, even if the bodies have no gap.

use ccd_core::glam::{DQuat, DVec3};
use ccd_core::{Motion, Outcome, Pose, Separation, Settings};
use ccd_tests::backends::{Backend, for_each_setup};
use ccd_tests::models::{Mesh, Shape, cuboid, dented_cube, l_prism};
use ccd_tests::query::{MovingShape, Query};
use ccd_tests::referee::nearest_on_triangle;
use ccd_tests::strategies::{random_direction, runner};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use std::f64::consts::TAU;

/// The allowed angle between a contact's normal and the normal cone, in radians, for coordinates near 1 and faces of at
/// least 0.3.
const MAX_ANGLE_FROM_CONE: f64 = 1e-12;

/// The rounding error of the direction between two points, multiplied by their distance.
const DIRECTION_ERROR_TIMES_DISTANCE: f64 = 4e-15;

/// The distance between witnesses above which the direction between them is accurate enough for a normal.
const MIN_WITNESS_DISTANCE: f64 = 1e-8;

const TESTED_GAPS: [f64; 9] = [0.0, 1e-12, 1e-11, 1e-10, 1e-9, 1e-8, 1e-6, 1e-5, 1e-3];

#[test]
fn normals_are_in_the_cones_of_both_surfaces() {
    let rng = &mut Pcg64::seed_from_u64(45);
    let (mut checked, mut blurred) = ([0; 3], 0);
    for round in 0..runner(150).config().cases {
        let touch = FeatureContactCase::draw(rng);
        for bodies in touch.query.bodies_of_kind_pairs() {
            let settings = touch.config();
            let problem = touch.query.problem(&bodies, &settings);
            let pairs = problem.contacts_at(0.0).unwrap();
            assert!(!pairs.is_empty(), "{round} {:?}", bodies.piece_kinds);
            for pair in &pairs {
                if let Some(way) = touch.check(&pair.separation) {
                    checked[touch.larger_feature_dimension] += 1;
                    blurred += usize::from(way < MIN_WITNESS_DISTANCE);
                }
            }
            touch.check_answer(Backend::DEFAULT.solve(&problem).outcome);
        }
    }
    assert!(
        checked.iter().all(|&count| count > 100) && blurred > 1000,
        "{checked:?} {blurred}"
    );
}

/// Tests that the normals of all backends are in the normal cones of both surfaces, whatever axis the oracle claims.
#[test]
fn answers_of_all_backends_have_a_common_normal() {
    let rng = &mut Pcg64::seed_from_u64(46);
    for _ in 0..runner(25).config().cases {
        let touch = FeatureContactCase::draw(rng);
        for_each_setup(&touch.query, &touch.config(), |_, _, answer| {
            touch.check_answer(answer.outcome);
        });
    }
}

/// Two bodies a small gap apart along a direction that is in the normal cone of a feature of each body.
struct FeatureContactCase {
    query: Query,
    gap: f64,
    /// The larger dimension of both features: 0 for a vertex, 1 for an edge, 2 for a face.
    larger_feature_dimension: usize,
}

impl FeatureContactCase {
    fn draw(rng: &mut Pcg64) -> Self {
        let shape_b = random_shape(rng);
        let same = rng.random_bool(0.4);
        let shape_a = if same {
            shape_b.clone()
        } else {
            random_shape(rng)
        };
        let [a, b] = [&shape_a, &shape_b].map(|shape| SupportFeature::draw(rng, shape));
        let gap = TESTED_GAPS[rng.random_range(0..TESTED_GAPS.len())];
        let frame = if rng.random_bool(0.3) {
            Pose::IDENTITY
        } else {
            Pose::new(random_direction(rng), random_rotation(rng)).unwrap()
        };
        // A's support touches B's from the other side; its edge is parallel to B's, or arbitrary.
        let aligned = b.rotation_to_frame() * a.rotation_to_frame().conjugate();
        let facing = DQuat::from_axis_angle(b.edge_direction, TAU / 2.0) * aligned;
        let twist = match rng.random_range(0..3) {
            0 => rng.random_range(0.0..TAU),
            quarters => TAU / 4.0 * f64::from(quarters),
        };
        let turn = (DQuat::from_axis_angle(b.normal, twist) * facing).normalize();
        let place = b.point + gap * b.normal - turn * a.point;
        let start = pose_from_frame(&frame, turn, place);
        let still = |shape, pose| MovingShape {
            shape,
            motion: Motion::still(pose),
        };
        FeatureContactCase {
            query: Query::new(still(shape_a, start), still(shape_b, frame)),
            gap,
            larger_feature_dimension: a.dimension.max(b.dimension),
        }
    }

    fn config(&self) -> Settings {
        Settings {
            tolerance: 2e-3,
            ..Settings::DEFAULT
        }
    }

    fn check_answer(&self, outcome: Outcome) {
        let Outcome::Touching { contact } = outcome else {
            panic!("{outcome:?} at {}", self.gap);
        };
        // Any of the pieces that are nearest, up to a fraction of their distance, is a right answer.
        let way = self.check(&contact.separation);
        assert!(
            way.is_some() || self.gap > 1e-9,
            "{contact:?} at {}",
            self.gap
        );
    }

    /// Checks the normal of two nearest points, and returns their distance; `None` for points that are not the nearest.
    /// Features that are farther apart have a normal of their own.
    fn check(&self, separation: &Separation) -> Option<f64> {
        let Separation {
            normal,
            witness_a,
            witness_b,
            ..
        } = *separation;
        let way = witness_a.distance(witness_b);
        if way > self.gap + 1e-13 {
            return None;
        }
        let allowed = if way < MIN_WITNESS_DISTANCE {
            MAX_ANGLE_FROM_CONE
        } else {
            MAX_ANGLE_FROM_CONE + DIRECTION_ERROR_TIMES_DISTANCE / way
        };
        let off_a = sine_from_normal_cone(&self.query.a, witness_a, normal);
        let off_b = sine_from_normal_cone(&self.query.b, witness_b, -normal);
        assert!(
            off_a <= allowed && off_b <= allowed,
            "{off_a:e} {off_b:e} at {:e}: {separation:?}\n{:?}\n{:?}",
            self.gap,
            self.query.a,
            self.query.b
        );
        Some(way)
    }
}

/// Returns the sine of the angle by which a direction is outside the normal cone of a surface at a point; 0 within the
/// cone.
fn sine_from_normal_cone(actor: &MovingShape, at: DVec3, n: DVec3) -> f64 {
    let mesh = &actor.shape.mesh;
    let pose = actor.motion.start();
    let placed = |p: DVec3| pose.transform_point(p);
    let off = |p: DVec3| {
        let way = p - at;
        // A corner at the point itself has no direction.
        if way.length() > 1e-4 {
            n.dot(way) / way.length()
        } else {
            0.0
        }
    };
    let largest =
        |ways: &mut dyn Iterator<Item = DVec3>| ways.map(off).fold(0.0, ccd_core::order::greater);
    if actor.shape.is_convex() {
        return largest(&mut mesh.vertices.iter().map(|&p| placed(p)));
    }
    let triangles = (0..mesh.faces.len()).map(|face| mesh.triangle(face).map(placed));
    let around =
        triangles.filter(|&triangle| nearest_on_triangle(at, triangle).distance(at) < 1e-9);
    // The solid is below the middle of each face.
    let ends = around.flat_map(|[a, b, c]| {
        let inward = -(b - a).cross(c - a).normalize();
        [a, b, c, (a + b + c) / 3.0 + 1e-3 * inward]
    });
    largest(&mut ends.collect::<Vec<_>>().into_iter())
}

/// A random feature of a shape that is extreme along a direction, with a point on it.
struct SupportFeature {
    normal: DVec3,
    point: DVec3,
    /// A direction perpendicular to the normal, along an edge of the feature if there is one.
    edge_direction: DVec3,
    dimension: usize,
}

impl SupportFeature {
    fn draw(rng: &mut Pcg64, shape: &Shape) -> Self {
        let mesh = &shape.mesh;
        let normal = |face: usize| {
            let [a, b, c] = mesh.triangle(face);
            (b - a).cross(c - a).normalize()
        };
        let supports = |n: DVec3, p: DVec3| mesh.vertices.iter().all(|x| n.dot(x - p) < 1e-12);
        let outer: Vec<usize> = (0..mesh.faces.len())
            .filter(|&k| supports(normal(k), mesh.triangle(k)[0]))
            .collect();
        let face = outer[rng.random_range(0..outer.len())];
        let [a, b, c] = mesh.triangle(face);
        let fraction = [0.0, 1.0, 0.5, rng.random_range(0.1..0.9)][rng.random_range(0..4)];
        let on_edge = a + fraction * (b - a);
        let size = rng.random_range(0..3);
        let [normal, point] = match size {
            0 => {
                let n = random_direction(rng);
                let higher = |p: &&DVec3, q: &&DVec3| n.dot(**p).total_cmp(&n.dot(**q));
                [n, *mesh.vertices.iter().max_by(higher).unwrap()]
            }
            1 => {
                // The direction is between the edge's two faces, or across the face if that one is flush.
                let at = |v: &DVec3| *v == a || *v == b;
                let holds = |k: &&usize| mesh.triangle(**k).iter().filter(|v| at(v)).count() == 2;
                let sides: Vec<DVec3> = outer.iter().filter(holds).map(|&k| normal(k)).collect();
                let s = rng.random_range(0.2..0.8);
                let (one, other) = (sides[0], sides[sides.len() - 1]);
                [(s * one + (1.0 - s) * other).normalize(), on_edge]
            }
            _ => {
                let inner = on_edge + rng.random_range(0.1..0.9) * (c - on_edge);
                [
                    normal(face),
                    if rng.random_bool(0.5) { on_edge } else { inner },
                ]
            }
        };
        let along = match size {
            0 => normal.any_orthonormal_vector(),
            _ => (b - a).reject_from(normal).normalize(),
        };
        SupportFeature {
            normal,
            point,
            edge_direction: along,
            dimension: size,
        }
    }

    /// Returns the rotation that takes x to the edge direction and z to the normal.
    fn rotation_to_frame(&self) -> DQuat {
        let aside = self.normal.cross(self.edge_direction);
        DQuat::from_mat3(&ccd_core::glam::DMat3::from_cols(
            self.edge_direction,
            aside,
            self.normal,
        ))
    }
}

/// Returns a random box, cube, skewed box, or non-convex shape.
fn random_shape(rng: &mut Pcg64) -> Shape {
    let mut half = || rng.random_range(0.3..1.0);
    let half = DVec3::new(half(), half(), half());
    match rng.random_range(0..5) {
        0 => cuboid(DVec3::splat(0.5)),
        1 => cuboid(half),
        2 => {
            let Mesh { vertices, faces } = cuboid(half).mesh;
            let lean = 0.5 * random_direction(rng);
            let vertices = vertices
                .into_iter()
                .map(|p| p + p.z * lean.with_z(0.0))
                .collect();
            Shape::from_convex_mesh(Mesh { vertices, faces })
        }
        3 => l_prism(),
        _ => dented_cube(0.5, 0.2),
    }
}

fn pose_from_frame(frame: &Pose, turn: DQuat, place: DVec3) -> Pose {
    let rotation = (frame.rotation() * turn).normalize();
    Pose::new(frame.transform_point(place), rotation).unwrap()
}

fn random_rotation(rng: &mut Pcg64) -> DQuat {
    DQuat::from_axis_angle(random_direction(rng), rng.random_range(0.0..TAU))
}
