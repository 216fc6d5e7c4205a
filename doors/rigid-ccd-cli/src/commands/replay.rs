//! `ccd replay`: asks recorded questions again, and says whether the recorded answers hold.

use crate::console::causes::message_with_causes;
use crate::console::{RunOutcome, print_error};
use crate::files::input_name;
use crate::files::output::print_line;
use crate::robots::loading::CellArgs;
use anyhow::{Context, Result};
use clap::Args;
use rigid_ccd_robot::Cell;
use rigid_ccd_robot::evidence::{Evidence, RecordedAnswer, Replay, Verdict};
use std::path::{Path, PathBuf};

/// Ask recorded questions about a robot again, and say whether the recorded answers hold
#[derive(Clone, Debug, Args)]
#[command(mut_arg("urdf", |urdf| urdf.required(true)), after_help = AFTER_HELP)]
pub(crate) struct ReplayArgs {
    #[command(flatten)]
    cell: CellArgs,
    /// Record of an answer, JSON; may be given several times
    #[arg(long, value_name = "JSON", required = true)]
    record: Vec<PathBuf>,
    /// Print only warnings and errors on standard error
    #[arg(long, short)]
    quiet: bool,
}

const AFTER_HELP: &str = "\
A record comes from rccd_evidence_write in C, or from evidence::Evidence in Rust. It holds a path, settings, an answer, and
digests of all bodies of the cell; the robot and the cell that are given have to be the same.

Verdicts:
  same answer   the answer is the same in every bit
  holds         nothing touches up to the point to which the record calls the path free, within a thousandth of the tolerance;
                the answer differs because the record ended at a limit, or is of another machine or version
  refuted       something touches before that point
  undecided     a limit was reached

Exit code: 0 if all records hold, 3 if one is refuted or undecided, 2 for bad input and for another cell.

Examples:
  ccd replay arm.urdf --cell cell.toml --record stop.json";

/// Runs `ccd replay`.
pub(crate) fn run(args: &ReplayArgs) -> Result<RunOutcome> {
    let cell = args.cell.load(args.quiet)?;
    let mut outcome = RunOutcome::AllAnswered;
    for path in &args.record {
        let name = input_name(path);
        let (record, replay) = match read_and_replay(&cell, path) {
            Ok(replayed) => replayed,
            Err(error) => {
                print_error(&message_with_causes(&error.context(name)));
                outcome = outcome.max(RunOutcome::SomeRowsBad);
                continue;
            }
        };
        let line = format!("{name}: {}", describe(&record, &replay));
        print_line(&line)?;
        if matches!(replay.verdict, Verdict::Refuted { .. } | Verdict::Undecided) {
            outcome = outcome.max(RunOutcome::SomeRowsUnproven);
        }
    }
    Ok(outcome)
}

fn read_and_replay(cell: &Cell, path: &Path) -> Result<(Evidence, Replay)> {
    let text = ccd_file::read_to_string(path).context("cannot read it")?;
    let record = Evidence::from_json(&text)?;
    let replay = record.replay(cell)?;
    Ok((record, replay))
}

/// Describes the recorded answer, and the verdict of the replay.
fn describe(record: &Evidence, replay: &Replay) -> String {
    let verdict = match replay.verdict {
        Verdict::SameAnswer => "same answer".to_owned(),
        Verdict::Holds => format!("holds; without the limit: {}", answer_text(&replay.answer)),
        Verdict::Refuted { at } => {
            format!(
                "refuted: touches in segment {} at {}",
                at.segment, at.fraction
            )
        }
        Verdict::Undecided => format!("undecided: {}", answer_text(&replay.answer)),
    };
    format!(
        "{} by {}; {verdict}",
        answer_text(&record.answer),
        record.library
    )
}

fn answer_text(answer: &RecordedAnswer) -> String {
    match answer {
        RecordedAnswer::Free => "free".to_owned(),
        RecordedAnswer::Contact {
            segment,
            fraction,
            items: [a, b],
        } => format!("contact of {a} and {b} in segment {segment} at {fraction}"),
        RecordedAnswer::Unresolved {
            limit,
            segment,
            fraction,
        } => format!("unresolved ({limit}), free until segment {segment} at {fraction}"),
    }
}
