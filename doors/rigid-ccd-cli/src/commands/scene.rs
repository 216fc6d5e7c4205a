//! `ccd scene`: lists which bodies of a scene touch, in order of time.

use crate::bodies::meshes::MeshArgs;
use crate::bodies::scene_table;
use crate::console::{RunOutcome, print_error};
use crate::files::output::Output;
use crate::files::table::TableWriter;
use crate::options::numbers::{parse_nonnegative, tolerance};
use crate::picture::scene_verdict;
use anyhow::Result;
use ccd_core::Settings;
use ccd_core::limits::{DEFAULT_BUDGET, DEFAULT_TOLERANCE};
use ccd_tables::results::{Line, ResultRow, Status, names, reordered_columns};
use clap::Args;
use rigid_ccd::Error;
use rigid_ccd::scene::{Impact, PairError};
use std::path::PathBuf;

/// List which bodies of a scene touch: when, where, with which features
#[derive(Clone, Debug, Args)]
#[command(after_help = AFTER_HELP)]
pub(crate) struct SceneCommandArgs {
    /// Table of the bodies, CSV or Parquet; - reads CSV from standard input. Column `body` is as in `ccd query --a`,
    /// columns px, vx, ... as in a table of motions
    #[arg(value_name = "TABLE")]
    scene: PathBuf,
    #[command(flatten)]
    meshes: MeshArgs,
    /// Time at which all motions end [default: 1]
    #[arg(long, value_name = "TIME", value_parser = parse_nonnegative, allow_hyphen_values = true)]
    duration: Option<f64>,
    /// Report a contact at a distance of at most margin + tolerance, in the scene's unit of length
    #[arg(long, value_name = "LENGTH", default_value_t = DEFAULT_TOLERANCE, value_parser = tolerance, allow_hyphen_values = true)]
    tolerance: f64,
    /// Distance to keep between the bodies, in the scene's unit of length
    #[arg(long, value_name = "LENGTH", default_value_t = 0.0, value_parser = parse_nonnegative, allow_hyphen_values = true)]
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

/// The columns of a query's results that the table of `ccd scene` omits.
const OMITTED_COLUMNS: &[&str] = &["id", "iterations", "oracle_calls", "micros"];

/// Runs `ccd scene`: finds the contacts of the bodies in a scene, and writes the table of contacts.
pub(crate) fn run(args: &SceneCommandArgs) -> Result<RunOutcome> {
    let table = scene_table::read(
        ("the scene", &args.scene),
        (&args.meshes, args.duration),
        &args.out,
    )?;
    if !args.quiet {
        table.print_load_report(args.tolerance);
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
        let bodies = table.bodies_to_draw();
        print_error(&scene_verdict(&bodies, &contacts, table.duration));
    }
    let ids: Vec<&str> = table.ids().collect();
    let columns = reordered_columns(&[], OMITTED_COLUMNS);
    let header = [vec!["a", "b"], names(&columns)].concat();
    let mut out = TableWriter::start(out, &header)?;
    let mut exit = RunOutcome::AllAnswered;
    for contact in &contacts {
        let bodies = match contact {
            Ok(impact) => impact.bodies,
            Err(error) => error.bodies,
        };
        let row = row(contact);
        if row.status == Status::Error {
            exit = RunOutcome::SomeRowsBad;
        }
        out.add_row(&(bodies.map(|body| ids[body]), Line(&columns, &row)))?;
    }
    out.finish()?;
    Ok(exit)
}

/// Returns the row of the table of results for the contact or error of a pair.
fn row(contact: &Result<Impact, PairError>) -> ResultRow {
    match contact.as_ref().map_err(|pair| &pair.error) {
        Ok(impact) => ResultRow::from_hit(&impact.hit),
        Err(Error::Unresolved(known)) => ResultRow {
            status: Status::Unresolved,
            time: Some(known.safe_until),
            reason: Some(known.limit.to_string()),
            ..ResultRow::default()
        },
        Err(error) => ResultRow {
            reason: Some(error.to_string()),
            ..ResultRow::default()
        },
    }
}
