use super::super::library::math::Vector;
use super::super::library::query::NonlinearRigidMotion;
use super::super::library::shape::SharedShape;
use super::*;

fn cast_finds_hit(caster: &mut Caster, a: &SharedShape, b: &SharedShape) -> bool {
    let start = Pose::translation(-3.0, 0.0, 0.0);
    let flies = NonlinearRigidMotion::new(start, Vector::ZERO, Vector::X, Vector::ZERO);
    let rests = NonlinearRigidMotion::identity();
    let hit = caster.cast_shapes_nonlinear(&flies, a, &rests, b, 0.0, 1.5, true);
    hit.expect("served").is_some()
}

#[test]
fn bodies_are_kept_by_their_shape() {
    let mut caster = Caster::default();
    let (ball, wall) = (SharedShape::ball(1.0), SharedShape::cuboid(1.0, 1.0, 1.0));
    for _ in 0..3 {
        assert!(cast_finds_hit(&mut caster, &ball, &wall));
        assert!(cast_finds_hit(&mut caster, &ball.clone(), &wall));
    }
    assert_eq!(caster.cached_body_count(), 2);
    let kept = caster.body(&wall).expect("served");
    assert!(Arc::ptr_eq(&kept, &caster.body(&wall).expect("served")));
}

#[test]
fn a_shape_that_is_changed_is_another_one() {
    let mut caster = Caster::default();
    let (mut ball, wall) = (SharedShape::ball(1.0), SharedShape::cuboid(1.0, 1.0, 1.0));
    assert!(cast_finds_hit(&mut caster, &ball, &wall));
    // The caster holds the ball, so that this makes a copy.
    ball.make_mut().as_ball_mut().expect("a ball").radius = 0.1;
    assert!(!cast_finds_hit(&mut caster, &ball, &wall));
}

#[test]
fn a_new_shape_is_never_taken_for_one_that_is_gone() {
    let mut caster = Caster::default();
    let wall = SharedShape::cuboid(1.0, 1.0, 1.0);
    // Freed memory is reused at once: addresses would repeat if the caster did not hold the shapes.
    for k in 0..500 {
        let near = k % 2 == 0;
        let ball = SharedShape::ball(if near { 1.0 } else { 0.1 });
        assert_eq!(cast_finds_hit(&mut caster, &ball, &wall), near, "{k}");
    }
    assert!(
        caster.cached_body_count() < 200,
        "{}",
        caster.cached_body_count()
    );
    caster.remove_unused_bodies();
    assert_eq!(caster.cached_body_count(), 1);
}

#[test]
fn half_spaces_have_no_body() {
    let mut caster = Caster::default();
    let (ground, ball) = (SharedShape::halfspace(Vector::X), SharedShape::ball(1.0));
    assert!(cast_finds_hit(&mut caster, &ball, &ground));
    assert_eq!(caster.body(&ground).err(), Some(ShapeError::HalfSpace));
}
