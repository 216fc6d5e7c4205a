//! Tests that bodies in contact at the start that are let go are in contact again as soon as they approach.

use crate::answer::Outcome;
use crate::distance::oracle::{Claim, DistanceOracle, GiveUpReason, PiecePair};
use crate::engine::answer::EngineSchedule;
use crate::motion::Motion;
use crate::motion::pose::Pose;
use crate::problem::Problem;
use crate::rounding::MIN_APPROACH_PER_ROUNDING;
use crate::schedule::BestFirst;
use crate::settings::{Settings, StartPolicy};
use crate::tests::oracle::ExhaustiveOracle;
use crate::tests::scene::{RngExt, body, random_direction, random_power_of_ten, rng};
use glam::DVec3;

/// An oracle whose axis is the vector between the nearest points, which rounding tilts.
struct TiltedAxisOracle;

impl DistanceOracle for TiltedAxisOracle {
    type Cache = ();

    fn separation(&mut self, pair: &PiecePair<'_>, cache: &mut ()) -> Result<Claim, GiveUpReason> {
        let claim = ExhaustiveOracle.separation(pair, cache)?;
        let points = [(claim.a, pair.a.points), (claim.b, pair.b.points)];
        let [a, b] = points.map(|(combination, points)| combination.position(points).unwrap());
        let axis = pair.b_to_a.transform_point(b) - a;
        Ok(Claim { axis, ..claim })
    }
}

/// Tests that a turning tip over large ground, within the margin at the start, is in contact once it has come nearer by
/// some units of rounding. The normal at the start is tilted by the rounding of a small distance, and over the ground's
/// size this takes far more than that from the gap.
#[test]
fn a_tip_that_descends_is_in_contact_at_once() {
    let ground = body(
        &[
            [[-8.0, -8.0], [8.0, -8.0], [8.0, 8.0]],
            [[-8.0, -8.0], [8.0, 8.0], [-8.0, 8.0]],
        ]
        .map(|corners| corners.map(|[x, y]| DVec3::new(x, y, 0.0))),
    );
    let mut rng = rng(21);
    let (mut descending, mut rising, mut early) = (0, 0, 0);
    for number in 0..4_000 {
        let mut upper = || {
            let across = random_direction(&mut rng);
            DVec3::new(across.x, across.y, rng.random_range(0.2..1.0))
        };
        let tip = body(&[[DVec3::ZERO, upper(), upper()]]);
        let height = random_power_of_ten(&mut rng, -6.0, -2.0);
        let (x, y) = (rng.random_range(-1.0..1.0), rng.random_range(-1.0..1.0));
        // Far from the world's origin, points of contact are rounded by more than the distances of bodies.
        let place = [0.0, 1e7][number % 2] * random_direction(&mut rng);
        let start = Pose::at(place + DVec3::new(x, y, height)).unwrap();
        let ground_motion = Motion::still(Pose::at(place).unwrap());
        let velocity = 2.0 * random_direction(&mut rng);
        let spin = 3.0 * random_direction(&mut rng);
        let motion = Motion::new(start, velocity, spin).unwrap();
        let settings = Settings {
            margin: 2.0 * height,
            start_policy: StartPolicy::Leave,
            ..Settings::DEFAULT
        };
        let bodies = [(&tip, motion), (&ground, ground_motion)];
        let problem = Problem::new(bodies, 1e-6, &settings.to_query_settings()).unwrap();
        let answer = BestFirst::default().answer_first_contact(&problem, &mut TiltedAxisOracle);
        match answer.outcome {
            Outcome::Contact { time, .. } => {
                descending += 1;
                early += usize::from(velocity.z > 1e-5);
                // Both bounds of the distance at the start may be off by it, too.
                let allowed = 2.0 * (MIN_APPROACH_PER_ROUNDING + 1.0) * problem.rounding;
                let fallen = -velocity.z * time;
                assert!(fallen <= allowed, "{number}: {fallen:e} > {allowed:e}");
            }
            Outcome::Free { .. } => {
                rising += 1;
                assert!(velocity.z > -1e-5, "{number}: {velocity}");
            }
            outcome => panic!("{number}: {outcome:?}"),
        }
    }
    assert!(
        descending > 1_500 && rising > 1_500,
        "{descending} {rising}"
    );
    // A tip that rises and passes from one triangle of the ground to the other comes nearer to that one.
    assert!(early <= 4, "{early}");
}
