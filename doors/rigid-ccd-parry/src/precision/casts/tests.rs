use super::super::library::shape::{Ball, Cuboid};
use super::*;

fn cast_ball_at_wall(radius: Real) -> Option<Real> {
    let start = Pose::translation(-3.0, 0.0, 0.0);
    let flies = NonlinearRigidMotion::new(start, Vector::ZERO, Vector::X, Vector::ZERO);
    let rests = NonlinearRigidMotion::identity();
    let (ball, wall) = (Ball::new(radius), Cuboid::new(Vector::splat(1.0)));
    let hit = cast_shapes_nonlinear(&flies, &ball, &rests, &wall, 0.0, 9.0, true);
    hit.expect("served").map(|hit| hit.time_of_impact)
}

/// A thread-local value that casts when its thread ends, after the thread's memory is dropped.
struct CastOnDrop;

impl Drop for CastOnDrop {
    fn drop(&mut self) {
        assert!(cast_ball_at_wall(1.0).is_some_and(|time| time <= 1.0));
    }
}

thread_local! {
    static CAST_ON_DROP: CastOnDrop = const { CastOnDrop };
}

#[test]
fn casts_work_when_a_thread_ends() {
    let thread = std::thread::spawn(|| {
        // Thread-local values are dropped in the reverse order of their creation.
        CAST_ON_DROP.with(|_| ());
        cast_ball_at_wall(0.5)
    });
    assert!(thread.join().expect("no panic").is_some());
}

#[test]
fn shapes_at_one_address_are_distinguished_by_their_numbers() {
    for k in 1..200 {
        // Every ball has the same address on the stack.
        let radius = 0.001 * k as Real;
        let time = cast_ball_at_wall(radius).expect("they meet");
        let exact = 2.0 - radius;
        assert!((time - exact).abs() < 1e-5, "{radius}: {time}");
    }
}

#[test]
fn errors_have_a_reason() {
    let (ball, bad) = (Ball::new(1.0), Ball::new(Real::NAN));
    let rests = NonlinearRigidMotion::identity();
    let told = try_cast_shapes_nonlinear(&rests, &ball, &rests, &bad, [0.0, 1.0], true);
    assert!(
        matches!(
            told,
            Err(CastError::Shape {
                shape_number: 2,
                ..
            })
        ),
        "{told:?}"
    );
    let silent = cast_shapes_nonlinear(&rests, &ball, &rests, &bad, 0.0, 1.0, true);
    assert!(matches!(silent, Err(Unsupported)));
}
