//! Compares three ways of stepping fast bodies in rapier by their passages through each other and penetration depths:
//! without continuous collision detection, with rapier's own, and with certified times.
//!
//! ```sh
//! cargo run --release -p ccd-bench --example physics -- [STEPS [CHART.svg]]
//! ```

mod bunny;
mod chart;
mod glue;
mod judge;
mod worlds;

use anyhow::Result;
use chart::{Depths, draw};
use glue::pose;
use judge::{StoppedMotion, Tally};
use rigid_ccd::trajectory::Trajectory;
use rigid_ccd::{Motion, Pose, Scene};
use std::io::Write;
use std::num::NonZeroUsize;
use std::path::Path;
use std::time::{Duration, Instant};
use worlds::{Simulated, World};

/// The way in which a world is stepped.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Method {
    /// Steps without continuous collision detection.
    Plain,
    /// Steps with rapier's continuous collision detection, for all bodies and also between moving ones.
    Rapier,
    /// Steps in which each body stops at its certified first contact.
    Certified,
}

const METHODS: [Method; 3] = [Method::Plain, Method::Rapier, Method::Certified];

impl Method {
    fn name(self) -> &'static str {
        match self {
            Method::Plain => "rapier without CCD",
            Method::Rapier => "rapier's CCD",
            Method::Certified => "certified times",
        }
    }
}

fn main() -> Result<()> {
    let steps = std::env::args()
        .nth(1)
        .map_or(Ok(600), |text| text.parse())?;
    let chart = std::env::args()
        .nth(2)
        .unwrap_or("target/physics.svg".to_owned());
    let mut out = std::io::stdout().lock();
    writeln!(
        out,
        "world,stepped,steps,passed through,deepest m,stopped,step ms"
    )?;
    let mut drawn = Vec::new();
    for number in 0..World::COUNT {
        let mut methods = Vec::new();
        let mut name = "";
        for method in METHODS {
            let mut world = World::new(number, method)?;
            let (tally, time) = run(&mut world, method, steps)?;
            let millis = 1e3 * time.as_secs_f64() / f64::from(steps);
            let (deepest, stopped) = (tally.deepest(), tally.stopped_share());
            name = world.name;
            writeln!(
                out,
                "{name},{},{steps},{},{deepest:.2e},{stopped:.4},{millis:.3}",
                method.name(),
                tally.passed
            )?;
            methods.push(tally.depths);
        }
        drawn.push(Depths {
            world: name,
            methods,
        });
    }
    draw(&drawn, Path::new(&chart))?;
    writeln!(out, "drawn: {chart}")?;
    Ok(())
}

/// Steps a world many times; returns the measurements and the duration of the steps.
fn run(world: &mut World, method: Method, steps: u32) -> Result<(Tally, Duration)> {
    let duration = world.physics.integration_parameters.dt;
    let bodies: Vec<_> = world.bodies.iter().map(|body| body.body.clone()).collect();
    let joined = world.joined.clone();
    let mut scene =
        Scene::with_threads(NonZeroUsize::MIN).with_filter(|a, b| !joined.contains(&[a, b]));
    let mut moving = Vec::new();
    for (simulated, body) in world.bodies.iter().zip(&bodies) {
        let start = pose(&world.physics.bodies[simulated.handle])?;
        if simulated.is_fixed {
            scene.add_fixed(body, start)
        } else {
            let index = scene.add(body, Motion::still(start));
            moving.push((index, simulated.handle));
            index
        };
    }
    let (mut tally, mut time) = (Tally::default(), Duration::ZERO);
    for step in 0..steps {
        world.apply_forces(step);
        let starts = poses(world)?;
        let begun = Instant::now();
        let stops = match method {
            Method::Certified => Some(glue::step(&mut world.physics, &mut scene, &moving)?),
            Method::Plain | Method::Rapier => {
                world.physics.step();
                None
            }
        };
        time += begun.elapsed();
        let moved = match stops {
            Some(stops) => (0..)
                .zip(stops)
                .map(|(index, stop)| {
                    let motion = scene.movement(index).as_motion();
                    (motion.expect("a step is a motion"), stop.time)
                })
                .collect(),
            None => motions_without_stops(world, &starts, duration)?,
        };
        tally.step(world, &moved, duration)?;
    }
    Ok((tally, time))
}

fn poses(world: &World) -> Result<Vec<Pose>> {
    let poses = world
        .bodies
        .iter()
        .map(|body| pose(&world.physics.bodies[body.handle]));
    poses.collect()
}

/// Returns the motion that each body has in a step without stops.
fn motions_without_stops(
    world: &World,
    starts: &[Pose],
    duration: f64,
) -> Result<Vec<StoppedMotion>> {
    let between = |(body, start): (&Simulated, &Pose)| {
        let rigid = &world.physics.bodies[body.handle];
        let centre = rigid.mass_properties().local_mprops.local_com.to_array();
        let motion = Motion::between(*start, pose(rigid)?, centre, duration)?;
        Ok((motion, duration))
    };
    world.bodies.iter().zip(starts).map(between).collect()
}
