//! Measures the interface: what it costs over Rust, and whether a gate keeps its deadlines.
//!
//! Folders are as `ccd-bench/scripts/robot_edges/data.py` describes them. Pin the process: `taskset -c 1`, or `-c 0,1` for two
//! threads.

#![allow(clippy::print_stdout, reason = "figures are its output")]
#![allow(unsafe_code, reason = "it calls the interface as C does")]

mod folder;
mod gate;
mod noise;
mod pairs;
mod same;
mod tally;

use clap::Parser;
use std::path::PathBuf;

/// Measure the C interface
#[derive(Parser)]
enum Command {
    /// Compare each answer with that of Rust, bit by bit, and the times of both
    Same {
        /// A folder of meshes, motions (`knots.csv`, …) and certified answers
        #[arg(long)]
        scenes: Option<PathBuf>,
        /// A folder with a robot, cells and edges
        #[arg(long)]
        arms: Option<PathBuf>,
        /// A folder of the meshes of its cells
        #[arg(long, default_value = ".")]
        meshes: PathBuf,
        /// How often each row is asked; the least time counts
        #[arg(long, default_value_t = 5)]
        repeat: usize,
    },
    /// Check chunks of waypoints under a deadline, on several threads
    Gate(gate::Args),
    /// Ask about two bodies under a deadline
    Pairs(pairs::Args),
    /// Do nothing until a deadline: how late the machine is by itself
    Noise(noise::Args),
}

fn main() -> anyhow::Result<()> {
    match Command::parse() {
        Command::Same {
            scenes,
            arms,
            meshes,
            repeat,
        } => {
            if let Some(folder) = scenes {
                same::compare_scenes(&folder, repeat)?;
            }
            if let Some(folder) = arms {
                same::compare_edges(&folder, &meshes, repeat)?;
            }
            Ok(())
        }
        Command::Gate(args) => gate::run(&args),
        Command::Pairs(args) => pairs::run(&args),
        Command::Noise(args) => noise::run(&args),
    }
}
