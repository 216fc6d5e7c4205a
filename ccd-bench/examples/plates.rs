//! Drops a plate of 8,192 triangles flat onto a parallel one: every triangle of one plate meets
//! some triangle of the other at the same time.
//!
//! Prints the median time of a query for several tolerances: `cargo run --release -p ccd-bench
//! --example plates`.

use anyhow::ensure;
use ccd_bench::scene::model::Plate;
use ccd_core::glam::{DQuat, DVec3};
use ccd_core::schedule::{BestFirst, Schedule};
use ccd_core::{Config, Motion, Moving, Outcome, Pose, Problem};
use ccd_decomp::{Detail, body_from_mesh};
use ccd_distance_gjk::Direct;
use std::io::Write;
use std::time::Instant;

const REPEATS: usize = 51;

fn main() -> anyhow::Result<()> {
    let plate = Plate {
        half_side: 1.0,
        squares: 64,
    };
    let body = body_from_mesh(&plate.mesh()?, Detail::Triangles)?.body;
    let mut out = std::io::stdout().lock();
    writeln!(out, "tolerance,turned,time,iterations,oracle_calls,micros")?;
    for tolerance in [1e-3, 1e-6, 1e-7, 1e-9] {
        for turned in [0.0, 0.3] {
            // The plates are shifted a little against each other, so that no edge lies on another.
            let above = Pose::new(
                DVec3::new(0.013, 0.007, 1.0),
                DQuat::from_rotation_z(turned),
            )?;
            let falling = Moving {
                body: &body,
                motion: Motion::new(above, -2.0 * DVec3::Z, DVec3::ZERO)?,
            };
            let lying = Moving {
                body: &body,
                motion: Motion::still(Pose::IDENTITY),
            };
            let config = Config {
                tolerance,
                ..Config::default()
            };
            let (mut schedule, mut oracle) = (BestFirst::<Direct>::default(), Direct::default());
            let mut micros = Vec::new();
            let mut last = None;
            for _ in 0..REPEATS {
                let start = Instant::now();
                let problem = Problem::new(falling, lying, 1.0, &config)?;
                last = Some(schedule.solve(&problem, &mut oracle));
                micros.push(start.elapsed().as_secs_f64() * 1e6);
            }
            micros.sort_by(f64::total_cmp);
            let Some((answer, Outcome::Contact { time, .. })) = last.map(|a| (a, a.outcome)) else {
                anyhow::bail!("no contact: {last:?}");
            };
            // They meet after half the time. The answer must not be later, nor earlier than the
            // tolerance allows.
            ensure!(time <= 0.5 && time >= 0.5 - 0.5 * tolerance, "{time}");
            writeln!(
                out,
                "{tolerance:e},{turned},{time},{},{},{:.1}",
                answer.stats.iterations,
                answer.stats.oracle_calls,
                micros[REPEATS / 2]
            )?;
        }
    }
    Ok(())
}
