//! `ccd query`: reads two bodies and a table of motions, and writes a table of results.

mod args;
mod help;
mod run;
mod summary;

pub(crate) use args::QueryArgs;

use args::UNRECORDED_OPTIONS;

use crate::bodies::pair::Pair;
use crate::commands::view::{ChosenRows, title, write_rows_page};
use crate::console::progress::Progress;
use crate::console::{RunOutcome, print_error};
use crate::files::output::Output;
use crate::files::{Rows, input_name, open_movement_rows, refuse_shared_files};
use crate::options::solver_kind::{BoundKind, ScheduleKind, SolverKind};
use crate::picture::{Painter, QueryContext, TimeMeaning};
use crate::rows::bad_rows::BadRowCounter;
use crate::rows::certificates::PairCertificates;
use crate::rows::resumable::{
    self, ClaimedFiles, FILE_CHECKSUM_PREFIX, OpenedTables, RunFiles, answer_in_batches,
    option_values, options_text,
};
use crate::rows::timed::TimedQuestion;
use anyhow::{Result, bail};
use ccd_core::{Settings, StartPolicy};
use ccd_tables::batch::{BatchSize, parallel_solver};
use ccd_tables::paths::Grouping;
use ccd_tables::results::names;
use clap::ArgMatches;
use rigid_ccd::Question;
use run::QueryRun;
use std::io::{self, Write};
use std::iter::once;
use std::num::NonZeroUsize;
use summary::Summary;

/// Runs `ccd query`: answers all valid rows; an invalid row gets the status `error` and a reason.
pub(crate) fn run(args: &QueryArgs, matches: &ArgMatches) -> Result<RunOutcome> {
    refuse_shared_query_files(args)?;
    refuse_options_unfit_for_each_other(args)?;
    let (mut rows, length) =
        open_movement_rows(&args.motions, Grouping::of_question(args.question))?;
    refuse_options_unfit_for_paths(args, &rows)?;
    let files = run_files(args);
    let claimed = ClaimedFiles::claim(&files)?;
    let html = args.html.as_deref().map(Output::claim).transpose()?;
    let pair = args.bodies.load(method(args), args.quiet)?;
    let certificates = args.certificates.as_deref();
    let certificates = certificates
        .map(|folder| {
            let settings = timed_question_from_args(args).settings;
            PairCertificates::new(folder, pair.bodies(), settings)
        })
        .transpose()?;
    let (mut outputs, earlier) =
        match OpenedTables::new(&files, claimed, &recorded_options(args, matches, &pair))? {
            OpenedTables::Unfinished(outputs, earlier) => (*outputs, earlier),
            OpenedTables::Finished(end) => {
                warn_of_partial_page(args);
                resumable::check_finished(&files, &mut rows, end)?;
                if let Some(certificates) = &certificates {
                    certificates.begin_or_resume(Some(end))?;
                }
                if !args.quiet {
                    let summary = Summary::new(args.tolerance).with_earlier_counts(end.counts);
                    print_summary(args, &summary);
                }
                return Ok(resumable::report_outcome(&files, end));
            }
        };
    if let Some(certificates) = &certificates {
        certificates.begin_or_resume(earlier)?;
    }
    if args.resume {
        if earlier.is_some() {
            warn_of_partial_page(args);
        }
        resumable::report(&files, earlier);
    }
    let start = resumable::skip_rows(&files, &mut rows, earlier)?;
    outputs.save(start)?;
    let timing = timed_question_from_args(args);
    if timing.method.motion_bound == BoundKind::Published {
        print_error("--bound published: times are not certified, contacts may be late or missed");
    }
    let solver = parallel_solver(args.threads, || timing.method.solver());
    let mut run = QueryRun {
        args,
        bodies: pair.bodies(),
        timed_question: timing,
        batch_size: BatchSize::new(solver.threads()),
        solver,
        bad_rows: BadRowCounter::new(input_name(&args.motions)),
        progress: Progress::for_rows(length, args.quiet),
        outputs,
        certificates,
        html_rows: args
            .html
            .as_ref()
            .map(|_| ChosenRows::new(args.html_ids.clone())),
        summary: Summary::new(args.tolerance).with_earlier_counts(start.counts),
    };
    let end = answer_in_batches(&files, &mut rows, start, &mut run)?;
    run.outputs.finish(end)?;
    drop(run.progress);
    run.bad_rows.print_total();
    let page_outcome = write_page(args, &pair, run.html_rows.zip(html))?;
    if run.summary.counts.row_count() == 0 && earlier.is_none() {
        resumable::warn_of_no_rows(&files, start);
    }
    if !args.quiet {
        print_summary(args, &run.summary);
        pair.print_remarks(args.tolerance, &rows);
    }
    Ok(resumable::report_outcome(&files, end).max(page_outcome))
}

/// Returns the files of the run.
fn run_files(args: &QueryArgs) -> RunFiles<'_> {
    RunFiles {
        input: &args.motions,
        rows: args.rows,
        out: &args.out,
        header: names(&args.columns()),
        contacts: args.contacts.as_deref(),
        resume: args.resume,
        check: args.check,
        quiet: args.quiet,
    }
}

/// Warns, if `--html` is given, that the page of a resumed run shows only the rows answered in this run.
fn warn_of_partial_page(args: &QueryArgs) {
    if args.html.is_some() {
        print_error(
            "--html: shows the rows that this run answers; `ccd view --results` shows the rows of earlier runs",
        );
    }
}

/// Writes the HTML page of the chosen rows, if `--html` is given.
fn write_page(
    args: &QueryArgs,
    pair: &Pair,
    page: Option<(ChosenRows, Output)>,
) -> Result<RunOutcome> {
    let Some((chosen_rows, html)) = page else {
        return Ok(RunOutcome::AllAnswered);
    };
    let painter = Painter::new(pair.bodies(), page_context(args));
    write_rows_page(
        (&title(&args.bodies), painter),
        chosen_rows,
        html,
        args.quiet,
    )
}

/// Returns what a page needs to describe the answers: the meaning of times, the margin and the clearance.
fn page_context(args: &QueryArgs) -> QueryContext {
    let time_meaning = match (args.bound, args.question) {
        (Some(BoundKind::Published), _) => TimeMeaning::UncertifiedFirstContact,
        (_, Question::AnyContact) => TimeMeaning::SomeContact,
        (_, Question::Distance) => TimeMeaning::MeasurementTime,
        _ if ignores_start_contacts(args) => TimeMeaning::FirstContactAfterParting,
        (_, Question::FirstContact | Question::ContactInterval | Question::ClosestApproach) => {
            TimeMeaning::FirstContact
        }
    };
    QueryContext {
        time_meaning,
        query_margin: args.margin,
        clearance: args.clearance,
    }
}

/// Refuses an output that is also an input or another output.
fn refuse_shared_query_files(args: &QueryArgs) -> Result<()> {
    let mut read = vec![("--motions", args.motions.clone())];
    read.extend(args.bodies.files_with_options()?);
    let mut written = vec![("--out", args.out.as_path())];
    written.extend(args.html.iter().map(|path| ("--html", path.as_path())));
    written.extend(
        args.contacts
            .iter()
            .map(|path| ("--contacts", path.as_path())),
    );
    let read = read.iter().map(|(option, path)| (*option, path.as_path()));
    refuse_shared_files(read, &written)
}

/// Refuses `--bound` for a schedule that uses no bound on the motion, options that do not apply to the question of
/// `--question`, and `--check` with options under which no answer is a proof.
fn refuse_options_unfit_for_each_other(args: &QueryArgs) -> Result<()> {
    let question = args.question;
    if let Some(bound) = args.bound
        && !args.schedule.uses_velocity_bound()
    {
        bail!("--bound {bound} needs --schedule fast or naive");
    }
    if args.clearance.is_some() && !question.is_for_a_distance() {
        bail!(
            "--clearance needs --question closest-approach or distance; --margin keeps a distance otherwise"
        );
    }
    if args.margin > 0.0 && question.is_for_a_distance() {
        bail!(
            "--question {question} measures distances without a margin; use --clearance instead of --margin"
        );
    }
    if args.contacts.is_some() && !question.has_single_contact_time() {
        bail!("--contacts needs --question first-contact or is-free");
    }
    if args.certificates.is_some() {
        if !question.has_single_contact_time() {
            bail!("--certificates needs --question first-contact or is-free");
        }
        if ignores_start_contacts(args) {
            bail!(
                "--certificates needs --start report: bodies that touch at the start are not apart"
            );
        }
    }
    if question != Question::FirstContact && args.schedule != ScheduleKind::BestFirst {
        bail!("--question {question} needs --schedule best-first");
    }
    if ignores_start_contacts(args) && !question.has_single_contact_time() {
        bail!("--start leave needs --question first-contact or is-free");
    }
    if args.check && args.bound == Some(BoundKind::Published) {
        bail!("--check needs certified answers, which --bound published does not give");
    }
    if args.check && question.is_for_a_distance() && args.clearance.is_none() {
        bail!(
            "--check needs --clearance with --question {question}: a distance alone is neither good nor bad"
        );
    }
    Ok(())
}

/// Refuses options for tables of motions if the table contains paths.
fn refuse_options_unfit_for_paths(args: &QueryArgs, rows: &Rows) -> Result<()> {
    if rows.is_path_table() && args.schedule != ScheduleKind::BestFirst {
        bail!(
            "--schedule {} needs a table of motions, not of paths",
            args.schedule
        );
    }
    if rows.is_path_table() && args.certificates.is_some() {
        bail!("--certificates needs a table of motions, not of paths");
    }
    if rows.is_path_table() && ignores_start_contacts(args) {
        bail!("--start leave needs a table of motions, not of paths");
    }
    Ok(())
}

fn ignores_start_contacts(args: &QueryArgs) -> bool {
    args.start == StartPolicy::Leave
}

/// Returns the version, the options and the bodies' checksums that determine the tables of the run. The checksum of the
/// motions is in each checkpoint.
fn recorded_options(args: &QueryArgs, matches: &ArgMatches, pair: &Pair) -> String {
    let version = ("ccd".to_owned(), env!("CARGO_PKG_VERSION").to_owned());
    let checksums = (pair.checksums.iter())
        .map(|(option, checksum)| (format!("{FILE_CHECKSUM_PREFIX}{option}"), checksum.clone()));
    let options = option_values::<QueryArgs>(matches, &UNRECORDED_OPTIONS).into_iter();
    let rows = ("--rows".to_owned(), args.rows.to_string());
    options_text(once(version).chain(options).chain([rows]).chain(checksums))
}

fn method(args: &QueryArgs) -> SolverKind {
    SolverKind {
        schedule: args.schedule,
        oracle: args.oracle,
        motion_bound: args.bound.unwrap_or_default(),
    }
}

fn timed_question_from_args(args: &QueryArgs) -> TimedQuestion {
    TimedQuestion {
        question: args.question,
        method: method(args),
        settings: Settings {
            tolerance: args.tolerance,
            margin: args.margin,
            clearance: args.clearance,
            start_policy: args.start,
            budget: args.budget,
            deadline: args.deadline,
            ..Settings::DEFAULT
        },
        repetitions: NonZeroUsize::new(args.repeat as usize).unwrap_or(NonZeroUsize::MIN),
    }
}

fn print_summary(args: &QueryArgs, summary: &Summary) {
    let prefix = match args.bound {
        Some(BoundKind::Published) => "not certified: ",
        Some(BoundKind::Sound) | None => "",
    };
    let _ = writeln!(io::stderr(), "{prefix}{summary}");
    if let (true, Some(means)) = (args.counters, summary.describe_means()) {
        let _ = writeln!(io::stderr(), "{means}");
    }
}
