//! The command `ccd-bench falsify`: searches for the smallest scene at which each method fails.

use super::chart::chosen;
use super::print_summary;
use super::stability::all_methods;
use crate::falsify::{Aim, Hunt, Report, table, write_gallery};
use crate::method::Method;
use crate::method::guarded::Programs;
use anyhow::{Context, Result};
use clap::Args;
use rayon::prelude::*;
use rigid_ccd::command::{Exit, Progress, Total};
use std::collections::BTreeMap;
use std::fs;
use std::num::{NonZeroU32, NonZeroUsize};
use std::path::PathBuf;
use std::sync::{Mutex, PoisonError};
use std::time::Duration;

/// Search for the smallest scene at which each method fails
#[derive(Debug, Args)]
#[command(after_help = AFTER_HELP)]
pub(super) struct FalsifyArgs {
    /// Only these methods
    #[arg(long, value_name = "NAME", value_delimiter = ',')]
    methods: Vec<String>,
    /// Only these kinds of failures
    #[arg(long, value_delimiter = ',', default_values_t = Aim::ALL)]
    aims: Vec<Aim>,
    /// The scenes to try, for each method and kind of failure
    #[arg(long, value_name = "N", default_value = "2000")]
    tries: NonZeroUsize,
    /// The failures to make small; the smallest is kept
    #[arg(long, value_name = "N", default_value = "5")]
    finds: NonZeroUsize,
    /// The seed of the search
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// The script that runs Coal and FCL, which adds their methods: scripts/peers.py
    #[arg(long, value_name = "SCRIPT")]
    peers: Option<PathBuf>,
    /// Seconds that a query may take
    #[arg(long, value_name = "SECONDS", default_value = "1")]
    patience: NonZeroU32,
    /// Write the failures to this folder
    #[arg(long, value_name = "DIR", default_value = "target/ccd-failures")]
    out: PathBuf,
}

const AFTER_HELP: &str = "\
The search draws two small meshes and their motions, and changes them step by step toward a failure: a
contact that is late or missed, a contact that is early, a query without an end. What fails is made small:
the fewest triangles and round numbers that still fail. Every answer is judged by an independent referee.

The table: judged are the queries with an exact answer, left out those without one or refused. Nearest to one
is how near the search came: the share of the tolerance that was left before a late contact, the distance at an
early contact in units of the tolerance, or the most steps or microseconds.

Files: gallery.md has each failure and the command that repeats it, index.html shows it in three dimensions;
each failure has a folder with its meshes and motions.

Examples:
  ccd-bench falsify
  ccd-bench falsify --methods 'C2A,parry-f64' --aims late
  ccd-bench falsify --methods 'best-first direct' --tries 1000000 --seed 7";

pub(super) fn run(args: &FalsifyArgs) -> Result<Exit> {
    let methods = chosen(
        all_methods(args.peers.as_deref()),
        &args.methods,
        "method",
        Method::to_string,
    )?;
    let hunts: Vec<Hunt> = methods
        .iter()
        .flat_map(|&method| args.aims.iter().map(move |&aim| (method, aim)))
        .map(|(method, aim)| Hunt {
            method,
            aim,
            tries: args.tries.get(),
            finds: args.finds.get(),
            seed: args.seed,
            patience: Duration::from_secs(args.patience.get().into()),
        })
        .collect();
    fs::create_dir_all(&args.out).with_context(|| args.out.display().to_string())?;
    // No other search writes to the folder meanwhile.
    let claim = ccd_file::Claim::new(args.out.join("gallery.md"));
    let _claim = claim.with_context(|| args.out.display().to_string())?;
    let progress = Progress::new(Total::Steps(args.tries.get() * hunts.len()));
    let programs = Programs {
        script: args.peers.clone(),
    };
    for &method in &methods {
        programs.check(method).with_context(|| method.to_string())?;
    }
    // In the order of the searches. Whatever is found is written at once, in case the rest takes too long.
    let reports = Mutex::new(BTreeMap::new());
    let searched: Result<()> = hunts.par_iter().enumerate().try_for_each(|(number, hunt)| {
        let name = format!("{} {}", hunt.method, hunt.aim);
        progress.say(&name);
        let report = hunt.run(&programs, &progress).context(name)?;
        let mut reports = reports.lock().unwrap_or_else(PoisonError::into_inner);
        reports.insert(number, report);
        let so_far: Vec<Report> = reports.values().cloned().collect();
        write_gallery(&so_far, &args.out, args.peers.as_deref())
    });
    searched?;
    drop(progress);
    let reports = reports.into_inner().unwrap_or_else(PoisonError::into_inner);
    let reports: Vec<Report> = reports.into_values().collect();
    print_summary(&table(&reports))?;
    Ok(Exit::AllAnswered)
}
