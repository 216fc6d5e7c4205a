//! Certifies edges of a motion planner's graph for an arm of seven joints, and compares the result with checks at equal
//! steps.
//!
//! ```sh
//! cargo run --release -p rigid-ccd-robot --example edges -- [EDGES [STEPS]]
//! ```
//! It checks 50 edges, or `EDGES`, among obstacles, with a clearance of 5 mm. Beside the proofs it shows checks at 5 to
//! 1,000 equal steps: how many edges they accept, how fast, and how many of these come nearer than the clearance at
//! one of `STEPS` steps (2,000 by default).

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rigid_ccd::glam::{DQuat, DVec3};
use rigid_ccd::{Body, Pose, Settings, Solver};
use rigid_ccd_robot::{Cell, CellSolver, LinkPairs, PathError, Robot, RobotFile, SkipReason};
use std::error::Error;
use std::io::Write;
use std::path::Path;
use std::time::Instant;

const CLEARANCE: f64 = 0.005;
const OBSTACLE_COUNT: usize = 20;

/// An edge of a planner's graph: its start and its end.
type Edge = [Vec<f64>; 2];

/// Returns whether the arm keeps its clearance at equally spaced configurations of an edge, both ends included.
fn steps_are_free(
    solver: &mut CellSolver<'_>,
    [from, to]: &Edge,
    steps: u32,
) -> Result<bool, PathError> {
    for step in 0..=steps {
        let share = f64::from(step) / f64::from(steps);
        let ends = from.iter().zip(to);
        let at: Vec<f64> = ends.map(|(a, b)| a + share * (b - a)).collect();
        if !solver.is_free(&[at])? {
            return Ok(false);
        }
    }
    Ok(true)
}

/// Returns the arm among random obstacles. Links that nearly touch in the home position are not checked.
fn random_cell(random: &mut Pcg64) -> Result<Cell, Box<dyn Error>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/edges");
    let robot = RobotFile::from_path(folder.join("arm.urdf")).read()?;
    let pairs = pairs_apart_at_home(&robot)?;
    let mut cell = Cell::new(robot, pairs);
    while cell.obstacle_names().len() < OBSTACLE_COUNT {
        let size = [(); 3].map(|()| random.random_range(0.03..0.12));
        let at = DVec3::from_array([(); 3].map(|()| random.random_range(-1.6..1.6)));
        let turn = DVec3::from_array([(); 3].map(|()| random.random_range(-2.0..2.0)));
        // No obstacle stands in the arm's foot.
        if at.length() > 0.5 {
            let pose = Pose::new(at, DQuat::from_scaled_axis(turn))?;
            let name = format!("box {}", cell.obstacle_names().len());
            cell.add_obstacle(name, Body::cuboid(size)?, pose)?;
        }
    }
    Ok(cell)
}

fn pairs_apart_at_home(robot: &Robot) -> Result<LinkPairs, Box<dyn Error>> {
    let home = vec![0.0; robot.free_joint_names().len()];
    let mut pairs = LinkPairs::from_robot(robot);
    let checked: Vec<[usize; 2]> = pairs.checked_pairs().collect();
    for [one, other] in checked {
        let [a, b] = [one, other].map(|link| {
            let link = &robot.links()[link];
            let pose = robot.pose(&link.name, &home)?;
            Ok::<_, Box<dyn Error>>((&*link.bodies[0].body, pose.compose(&link.bodies[0].pose)))
        });
        if Solver::new().distance(a?, b?)?.outcome.lower() <= 0.01 {
            pairs.skip(one, other, SkipReason::Disabled("touch at home".into()));
        }
    }
    Ok(pairs)
}

/// Draws random edges whose start keeps the clearance.
fn random_edges(
    cell: &Cell,
    solver: &mut CellSolver<'_>,
    random: &mut Pcg64,
    count: usize,
) -> Result<Vec<Edge>, PathError> {
    let mut edges = Vec::new();
    while edges.len() < count {
        let limits = cell.robot().limits();
        let from: Vec<f64> = limits
            .map(|[low, high]| random.random_range(low..high))
            .collect();
        let limits = cell.robot().limits().zip(&from);
        let to = limits
            .map(|([low, high], at)| (at + random.random_range(-0.6..0.6)).clamp(low, high))
            .collect();
        if solver.is_free(&[&from])? {
            edges.push([from, to]);
        }
    }
    Ok(edges)
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut args = std::env::args().skip(1).map(|arg| arg.parse::<u32>());
    let count = args.next().transpose()?.unwrap_or(50) as usize;
    let most_steps = args.next().transpose()?.unwrap_or(2_000);
    let mut random = Pcg64::seed_from_u64(1);
    let cell = random_cell(&mut random)?;
    let settings = Settings {
        margin: CLEARANCE,
        ..Settings::DEFAULT
    };
    let mut solver = cell.solver().with_settings(settings.clone());
    let edges = random_edges(&cell, &mut solver, &mut random, count)?;

    let begin = Instant::now();
    let free: Vec<bool> = edges
        .iter()
        .map(|edge| solver.is_free(edge))
        .collect::<Result<_, _>>()?;
    let rate = count as f64 / begin.elapsed().as_secs_f64();

    // Only the steps can disprove a proof. They have no tolerance, with which they would reject a barely kept
    // clearance.
    solver.set_settings(Settings {
        tolerance: 1e-9,
        ..settings
    });
    let touching: Vec<bool> = edges
        .iter()
        .map(|edge| steps_are_free(&mut solver, edge, most_steps).map(|free| !free))
        .collect::<Result<_, _>>()?;
    let mut out = std::io::stdout().lock();
    writeln!(
        out,
        "{count} edges, clearance {CLEARANCE} m, {OBSTACLE_COUNT} obstacles"
    )?;
    writeln!(out, "check           free  edges/s  wrongly accepted")?;
    let mut report = |check: &str, free: &[bool], rate: f64| {
        let accepted = free.iter().filter(|&&free| free).count();
        let wrong = free
            .iter()
            .zip(&touching)
            .filter(|&(&free, &touches)| free && touches);
        let wrong = wrong.count();
        writeln!(out, "{check:<10} {accepted:>9}  {rate:>7.0}  {wrong:>16}")
    };
    report("certified", &free, rate)?;
    for steps in [5, 20, 100, 300, 1_000] {
        let begin = Instant::now();
        let free: Vec<bool> = edges
            .iter()
            .map(|edge| steps_are_free(&mut solver, edge, steps))
            .collect::<Result<_, _>>()?;
        let rate = count as f64 / begin.elapsed().as_secs_f64();
        report(&format!("{steps} steps"), &free, rate)?;
    }
    Ok(())
}
