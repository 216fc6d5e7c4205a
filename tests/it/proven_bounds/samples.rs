//! Scenes of two solids on trajectories, and their distances at sampled times.

use ccd_core::order::lesser;
use ccd_core::{Body, MovingBody, Trajectory};
use ccd_tests::checks::CheckResult;
use ccd_tests::courses::{self, TRAJECTORY_KINDS};
use ccd_tests::law;
use ccd_tests::solids::Solid;
use rand::RngExt;
use rand_pcg::Pcg64;

/// The distance from the origin within which the bodies move.
const SCENE_RADIUS: f64 = 2.0;

/// A bound on the rounding errors of distances and poses in this test, for coordinates below 32.
pub(super) const ROUNDING: f64 = 2e-14;

/// Two solids on trajectories over the times 0 to 1.
pub(super) struct Scene {
    pub(super) trajectory_kinds: [usize; 2],
    pub(super) solids: [Solid; 2],
    pub(super) bodies: [Body; 2],
    pub(super) trajectories: [Box<dyn Trajectory>; 2],
}

impl Scene {
    pub(super) fn draw(rng: &mut Pcg64) -> Self {
        let solids = [(); 2].map(|()| Solid::draw(rng, 0.7));
        let kinds = [(); 2].map(|()| rng.random_range(0..TRAJECTORY_KINDS.len()));
        Scene {
            bodies: [0, 1].map(|k| solids[k].body()),
            trajectories: kinds.map(|kind| courses::draw(rng, kind, SCENE_RADIUS)),
            trajectory_kinds: kinds,
            solids,
        }
    }

    pub(super) fn moving_bodies(&self) -> [MovingBody<'_>; 2] {
        [0, 1].map(|k| (&self.bodies[k], self.trajectories[k].as_ref()).into())
    }

    pub(super) fn distance(&self, time: f64) -> f64 {
        let [a, b] = [0, 1].map(|k| {
            let pose = self.trajectories[k].pose(time).expect("a pose");
            self.solids[k].placed(&pose)
        });
        a.distance(&b)
    }

    /// Samples the distance at even times, at and beside all knots, and more finely near its least values.
    pub(super) fn samples(&self) -> DistanceSamples {
        const INTERVAL_COUNT: u32 = 48;
        let mut times: Vec<f64> = (0..=INTERVAL_COUNT)
            .map(|k| f64::from(k) / f64::from(INTERVAL_COUNT))
            .collect();
        let mut corners = Vec::new();
        for way in &self.trajectories {
            collect_corner_times(way.as_ref(), [0.0, 1.0], &mut corners);
        }
        for corner in corners {
            let beside = [corner - 1e-7, corner, corner + 1e-7];
            times.extend(beside.into_iter().filter(|time| (0.0..=1.0).contains(time)));
        }
        times.sort_unstable_by(f64::total_cmp);
        let mut samples: Vec<_> = times.into_iter().map(|t| (t, self.distance(t))).collect();
        let lowest = |k: &usize| {
            let [before, after] = [k.saturating_sub(1), (k + 1).min(samples.len() - 1)];
            samples[*k].1 <= lesser(samples[before].1, samples[after].1)
        };
        let mut valleys: Vec<usize> = (0..samples.len()).filter(lowest).collect();
        valleys.sort_unstable_by(|i, k| samples[*i].1.total_cmp(&samples[*k].1));
        for k in valleys.into_iter().take(4) {
            let [mut from, mut to] =
                [k.saturating_sub(1), (k + 1).min(samples.len() - 1)].map(|k| samples[k].0);
            for _ in 0..24 {
                let [one, two] = [from + 0.382 * (to - from), to - 0.382 * (to - from)];
                let [near, far] = [one, two].map(|time| self.distance(time));
                samples.extend([(one, near), (two, far)]);
                if near < far { to = two } else { from = one }
            }
        }
        DistanceSamples(samples)
    }
}

fn collect_corner_times(way: &dyn Trajectory, [from, to]: [f64; 2], corners: &mut Vec<f64>) {
    if let Some(corner) = way.velocity_jump_time(from, to)
        && from < corner
        && corner < to
    {
        corners.push(corner);
        collect_corner_times(way, [from, corner], corners);
        collect_corner_times(way, [corner, to], corners);
    }
}

/// The sampled times, each with the distance at that time.
pub(super) struct DistanceSamples(Vec<(f64, f64)>);

impl DistanceSamples {
    pub(super) fn least_distance(&self) -> f64 {
        self.0
            .iter()
            .map(|sample| sample.1)
            .fold(f64::INFINITY, lesser)
    }

    /// Checks that no sampled distance is below a bound, at the sample times that `chosen` selects.
    pub(super) fn check_lower_bound(
        &self,
        bound: f64,
        chosen: impl Fn(f64) -> bool,
        what: &str,
    ) -> CheckResult {
        let chosen = self.0.iter().filter(|sample| chosen(sample.0));
        for &(time, distance) in chosen {
            law!(
                distance >= bound - ROUNDING,
                "{what}: {bound:e} is claimed, but at {time} it is {distance:e}"
            );
        }
        Ok(())
    }
}
