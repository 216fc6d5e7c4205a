//! Compares the relative motion with the frames of both bodies.

use super::{RelativePath, RelativeState};
use crate::math::simd::{PackedMatrix, PackedVector, padded_columns};
use crate::motion::Motion;
use crate::motion::kind::AnyMotion;
use crate::motion::path::Path;
use crate::motion::pose::Pose;
use crate::settings::VectorInstructions;
use crate::tests::scene::{
    Pcg64, RngExt, random_direction, random_point_in_ball, random_power_of_ten, random_rotation,
    rng,
};
use crate::vectorize;
use fearless_simd::Simd;
use glam::DVec3;

fn path(rng: &mut Pcg64) -> Path {
    let start = Pose::new(random_point_in_ball(rng, 9.0), random_rotation(rng)).unwrap();
    let turn = match rng.random_range(0..3) {
        0 => 0.0,
        1 => random_power_of_ten(rng, -12.0, -3.0),
        _ => random_power_of_ten(rng, -3.0, 1.6),
    };
    let spin = random_direction(rng) * turn;
    let motion = Motion::about(
        start,
        random_point_in_ball(rng, 5.0),
        spin,
        random_point_in_ball(rng, 3.0),
    )
    .unwrap();
    let path = Path::new(&motion, random_point_in_ball(rng, 9.0), 1.0);
    if rng.random_bool(0.5) {
        path.with_acceleration(random_point_in_ball(rng, 5.0))
    } else {
        path
    }
}

/// Returns the position, velocity and acceleration of a point of the seen body, and that body's angular velocity, in
/// the seeing body's frame.
#[inline(always)]
fn relative_state_of_point<L: Simd>(
    level: L,
    view: &RelativePath,
    s: f64,
    point: DVec3,
) -> [DVec3; 4] {
    let RelativeState {
        rotation,
        offset,
        velocity,
        acceleration,
        spin,
    } = view.state_at::<L, AnyMotion>(level, s);
    let point = rotation * (PackedVector::new(level, point) - view.other_rotation_center(level));
    let acceleration = acceleration.unwrap_or(PackedVector::new(level, DVec3::ZERO));
    [
        offset + point + view.rotation_center(level),
        velocity,
        acceleration,
        spin,
    ]
    .map(PackedVector::to_dvec3)
}

#[test]
fn each_body_sees_what_the_frames_of_both_say() {
    let mut rng = rng(3);
    let mut counts = [0; 3];
    for _ in 0..4_000 {
        let paths = (path(&mut rng), path(&mut rng));
        counts[usize::from(paths.0.is_turning()) + usize::from(paths.1.is_turning())] += 1;
        for (own, other) in [(&paths.0, &paths.1), (&paths.1, &paths.0)] {
            let view = RelativePath::new(own, other);
            for s in [0.0, 1.0, rng.random_range(0.0..1.0)] {
                let x = random_point_in_ball(&mut rng, 3.0);
                let [best, plain] = [VectorInstructions::Best, VectorInstructions::Baseline]
                    .map(|set| vectorize!(set.simd_level(), level => relative_state_of_point(level, &view, s, x)));
                assert_eq!(best, plain);
                let frame = own.frame(s);
                let expected = [
                    frame.transform_from(&other.frame(s)).transform_point(x),
                    frame.inverse_transform_vector(
                        own.center_velocity_at(s) - other.center_velocity_at(s),
                    ),
                    frame.inverse_transform_vector(own.acceleration - other.acceleration),
                    frame.inverse_transform_vector(other.spin),
                ];
                let scale = 1e-14 * (30.0 + own.angular_speed + other.angular_speed);
                let scales = [scale, scale, scale, scale * (1.0 + other.angular_speed)];
                for k in 0..4 {
                    let off = best[k].distance(expected[k]);
                    assert!(off < scales[k], "{k}: {off:e} {own:?} {other:?}");
                }
            }
        }
    }
    assert!(counts.iter().all(|&n| n > 200), "{counts:?}");
}

#[test]
fn packed_products_are_those_of_the_library() {
    let mut rng = rng(4);
    for _ in 0..1_000 {
        let frame = path(&mut rng).frame(rng.random_range(0.0..1.0));
        let (v, w) = (
            random_point_in_ball(&mut rng, 5.0),
            random_point_in_ball(&mut rng, 5.0),
        );
        let products = |set: VectorInstructions| {
            vectorize!(set.simd_level(), level => {
                let columns = padded_columns(frame.rotation).map(|column| PackedVector::load(level, &column));
                let matrix = PackedMatrix::new(columns);
                let (a, b) = (PackedVector::new(level, v), PackedVector::new(level, w));
                [matrix * a, a + b, a - b, -a, a * w.x].map(PackedVector::to_dvec3)
            })
        };
        let expected = [frame.rotation * v, v + w, v - w, -v, v * w.x];
        assert_eq!(products(VectorInstructions::Best), expected);
        assert_eq!(products(VectorInstructions::Baseline), expected);
    }
}
