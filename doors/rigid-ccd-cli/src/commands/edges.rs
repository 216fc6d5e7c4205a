//! `ccd edges`: answers a question about each edge or path of a robot in a table.

mod args;

pub(crate) use args::EdgesArgs;

use crate::console::progress::Progress;
use crate::console::{RunOutcome, print_remarks};
use crate::files::output::OutputError;
use crate::files::{input_name, refuse_shared_files};
use crate::robots::path_table::{PathTable, TablePath};
use crate::rows::bad_rows::BadRowCounter;
use crate::rows::certificates::CellCertificates;
use crate::rows::counts::StatusCounts;
use crate::rows::raised_tolerances::RaisedTolerances;
use crate::rows::resumable::{
    self, Batches, Checkpoint, ClaimedFiles, FILE_CHECKSUM_PREFIX, OpenedTables, Outputs, RunFiles,
    answer_in_batches, option_values, options_text,
};
use crate::rows::time_histogram::TimeHistogram;
use crate::rows::timed::microseconds;
use anyhow::{Context, Result, bail};
use args::UNRECORDED_OPTIONS;
use ccd_core::StartPolicy;
use ccd_tables::batch::{BatchSize, parallel_solver};
use ccd_tables::motions::RowError;
use ccd_tables::path_rows::{self, PathQuestion, PathRow};
use ccd_tables::results::{Column, Line, ResultRow, Status, names};
use clap::ArgMatches;
use rigid_ccd::{ParallelSolver, Question, Settings};
use rigid_ccd_robot::{Cell, CellRemark, CellSolver, Robot};
use std::iter::once;
use std::time::Instant;

/// Runs `ccd edges`: answers all valid rows; an invalid row gets the status `error` and a reason.
pub(crate) fn run(args: &EdgesArgs, matches: &ArgMatches) -> Result<RunOutcome> {
    let inputs = args.cell.files().chain([("--edges", args.edges.as_path())]);
    refuse_shared_files(inputs, &[("--out", &args.out)])?;
    if args.check && args.question == Question::ClosestApproach && args.clearance == 0.0 {
        bail!(
            "--check needs --clearance with --question closest-approach: a distance alone is neither good nor bad"
        );
    }
    if args.question == Question::ClosestApproach && args.start == StartPolicy::Leave {
        bail!("--start leave is for --question is-free and first-contact");
    }
    let columns = args.columns();
    let files = RunFiles {
        input: &args.edges,
        rows: args.rows,
        out: &args.out,
        header: names(&columns),
        contacts: None,
        resume: args.resume,
        check: args.check,
        quiet: args.quiet,
    };
    let claimed = ClaimedFiles::claim(&files)?;
    let cell = args.cell.load(args.quiet)?;
    print_remarks(cell.remark_on_tolerance(args.tolerance));
    let (mut table, length) = PathTable::open("--edges", &args.edges, cell.robot(), &args.joints)
        .with_context(|| input_name(&args.edges))?;
    let certificates = args
        .certificates
        .as_deref()
        .map(|folder| CellCertificates::new(folder, &cell, args.settings()));
    let certificates = certificates.transpose()?;
    let options = recorded_options(args, matches, &cell)?;
    let (mut outputs, earlier) = match OpenedTables::new(&files, claimed, &options)? {
        OpenedTables::Unfinished(outputs, earlier) => (*outputs, earlier),
        OpenedTables::Finished(end) => {
            resumable::check_finished(&files, &mut table, end)?;
            if let Some(certificates) = &certificates {
                certificates.begin_or_resume(Some(end))?;
            }
            return Ok(resumable::report_outcome(&files, end));
        }
    };
    if let Some(certificates) = &certificates {
        certificates.begin_or_resume(earlier)?;
    }
    if args.resume {
        resumable::report(&files, earlier);
    }
    let start = resumable::skip_rows(&files, &mut table, earlier)?;
    outputs.save(start)?;
    let solver = parallel_solver(args.threads, || {
        cell.solver().with_settings(args.settings())
    });
    let mut run = EdgesRun {
        args,
        robot: cell.robot(),
        remark: None,
        columns,
        batch_size: BatchSize::new(solver.threads()),
        solver,
        bad_rows: BadRowCounter::new(input_name(&args.edges)),
        progress: Progress::for_rows(length, args.quiet),
        outputs,
        certificates,
        counts: start.counts,
        times: TimeHistogram::default(),
        raised_tolerances: RaisedTolerances::new(args.tolerance),
    };
    let end = answer_in_batches(&files, &mut table, start, &mut run)?;
    let remark = table.remark_on_degrees();
    let EdgesRun {
        outputs,
        progress,
        bad_rows,
        times,
        raised_tolerances,
        remark: remark_on_radians,
        ..
    } = run;
    outputs.finish(end)?;
    drop(progress);
    print_remarks(remark);
    print_remarks(remark_on_radians);
    bad_rows.print_total();
    if end.counts.row_count() == 0 && earlier.is_none() {
        resumable::warn_of_no_rows(&files, start);
    }
    if !args.quiet {
        print_summary(end, &times, &raised_tolerances);
    }
    Ok(resumable::report_outcome(&files, end))
}

/// The state of a run while it answers rows.
struct EdgesRun<'a> {
    args: &'a EdgesArgs,
    robot: &'a Robot,
    /// A remark on the first position that seems to be in degrees.
    remark: Option<CellRemark>,
    columns: Vec<Column>,
    solver: ParallelSolver<CellSolver<'a>>,
    batch_size: BatchSize,
    bad_rows: BadRowCounter,
    progress: Progress,
    outputs: Outputs,
    certificates: Option<CellCertificates<'a>>,
    counts: StatusCounts,
    times: TimeHistogram,
    raised_tolerances: RaisedTolerances,
}

impl Batches<Result<TablePath, RowError>> for EdgesRun<'_> {
    fn row_count(&self) -> usize {
        self.batch_size.row_count()
    }

    fn begin(&mut self, row_count: usize, end_byte: u64) {
        self.progress.begin_batch(row_count, end_byte);
    }

    fn answer_and_write(
        &mut self,
        paths: &[Result<TablePath, RowError>],
    ) -> Result<(), OutputError> {
        if self.remark.is_none() {
            let mut paths_read = paths.iter().flatten();
            self.remark = paths_read.find_map(|path| path.remark(self.robot));
        }
        let (args, progress) = (self.args, &self.progress);
        let start = Instant::now();
        let rows = self.solver.map(paths, |solver, path| {
            let answer = match path {
                Ok(path) => answer(args, solver, path),
                Err(error) => PathRow::from(ResultRow::error(&error.id, &error.problem)),
            };
            progress.step();
            answer
        });
        self.batch_size.adapt(start.elapsed());
        for (path, answer) in paths.iter().zip(rows) {
            if answer.row.status != Status::Error {
                self.raised_tolerances.add(answer.tolerance);
            }
            self.write(path, answer.row)?;
        }
        self.prove_and_write(paths)
    }

    fn counts(&self) -> (usize, StatusCounts) {
        (self.bad_rows.count(), self.counts)
    }

    fn save(&mut self, checkpoint: Checkpoint) -> Result<(), OutputError> {
        self.outputs.save(checkpoint)
    }
}

impl EdgesRun<'_> {
    /// Writes the proofs of paths. A path that cannot be proven counts as bad.
    fn prove_and_write(
        &mut self,
        paths: &[Result<TablePath, RowError>],
    ) -> Result<(), OutputError> {
        let Some(certificates) = &self.certificates else {
            return Ok(());
        };
        let paths: Vec<&TablePath> = paths.iter().filter_map(|path| path.as_ref().ok()).collect();
        for batch in paths.chunks(PROVEN_BATCH_ROWS) {
            let proven = self.solver.map(batch, |solver, path| {
                certificates.prove(solver, &path.configurations)
            });
            for (path, proofs) in batch.iter().zip(proven) {
                match proofs {
                    Ok(proofs) => {
                        for (segment, proof) in proofs {
                            let row = (path.position.row, segment);
                            certificates.folder.write_proof(row, &path.id, &proof)?;
                        }
                    }
                    Err(error) => {
                        let problem = format!("certificate: {error}");
                        self.bad_rows
                            .report(path.position, &problem, &self.progress);
                    }
                }
            }
        }
        Ok(())
    }

    fn write(
        &mut self,
        path: &Result<TablePath, RowError>,
        mut row: ResultRow,
    ) -> Result<(), OutputError> {
        self.counts.add(row.status);
        if let Some(micros) = row.micros {
            self.times.add(micros);
        }
        if row.status == Status::Error {
            let position = match path {
                Ok(path) => path.position,
                Err(error) => error.position,
            };
            let problem = row.reason.clone().unwrap_or_default();
            self.bad_rows.report(position, &problem, &self.progress);
        }
        row.micros = row.micros.filter(|_| !self.args.no_micros);
        self.outputs.results.add_row(&Line(&self.columns, &row))
    }
}

/// The number of paths whose proofs are in memory at the same time.
const PROVEN_BATCH_ROWS: usize = 64;

/// Answers the question about a path, and measures the time.
fn answer(args: &EdgesArgs, solver: &mut CellSolver<'_>, path: &TablePath) -> PathRow {
    let start = Instant::now();
    let question = PathQuestion {
        question: args.question,
        clearance: Some(args.clearance).filter(|&clearance| clearance > 0.0),
    };
    let answer = question.answer(solver, &path.configurations);
    let micros = microseconds(start.elapsed());
    let row = answer.row;
    PathRow {
        row: ResultRow {
            id: path.id.clone(),
            time: row.time.map(|time| path.table_time_rounded_down(time)),
            micros: Some(micros).filter(|_| row.status != Status::Error),
            ..row
        },
        ..answer
    }
}

/// Returns the version, the options and the checksums of the files that determine the table. The checksum of the edges
/// is in each checkpoint.
fn recorded_options(args: &EdgesArgs, matches: &ArgMatches, cell: &Cell) -> Result<String> {
    let version = ("ccd".to_owned(), env!("CARGO_PKG_VERSION").to_owned());
    let options = option_values::<EdgesArgs>(matches, &UNRECORDED_OPTIONS);
    let rows = ("--rows".to_owned(), args.rows.to_string());
    let mut checksums = Vec::new();
    for (option, file) in args.cell.files() {
        let bytes = ccd_file::read(file).with_context(|| file.display().to_string())?;
        let checksum = format!("{:08x}", crc32fast::hash(&bytes));
        checksums.push((format!("{FILE_CHECKSUM_PREFIX}{option}"), checksum));
    }
    let meshes = format!("{:08x}", checksum_of_bodies(cell)?);
    checksums.push((format!("{FILE_CHECKSUM_PREFIX}meshes"), meshes));
    Ok(options_text(
        once(version).chain(options).chain([rows]).chain(checksums),
    ))
}

/// Returns the checksum of the joints and of the pieces of all bodies. It does not depend on the names of files.
fn checksum_of_bodies(cell: &Cell) -> Result<u32> {
    let at_rest = cell.robot().configuration_nearest_zero();
    let mut sum = crc32fast::Hasher::new();
    sum.update(format!("{:?} {:?}", cell.robot().joints(), cell.link_pairs()).as_bytes());
    for (_, body, _) in cell.placed_bodies(&at_rest)? {
        for piece in body.pieces().iter() {
            sum.update(&piece.radius.to_le_bytes());
            for point in piece.points {
                for coordinate in point.to_array() {
                    sum.update(&coordinate.to_le_bytes());
                }
            }
        }
    }
    Ok(sum.finalize())
}

fn print_summary(end: Checkpoint, times: &TimeHistogram, raised_tolerances: &RaisedTolerances) {
    let mut text = end.counts.to_string();
    if times.count() > 0 {
        text += &format!(
            "; median {:.1} µs, mean {:.1} µs",
            times.median(),
            times.mean()
        );
    }
    text += &raised_tolerances.to_string();
    for line in text.lines() {
        crate::console::print_escaped_to_stderr(line);
    }
}

impl EdgesArgs {
    fn columns(&self) -> Vec<Column> {
        path_rows::columns(self.question)
    }

    /// Returns the settings of a question. A closest approach measures distances without a margin.
    fn settings(&self) -> Settings {
        let margin = match self.question {
            Question::ClosestApproach => 0.0,
            _ => self.clearance,
        };
        Settings {
            tolerance: self.tolerance,
            margin,
            deadline: self.deadline,
            start_policy: self.start,
            ..Settings::DEFAULT
        }
    }
}
