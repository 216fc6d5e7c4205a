//! Counts how often bodies pass through each other, and measures how deep they penetrate, by parry's own tests.

use crate::glue::to_rapier_pose;
use crate::worlds::{SimulatedBody, World};
use anyhow::Result;
use ccd_core::order::{greater, lesser};
use parry3d_f64::query::{contact, intersection_test};
use rigid_ccd::trajectory::MovingBody;
use rigid_ccd::{Motion, Settings};

/// The passages and penetration depths measured so far.
#[derive(Default)]
pub(crate) struct Tally {
    /// The number of times that a pair of bodies was apart before and after a step, but overlapped during it.
    pub(crate) tunneling_count: usize,
    /// The greatest penetration depth of two bodies at the end of any step, in metres.
    pub(crate) max_penetration_depth: f64,
    /// The number of times that a body was stopped before the end of a step.
    pub(crate) stop_count: usize,
}

/// The motion of a body in a step, and the time at which the body stops.
pub(crate) type StoppedMotion = (Motion, f64);

impl Tally {
    /// Adds the passages, the penetration depths and the stops of one step of a world to the tally.
    pub(crate) fn record_step(
        &mut self,
        world: &World,
        moved: &[StoppedMotion],
        duration: f64,
    ) -> Result<()> {
        self.stop_count += moved.iter().filter(|(_, stop)| *stop < duration).count();
        let swept = |(body, &(motion, _)): (&SimulatedBody, &StoppedMotion)| {
            let moving = MovingBody::from((&body.body, motion));
            moving.swept_box(duration, &Settings::DEFAULT)
        };
        let boxes = world.bodies.iter().zip(moved).map(swept);
        let boxes = boxes.collect::<Result<Vec<_>, _>>()?;
        let pairs = (0..boxes.len()).flat_map(|b| (0..b).map(move |a| [a, b]));
        let asked = pairs.filter(|&[a, b]| {
            let is_fixed = world.bodies[a].is_fixed && world.bodies[b].is_fixed;
            !is_fixed && boxes[a].meets(&boxes[b]) && !world.joined_pairs.contains(&[a, b])
        });
        for pair in asked {
            let pair = BodyPair {
                world,
                motions: moved,
                body_indices: pair,
            };
            self.max_penetration_depth =
                greater(self.max_penetration_depth, pair.penetration_depth(duration));
            self.tunneling_count += usize::from(pair.is_tunneling(duration));
        }
        Ok(())
    }
}

/// Two bodies of a world, given by their indices, with the motions of all bodies in a step.
struct BodyPair<'w> {
    world: &'w World,
    motions: &'w [StoppedMotion],
    body_indices: [usize; 2],
}

impl BodyPair<'_> {
    fn penetration_depth(&self, time: f64) -> f64 {
        let ([p, q], [a, b]) = (self.poses(time), self.shapes());
        let found = contact(&p, a, &q, b, 0.0).ok().flatten();
        found.map_or(0.0, |contact| greater(0.0, -contact.dist))
    }

    fn overlaps(&self, time: f64) -> bool {
        let ([p, q], [a, b]) = (self.poses(time), self.shapes());
        intersection_test(&p, a, &q, b).is_ok_and(|found| found.intersecting)
    }

    /// Returns true if the two bodies are apart at the start and at the end of a step, but overlap at a sampled time
    /// between. The samples are dense enough for the thinnest part, up to a limit of 20,000.
    fn is_tunneling(&self, duration: f64) -> bool {
        if self.overlaps(0.0) || self.overlaps(duration) {
            return false;
        }
        let [a, b] = self.body_indices.map(|k| self.motions[k].0);
        let travel = (a.velocity() - b.velocity()).length() * duration;
        let turn = (a.angular_velocity().length() + b.angular_velocity().length()) * duration;
        let samples = 2.0 * (travel + turn) / self.world.min_thickness;
        let samples = samples.clamp(4.0, 20_000.0) as u32;
        (1..samples).any(|k| self.overlaps(duration * f64::from(k) / f64::from(samples)))
    }

    fn poses(&self, time: f64) -> [parry3d_f64::math::Pose; 2] {
        self.body_indices.map(|k| {
            let (motion, stop) = &self.motions[k];
            to_rapier_pose(motion.pose(lesser(time, *stop)))
        })
    }

    fn shapes(&self) -> [&dyn parry3d_f64::shape::Shape; 2] {
        self.body_indices.map(|k| &*self.world.bodies[k].shape)
    }
}
