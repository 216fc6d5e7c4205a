//! Certifies edges of a motion planner's graph for an arm of seven joints, and compares the result with checks at equal
//! steps.
//!
//! ```sh
//! cargo run --release -p rigid-ccd --example arm -- [EDGES [STEPS]]
//! ```
//! It checks 50 edges, or `EDGES`, among obstacles, with a clearance of 5 mm. Beside the proofs it shows checks at 5 to
//! 1,000 equal steps: how many edges they accept, how fast, and how many of these come nearer than the clearance at
//! one of `STEPS` steps (2,000 by default).

#[path = "scene.rs"]
mod scene;

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rigid_ccd::{Error, Motion, Settings, Solver};
use scene::Scene;
use std::io::Write;
use std::path::Path;
use std::time::Instant;

const CLEARANCE: f64 = 0.005;
const OBSTACLE_COUNT: usize = 20;

/// Returns whether the arm is free of contact while each joint moves from its position in `from` to that in `to`.
fn edge_is_free(
    solver: &mut Solver,
    scene: &Scene,
    from: &[f64],
    to: &[f64],
) -> Result<bool, Error> {
    for (k, link) in scene.links.iter().enumerate() {
        let moves = scene.chain.link(k, from, to, 1.0)?;
        for (obstacle, stands) in &scene.obstacles {
            if !solver.is_free((link, &moves), (obstacle, stands), 1.0)? {
                return Ok(false);
            }
        }
        for &other in &scene.tested_links[k] {
            let (seen, other) = (moves.seen_from(other)?, &scene.links[other]);
            if !solver.is_free((link, &seen), (other, &Motion::STILL), 1.0)? {
                return Ok(false);
            }
        }
    }
    Ok(true)
}

/// Returns whether the arm is free of contact at equally spaced poses of an edge, both ends included.
fn steps_are_free(
    solver: &mut Solver,
    scene: &Scene,
    from: &[f64],
    to: &[f64],
    steps: u32,
) -> Result<bool, Error> {
    for step in 0..=steps {
        let share = f64::from(step) / f64::from(steps);
        let at: Vec<f64> = from
            .iter()
            .zip(to)
            .map(|(a, b)| a + share * (b - a))
            .collect();
        let poses = (0..scene.links.len()).map(|k| scene.chain.pose(k, &at).map(Motion::still));
        let poses: Vec<Motion> = poses.collect::<Result<_, _>>()?;
        for (k, link) in scene.links.iter().enumerate() {
            let a = (link, poses[k]);
            for (obstacle, stands) in &scene.obstacles {
                if !solver.is_free(a, (obstacle, *stands), 0.0)? {
                    return Ok(false);
                }
            }
            for &other in &scene.tested_links[k] {
                if !solver.is_free(a, (&scene.links[other], poses[other]), 0.0)? {
                    return Ok(false);
                }
            }
        }
    }
    Ok(true)
}

/// Draws random edges of the graph whose start is free of contact.
fn draw_random_edges(
    scene: &Scene,
    solver: &mut Solver,
    random: &mut Pcg64,
    count: usize,
) -> Result<Vec<[Vec<f64>; 2]>, Error> {
    let mut edges = Vec::new();
    while edges.len() < count {
        let joints = scene.chain.joints().iter();
        let from: Vec<f64> = joints
            .clone()
            .map(|joint| random.random_range(*joint.limits().start()..*joint.limits().end()))
            .collect();
        let to = joints
            .zip(&from)
            .map(|(joint, at)| {
                let limits = joint.limits();
                (at + random.random_range(-0.6..0.6)).clamp(*limits.start(), *limits.end())
            })
            .collect();
        if steps_are_free(solver, scene, &from, &from, 1)? {
            edges.push([from, to]);
        }
    }
    Ok(edges)
}

fn main() -> anyhow::Result<()> {
    let args: Vec<usize> = std::env::args()
        .skip(1)
        .map(|arg| arg.parse())
        .collect::<Result<_, _>>()?;
    let count = args.first().copied().unwrap_or(50);
    let most_steps = args.get(1).map_or(2_000, |&steps| steps as u32);
    let mut random = Pcg64::seed_from_u64(1);
    let urdf = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/arm/arm.urdf");
    let scene = Scene::load(&urdf, OBSTACLE_COUNT, &mut random)?;
    let config = Settings {
        margin: CLEARANCE,
        tolerance: 1e-3,
        ..Settings::DEFAULT
    };
    let mut solver = Solver::new().with_settings(config.clone());
    let edges = draw_random_edges(&scene, &mut solver, &mut random, count)?;
    let mut out = std::io::stdout().lock();

    let begin = Instant::now();
    let mut free = Vec::new();
    for [from, to] in &edges {
        free.push(edge_is_free(&mut solver, &scene, from, to)?);
    }
    let taken = begin.elapsed().as_secs_f64();
    let accepted = free.iter().filter(|&&free| free).count();
    writeln!(
        out,
        "{count} edges, clearance {CLEARANCE} m, {OBSTACLE_COUNT} obstacles"
    )?;
    writeln!(out, "check            free  edges/s  wrongly accepted")?;
    let rate = count as f64 / taken;

    // Only the steps can disprove a proof. They have no tolerance, with which they would reject a barely kept
    // clearance.
    let sharp = Settings {
        tolerance: 1e-9,
        ..config
    };
    solver.set_settings(sharp);
    let mut wrong = 0;
    let mut contact = vec![false; count];
    for (k, [from, to]) in edges.iter().enumerate() {
        contact[k] = !steps_are_free(&mut solver, &scene, from, to, most_steps)?;
        wrong += u32::from(free[k] && contact[k]);
    }
    writeln!(out, "certified  {accepted:>10}  {rate:>7.0}  {wrong:>16}")?;
    for steps in [5, 20, 100, 300, 1_000] {
        let begin = Instant::now();
        let (mut accepted, mut wrong) = (0, 0);
        for (k, [from, to]) in edges.iter().enumerate() {
            let free = steps_are_free(&mut solver, &scene, from, to, steps)?;
            accepted += u32::from(free);
            wrong += u32::from(free && contact[k]);
        }
        let rate = count as f64 / begin.elapsed().as_secs_f64();
        writeln!(
            out,
            "{steps:>5} steps  {accepted:>9}  {rate:>7.0}  {wrong:>16}"
        )?;
    }
    Ok(())
}
