//! Tests that the engine's motions equal parry's.

use crate::scenes::{MotionSpec, number, random_motions, random_vector, seeded_rng};
use crate::{double, single};
use ccd_core::order::greater;
use rigid_ccd::{Motion, glam::DVec3};

/// Returns the largest error that `error` measures over random motions, times and points.
fn largest_error_over_motions(
    rounds: u64,
    error: impl Fn(&MotionSpec, f32, [f32; 3]) -> f64,
) -> f64 {
    let mut rng = seeded_rng(1);
    let mut worst = 0.0;
    for _ in 0..rounds {
        let [moves, _] = random_motions(&mut rng);
        let (time, point) = (number(&mut rng, -2.0, 5.0), random_vector(&mut rng, 2.0));
        worst = greater(worst, error(&moves, time, point));
    }
    worst
}

fn distance(motion: &Motion, time: f64, point: [f32; 3], theirs: [f64; 3]) -> f64 {
    let point = DVec3::from_array(point.map(f64::from));
    let ours = motion.pose(time).transform_point(point);
    ours.distance(DVec3::from_array(theirs))
}

#[test]
fn poses_are_those_of_position_at_time() {
    let worst = largest_error_over_motions(2000, |moves, time, point| {
        let theirs = double::make::motion(moves);
        let motion = rigid_ccd_parry::f64::motion(&theirs).expect("finite");
        let at = theirs.position_at_time(f64::from(time)) * double::make::vector(point);
        distance(&motion, f64::from(time), point, at.to_array())
    });
    assert!(worst < 1e-13, "{worst:e}");
}

#[test]
fn poses_are_those_of_single_precision_up_to_its_rounding() {
    let worst = largest_error_over_motions(2000, |moves, time, point| {
        let theirs = single::make::motion(moves);
        let motion = rigid_ccd_parry::f32::motion(&theirs).expect("finite");
        let at = theirs.position_at_time(time) * single::make::vector(point);
        distance(
            &motion,
            f64::from(time),
            point,
            at.to_array().map(f64::from),
        )
    });
    // Rotations of up to 60 radians, of bodies of size 2, after displacements of up to 30.
    assert!(worst < 5e-5 && worst > 1e-9, "{worst:e}");
}

#[test]
fn velocities_are_those_of_the_center() {
    // A half turn about a moving center beside the body: the body's origin ends beyond it.
    use parry3d::math::{Pose, Vector};
    let start = Pose::translation(1.0, 0.0, 0.0);
    let spin = std::f32::consts::PI * Vector::Z;
    let theirs = parry3d::query::NonlinearRigidMotion::new(start, Vector::X, 3.0 * Vector::Y, spin);
    let motion = rigid_ccd_parry::f32::motion(&theirs).expect("finite");
    let end = motion.pose(1.0).translation();
    assert!(end.distance(DVec3::new(3.0, 3.0, 0.0)) < 1e-6, "{end}");
    assert_eq!(motion.center(), DVec3::X);
}
