//! Tests that boxes contain sampled points, that bodies with separate boxes do not touch, and that boxes are not much
//! larger than necessary.

use super::*;
use crate::engine::answer::EngineSchedule;
use crate::math::order::greater;
use crate::schedule::BestFirst;
use crate::tests::oracle::ExhaustiveOracle;
use crate::tests::scene::{
    RngExt, Scene, SceneKind, random_direction, random_power_of_ten, rng, scene,
};
use crate::tests::trajectories::SwingingTrajectory;
use crate::{Motion, Outcome, Pose};

fn swept_boxes(scene: &Scene) -> [SweptBox; 2] {
    [0, 1].map(|k| {
        moving_body(scene, k)
            .swept_box(1.0, &scene.settings)
            .unwrap()
    })
}

fn moving_body(scene: &Scene, k: usize) -> MovingBody<'_> {
    MovingBody::from((&scene.bodies[k], scene.motions[k]))
}

#[test]
fn points_stay_in_their_box() {
    let mut rng = rng(1);
    let (mut tightest, mut turning) = (f64::INFINITY, 0);
    for _ in 0..2_000 {
        let kind = [
            SceneKind::RandomMotion,
            SceneKind::Sliding,
            SceneKind::NearRim,
        ][rng.random_range(0..3)];
        let scene = scene(&mut rng, kind, 8);
        for (k, swept) in swept_boxes(&scene).iter().enumerate() {
            let path = Path::new(&scene.motions[k], DVec3::ZERO, 1.0);
            turning += usize::from(path.is_turning());
            let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
            for step in 0..=128 {
                let frame = path.frame(f64::from(step) / 128.0);
                let pieces = scene.bodies[k].pieces();
                for x in (0..pieces.len()).flat_map(|piece| pieces.triangle(piece)) {
                    let point = frame.transform_point(x);
                    (low, high) = (
                        componentwise_min(low, point),
                        componentwise_max(high, point),
                    );
                }
            }
            assert!(swept.min.cmple(low).all() && swept.max.cmpge(high).all());
            let size = high - low;
            let excess = (swept.max - swept.min - size).max_element() / size.max_element();
            tightest = lesser(tightest, excess);
            // In the worst case the box is about a ball.
            let whole = &scene.bodies[k].tree().body_box;
            let ball = distance(whole.center, path.center) + whole.radius;
            let worst = path.velocity.abs() + 2.0 * (ball + box_growth_of(&scene, k));
            // Coordinates are rounded at their position.
            let rounding = 4.0 * f64::EPSILON * (swept.max.abs() + swept.min.abs());
            assert!(
                (swept.max - swept.min)
                    .cmple(worst * (1.0 + 1e-9) + rounding)
                    .all()
            );
        }
    }
    assert!(tightest < 1e-3 && turning > 500, "{tightest:e} {turning}");
}

#[test]
fn points_of_bodies_on_trajectories_stay_in_their_box() {
    let mut rng = rng(3);
    let mut widest: f64 = 0.0;
    for _ in 0..300 {
        let scene = scene(&mut rng, SceneKind::RandomMotion, 8);
        let (body, swing) = (&scene.bodies[0], SwingingTrajectory::draw(&mut rng, 3.0));
        let swept = MovingBody::from((body, &swing)).swept_box(2.0, &Settings::DEFAULT);
        let swept = swept.unwrap();
        let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        for step in 0..=256 {
            let pose = swing.pose(f64::from(step) / 128.0).unwrap();
            let pieces = body.pieces();
            for x in (0..pieces.len()).flat_map(|piece| pieces.triangle(piece)) {
                let point = pose.transform_point(x);
                (low, high) = (
                    componentwise_min(low, point),
                    componentwise_max(high, point),
                );
            }
        }
        assert!(swept.min.cmple(low).all() && swept.max.cmpge(high).all());
        let span = 2.0 * body.bounding_radius();
        let excess = (swept.max - swept.min - (high - low)).max_element() / (span + 1.0);
        widest = greater(widest, excess);
    }
    // The swings extend up to three units, and their accelerations are known.
    assert!(widest < 4.0, "{widest}");
}

fn box_growth_of(scene: &Scene, k: usize) -> f64 {
    let side = BodyWithPath {
        body: &scene.bodies[k],
        given_body: None,
        path: Path::new(&scene.motions[k], DVec3::ZERO, 1.0),
    };
    box_padding(&side, &scene.settings.to_query_settings())
}

/// Tests that bodies do not touch if their boxes are disjoint, even if the boxes are barely disjoint.
#[test]
fn bodies_whose_boxes_are_apart_are_free() {
    let mut rng = rng(2);
    let (mut apart, mut others, mut contacts) = (0, 0, 0);
    for number in 0..4_000 {
        let kind = [
            SceneKind::RandomMotion,
            SceneKind::Sliding,
            SceneKind::NearRim,
        ][rng.random_range(0..3)];
        let mut scene = scene(&mut rng, kind, 8);
        scene.settings.margin = match rng.random_range(0..3) {
            0 => scene.settings.tolerance * random_power_of_ten(&mut rng, -2.0, 5.0),
            _ => 0.0,
        };
        let [a, b] = swept_boxes(&scene);
        // The displacement is along an axis that separates the boxes.
        let axis = rng.random_range(0..3);
        let overlap = a.max[axis] - b.min[axis];
        let share = [1.0 + 1e-12, 1.0, 0.999, 0.2, 0.0][rng.random_range(0..5)];
        let mut way = DVec3::ZERO;
        way[axis] = overlap * share + [0.0, 1e-15 * overlap.abs()][rng.random_range(0..2)];
        let motion = scene.motions[1];
        let start = motion.start();
        let start = Pose::new(start.translation() + way, start.rotation()).unwrap();
        scene.motions[1] = Motion::about(
            start,
            motion.velocity(),
            motion.angular_velocity(),
            motion.center(),
        )
        .unwrap();
        let [a, b] = swept_boxes(&scene);
        let outcome = BestFirst::default()
            .answer_first_contact(&scene.problem(), &mut ExhaustiveOracle)
            .outcome;
        let is_free = matches!(outcome, Outcome::Free { .. });
        if a.meets(&b) {
            others += 1;
        } else {
            apart += 1;
            assert!(is_free, "{number}: {outcome:?}");
        }
        contacts += usize::from(!is_free);
    }
    assert!(
        apart > 500 && others > 500 && contacts > 50,
        "{apart} {others} {contacts}"
    );
}

#[test]
fn the_shares_of_two_bodies_are_no_less_than_the_rounding_of_their_distance() {
    let mut rng = rng(3);
    for _ in 0..10_000 {
        let scene = scene(&mut rng, SceneKind::RandomMotion, 2);
        let problem = scene.problem();
        let shares: f64 = [&problem.a, &problem.b]
            .iter()
            .zip(&scene.motions)
            .map(|(side, motion)| {
                let path = Path::new(motion, DVec3::ZERO, 1.0);
                let way = length(path.center_at(0.0)) + path.speed_bound() + scene.settings.margin;
                body_distance_rounding(side.extent_with_center(), path.angular_speed, way)
            })
            .sum();
        assert!(shares * (1.0 + 1e-12) >= problem.rounding);
    }
}

#[test]
fn a_ball_that_flies_has_the_box_of_its_way() {
    let ball = crate::Body::sphere(0.5).unwrap();
    let mut rng = rng(4);
    let spin = 10.0 * random_direction(&mut rng);
    let flies = Motion::new(Pose::at([1.0, 2.0, 3.0]).unwrap(), [4.0, -2.0, 0.0], spin).unwrap();
    let config = Settings {
        tolerance: 1e-9,
        ..Settings::DEFAULT
    };
    let swept = MovingBody::from((&ball, flies))
        .swept_box(1.0, &config)
        .unwrap();
    let (min, max) = (DVec3::new(0.5, -0.5, 2.5), DVec3::new(5.5, 2.5, 3.5));
    assert!((swept.min - min).abs().max_element() < 1e-9);
    assert!((swept.max - max).abs().max_element() < 1e-9);
}

#[test]
fn what_a_problem_refuses_has_no_box() {
    let ball = crate::Body::sphere(0.5).unwrap();
    let far = Motion::new(Pose::IDENTITY, [2e12, 0.0, 0.0], [0.0; 3]).unwrap();
    let (config, still) = (Settings::DEFAULT, Motion::STILL);
    assert!(
        MovingBody::from((&ball, far))
            .swept_box(1.0, &config)
            .is_err()
    );
    assert!(
        MovingBody::from((&ball, far))
            .swept_box(0.1, &config)
            .is_ok()
    );
    assert!(
        MovingBody::from((&ball, still))
            .swept_box(-1.0, &config)
            .is_err()
    );
    assert!(
        MovingBody::from((&ball, still))
            .swept_box(f64::NAN, &config)
            .is_err()
    );
}
