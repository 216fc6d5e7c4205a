//! Scenes of one or two bodies that rotate about a fixed axis.

use super::{ExpectedOutcome, Scene};
use crate::models::{cuboid, frame_plate, mace, post, rod, wall_at};
use crate::query::MovingShape;
use ccd_core::glam::{DQuat, DVec3};
use ccd_core::{Motion, Pose};
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

/// The half length of a rod, in units of length.
const ROD_HALF_LENGTH: f64 = 2.0;
const ROD_HALF_WIDTH: f64 = 0.05;

fn rod_corner_radius() -> f64 {
    ROD_HALF_LENGTH.hypot(ROD_HALF_WIDTH)
}

pub(super) fn scenes() -> Vec<Scene> {
    let mut out = vec![
        rod_on_slab(),
        rod_on_post(),
        swinging_mace(),
        peg_in_hole(),
        mirrored_rods(),
    ];
    out.extend([1.0, 1.9, 2.0, 7.5].map(|turns| upright_rod_scene("T4", turns, 1.25)));
    out.push(pre_rotated_rod());
    for depth in [1e-3, 1e-6] {
        out.push(upright_rod_scene(
            "T5",
            1.0,
            rod_corner_radius() * (1.0 - depth),
        ));
        out.push(grazing_miss(depth));
    }
    out.extend([10, 17, 23].map(|power| far_rod(f64::from(1u32 << power))));
    out.extend([1e-6, 1e6].map(scaled_rod));
    out.push(rigidly_turning_pair());
    out
}

/// Returns the time at which a corner of a rod, rotating at `speed`, is first at the distance `height` from the plane
/// through the axis.
fn corner_arrival_time(height: f64, speed: f64) -> f64 {
    ((height / rod_corner_radius()).asin() - ROD_HALF_WIDTH.atan2(ROD_HALF_LENGTH)) / speed
}

/// Returns T2: a rod that rotates until its end comes down on a slab.
fn rod_on_slab() -> Scene {
    let height = 1.2;
    let spinning = MovingShape::rotating_shape(
        rod(ROD_HALF_LENGTH, ROD_HALF_WIDTH),
        height * DVec3::Z,
        PI * DVec3::Y,
    );
    let slab = MovingShape::still(cuboid(DVec3::new(4.0, 4.0, 0.5)), -0.5 * DVec3::Z);
    Scene::new(
        "T2 rod on slab",
        [spinning, slab],
        ExpectedOutcome::exact_hit(move |g| corner_arrival_time(height - g, PI)),
    )
}

/// Returns T4: an upright rod that rotates by some half turns towards a wall.
fn upright_rod_scene(name: &str, half_turns: f64, wall: f64) -> Scene {
    let speed = half_turns * PI;
    Scene::new(
        format!("{name} rod by {half_turns} half turns, wall at {wall:.7}"),
        upright_rod_and_wall(speed, wall, Pose::IDENTITY),
        ExpectedOutcome::exact_hit(move |g| corner_arrival_time(wall - g, speed)),
    )
}

fn upright_rod_and_wall(speed: f64, wall: f64, pose: Pose) -> [MovingShape; 2] {
    let shape = cuboid(DVec3::new(ROD_HALF_WIDTH, 0.3, ROD_HALF_LENGTH));
    let motion = Motion::new(pose, DVec3::ZERO, pose.rotation() * (speed * DVec3::Y));
    let still = Motion::still(pose);
    [
        MovingShape {
            shape,
            motion: motion.expect("finite"),
        },
        MovingShape {
            shape: wall_at(wall),
            motion: still,
        },
    ]
}

/// Returns T3: T4 with a rod whose body frame is rotated against the world at the start.
fn pre_rotated_rod() -> Scene {
    let [rod, wall] = upright_rod_and_wall(PI, 1.25, Pose::IDENTITY);
    let turn = DQuat::from_rotation_z(FRAC_PI_2);
    let start = Pose::new(DVec3::ZERO, turn.conjugate()).expect("a pose");
    let rod = MovingShape {
        shape: rod.shape.placed(turn, DVec3::ZERO),
        motion: Motion::new(start, DVec3::ZERO, PI * DVec3::Y).expect("finite"),
    };
    Scene::new(
        "T3 pre-rotated rod",
        [rod, wall],
        ExpectedOutcome::exact_hit(|g| corner_arrival_time(1.25 - g, PI)),
    )
}

/// Returns T6: a rod whose corner passes a wall at a small distance.
fn grazing_miss(depth: f64) -> Scene {
    let gap = rod_corner_radius() * depth;
    Scene::new(
        format!("T6 grazing miss {depth:.0e}"),
        upright_rod_and_wall(PI, rod_corner_radius() + gap, Pose::IDENTITY),
        ExpectedOutcome::Free { gap },
    )
}

/// Returns T7: a rod whose side edge meets the parallel edge of a post.
fn rod_on_post() -> Scene {
    let (radius, angle, speed, width) = (1.3, 1.0, 1.5, 0.1);
    let shape = cuboid(DVec3::new(ROD_HALF_LENGTH, width, 0.1));
    let spinning = MovingShape::rotating_shape(shape, DVec3::ZERO, speed * DVec3::Z);
    let post = MovingShape::still(post(radius, angle), DVec3::ZERO);
    let time = move |g: f64| (angle - ((width + g) / radius).asin()) / speed;
    Scene::new(
        "T7 rod on post",
        [spinning, post],
        ExpectedOutcome::exact_hit(time),
    )
}

/// Returns T9: a mace that rotates about its heavy head until the end of its long arm reaches a wall. Bounds that use
/// the present pose alone do not anticipate this contact.
fn swinging_mace() -> Scene {
    let (length, width, speed) = (2.0_f64, 0.02, 3.0);
    let reach: f64 = length.hypot(width);
    let swinging = MovingShape::rotating_shape(mace(length, width), DVec3::ZERO, speed * DVec3::Z);
    let wall = MovingShape::still(
        wall_at(1.0).placed(DQuat::from_rotation_z(FRAC_PI_2), DVec3::ZERO),
        DVec3::ZERO,
    );
    let time = move |g: f64| (length.atan2(width) + ((1.0 - g) / reach).asin()) / speed;
    Scene::new(
        "T9 mace",
        [swinging, wall],
        ExpectedOutcome::exact_hit(time),
    )
}

/// Returns T12: a square peg that rotates in a square hole, with four contacts at once.
fn peg_in_hole() -> Scene {
    let (peg, hole) = (1.0, 1.2);
    let turning =
        MovingShape::rotating_shape(cuboid(DVec3::new(peg, peg, 0.5)), DVec3::ZERO, DVec3::Z);
    let plate = MovingShape::still(frame_plate(hole), DVec3::ZERO);
    let time = move |g: f64| ((hole - g) / (peg * 2.0_f64.sqrt())).asin() - FRAC_PI_4;
    Scene::new(
        "T12 peg in hole",
        [turning, plate],
        ExpectedOutcome::exact_hit(time),
    )
}

/// Returns T14: two upright rods that rotate towards each other, as mirror images.
fn mirrored_rods() -> Scene {
    let (apart, speed) = (3.0, 2.0);
    let upright = || cuboid(DVec3::new(ROD_HALF_WIDTH, 0.3, ROD_HALF_LENGTH));
    let left = MovingShape::rotating_shape(upright(), DVec3::ZERO, speed * DVec3::Y);
    let right = MovingShape::rotating_shape(upright(), apart * DVec3::X, -speed * DVec3::Y);
    let time = move |g: f64| corner_arrival_time(0.5 * (apart - g), speed);
    Scene::new(
        "T14 two rods",
        [left, right],
        ExpectedOutcome::exact_hit(time),
    )
}

/// Returns T20: T4 far from the origin. The offsets are powers of two, so that the scene itself is not rounded.
fn far_rod(offset: f64) -> Scene {
    let pose = Pose::at(DVec3::new(offset, -offset, offset)).expect("finite");
    Scene::new(
        format!("T20 rod at {offset}"),
        upright_rod_and_wall(PI, 1.25, pose),
        ExpectedOutcome::exact_hit(|g| corner_arrival_time(1.25 - g, PI)),
    )
}

/// Returns case T20: the rod and the wall of case T4 at a very small or very large scale.
fn scaled_rod(scale: f64) -> Scene {
    let [mut rod, mut wall] = upright_rod_and_wall(PI, 1.25, Pose::IDENTITY);
    rod.shape = rod.shape.scaled(scale);
    wall.shape = wall.shape.scaled(scale);
    Scene::new(
        format!("T20 rod times {scale:.0e}"),
        [rod, wall],
        ExpectedOutcome::exact_hit(move |g| corner_arrival_time(1.25 - g / scale, PI)),
    )
}

/// Returns two bodies at rest relative to each other, one unit apart, which rotate about a common axis. They are free
/// at any speed.
fn rigidly_turning_pair() -> Scene {
    let cube = || cuboid(DVec3::splat(0.5));
    let on_table = |x: f64| {
        let start = Pose::at(x * DVec3::X).expect("finite");
        let about_origin = -x * DVec3::X;
        MovingShape {
            shape: cube(),
            motion: Motion::about(start, DVec3::ZERO, 40.0 * DVec3::Z, about_origin)
                .expect("finite"),
        }
    };
    Scene::new(
        "turntable",
        [on_table(-1.0), on_table(1.0)],
        ExpectedOutcome::Free { gap: 1.0 },
    )
}
