//! What a body sees of another, against the two frames.

use super::{RelativePath, Seen};
use crate::motion::Motion;
use crate::motion::path::Path;
use crate::motion::pose::Pose;
use crate::tests::scene::{Pcg64, RngExt, direction, magnitude, rng, rotation, within};

fn path(rng: &mut Pcg64) -> Path {
    let start = Pose::new(within(rng, 9.0), rotation(rng)).unwrap();
    let turn = match rng.random_range(0..3) {
        0 => 0.0,
        1 => magnitude(rng, -12.0, -3.0),
        _ => magnitude(rng, -3.0, 1.6),
    };
    let spin = direction(rng) * turn;
    let motion = Motion::about(start, within(rng, 5.0), spin, within(rng, 3.0)).unwrap();
    Path::new(&motion, within(rng, 9.0), 1.0)
}

#[test]
fn each_body_sees_what_the_frames_of_both_say() {
    let mut rng = rng(3);
    let (mut one, mut both) = (0, 0);
    for _ in 0..2_000 {
        let (a, b) = (path(&mut rng), path(&mut rng));
        let relative = RelativePath::new(&a, &b);
        for s in [0.0, 1.0, rng.random_range(0.0..1.0)] {
            let seen = match &relative {
                Some(path) => [path.seen_by_a(s), path.seen_by_b(s)],
                None => [Seen::at(&a, &b, s), Seen::at(&b, &a, s)],
            };
            for (seen, own, other) in [(seen[0], &a, &b), (seen[1], &b, &a)] {
                let frame = own.frame(s);
                let expected = frame.from_frame(&other.frame(s));
                let scale = 1e-14 * (30.0 + own.rate + other.rate);
                let x = within(&mut rng, 3.0);
                let point = seen.frame(own, other).point(x);
                assert!(
                    point.distance(expected.point(x)) < scale,
                    "{own:?} {other:?}"
                );
                let velocity = frame.inverse_vector(own.velocity - other.velocity);
                assert!(seen.velocity.distance(velocity) < scale);
                let spin = frame.inverse_vector(other.spin);
                assert!(seen.spin.distance(spin) < scale * (1.0 + other.rate));
            }
        }
        match relative {
            Some(_) => one += 1,
            None => both += 1,
        }
    }
    assert!(one > 500 && both > 500, "{one} {both}");
}
