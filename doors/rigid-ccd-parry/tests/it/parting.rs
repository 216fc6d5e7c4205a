//! Tests that the overlap of bodies at the start is ignored while they part.

use crate::double::library::math::{Pose, Vector};
use crate::double::library::query::{
    self, NonlinearRigidMotion, ShapeCastOptions, ShapeCastStatus,
};
use crate::double::library::shape::{Ball, Cuboid, HalfSpace, HeightField, Shape, SharedShape};
use crate::double::library::utils::Array2;
use crate::double::make;
use crate::scenes::{random_motions, random_shape, random_vector, seeded_rng};
use rigid_ccd_parry::f64::{cast_shapes, cast_shapes_nonlinear};

fn options() -> ShapeCastOptions {
    ShapeCastOptions {
        max_time_of_impact: 5.0,
        stop_at_penetration: false,
        ..ShapeCastOptions::default()
    }
}

fn pose_at(x: f64, y: f64, z: f64) -> Pose {
    Pose::translation(x, y, z)
}

/// Casts a shape from a pose at a shape that rests at the origin.
fn cast_at_resting_shape(
    a: &dyn Shape,
    from: Pose,
    velocity: Vector,
    b: &dyn Shape,
) -> Option<(f64, ShapeCastStatus)> {
    let hit = cast_shapes(
        &from,
        velocity,
        a,
        &Pose::IDENTITY,
        Vector::ZERO,
        b,
        options(),
    );
    hit.expect("served")
        .map(|hit| (hit.time_of_impact, hit.status))
}

const PENETRATING_STATUS: ShapeCastStatus = ShapeCastStatus::PenetratingOrWithinTargetDist;

#[test]
fn parting_convex_shapes_are_ignored_as_in_parry() {
    let (mut gone, mut kept, mut others) = (0, 0, 0);
    for seed in 0..500 {
        let mut rng = seeded_rng(seed);
        let kinds = [
            [0, 1, 2, 3, 8][seed as usize % 5],
            [0, 1, 2, 3, 8][seed as usize / 5 % 5],
        ];
        let [a, b] = kinds.map(|kind| make::shape(&random_shape(&mut rng, kind)));
        let [moves, beside] = random_motions(&mut rng);
        let near = random_vector(&mut rng, 0.3);
        let [p, q] = [
            make::pose(near, moves.turned),
            make::pose([0.0; 3], beside.turned),
        ];
        let velocity = make::vector(moves.velocity);
        if query::distance(&p, &*a, &q, &*b)
            .expect("supported")
            .distance
            > 0.0
        {
            continue;
        }
        let theirs = query::cast_shapes(&p, velocity, &*a, &q, Vector::ZERO, &*b, options())
            .expect("supported");
        let ours =
            cast_shapes(&p, velocity, &*a, &q, Vector::ZERO, &*b, options()).expect("served");
        match (
            ours.map(|hit| (hit.time_of_impact, hit.status)),
            theirs.is_some(),
        ) {
            (None, false) => gone += 1,
            (Some(found), true) => {
                assert_eq!(found, (0.0, PENETRATING_STATUS));
                kept += 1;
            }
            // Two directions have nearly the same depth.
            _ => others += 1,
        }
    }
    assert!(
        gone > 50 && kept > 50 && others < 10,
        "{gone} {kept} {others}"
    );
}

#[test]
fn a_body_slides_on_a_floor_that_it_is_in() {
    let ball = Ball::new(0.5);
    let floors = [
        SharedShape::cuboid(9.0, 1.0, 9.0),
        SharedShape::new(HalfSpace::new(Vector::Y)),
    ];
    for (floor, top) in floors.iter().zip([1.0, 0.0]) {
        let within = pose_at(-2.0, top + 0.49, 0.1);
        let slide = Vector::new(1.0, 0.0, 0.3);
        assert_eq!(cast_at_resting_shape(&ball, within, slide, &**floor), None);
        assert_eq!(
            cast_at_resting_shape(&ball, within, slide + 0.01 * Vector::Y, &**floor),
            None
        );
        assert_eq!(
            cast_at_resting_shape(&ball, within, Vector::Y, &**floor),
            None
        );
        assert_eq!(
            cast_at_resting_shape(&ball, within, slide - 0.01 * Vector::Y, &**floor),
            Some((0.0, PENETRATING_STATUS))
        );
    }
}

#[test]
fn a_body_that_parts_from_flat_triangles_is_ignored_as_in_parry() {
    let (ball, flat) = (Ball::new(0.5), Array2::repeat(20, 20, 0.0));
    let floor = HeightField::new(flat, Vector::new(18.0, 1.0, 18.0));
    let (mut gone, mut kept) = (0, 0);
    for seed in 0..200 {
        let mut rng = seeded_rng(seed);
        let [x, _, z] = random_vector(&mut rng, 2.0).map(f64::from);
        let [vx, vy, vz] = random_vector(&mut rng, 1.0).map(f64::from);
        // The body moves upwards: off the plane, and into the edges of triangles within the plane.
        let (from, velocity) = (pose_at(x, 0.45, z), Vector::new(vx, vy.abs(), vz));
        let theirs = query::cast_shapes(
            &from,
            velocity,
            &ball,
            &Pose::IDENTITY,
            Vector::ZERO,
            &floor,
            options(),
        );
        let theirs = theirs.expect("supported").map(|hit| hit.time_of_impact);
        let ours = cast_at_resting_shape(&ball, from, velocity, &floor).map(|(time, _)| time);
        match (ours, theirs) {
            (None, None) => gone += 1,
            (Some(ours), Some(theirs)) => {
                kept += 1;
                assert!((ours - theirs).abs() < 1e-4, "seed {seed}: {ours} {theirs}");
            }
            other => panic!("seed {seed}: {other:?}"),
        }
    }
    assert!(gone > 50 && kept > 20, "{gone} {kept}");
}

#[test]
fn a_body_that_leaves_one_part_hits_the_next() {
    // The body leaves one box of a compound, and flies at the next one.
    let boxes = [0.0, 4.0, 8.0].map(|x| (pose_at(x, 0.0, 0.0), SharedShape::cuboid(0.5, 3.0, 3.0)));
    let walls = SharedShape::compound(boxes.to_vec());
    let ball = Ball::new(0.5);
    let (time, status) = cast_at_resting_shape(&ball, pose_at(0.8, 0.0, 0.0), Vector::X, &*walls)
        .expect("the next one");
    assert_eq!(status, ShapeCastStatus::Converged);
    assert!(time <= 2.2 && time > 2.2 - 1e-6, "{time}");
    assert_eq!(
        cast_at_resting_shape(&ball, pose_at(-0.8, 0.0, 0.0), -Vector::X, &*walls),
        None
    );
    assert_eq!(
        cast_at_resting_shape(&ball, pose_at(-0.8, 0.0, 0.0), Vector::X, &*walls),
        Some((0.0, PENETRATING_STATUS))
    );
    let hit = cast_shapes(
        &pose_at(0.8, 0.0, 0.0),
        Vector::X,
        &ball,
        &Pose::IDENTITY,
        Vector::ZERO,
        &*walls,
        options(),
    );
    assert_eq!(hit.expect("served").expect("the next one").subshape2, 1);
    // The roles are swapped.
    let (still, flies) = (Vector::ZERO, Vector::X);
    let hit = cast_shapes(
        &Pose::IDENTITY,
        still,
        &*walls,
        &pose_at(0.8, 0.0, 0.0),
        flies,
        &ball,
        options(),
    );
    assert_eq!(hit.expect("served").expect("the next one").subshape1, 1);
}

#[test]
fn bodies_that_turn_are_in_contact_where_they_overlap() {
    let cube = Cuboid::new(Vector::splat(0.5));
    let leaves =
        |spin| NonlinearRigidMotion::new(pose_at(0.9, 0.0, 0.0), Vector::ZERO, Vector::X, spin);
    let rests = NonlinearRigidMotion::identity();
    let cast = |spin: Vector, stop| {
        let hit = cast_shapes_nonlinear(&leaves(spin), &cube, &rests, &cube, 0.0, 5.0, stop);
        hit.expect("served")
            .map(|hit| (hit.time_of_impact, hit.status))
    };
    assert_eq!(cast(Vector::ZERO, true), Some((0.0, PENETRATING_STATUS)));
    assert_eq!(cast(Vector::ZERO, false), None);
    assert_eq!(cast(Vector::Y, false), Some((0.0, PENETRATING_STATUS)));
}

#[test]
fn inside_a_mesh_that_is_a_solid_nothing_parts() {
    use crate::double::library::shape::{TriMesh, TriMeshFlags};
    use rigid_ccd_parry::f64::Caster;
    use rigid_ccd_parry::{Meshes, Options};
    let (vertices, indices) = Cuboid::new(Vector::splat(2.0)).to_trimesh();
    let mesh = TriMesh::with_flags(vertices, indices, TriMeshFlags::ORIENTED).expect("a mesh");
    let (mesh, ball) = (SharedShape::new(mesh), SharedShape::ball(0.5));
    let cast = |meshes, x: f64| {
        let mut caster = Caster::new(Options {
            meshes,
            ..Options::default()
        });
        let rests = (Pose::IDENTITY, Vector::ZERO);
        let hit = caster.cast_shapes(
            &pose_at(x, 0.1, 0.2),
            -Vector::X,
            &ball,
            &rests.0,
            rests.1,
            &mesh,
            options(),
        );
        hit.expect("served").map(|hit| hit.time_of_impact)
    };
    // The body passes the wall from inside, from outside, and from its middle.
    for (x, surface) in [(1.8, Some(3.3)), (2.2, Some(0.0)), (0.0, Some(1.5))] {
        let found = cast(Meshes::Surfaces, x);
        let near = found
            .zip(surface)
            .is_some_and(|(time, exact)| (time - exact).abs() < 1e-6);
        assert!(near, "{x}: {found:?}");
        assert_eq!(cast(Meshes::SolidIfOriented, x), Some(0.0), "{x}");
    }
}
