//! Searches for the worst rounding of distances, against double-double arithmetic.
//!
//! Coordinates are about a unit or far from the origins of the bodies and of the world, and turns are up to a million
//! radians: each is a part of the bound.

use super::{ErrorShares, error_shares, far_body, random_motion};
use crate::math::order::greater;
use crate::motion::relative::RelativePath;
use crate::problem::Problem;
use crate::settings::{Settings, VectorInstructions};
use crate::tests::double::{DoubleDouble, DoubleDouble3, place};
use crate::tests::far_ends::{between, ends};
use crate::tests::scene::{RngExt, random_direction, random_power_of_ten};
use crate::tests::worst::{RandomCase, WorstCaseSearch, error_fraction};
use crate::{Body, Motion};
use glam::DVec3;

/// Two moving bodies, given by their points and motions.
struct Scene {
    bodies: [Body; 2],
    motions: [Motion; 2],
    accelerations: [DVec3; 2],
    duration: f64,
}

impl Scene {
    fn new(tape: &mut RandomCase) -> Self {
        let size = random_power_of_ten(tape, -6.0, 6.0);
        let far = match tape.random_range(0..3) {
            0 => 0.0,
            _ => random_power_of_ten(tape, 0.0, 6.0),
        };
        let world = random_direction(tape) * far;
        let duration = random_power_of_ten(tape, -3.0, 3.0);
        Scene {
            bodies: [(); 2].map(|()| far_body(tape, 1, size)),
            motions: [(); 2].map(|()| random_motion(tape, world, size, duration)),
            accelerations: [DVec3::ZERO; 2],
            duration,
        }
    }

    /// Removes the rotation of both bodies.
    fn without_rotation(mut self) -> Self {
        self.motions = self.motions.map(|motion| {
            let spin = DVec3::ZERO;
            Motion::about(motion.start(), motion.velocity(), spin, motion.center()).unwrap()
        });
        self
    }

    fn problem(&self) -> Option<Problem<'_>> {
        let moving = |k: usize| (&self.bodies[k], self.motions[k]);
        let (bodies, pulls) = ([moving(0), moving(1)], self.accelerations);
        Problem::with_accelerations(
            bodies,
            pulls,
            self.duration,
            &Settings::DEFAULT.to_query_settings(),
        )
        .ok()
    }

    /// Adds random accelerations, which move the bodies between a hundredth and a hundred times as far as their
    /// velocities.
    fn with_accelerations(self, tape: &mut RandomCase) -> Self {
        let pull = |motion: Motion| {
            let speed = motion.velocity().length() * random_power_of_ten(tape, -2.0, 2.0);
            random_direction(tape) * (speed / self.duration)
        };
        Scene {
            accelerations: self.motions.map(pull),
            ..self
        }
    }

    /// Returns the exact position of a body's point after the share `s` of the duration.
    fn exact_position(&self, body: usize, s: f64, point: DVec3) -> DoubleDouble3 {
        let time = DoubleDouble::from(self.duration) * DoubleDouble::from(s);
        let fall = DoubleDouble3::from(self.accelerations[body])
            .scale(time * time * DoubleDouble::from(0.5));
        place(&self.motions[body], self.duration, s, point) + fall
    }
}

/// Draws a scene, and returns the errors of its positions, gaps and distances as shares of their bound.
fn random_scene_error_shares(tape: &mut RandomCase) -> Option<ErrorShares> {
    let scene = Scene::new(tape);
    scene_error_shares(tape, &scene)
}

/// Draws a scene without rotation, and returns the errors of its positions, gaps and distances as shares of their
/// bound.
fn error_shares_without_rotation(tape: &mut RandomCase) -> Option<ErrorShares> {
    let scene = Scene::new(tape).without_rotation();
    scene_error_shares(tape, &scene)
}

fn scene_error_shares(tape: &mut RandomCase, scene: &Scene) -> Option<ErrorShares> {
    let problem = scene.problem()?;
    let s = tape.random_range(0.0..1.0);
    Some(error_shares(
        tape,
        &problem,
        &scene.motions,
        scene.duration,
        s,
    ))
}

#[test]
fn worst_places() {
    let found = WorstCaseSearch::new("distance_rounding, places", 8_000)
        .search(|tape| Some(random_scene_error_shares(tape)?.position_error_share));
    found.assert_tight_bound(100.0);
}

#[test]
fn worst_gaps() {
    let found = WorstCaseSearch::new("distance_rounding, gaps", 8_000)
        .search(|tape| Some(random_scene_error_shares(tape)?.gap));
    found.assert_tight_bound(100.0);
}

#[test]
fn worst_distances() {
    let found = WorstCaseSearch::new("distance_rounding, distances", 8_000)
        .search(|tape| Some(random_scene_error_shares(tape)?.distance));
    found.assert_tight_bound(100.0);
}

#[test]
fn worst_places_without_turns() {
    let found = WorstCaseSearch::new("distance_rounding, places, without turns", 8_000)
        .search(|tape| Some(error_shares_without_rotation(tape)?.position_error_share));
    found.assert_tight_bound(100.0);
}

#[test]
fn worst_gaps_without_turns() {
    let found = WorstCaseSearch::new("distance_rounding, gaps, without turns", 8_000)
        .search(|tape| Some(error_shares_without_rotation(tape)?.gap));
    found.assert_tight_bound(100.0);
}

#[test]
fn worst_distances_without_turns() {
    let found = WorstCaseSearch::new("distance_rounding, distances, without turns", 8_000)
        .search(|tape| Some(error_shares_without_rotation(tape)?.distance));
    found.assert_tight_bound(100.0);
}

/// Searches for the worst rounding of positions on motions whose velocities are derived from given poses at both ends.
#[test]
fn worst_places_between_poses() {
    let found = WorstCaseSearch::new("distance_rounding, between poses", 8_000).search(|tape| {
        let world = random_direction(tape) * random_power_of_ten(tape, 0.0, 11.9);
        let (size, duration) = (
            random_power_of_ten(tape, -3.0, 3.0),
            random_power_of_ten(tape, -3.0, 3.0),
        );
        let bodies = [(); 2].map(|()| far_body(tape, 1, size));
        let ends = [(); 2].map(|()| ends(tape, world, size));
        let motions = ends.map(|ends| between(&ends, duration));
        let scene = Scene {
            bodies,
            motions,
            accelerations: [DVec3::ZERO; 2],
            duration,
        };
        let problem = scene.problem()?;
        let origin = DoubleDouble3::from(ends[1].positions[0]);
        let s = tape.random_range(0.0..1.0);
        let k = tape.index_below(2);
        let frame = [&problem.a, &problem.b][k].path.frame(s);
        let off = |p: &DVec3| {
            let exact = ends[k].place(DoubleDouble::from(s), *p) - origin;
            (DoubleDouble3::from(frame.transform_point(*p)) - exact)
                .length()
                .get()
        };
        let off = scene.bodies[k].pieces().points().iter().map(off);
        Some(error_fraction(off.fold(0.0, greater), problem.rounding))
    });
    found.assert_tight_bound(100.0);
}

#[test]
fn worst_places_of_accelerating_bodies() {
    let found = WorstCaseSearch::new("distance_rounding, accelerating", 8_000).search(|tape| {
        let scene = Scene::new(tape).with_accelerations(tape);
        let problem = scene.problem()?;
        let origin = DoubleDouble3::from(scene.motions[1].start().translation());
        let s = tape.random_range(0.0..1.0);
        let k = tape.index_below(2);
        let frame = [&problem.a, &problem.b][k].path.frame(s);
        let off = |p: &DVec3| {
            let exact = scene.exact_position(k, s, *p) - origin;
            (DoubleDouble3::from(frame.transform_point(*p)) - exact)
                .length()
                .get()
        };
        let off = scene.bodies[k].pieces().points().iter().map(off);
        Some(error_fraction(off.fold(0.0, greater), problem.rounding))
    });
    found.assert_tight_bound(100.0);
}

/// Searches for the worst rounding of the relative pose of two bodies that bounds of nodes use.
#[test]
fn worst_views() {
    let found = WorstCaseSearch::new("distance_rounding, views", 8_000).search(|tape| {
        let mut scene = Scene::new(tape);
        if tape.index_below(2) == 0 {
            scene = scene.with_accelerations(tape);
        }
        let problem = scene.problem()?;
        let s = tape.random_range(0.0..1.0);
        let own = tape.index_below(2);
        let sides = [&problem.a, &problem.b];
        let (from, to) = (sides[own], sides[1 - own]);
        let view = RelativePath::new(&from.path, &to.path);
        let level = VectorInstructions::Baseline.simd_level();
        let [x, y] = [from, to].map(|side| side.body.pieces().points()[0]);
        let arm = y - to.path.center;
        let found = crate::vectorize!(level, level => {
            let seen = view.state_at::<_, crate::motion::kind::AnyMotion>(level, s);
            let arm = crate::math::simd::PackedVector::new(level, arm);
            (seen.rotation * arm + seen.offset).to_dvec3()
        });
        let found = DoubleDouble3::from(found)
            - (DoubleDouble3::from(x) - DoubleDouble3::from(from.path.center));
        let exact = scene.exact_position(1 - own, s, y) - scene.exact_position(own, s, x);
        let off = (found.length() - exact.length()).get().abs();
        Some(error_fraction(off, problem.rounding))
    });
    found.assert_tight_bound(100.0);
}
