//! Certifies random edges for a seven-joint arm on all cores, and compares the result with checks at discrete steps.
//!
//! ```sh
//! cargo run --release -p rigid-ccd-robot --example edges -- [EDGES]
//! ```
//! Checks 50 edges, or `EDGES`, among 20 boxes, with a clearance of 5 mm. `ccd acm` wrote the SRDF file.

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rigid_ccd::glam::{DQuat, DVec3};
use rigid_ccd::{Body, ParallelSolver, Pose, Settings};
use rigid_ccd_robot::{Cell, RobotFile};
use std::{error::Error, path::Path, time::Instant};

#[allow(clippy::print_stdout, reason = "an example prints its results")]
fn main() -> Result<(), Box<dyn Error>> {
    let count = std::env::args().nth(1).map_or(Ok(50), |arg| arg.parse())?;
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/edges");
    let file = RobotFile::from_path(folder.join("arm.urdf"));
    let robot = file.read()?;
    let pairs = file.link_pairs(&robot, Some(&folder.join("arm.srdf")))?;
    let mut cell = Cell::new(robot, pairs);
    let mut random = Pcg64::seed_from_u64(1);
    for k in 0..20 {
        let size = [(); 3].map(|()| random.random_range(0.03..0.12));
        let (height, turn) = (
            random.random_range(-1.0..1.6),
            random.random_range(-3.0..3.0),
        );
        let turned = DQuat::from_rotation_z(turn);
        let pose = Pose::new(turned * DVec3::new(0.8, 0.0, height), turned)?;
        cell.add_obstacle(format!("box {k}"), Body::cuboid(size)?, pose)?;
    }
    let settings = Settings {
        margin: 0.005,
        tolerance: 1e-5,
        ..Settings::DEFAULT
    };
    let mut solver = ParallelSolver::new(|| cell.solver().with_settings(settings.clone()));

    // Each edge starts at a collision-free configuration, and each of its joints turns by at most 0.6 radians.
    let mut edges: Vec<[Vec<f64>; 2]> = Vec::new();
    while edges.len() < count {
        let mut edge = [Vec::new(), Vec::new()];
        for [low, high] in cell.robot().limits() {
            let from = random.random_range(low..high);
            edge[0].push(from);
            edge[1].push((from + random.random_range(-0.6..0.6)).clamp(low, high));
        }
        if cell.solver().is_free(&edge[..1])? {
            edges.push(edge);
        }
    }

    let begin = Instant::now();
    let certified = solver.map(&edges, |solver, edge| solver.is_free(edge));
    let took = begin.elapsed();
    let certified: Vec<bool> = certified.into_iter().collect::<Result<_, _>>()?;
    let free = certified.iter().filter(|free| **free).count();
    println!("{free} of {count} edges are free: {took:.1?}");
    for steps in [5, 20, 100] {
        let begin = Instant::now();
        let free = solver.map(&edges, |solver, [from, to]| {
            (0..=steps).all(|step| {
                let fraction = f64::from(step) / f64::from(steps);
                let joints = from.iter().zip(to);
                let at: Vec<f64> = joints.map(|(a, b)| a + fraction * (b - a)).collect();
                matches!(solver.is_free(&[at]), Ok(true))
            })
        });
        let took = begin.elapsed();
        let pairs = free.iter().zip(&certified);
        let more = pairs.filter(|(free, certified)| **free && !**certified);
        println!("{steps} steps accept {} more: {took:.1?}", more.count());
    }
    Ok(())
}
