//! Tests the meaning of parry's arguments, as tabulated in the crate's documentation.

use parry3d::math::{Pose, Vector};
use parry3d::query::{NonlinearRigidMotion, ShapeCastOptions, ShapeCastStatus};
use parry3d::shape::{Ball, Cuboid, SharedShape, TriMesh, TriMeshFlags};
use rigid_ccd_parry::f32::{Caster, cast_shapes, cast_shapes_nonlinear, try_cast_shapes};
use rigid_ccd_parry::{CastError, Excess, Meshes, Options, ShapeError};

fn pose_at_x(x: f32) -> Pose {
    Pose::translation(x, 0.0, 0.0)
}

fn linear_motion(x: f32, speed: f32) -> NonlinearRigidMotion {
    NonlinearRigidMotion::new(pose_at_x(x), Vector::ZERO, speed * Vector::X, Vector::ZERO)
}

/// Casts a ball of radius 1 from `x` at a ball of radius 1 at the origin.
fn cast_ball(x: f32, speed: f32, options: ShapeCastOptions) -> Option<(f32, ShapeCastStatus)> {
    let ball = Ball::new(1.0);
    let hit = cast_shapes(
        &pose_at_x(x),
        speed * Vector::X,
        &ball,
        &pose_at_x(0.0),
        Vector::ZERO,
        &ball,
        options,
    );
    hit.expect("served")
        .map(|hit| (hit.time_of_impact, hit.status))
}

fn is_converged_just_before(found: Option<(f32, ShapeCastStatus)>, time: f32) -> bool {
    found.is_some_and(|(found, status)| {
        found <= time && found > time - 2e-6 && status == ShapeCastStatus::Converged
    })
}

#[test]
fn a_target_distance_is_kept() {
    let options = |target_distance| ShapeCastOptions {
        target_distance,
        ..ShapeCastOptions::default()
    };
    assert!(is_converged_just_before(
        cast_ball(-4.0, 1.0, options(0.0)),
        2.0
    ));
    assert!(is_converged_just_before(
        cast_ball(-4.0, 1.0, options(0.5)),
        1.5
    ));
    // Larger than both bodies.
    assert!(is_converged_just_before(
        cast_ball(-40.0, 8.0, options(30.0)),
        1.0
    ));
    let within = cast_ball(-4.0, 1.0, options(2.5)).expect("it is within");
    assert_eq!(
        within,
        (0.0, ShapeCastStatus::PenetratingOrWithinTargetDist)
    );
    // A negative distance is refused, as is NaN.
    let ball = Ball::new(1.0);
    for target in [-0.1, f32::NAN, f32::INFINITY] {
        let body = |x| (pose_at_x(x), Vector::X, &ball);
        let ((p, v, a), (q, w, b)) = (body(0.0), body(5.0));
        let error = try_cast_shapes((&p, v, a), (&q, w, b), options(target)).expect_err("refused");
        assert!(
            matches!(
                error,
                CastError::InvalidNumber {
                    what: "the target distance",
                    ..
                }
            ),
            "{error}"
        );
    }
}

#[test]
fn no_hit_is_after_the_end() {
    let until = ShapeCastOptions::with_max_time_of_impact;
    assert!(is_converged_just_before(
        cast_ball(-4.0, 1.0, until(2.1)),
        2.0
    ));
    assert_eq!(cast_ball(-4.0, 1.0, until(1.99)), None);
    for end in [f32::MAX, f32::INFINITY] {
        assert!(is_converged_just_before(
            cast_ball(-4.0, 1.0, until(end)),
            2.0
        ));
        assert_eq!(cast_ball(-4.0, -1.0, until(end)), None);
        assert_eq!(cast_ball(-4.0, 0.0, until(end)), None);
        assert_eq!(
            cast_ball(-4.0, 1e-44, until(end)).map(|_| ()),
            (end == f32::INFINITY).then_some(())
        );
    }
    // Such an interval contains no time.
    assert_eq!(cast_ball(0.0, 1.0, until(-1.0)), None);
    assert_eq!(cast_ball(0.0, 1.0, until(f32::NEG_INFINITY)), None);
}

#[test]
fn times_count_from_the_start_of_the_motion() {
    let ball = Ball::new(1.0);
    let cast = |from, to| {
        let hit = cast_shapes_nonlinear(
            &linear_motion(-4.0, 1.0),
            &ball,
            &linear_motion(0.0, 0.0),
            &ball,
            from,
            to,
            true,
        );
        hit.expect("served")
            .map(|hit| (hit.time_of_impact, hit.status))
    };
    assert!(is_converged_just_before(cast(0.0, 9.0), 2.0));
    assert!(is_converged_just_before(cast(1.0, 9.0), 2.0));
    assert!(is_converged_just_before(cast(-5.0, 9.0), 2.0));
    // They overlap from 2 to 6.
    assert_eq!(
        cast(3.0, 9.0),
        Some((3.0, ShapeCastStatus::PenetratingOrWithinTargetDist))
    );
    assert_eq!(cast(6.5, 9.0), None);
    assert_eq!(cast(0.0, 1.5), None);
    assert_eq!(cast(3.0, 2.0), None);
    assert!(is_converged_just_before(cast(0.0, f32::INFINITY), 2.0));
}

#[test]
fn times_that_are_no_numbers_are_refused() {
    let ball = Ball::new(1.0);
    for [from, to] in [
        [f32::NAN, 1.0],
        [0.0, f32::NAN],
        [f32::NEG_INFINITY, 1.0],
        [f32::INFINITY; 2],
    ] {
        let hit = cast_shapes_nonlinear(
            &linear_motion(-4.0, 1.0),
            &ball,
            &linear_motion(0.0, 0.0),
            &ball,
            from,
            to,
            true,
        );
        assert!(hit.is_err(), "{from} {to}");
    }
}

#[test]
fn touching_bodies_are_ignored_unless_they_approach() {
    let options = |stop_at_penetration| ShapeCastOptions {
        stop_at_penetration,
        ..ShapeCastOptions::default()
    };
    for (speed, found) in [(1.0, true), (0.0, false), (-1.0, false)] {
        // An approach is detected once it exceeds rounding.
        let touching = cast_ball(-2.0, speed, options(false));
        assert_eq!(
            touching.map(|(time, _)| time < 1e-9),
            found.then_some(true),
            "{speed}"
        );
        // The bodies are in contact, but do not overlap.
        assert_eq!(
            cast_ball(-2.0, speed, options(true)),
            Some((0.0, ShapeCastStatus::Converged))
        );
        let status = ShapeCastStatus::PenetratingOrWithinTargetDist;
        assert_eq!(cast_ball(-1.5, speed, options(true)), Some((0.0, status)));
    }
}

#[test]
fn a_limit_is_a_hit_at_a_time_that_is_safe() {
    let shapes = [
        SharedShape::cuboid(0.5, 0.4, 0.3),
        SharedShape::capsule_y(0.5, 0.2),
    ];
    let [rests, mut flies] = [linear_motion(0.0, 0.0), linear_motion(-3.0, 4.0)];
    flies.angvel = Vector::new(1.0, 7.0, 3.0);
    let cast = |budget| {
        let mut caster = Caster::new(Options {
            budget,
            ..Options::default()
        });
        let [a, b] = &shapes;
        let hit = caster.cast_shapes_nonlinear(&flies, a, &rests, b, 0.0, 1.0, true);
        hit.expect("served").expect("a hit")
    };
    let (whole, cut) = (cast(1 << 20), cast(0));
    assert_eq!(whole.status, ShapeCastStatus::Converged);
    assert_eq!(cut.status, ShapeCastStatus::OutOfIterations);
    assert!(cut.time_of_impact < whole.time_of_impact);
}

#[test]
fn a_motion_that_never_repeats_itself_ends_as_a_limit() {
    // Both bodies rotate, about axes that move apart: their distance is unknown for all later times.
    let cube = Cuboid::new(Vector::splat(0.3));
    let turns =
        |x: f32, spin| NonlinearRigidMotion::new(pose_at_x(x), Vector::ZERO, Vector::ZERO, spin);
    let (a, b) = (turns(0.0, Vector::X), turns(1.5, 1.7 * Vector::Y));
    let cast = |end| cast_shapes_nonlinear(&a, &cube, &b, &cube, 0.0, end, true).expect("served");
    assert!(cast(100.0).is_none());
    let hit = cast(f32::INFINITY).expect("a limit");
    assert_eq!(hit.status, ShapeCastStatus::OutOfIterations);
    assert!(hit.time_of_impact > 1e5, "{hit:?}");
    // A body that rotates alone repeats its poses.
    let hit = cast_shapes_nonlinear(
        &a,
        &cube,
        &linear_motion(1.5, 0.0),
        &cube,
        0.0,
        f32::MAX,
        true,
    );
    assert!(hit.expect("served").is_none());
}

/// Returns the first `faces` triangles of a box as a mesh, with outward normals.
fn mesh(flags: TriMeshFlags, faces: usize) -> SharedShape {
    let (vertices, mut indices) = Cuboid::new(Vector::splat(2.0)).to_trimesh();
    indices.truncate(faces);
    SharedShape::new(TriMesh::with_flags(vertices, indices, flags).expect("a mesh"))
}

#[test]
fn a_mesh_is_a_surface_unless_the_options_make_it_a_solid() {
    let ball = SharedShape::ball(0.5);
    let inside = |meshes, flags| {
        let mut caster = Caster::new(Options {
            meshes,
            ..Options::default()
        });
        let flies = linear_motion(0.0, 1.0);
        let hit = caster.cast_shapes_nonlinear(
            &flies,
            &ball,
            &linear_motion(0.0, 0.0),
            &mesh(flags, 12),
            0.0,
            9.0,
            true,
        );
        hit.expect("served")
            .map(|hit| (hit.time_of_impact, hit.status))
    };
    let oriented = TriMeshFlags::ORIENTED;
    for (meshes, flags) in [
        (Meshes::Surfaces, oriented),
        (Meshes::Surfaces, TriMeshFlags::empty()),
        (Meshes::SolidIfOriented, TriMeshFlags::empty()),
    ] {
        assert!(
            is_converged_just_before(inside(meshes, flags), 1.5),
            "{meshes:?} {flags:?}"
        );
    }
    let status = ShapeCastStatus::PenetratingOrWithinTargetDist;
    assert_eq!(
        inside(Meshes::SolidIfOriented, oriented),
        Some((0.0, status))
    );
    let mut caster = Caster::new(Options {
        meshes: Meshes::SolidIfOriented,
        ..Options::default()
    });
    let open = caster.body(&mesh(oriented, 11));
    assert!(matches!(open, Err(ShapeError::OpenMesh { .. })), "{open:?}");
}

#[test]
fn cylinders_are_early_by_at_most_the_excess() {
    let (wheel, wall) = (
        SharedShape::cylinder(0.2, 1.0),
        SharedShape::cuboid(0.1, 9.0, 9.0),
    );
    let turned = Vector::new(0.0, 0.3, 0.0);
    let flies = NonlinearRigidMotion::new(
        Pose::new(-5.0 * Vector::X, turned),
        Vector::ZERO,
        Vector::X,
        Vector::ZERO,
    );
    let cast = |excess| {
        let mut caster = Caster::new(Options {
            excess,
            ..Options::default()
        });
        let hit = caster.cast_shapes_nonlinear(
            &flies,
            &wheel,
            &linear_motion(0.0, 0.0),
            &wall,
            0.0,
            9.0,
            true,
        )?;
        Ok::<f32, CastError>(hit.expect("a hit").time_of_impact)
    };
    // It is a wheel about y, turned about y.
    let exact = 3.9;
    for excess in [0.1f32, 1e-2, 1e-3, 1e-5] {
        let time = cast(Excess::Length(f64::from(excess))).expect("served");
        assert!(
            time <= exact && time > exact - excess - 2e-6,
            "{time} of {excess}"
        );
    }
    let fine = cast(Excess::DefaultRadiusFraction).expect("served");
    assert!(fine <= exact && fine > exact - 1.0 / 4096.0 - 2e-6);
    let refused = cast(Excess::NotAllowed).expect_err("refused");
    let error = ShapeError::SolidOfRevolutionRefused;
    assert_eq!(
        refused,
        CastError::Shape {
            shape_number: 1,
            error
        }
    );
    let impossible = cast(Excess::Length(1e-12)).expect_err("refused");
    assert!(
        impossible.to_string().contains("too many corners"),
        "{impossible}"
    );
}
