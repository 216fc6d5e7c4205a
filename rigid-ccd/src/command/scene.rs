//! `ccd scene`: lists which bodies of a scene touch, in order of time.

use super::files::refuse_overwriting;
use super::meshes::MeshArgs;
use super::numbers::{not_negative, tolerance};
use super::output::Output;
use super::pieces::PiecesArgs;
use super::scene_table::{self, SceneArgs};
use super::table::Table;
use super::{Exit, complain};
use crate::picture::scene_verdict;
use crate::scene::{Impact, PairError};
use crate::table::results::Status;
use crate::{Error, Hit};
use anyhow::Result;
use ccd_core::Settings;
use ccd_core::limits::{DEFAULT_BUDGET, DEFAULT_TOLERANCE};
use clap::Args;
use serde::Serialize;
use std::path::PathBuf;

/// List which bodies of a scene touch: when, where, with which features
#[derive(Clone, Debug, Args)]
#[command(after_help = AFTER_HELP)]
pub(super) struct SceneCommandArgs {
    /// Table of the bodies, CSV: `body` as for `ccd query --a`, and px, vx, ... as in a table of motions
    #[arg(value_name = "CSV")]
    scene: PathBuf,
    #[command(flatten)]
    meshes: MeshArgs,
    #[command(flatten)]
    pieces: PiecesArgs,
    /// End of all motions [default: 1]
    #[arg(long, value_name = "TIME", value_parser = not_negative, allow_hyphen_values = true)]
    duration: Option<f64>,
    /// Report a contact at a distance of at most margin + tolerance, in the scene's unit of length
    #[arg(long, value_name = "LENGTH", default_value_t = DEFAULT_TOLERANCE, value_parser = tolerance, allow_hyphen_values = true)]
    tolerance: f64,
    /// Distance to keep between the bodies, in the scene's unit of length
    #[arg(long, value_name = "LENGTH", default_value_t = 0.0, value_parser = not_negative, allow_hyphen_values = true)]
    margin: f64,
    /// Leave a pair unresolved after N units of work; a million takes about a second
    #[arg(long, value_name = "N", default_value_t = DEFAULT_BUDGET,
          value_parser = clap::value_parser!(u64).range(1..))]
    budget: u64,
    /// Write the table of contacts to this file, CSV; - writes to standard output
    #[arg(long, value_name = "CSV", default_value = "-")]
    out: PathBuf,
    /// Print only warnings and errors on standard error: no progress, remarks or summary
    #[arg(long, short)]
    quiet: bool,
}

const AFTER_HELP: &str = "\
Examples:
  printf 'body,id,px,vx\\nsphere:.5,ball,-3,4\\n\"box:.5,1,1\",wall,0,0\\n' > balls.csv; ccd scene balls.csv
  ccd scene scene.csv --duration 0.5 --out contacts.csv
  ccd view --scene scene.csv --duration 0.5

Table of a scene: a row for each body.
  body,id,px,py,pz,vx,vz,wy
  part.obj,lid,0,0,2,0,-1,3
  \"box:1,1,0.1\",table,0,0,0,0,0,0

Table of contacts: a row for each pair that touches, in order of time.
  a, b              ids of both bodies
  status            contact, touching or overlapping at the start; unresolved: a limit was reached, and nothing
                    touches before `time`; error: no valid motion, see `reason`
  time, ...         as in the results of `ccd query`: bounds of the distance, normal, witnesses, features, reason
Pairs that are not listed are proven free.

Exit code: 0 if every pair has an answer, 2 for bad input, 1 if nothing can be written.";

const COLUMNS: [&str; 18] = [
    "a",
    "b",
    "status",
    "time",
    "distance_lower",
    "distance_upper",
    "normal_x",
    "normal_y",
    "normal_z",
    "witness_a_x",
    "witness_a_y",
    "witness_a_z",
    "witness_b_x",
    "witness_b_y",
    "witness_b_z",
    "feature_a",
    "feature_b",
    "reason",
];

/// One row, in the order of [`COLUMNS`]; cells that do not apply are empty.
#[derive(Serialize)]
struct Row<'a> {
    a: &'a str,
    b: &'a str,
    status: Status,
    time: Option<f64>,
    distance: [Option<f64>; 2],
    normal: [Option<f64>; 3],
    witnesses: [Option<f64>; 6],
    features: [Option<String>; 2],
    reason: Option<String>,
}

/// Runs `ccd scene`.
pub(super) fn run(args: &SceneCommandArgs) -> Result<Exit> {
    refuse_overwriting(("the scene", &args.scene), ("--out", &args.out))?;
    let table = scene_table::read(
        &args.scene,
        SceneArgs {
            meshes: &args.meshes,
            pieces: &args.pieces,
            duration: args.duration,
        },
    )?;
    if !args.quiet {
        table.report(args.tolerance);
    }
    for (option, path) in table.files() {
        refuse_overwriting((option, path), ("--out", &args.out))?;
    }
    let out = Output::claim_table(&args.out)?;
    let settings = Settings {
        tolerance: args.tolerance,
        margin: args.margin,
        budget: args.budget,
        ..Settings::DEFAULT
    };
    let contacts = table.contacts(settings);
    if !args.quiet {
        complain(&scene_verdict(&table.shown(), &contacts, table.duration));
    }
    let ids: Vec<&str> = table.ids().collect();
    let mut out = Table::start(out, &COLUMNS)?;
    let mut exit = Exit::AllAnswered;
    for contact in &contacts {
        let row = Row::new(&ids, contact);
        if row.status == Status::Error {
            exit = Exit::SomeRowsBad;
        }
        out.write(|writer| writer.serialize(row))?;
    }
    out.finish()?;
    Ok(exit)
}

impl<'a> Row<'a> {
    fn new(ids: &[&'a str], contact: &Result<Impact, PairError>) -> Self {
        match contact {
            Ok(Impact { bodies, hit }) => Row::touching(bodies.map(|k| ids[k]), hit),
            Err(PairError { bodies, error }) => {
                let (status, time, reason) = match error {
                    Error::Unresolved(known) => {
                        let (until, limit) = (known.safe_until, known.limit);
                        (Status::Unresolved, Some(until), limit.to_string())
                    }
                    error => (Status::Error, None, error.to_string()),
                };
                Row {
                    time,
                    reason: Some(reason),
                    ..Row::empty(bodies.map(|k| ids[k]), status)
                }
            }
        }
    }

    fn touching(ids: [&'a str; 2], hit: &Hit) -> Self {
        let status = Status::from(&hit.kind);
        let [[ax, ay, az], [bx, by, bz]] =
            [hit.witness_a(), hit.witness_b()].map(|witness| witness.to_array());
        let row = Row {
            time: Some(hit.time),
            witnesses: [ax, ay, az, bx, by, bz].map(Some),
            ..Row::empty(ids, status)
        };
        // Without pieces that intersect, one body is inside the other.
        let Some(contact) = hit.contact() else {
            return row;
        };
        let separation = &contact.separation;
        Row {
            distance: [separation.lower, separation.upper].map(Some),
            normal: separation.normal.to_array().map(Some),
            features: [contact.feature_a, contact.feature_b].map(|f| Some(f.to_string())),
            ..row
        }
    }

    fn empty([a, b]: [&'a str; 2], status: Status) -> Self {
        Row {
            a,
            b,
            status,
            time: None,
            distance: [None; 2],
            normal: [None; 3],
            witnesses: [None; 6],
            features: [None, None],
            reason: None,
        }
    }
}
