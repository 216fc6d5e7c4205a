//! Changes proofs, meshes and trees at random, and writes the forgeries with the checker's verdicts. Another checker can then be
//! compared with these verdicts.

#![allow(clippy::print_stdout, reason = "the example prints figures")]

mod files;
mod kinds;
mod scenes;
mod truth;

use anyhow::{Result, ensure};
use clap::Parser;
use files::Random;
use kinds::KINDS;
use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::PathBuf;

/// Forge proofs at random, check them, and write them with the verdicts
///
/// `proofs/ccd-check/second_opinion/forgeries.py FILE` checks the forgeries, and counts for each kind where both checkers agree.
#[derive(Parser)]
struct Args {
    /// The file to write
    file: PathBuf,
    /// The number of forgeries
    #[arg(long, default_value_t = 10_000)]
    count: usize,
    #[arg(long, default_value_t = 1)]
    seed: u64,
}

fn main() -> Result<()> {
    let args = Args::parse();
    let mut random = Random(args.seed);
    let scenes = scenes::all(&mut random)?;
    for (number, scene) in scenes.iter().enumerate() {
        ensure!(
            scene.verdict() == b'h' && truth::is_true(scene),
            "proof {number} does not hold, or is false, before it is forged"
        );
    }
    let mut out = BufWriter::new(File::create(&args.file)?);
    let mut counts = [[0usize; 4]; KINDS.len()];
    for number in 0..args.count {
        let kind = number % KINDS.len();
        // Some changes cannot be made to each proof, for example to the witness of a proof without one.
        let forged = loop {
            let scene = &scenes[random.below(scenes.len())];
            let mut forged = scene.clone();
            (KINDS[kind].1)(&mut random, &mut forged, &scenes);
            if forged != *scene {
                break forged;
            }
        };
        let verdict = forged.verdict();
        let is_true = truth::is_true(&forged);
        counts[kind][0] += 1;
        counts[kind][1] += usize::from(verdict == b'h');
        counts[kind][2] += usize::from(!is_true);
        counts[kind][3] += usize::from(verdict == b'h' && !is_true);
        forged.write(&mut out, KINDS[kind].0, verdict, is_true)?;
    }
    out.flush()?;
    for ((name, _), [all, held, seen_false, false_held]) in KINDS.iter().zip(counts) {
        println!(
            "{name}: {all} forged, {held} hold; {seen_false} false by samples, {false_held} of these hold"
        );
    }
    let false_held: usize = counts.iter().map(|[.., false_held]| false_held).sum();
    ensure!(false_held == 0, "{false_held} false statements hold");
    Ok(())
}
