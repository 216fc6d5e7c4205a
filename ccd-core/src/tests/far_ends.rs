//! Tests that answers hold for the exact motion between given poses far from the world's origin, not only for the
//! rounded motion.

use super::double::{DoubleDouble, DoubleDouble3, EndPoses};
use super::oracle::ExhaustiveOracle;
use super::scene::{
    Pcg64, RngExt, random_direction, random_point_in_ball, random_power_of_ten, random_rotation,
    rng,
};
use crate::answer::Outcome;
use crate::body::Body;
use crate::engine::answer::EngineSchedule;
use crate::motion::Motion;
use crate::motion::pose::Pose;
use crate::problem::Problem;
use crate::query::MovingBody;
use crate::schedule::{BestFirst, Naive};
use crate::settings::Settings;
use glam::DVec3;

/// Draws the poses at both ends of a motion near a point in the world; the orientations are sometimes equal, and the
/// quaternions not normalised.
pub(crate) fn ends<R: RngExt>(rng: &mut R, world: DVec3, size: f64) -> EndPoses {
    let at = |rng: &mut R| world + random_point_in_ball(rng, size);
    let start = random_rotation(rng) * random_power_of_ten(rng, -3.0, 3.0);
    let end = match rng.random_range(0..3) {
        0 => start,
        1 => start * random_power_of_ten(rng, -1.0, 1.0),
        _ => random_rotation(rng) * random_power_of_ten(rng, -3.0, 3.0),
    };
    let off = size * random_power_of_ten(rng, -3.0, 3.0);
    EndPoses {
        positions: [at(rng), at(rng)],
        turned: [start, end],
        center: [DVec3::ZERO, random_point_in_ball(rng, off)][rng.random_range(0..2)],
    }
}

/// Creates the motion between two poses that the engine searches, with velocities rounded to f64.
pub(crate) fn between(ends: &EndPoses, duration: f64) -> Motion {
    let [start, end] = [0, 1].map(|k| Pose::new(ends.positions[k], ends.turned[k]).unwrap());
    Motion::between(start, end, ends.center, duration).unwrap()
}

/// Two balls that move between given poses, each with its center away from its body's origin.
struct Scene {
    ends: [EndPoses; 2],
    centers: [DVec3; 2],
    radii: f64,
}

impl Scene {
    fn new(rng: &mut Pcg64) -> Self {
        let world = random_direction(rng) * random_power_of_ten(rng, 3.0, 11.9);
        Scene {
            ends: [(); 2].map(|()| ends(rng, world, 1.0)),
            centers: [(); 2].map(|()| random_point_in_ball(rng, 0.5)),
            radii: rng.random_range(0.1..0.4),
        }
    }

    /// Returns the exact distance of the balls after the share `share` of the duration.
    fn distance(&self, share: DoubleDouble) -> DoubleDouble {
        let [a, b] = [0, 1].map(|k| self.ends[k].place(share, self.centers[k]));
        let way: DoubleDouble3 = b - a;
        way.length() - DoubleDouble::from(self.radii) - DoubleDouble::from(self.radii)
    }
}

#[test]
fn answers_hold_for_the_motion_between_the_poses_as_given() {
    let mut rng = rng(41);
    let (mut hits, mut misses) = (0, 0);
    for number in 0..800 {
        let scene = Scene::new(&mut rng);
        let bodies = scene.centers.map(|center| {
            let ball = crate::body::polytope::Polytope {
                points: vec![center],
                radius: scene.radii,
                ..Default::default()
            };
            let pieces = crate::body::pieces::Pieces::from_polytopes(&[ball]).unwrap();
            Body::new(&pieces, crate::body::Solidity::Surface).unwrap()
        });
        let duration = random_power_of_ten(&mut rng, -2.0, 2.0);
        let config = Settings {
            tolerance: 1e-12,
            ..Settings::DEFAULT
        };
        let moving = |k: usize| MovingBody::from((&bodies[k], between(&scene.ends[k], duration)));
        let problem = Problem::of_moving_bodies(moving(0), moving(1), duration, &config).unwrap();
        for outcome in [
            BestFirst::default()
                .answer_first_contact(&problem, &mut ExhaustiveOracle)
                .outcome,
            Naive::default()
                .answer_first_contact(&problem, &mut ExhaustiveOracle)
                .outcome,
        ] {
            let (until, least) = match outcome {
                Outcome::Contact { time, contact } => {
                    hits += 1;
                    let share = DoubleDouble::from(time) / DoubleDouble::from(duration);
                    let exact = scene.distance(share);
                    let (lower, upper) = (contact.separation.lower, contact.separation.upper);
                    assert!(
                        (exact - DoubleDouble::from(lower)).get() >= 0.0,
                        "{number}: {outcome:?}"
                    );
                    assert!(
                        (DoubleDouble::from(upper) - exact).get() >= 0.0,
                        "{number}: {outcome:?}"
                    );
                    (share.get(), 0.0)
                }
                Outcome::Free { proven_gap } => {
                    misses += 1;
                    (1.0, proven_gap)
                }
                Outcome::Touching { .. } | Outcome::Overlapping { .. } => continue,
                outcome => panic!("{number}: {outcome:?}"),
            };
            for k in 0..64 {
                let found = scene.distance(DoubleDouble::from(until * f64::from(k) / 64.0));
                assert!(found.get() >= least, "{number}: {outcome:?}");
            }
        }
    }
    assert!(hits > 200 && misses > 200, "{hits} {misses}");
}
