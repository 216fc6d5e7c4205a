//! Fast bodies in rapier, stepped as they are, with rapier's own continuous collision detection, and with certified
//! times: what passes through what, and how deep bodies get into each other.
//!
//! ```sh
//! cargo run --release -p ccd-bench --example physics -- [STEPS [CHART.svg]]
//! ```

mod glue;
mod judge;
mod rock;
mod worlds;

use anyhow::Result;
use glue::pose;
use judge::{Moved, Seen};
use rapier3d_f64::prelude::RigidBodyHandle;
use rigid_ccd::{Motion, Pose, Scene, Stop};
use std::io::Write;
use std::num::NonZeroUsize;
use std::time::{Duration, Instant};
use worlds::{Detection, World};

/// How a world is stepped.
#[derive(Clone, Copy, Debug)]
enum Method {
    /// As it is.
    Plain,
    /// With rapier's continuous collision detection.
    Rapier,
    /// With certified times.
    Certified,
}

const METHODS: [Method; 3] = [Method::Plain, Method::Rapier, Method::Certified];

fn main() -> Result<()> {
    let steps = std::env::args()
        .nth(1)
        .map_or(Ok(600), |text| text.parse())?;
    let mut out = std::io::stdout().lock();
    writeln!(out, "world,stepped,steps,passed through,deepest,step ms")?;
    for method in METHODS {
        let detection = match method {
            Method::Rapier => Detection::Full,
            Method::Plain | Method::Certified => Detection::Off,
        };
        for mut world in World::all(detection)? {
            let (seen, time) = run(&mut world, method, steps)?;
            let millis = 1e3 * time.as_secs_f64() / f64::from(steps);
            let (name, deepest) = (world.name, seen.deepest());
            writeln!(
                out,
                "{name},{method:?},{steps},{},{deepest:.2e},{millis:.3}",
                seen.passed
            )?;
        }
    }
    Ok(())
}

/// Steps a world, and returns what was seen and the time that the steps took.
fn run(world: &mut World, method: Method, steps: u32) -> Result<(Seen, Duration)> {
    let duration = world.physics.integration_parameters.dt;
    let bodies: Vec<_> = world.bodies.iter().map(|body| body.body.clone()).collect();
    let joined = world.joined.clone();
    let mut scene =
        Scene::with_threads(NonZeroUsize::MIN).with_filter(|a, b| !joined.contains(&[a, b]));
    let mut moving = Vec::new();
    for (simulated, body) in world.bodies.iter().zip(&bodies) {
        let start = pose(&world.physics.bodies[simulated.handle])?;
        match simulated.is_fixed {
            true => scene.add_fixed(body, start),
            false => {
                let index = scene.add(body, Motion::still(start));
                moving.push((index, simulated.handle));
                index
            }
        };
    }
    let (mut seen, mut time) = (Seen::default(), Duration::ZERO);
    for step in 0..steps {
        world.act(step);
        let starts = poses(world)?;
        let begun = Instant::now();
        let stopped = match method {
            Method::Certified => Some(glue::step(&mut world.physics, &mut scene, &moving)?),
            Method::Plain | Method::Rapier => {
                world.physics.step();
                None
            }
        };
        time += begun.elapsed();
        let moved = moved(world, &starts, &moving, stopped, duration)?;
        seen.step(world, &moved, duration)?;
    }
    Ok((seen, time))
}

fn poses(world: &World) -> Result<Vec<Pose>> {
    let poses = world
        .bodies
        .iter()
        .map(|body| pose(&world.physics.bodies[body.handle]));
    poses.collect()
}

/// Returns how each body of a world moved in a step.
fn moved(
    world: &World,
    starts: &[Pose],
    moving: &[(usize, RigidBodyHandle)],
    stopped: Option<Vec<(Motion, Stop)>>,
    duration: f64,
) -> Result<Vec<Moved>> {
    if let Some(stopped) = stopped {
        let mut moved: Vec<Moved> = starts
            .iter()
            .map(|&start| (Motion::still(start), duration))
            .collect();
        for (&(index, _), (motion, stop)) in moving.iter().zip(stopped) {
            moved[index] = (motion, stop.time);
        }
        return Ok(moved);
    }
    let between = |(body, start): (&worlds::Simulated, &Pose)| -> Result<Moved> {
        let rigid = &world.physics.bodies[body.handle];
        let centre = rigid.mass_properties().local_mprops.local_com.to_array();
        Ok((
            Motion::between(*start, pose(rigid)?, centre, duration)?,
            duration,
        ))
    };
    world.bodies.iter().zip(starts).map(between).collect()
}
