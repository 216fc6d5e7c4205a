//! Writes the motions of the scenes of shots and drops, as stored in `scenes/`: `cargo run
//! --example record_shots -- ccd-bench/scenes`.

use ccd_bench::scene::{Shots, drops_past_board};
use rigid_ccd::table::motions::{Motions, write};
use std::fs::File;
use std::path::Path;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = std::env::args()
        .nth(1)
        .ok_or("say which folder to write to")?;
    let put = |name: &str, queries: &[Motions]| {
        write(File::create(Path::new(&folder).join(name))?, queries)
    };
    put("santa.csv", &drops_past_board(100, 1)?)?;
    put("bunnies.csv", &bunnies().queries()?)?;
    let knots = knots().queries()?;
    put("knots.csv", &knots)?;
    // Every tenth row keeps the proportion of both kinds of motion.
    let few: Vec<Motions> = knots.into_iter().step_by(10).collect();
    put("small-knots.csv", &few)?;
    Ok(())
}

/// Returns shots of a bunny past or at a resting one.
fn bunnies() -> Shots {
    Shots {
        count: 250,
        translations: 100,
        distance: 2.6..3.2,
        aside: 1.6,
        seed: 2,
    }
}

/// Returns shots of a torus knot past, at or through a resting one.
fn knots() -> Shots {
    Shots {
        count: 250,
        translations: 100,
        distance: 3.0..3.8,
        aside: 2.3,
        seed: 3,
    }
}
