//! The command `ccd-bench judge`: runs one method, and compares its answers with the exact ones.

use super::inputs::QueryTableArgs;
use crate::method::Method;
use crate::method::guarded::{GuardedMethod, GuardedMethodSettings, MethodPrograms};
use crate::method::rival::to_screw_motions;
use crate::method::solver::ContactClaim;
use crate::run::contest::{judge, judge_outcome};
use crate::truth::{Surface, TruthRow, TruthSolver};
use anyhow::{Context, Result, anyhow};
use clap::Args;
use rigid_ccd_cli::{
    BadRowCounter, Progress, RunOutcome, TableWriter, input_name, open_motions, tolerance,
};
use std::num::NonZeroU32;
use std::path::PathBuf;
use std::time::Duration;

/// Ask one method about a table of motions, and judge its answers by the exact ones
#[derive(Debug, Args)]
#[command(after_help = AFTER_HELP)]
pub(super) struct JudgeArgs {
    /// The name of the method, as in the tables
    #[arg(long, value_name = "NAME")]
    method: String,
    #[command(flatten)]
    input: QueryTableArgs,
    /// The tolerance, in the scene's unit of length
    #[arg(long, value_name = "LENGTH", default_value = "1e-3", value_parser = tolerance)]
    tolerance: f64,
    #[command(flatten)]
    programs: MethodPrograms,
    /// Seconds that the method may take for a query before it is stopped
    #[arg(long, value_name = "SECONDS", default_value = "3")]
    patience: NonZeroU32,
    /// The table of verdicts, CSV; - writes to standard output
    #[arg(long, value_name = "CSV", default_value = "-")]
    out: PathBuf,
}

const AFTER_HELP: &str = "\
The method runs in a process of its own, which is stopped when its time is over. The exact answers are those
of `ccd-bench truth`, with its statuses. The columns: id, status, lo and hi of the exact answer, the verdict, the answer, its time.

Example:
  ccd-bench judge --method C2A --a a.obj --b b.obj --motions motions.csv";

const VERDICT_COLUMNS: [&str; 7] = ["id", "status", "lo", "hi", "verdict", "answer", "time"];

pub(super) fn run(args: &JudgeArgs) -> Result<RunOutcome> {
    let name = &args.method;
    let method = Method::from_name(name).ok_or_else(|| anyhow!("there is no method `{name}`"))?;
    let meshes = args.input.meshes.read_meshes()?;
    let surfaces = meshes.each_ref().map(Surface::new);
    let referee = TruthSolver::new(&surfaces[0], &surfaces[1]);
    let setting = GuardedMethodSettings::new(method, args.tolerance);
    let guarded = GuardedMethod::start(&args.programs, setting, meshes.each_ref());
    let mut guarded = guarded.with_context(|| name.clone())?;
    let mut table = TableWriter::create(&args.out, &VERDICT_COLUMNS)?;
    let mut bad_rows = BadRowCounter::new(input_name(&args.input.motions));
    let (rows, _) = open_motions(&args.input.motions)?;
    for row in rows {
        let query = match row.with_context(|| input_name(&args.input.motions))? {
            Ok((_, query)) => query,
            Err(error) => {
                bad_rows.report(error.position, &error.problem, &Progress::new_hidden());
                continue;
            }
        };
        let query = if method.moves_along_screws() {
            to_screw_motions(&query)?
        } else {
            query
        };
        let truth = referee.first_contact(&query);
        let asked = guarded.run_query(&query, Duration::from_secs(args.patience.get().into()))?;
        let verdict = judge_outcome(&asked, |reply| {
            let tolerance = reply.judging_tolerance(args.tolerance);
            judge(&referee, &query, truth, reply.claim, tolerance)
        });
        let verdict = verdict.verdict.to_string();
        let claim = asked.reply().map(|reply| reply.claim);
        let (answer, time) = (
            claim.map_or("none", ContactClaim::status),
            claim.and_then(ContactClaim::contact_or_safe_time),
        );
        let truth = TruthRow::new(query.id.clone(), query.duration, truth);
        table.write_row(|writer| writer.serialize((truth, verdict, answer, time)))?;
    }
    table.finish()?;
    bad_rows.print_total();
    Ok(match bad_rows.count() {
        0 => RunOutcome::AllAnswered,
        _ => RunOutcome::SomeRowsBad,
    })
}
