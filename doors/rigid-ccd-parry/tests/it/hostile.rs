//! Tests that hostile inputs cause no panic, no endless loop, no hit outside the interval and no unnamed error.

use ccd_core::order::greater;
use parry3d::math::{Pose, Rotation, Vector};
use parry3d::query::{NonlinearRigidMotion, ShapeCastStatus};
use parry3d::shape::{
    Ball, Compound, Cuboid, Cylinder, HeightField, Segment, Shape, SharedShape, TriMesh, Triangle,
};
use parry3d::utils::Array2;
use rigid_ccd_parry::CastError;
use rigid_ccd_parry::f32::{cast_shapes_nonlinear, try_cast_shapes_nonlinear};

fn motion_at_rest(x: f32) -> NonlinearRigidMotion {
    NonlinearRigidMotion::constant_position(Pose::translation(x, 0.0, 0.0))
}

fn linear_motion(x: f32, speed: f32) -> NonlinearRigidMotion {
    NonlinearRigidMotion {
        linvel: speed * Vector::X,
        ..motion_at_rest(x)
    }
}

fn impact_time(
    a: &dyn Shape,
    b: &dyn Shape,
    motions: [NonlinearRigidMotion; 2],
    end: f32,
) -> Option<f32> {
    let [m, n] = &motions;
    let hit = cast_shapes_nonlinear(m, a, n, b, 0.0, end, true).expect("served");
    hit.map(|hit| hit.time_of_impact)
}

#[test]
fn shapes_without_size_meet() {
    let point = Triangle::new(Vector::ZERO, Vector::ZERO, Vector::ZERO);
    let shapes: [SharedShape; 6] = [
        SharedShape::ball(0.0),
        SharedShape::cuboid(0.0, 0.0, 0.0),
        SharedShape::capsule(Vector::ZERO, Vector::ZERO, 0.0),
        SharedShape::new(Segment::new(Vector::ZERO, Vector::ZERO)),
        SharedShape::new(point),
        SharedShape::new(Cylinder::new(0.0, 0.0)),
    ];
    for a in &shapes {
        for b in &shapes {
            let found = impact_time(
                &**a,
                &**b,
                [linear_motion(-4.0, 2.0), motion_at_rest(0.0)],
                9.0,
            )
            .expect("they meet");
            assert!(found <= 2.0 && found > 1.999999, "{found}");
            let beside = motion_at_rest(0.0);
            let past = NonlinearRigidMotion {
                start: Pose::translation(-4.0, 0.001, 0.0),
                ..linear_motion(0.0, 2.0)
            };
            assert_eq!(impact_time(&**a, &**b, [past, beside], 9.0), None);
        }
    }
}

#[test]
fn tiny_bodies_are_not_in_contact_at_their_own_size() {
    for scale in [1e-6, 1e-12, 1e-20, 1e-30f32] {
        let (ball, cube) = (Ball::new(scale), Cuboid::new(Vector::splat(scale)));
        let found = impact_time(
            &ball,
            &cube,
            [linear_motion(-4.0 * scale, scale), motion_at_rest(0.0)],
            9.0,
        );
        let found = found.expect("they meet");
        assert!(found <= 2.0 && found > 1.99999, "{scale:e}: {found}");
        let past = linear_motion(-4.0 * scale, scale);
        let past = NonlinearRigidMotion {
            start: Pose::translation(-4.0 * scale, 2.01 * scale, 0.0),
            ..past
        };
        assert_eq!(
            impact_time(&ball, &cube, [past, motion_at_rest(0.0)], 9.0),
            None,
            "{scale:e}"
        );
    }
}

#[test]
fn large_scenes_and_far_origins_are_met_in_time() {
    // Every number is exact in single precision.
    for far in [0.0, 65536.0, 1e9, 68719476736.0f32] {
        let (ball, cube) = (Ball::new(1.0), Cuboid::new(Vector::splat(1.0)));
        let step = greater(far * 1e-6, 8.0).log2().ceil().exp2();
        let found = impact_time(
            &ball,
            &cube,
            [linear_motion(far - step, 1.0), motion_at_rest(far)],
            1e6,
        );
        let exact = step - 2.0;
        let found = found.expect("they meet");
        assert!(
            found <= exact && found > exact - 1e-3 - 1e-6 * step,
            "{far}: {found} {exact}"
        );
    }
    for size in [1e3, 1e6, 1e9f32] {
        let (ball, cube) = (Ball::new(size), Cuboid::new(Vector::splat(size)));
        let found = impact_time(
            &ball,
            &cube,
            [linear_motion(-4.0 * size, size), motion_at_rest(0.0)],
            9.0,
        )
        .expect("they meet");
        assert!(found <= 2.0 && found > 1.999999, "{size:e}: {found}");
    }
    let beyond = try_cast_shapes_nonlinear(
        &motion_at_rest(2e12),
        &Ball::new(1.0),
        &motion_at_rest(0.0),
        &Ball::new(1.0),
        [0.0, 1.0],
        true,
    );
    let error = beyond.expect_err("refused");
    assert!(
        matches!(error, CastError::Scene(_)) && error.to_string().contains("1e12"),
        "{error}"
    );
}

#[test]
fn speeds_beyond_all_scales_are_met() {
    let ball = Ball::new(1.0);
    for speed in [1e-30, 1e-3, 1e6, 1e15, 1e30, 3e38f32] {
        let found = impact_time(
            &ball,
            &ball,
            [linear_motion(-4.0, speed), motion_at_rest(0.0)],
            f32::INFINITY,
        );
        let (found, exact) = (found.expect("they meet"), 2.0 / f64::from(speed));
        let found = f64::from(found);
        assert!(
            found <= exact && found > exact * (1.0 - 1e-5) - 1e-45,
            "{speed:e}: {found:e}"
        );
        assert_eq!(
            impact_time(
                &ball,
                &ball,
                [linear_motion(-4.0, -speed), motion_at_rest(0.0)],
                f32::INFINITY
            ),
            None
        );
    }
    // Two bodies that fly along each other, at any speed.
    let along = [linear_motion(-4.0, 1e30), linear_motion(0.0, 1e30)];
    assert_eq!(impact_time(&ball, &ball, along, f32::INFINITY), None);
}

#[test]
fn spins_beyond_the_limit_end_as_a_limit() {
    let cube = Cuboid::new(Vector::splat(1.0));
    let spins = |rate: f32| NonlinearRigidMotion {
        angvel: rate * Vector::Z,
        ..linear_motion(-9.0, 1.0)
    };
    let cast = |shape: &dyn Shape, rate| {
        let hit = cast_shapes_nonlinear(
            &spins(rate),
            shape,
            &motion_at_rest(0.0),
            &cube,
            0.0,
            100.0,
            true,
        );
        hit.expect("served").expect("they meet")
    };
    let hit = cast(&cube, 1e8);
    assert_eq!(hit.status, ShapeCastStatus::OutOfIterations);
    assert!(hit.time_of_impact < 7.0);
    // A ball is the same for any angular velocity.
    for rate in [0.0, 1.0, 1e8, 3e38] {
        let hit = cast(&Ball::new(1.0), rate);
        assert_eq!(hit.status, ShapeCastStatus::Converged);
        assert!(hit.time_of_impact <= 7.0 && hit.time_of_impact > 6.99999);
        assert!((hit.witness1.length() - 1.0).abs() < 1e-5);
    }
}

#[test]
fn errors_name_what_is_wrong() {
    let ball = Ball::new(1.0);
    let told = |shape: &dyn Shape| {
        let found = try_cast_shapes_nonlinear(
            &motion_at_rest(0.0),
            &ball,
            &motion_at_rest(9.0),
            shape,
            [0.0, 1.0],
            true,
        );
        found.expect_err("refused").to_string()
    };
    assert_eq!(
        told(&Ball::new(f32::NAN)),
        "shape 2: its radius is NaN, but must be at least 0 and finite"
    );
    assert_eq!(
        told(&Ball::new(-1.0)),
        "shape 2: its radius is -1, but must be at least 0 and finite"
    );
    let mut vertices = vec![Vector::ZERO, Vector::X, Vector::Y, Vector::Z];
    vertices[3].y = f32::NAN;
    let mesh = TriMesh::new(vertices, vec![[0, 1, 2], [0, 1, 3]]).expect("a mesh");
    assert!(
        told(&mesh).starts_with("shape 2: sub-shape 1: point 2"),
        "{}",
        told(&mesh)
    );
    let mut heights = Array2::repeat(3, 3, 0.0);
    heights[(2, 2)] = f32::INFINITY;
    let field = HeightField::new(heights, Vector::splat(1.0));
    assert!(
        told(&field).starts_with("shape 2: sub-shape"),
        "{}",
        told(&field)
    );
    let parts = vec![
        (Pose::IDENTITY, SharedShape::ball(1.0)),
        (Pose::IDENTITY, SharedShape::ball(f32::INFINITY)),
    ];
    assert!(told(&Compound::new(parts)).starts_with("shape 2: part 1: its radius is inf"));
    let mut motion = motion_at_rest(0.0);
    motion.start.rotation = Rotation::from_xyzw(0.0, 0.0, 0.0, 0.0);
    let found = try_cast_shapes_nonlinear(
        &motion,
        &ball,
        &motion_at_rest(0.0),
        &ball,
        [0.0, 1.0],
        true,
    );
    let told = found.expect_err("refused").to_string();
    assert_eq!(
        told,
        "motion 1: a quaternion of length zero names no orientation"
    );
}

#[test]
fn a_speed_that_both_have_costs_no_digits() {
    // Two ships in orbit, one of which closes in slowly. All numbers are exact in single precision.
    let ball = Ball::new(1.0);
    let orbit = 8192.0 * Vector::new(1.0, -2.0, 3.0);
    let near = NonlinearRigidMotion {
        linvel: orbit + 0.125 * Vector::X,
        ..motion_at_rest(-10.0)
    };
    let ahead = NonlinearRigidMotion {
        linvel: orbit,
        ..motion_at_rest(0.0)
    };
    let found = impact_time(&ball, &ball, [near, ahead], f32::INFINITY).expect("they meet");
    assert!(found <= 64.0 && found > 64.0 - 2e-5, "{found}");
    assert_eq!(
        impact_time(
            &ball,
            &ball,
            [ahead, ahead.append_translation(3.0 * Vector::Y)],
            1e30
        ),
        None
    );
}

#[test]
fn a_body_slides_above_a_half_space_for_ever() {
    let (ball, ground) = (Ball::new(1.0), SharedShape::halfspace(Vector::Y));
    let slides = |height: f32, speed: f32, spin: f32| NonlinearRigidMotion {
        start: Pose::translation(0.0, height, 0.0),
        linvel: Vector::new(speed, 0.0, -0.3 * speed),
        angvel: spin * Vector::X,
        local_center: 0.25 * Vector::Z,
    };
    for speed in [0.0, 1.0, 1e6, 1e30] {
        for spin in [0.0, 1.0] {
            let found = impact_time(
                &ball,
                &*ground,
                [slides(1.5, speed, spin), motion_at_rest(0.0)],
                f32::MAX,
            );
            // At the highest speed a rotation leads farther than the plane is bounded.
            let known = speed < 1e30 || spin == 0.0;
            assert_eq!(found.is_none(), known, "{speed:e} {spin}");
        }
        let found = impact_time(
            &ball,
            &*ground,
            [slides(1.0, speed, 0.0), motion_at_rest(0.0)],
            f32::MAX,
        );
        assert_eq!(found, Some(0.0), "{speed:e}");
    }
    // The body rotates about a point beside its middle, and comes down by a quarter.
    let found = impact_time(
        &ball,
        &*ground,
        [slides(1.2, 1.0, 1.0), motion_at_rest(0.0)],
        f32::MAX,
    );
    assert!(
        found.is_some_and(|time| time > 0.1 && time < 6.3),
        "{found:?}"
    );
}
