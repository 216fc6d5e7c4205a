//! Counts passages of bodies through each other and measures penetration depths, with parry's own tests.

use crate::glue::at;
use crate::worlds::World;
use anyhow::Result;
use ccd_core::order::{greater, lesser};
use parry3d_f64::math::Pose as At;
use parry3d_f64::query::{contact, intersection_test};
use parry3d_f64::shape::Shape;
use rigid_ccd::trajectory::{Motion, Moving};

/// The passages and penetration depths measured so far.
#[derive(Default)]
pub(crate) struct Tally {
    /// The number of pairs that were apart before and after a step, and overlapped between.
    pub(crate) passed: usize,
    /// The deepest penetration after each step, in metres.
    pub(crate) depths: Vec<f64>,
    /// The number of steps of single moving bodies, and how many of these were stopped.
    moves: usize,
    stops: usize,
}

/// The motion of a body in a step, and the time at which the body stops.
pub(crate) type StoppedMotion = (Motion, f64);

impl Tally {
    /// Measures one step of all bodies in a world.
    pub(crate) fn step(
        &mut self,
        world: &World,
        moved: &[StoppedMotion],
        duration: f64,
    ) -> Result<()> {
        let mut deepest = 0.0;
        for (body, &(_, stop)) in world.bodies.iter().zip(moved) {
            self.moves += usize::from(!body.is_fixed);
            self.stops += usize::from(stop < duration);
        }
        for [a, b] in pairs_that_may_meet(world, moved, duration)? {
            deepest = greater(deepest, depth(world, moved, [a, b], duration));
            self.passed += usize::from(passes(world, moved, [a, b], duration));
        }
        self.depths.push(deepest);
        Ok(())
    }

    /// Returns the share of the bodies' steps in which the body was stopped.
    pub(crate) fn stopped_share(&self) -> f64 {
        self.stops as f64 / self.moves as f64
    }

    pub(crate) fn deepest(&self) -> f64 {
        self.depths.iter().copied().fold(0.0, greater)
    }
}

/// Returns the pairs whose swept boxes meet, except joined pairs and pairs at rest.
fn pairs_that_may_meet(
    world: &World,
    moved: &[StoppedMotion],
    duration: f64,
) -> Result<Vec<[usize; 2]>> {
    let swept = |(body, &(motion, _)): (&crate::worlds::Simulated, &StoppedMotion)| {
        let moving = Moving::from((&body.body, motion));
        moving.swept_box(duration, &rigid_ccd::Settings::DEFAULT)
    };
    let boxes = world.bodies.iter().zip(moved).map(swept);
    let boxes = boxes.collect::<Result<Vec<_>, _>>()?;
    let pairs = (0..boxes.len()).flat_map(|b| (0..b).map(move |a| [a, b]));
    let asked = pairs.filter(|&[a, b]| {
        let is_fixed = world.bodies[a].is_fixed && world.bodies[b].is_fixed;
        !is_fixed && boxes[a].meets(&boxes[b]) && !world.joined.contains(&[a, b])
    });
    Ok(asked.collect())
}

/// Returns the poses and the shapes of two bodies at a time.
fn pose_and_shape_at<'w>(
    world: &'w World,
    moved: &[StoppedMotion],
    pair: [usize; 2],
    time: f64,
) -> [Placed<'w>; 2] {
    pair.map(|k| {
        let (motion, stop) = &moved[k];
        (
            at(motion.pose(lesser(time, *stop))),
            &*world.bodies[k].shape,
        )
    })
}

type Placed<'w> = (At, &'w dyn Shape);

fn depth(world: &World, moved: &[StoppedMotion], pair: [usize; 2], time: f64) -> f64 {
    let [a, b] = pose_and_shape_at(world, moved, pair, time);
    let found = contact(&a.0, a.1, &b.0, b.1, 0.0).ok().flatten();
    found.map_or(0.0, |contact| greater(0.0, -contact.dist))
}

fn overlap(world: &World, moved: &[StoppedMotion], pair: [usize; 2], time: f64) -> bool {
    let [a, b] = pose_and_shape_at(world, moved, pair, time);
    intersection_test(&a.0, a.1, &b.0, b.1).is_ok_and(|found| found.intersecting)
}

/// Returns whether bodies that are apart at both ends overlap between them, at samples dense enough for the thinnest
/// part.
fn passes(world: &World, moved: &[StoppedMotion], pair: [usize; 2], duration: f64) -> bool {
    if overlap(world, moved, pair, 0.0) || overlap(world, moved, pair, duration) {
        return false;
    }
    let [a, b] = pair.map(|k| moved[k].0);
    let travel = (a.velocity() - b.velocity()).length() * duration;
    let turn = (a.spin().length() + b.spin().length()) * duration;
    let samples = (2.0 * (travel + turn) / world.thinnest).clamp(4.0, 20_000.0) as u32;
    (1..samples).any(|k| {
        let time = duration * f64::from(k) / f64::from(samples);
        overlap(world, moved, pair, time)
    })
}
