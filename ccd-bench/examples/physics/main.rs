//! Compares three ways to step fast bodies in rapier by how often bodies pass through each other, and how deep they
//! penetrate. The ways are: without continuous collision detection, with rapier's own, and with certified times.
//!
//! ```sh
//! cargo run --release -p ccd-bench --example physics -- [STEPS]
//! ```

mod glue;
mod judge;
mod worlds;

use anyhow::Result;
use glue::{body_pose, motion_since};
use judge::{StoppedMotion, Tally};
use rigid_ccd::trajectory::Trajectory;
use rigid_ccd::{Motion, Pose, Scene};
use std::io::Write;
use std::num::NonZeroUsize;
use std::time::{Duration, Instant};
use worlds::{WORLDS, World};

/// The way in which a world is stepped.
#[derive(Clone, Copy, PartialEq)]
enum Method {
    /// Steps without continuous collision detection.
    WithoutCcd,
    /// Steps with rapier's own continuous collision detection, enabled for every moving body.
    Rapier,
    /// Steps in which each body stops at its certified first contact.
    CertifiedCcd,
}

const METHODS: [(&str, Method); 3] = [
    ("rapier without CCD", Method::WithoutCcd),
    ("rapier's CCD", Method::Rapier),
    ("certified times", Method::CertifiedCcd),
];

fn main() -> Result<()> {
    let steps = std::env::args().nth(1);
    let steps = steps.map_or(Ok(600), |text| text.parse())?;
    let mut out = std::io::stdout().lock();
    let columns = "world,stepped,steps,passed through,deepest m,stopped,step ms";
    writeln!(out, "{columns}")?;
    for (world, make) in WORLDS {
        for (method, kind) in METHODS {
            let (tally, moves, time) = simulate_world(make(kind == Method::Rapier)?, kind, steps)?;
            let Tally {
                tunneling_count: passed,
                max_penetration_depth: deepest,
                stop_count: stops,
            } = tally;
            let stopped = stops as f64 / moves as f64;
            let millis = 1e3 * time.as_secs_f64() / f64::from(steps);
            writeln!(
                out,
                "{world},{method},{steps},{passed},{deepest:.2e},{stopped:.4},{millis:.3}"
            )?;
        }
    }
    Ok(())
}

/// Steps a world many times, and returns the tally, the number of moving bodies times the number of steps, and the
/// computing time of the steps.
fn simulate_world(
    mut world: World,
    method: Method,
    steps: u32,
) -> Result<(Tally, usize, Duration)> {
    let duration = world.physics.integration_parameters.dt;
    let bodies: Vec<_> = world.bodies.iter().map(|body| body.body.clone()).collect();
    let joined = world.joined_pairs.clone();
    let mut scene =
        Scene::with_threads(NonZeroUsize::MIN).with_filter(|a, b| !joined.contains(&[a, b]));
    let mut moving = Vec::new();
    for (simulated, body) in world.bodies.iter().zip(&bodies) {
        let start = body_pose(&world.physics.bodies[simulated.handle])?;
        if simulated.is_fixed {
            scene.add_fixed(body, start);
        } else {
            moving.push((scene.add(body, Motion::still(start)), simulated.handle));
        }
    }
    let (mut tally, mut time) = (Tally::default(), Duration::ZERO);
    for step in 0..steps {
        (world.step_action)(&mut world, step);
        let bodies = world.bodies.iter();
        let starts = bodies.map(|body| body_pose(&world.physics.bodies[body.handle]));
        let starts: Vec<Pose> = starts.collect::<Result<_>>()?;
        let begun = Instant::now();
        let stops = if method == Method::CertifiedCcd {
            Some(glue::step_to_first_contacts(
                &mut world.physics,
                &mut scene,
                &moving,
            )?)
        } else {
            world.physics.step();
            None
        };
        time += begun.elapsed();
        let moved: Vec<StoppedMotion> = match stops {
            Some(stops) => (0..)
                .zip(stops)
                .map(|(index, stop)| {
                    let motion = scene.movement(index).as_motion();
                    (motion.expect("a step is a motion"), stop.time)
                })
                .collect(),
            None => {
                let bodies = world.bodies.iter().zip(starts);
                let moved = bodies.map(|(body, start)| {
                    let body = &world.physics.bodies[body.handle];
                    Ok((motion_since(start, body, duration)?, duration))
                });
                moved.collect::<Result<_>>()?
            }
        };
        tally.record_step(&world, &moved, duration)?;
    }
    Ok((tally, moving.len() * steps as usize, time))
}
