//! `ccd audit`: certifies motions that another checker has called free, and lists those that are not.

use super::answering::{AnsweredRow, BatchRun};
use super::counts::StatusCounts;
use super::files::{Rows, input_name, open_movement_rows, refuse_overwriting};
use super::numbers::{not_negative, parse_seconds, tolerance};
use super::output::{CannotWrite, Output};
use super::pair::{BodiesArgs, Pair};
use super::progress::Progress;
use super::table::Table;
use super::view::title;
use super::{Exit, print_error};
use crate::batch::{Question, SolverKind, TimedQuestion};
use crate::picture::{Asked, Claim, PageError, Pages, PagesError};
use crate::table::results::{COLUMNS, Line, Status, names};
use anyhow::{Context, Result};
use ccd_core::Settings;
use ccd_core::limits::DEFAULT_BUDGET;
use ccd_file::check_folder;
use clap::Args;
use std::path::PathBuf;
use std::time::Duration;

/// Certify motions that another checker has called free, and list those that are not
#[derive(Clone, Debug, Args)]
#[command(after_help = AFTER_HELP)]
pub(super) struct AuditArgs {
    #[command(flatten)]
    bodies: BodiesArgs,
    /// Table of the motions that were called free, CSV, or of paths if it has a column `t`; - reads standard input
    #[arg(long, value_name = "CSV")]
    motions: PathBuf,
    /// Write the rows that are not free to this file, CSV; - writes to standard output
    #[arg(long, value_name = "CSV", default_value = "-")]
    out: PathBuf,
    /// Write a page for each of these rows to this folder, and its name to column `page`
    #[arg(long, value_name = "FOLDER")]
    pages: Option<PathBuf>,
    /// Write at most N pages
    #[arg(long, value_name = "N", default_value_t = 100, requires = "pages")]
    most_pages: usize,
    /// Report a contact at a distance of at most margin + tolerance, in the scene's unit of length
    #[arg(long, value_name = "LENGTH", default_value_t = DEFAULT_TOLERANCE, value_parser = tolerance, allow_hyphen_values = true)]
    tolerance: f64,
    /// Distance that the checker was to keep between the bodies, in the scene's unit of length
    #[arg(long, value_name = "LENGTH", default_value_t = 0.0, value_parser = not_negative, allow_hyphen_values = true)]
    margin: f64,
    /// Leave a query unresolved after N units of work, of a path after N between two poses; a million takes
    /// about a second
    #[arg(long, value_name = "N", default_value_t = DEFAULT_BUDGET,
          value_parser = clap::value_parser!(u64).range(1..))]
    budget: u64,
    /// Leave a query unresolved after this time, in seconds [default: none]
    #[arg(long, value_name = "SECONDS", value_parser = parse_seconds, allow_hyphen_values = true)]
    deadline: Option<Duration>,
    /// Number of threads; it changes no answer [default: all cores]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
    /// Print only warnings and errors on standard error: no progress, remarks or summary
    #[arg(long, short)]
    quiet: bool,
}

const AFTER_HELP: &str = "\
Examples:
  ccd audit --a gripper.stl --b shelf.stl --motions edges.csv --out missed.csv --pages missed
  ccd audit --a tool.stl --b part.stl --motions toolpath.csv --margin .0005

The table of motions or paths and the columns of the output are those of `ccd query`, see its --help. Rows that are
proven free are counted, and left out. The others are:
  contact, touching, overlapping    missed by the checker: within margin + tolerance; `time` and witnesses tell where
  unresolved                        not proven: a limit was reached; a larger --tolerance decides sooner, a larger
                                    --budget or --deadline takes longer
  error                             no valid motion; column `reason` tells why

Exit code: 0 if all rows are proven free, 3 if some are not, 2 for bad input, 1 if nothing can be written.";

/// The default tolerance, in the scene's unit of length: so small that close passes are not reported as contacts.
const DEFAULT_TOLERANCE: f64 = 1e-6;

/// The name of the column that holds the pages' file names; it follows the columns of the results.
const PAGE_COLUMN: &str = "page";

/// Runs `ccd audit`: certifies all rows of a table.
pub(super) fn run(args: &AuditArgs) -> Result<Exit> {
    let mut read = vec![("--motions", args.motions.clone())];
    read.extend(args.bodies.files()?);
    for (option, path) in &read {
        refuse_overwriting((option, path), ("--out", &args.out))?;
    }
    let (mut rows, length) = open_movement_rows(&args.motions, Question::FirstContact.grouping())?;
    let out = Output::claim_table(&args.out)?;
    let pair = args.bodies.load(SolverKind::default(), args.quiet)?;
    let mut columns = names(&COLUMNS);
    columns.extend(args.pages.as_ref().map(|_| PAGE_COLUMN));
    let (timing, progress) = (timing(args), Progress::of_rows(length, args.quiet));
    let mut audit = Audit {
        args,
        batch_run: BatchRun::new(pair.bodies(), timing, args.threads, &args.motions, progress),
        out: Table::start(out, &columns)?,
        pages: pages(args, &pair)?,
        counts: StatusCounts::default(),
    };
    audit.all(&mut rows)?;
    let exit = audit.finish()?;
    if !args.quiet {
        pair.print_remarks(args.tolerance, &rows);
    }
    Ok(exit)
}

fn timing(args: &AuditArgs) -> TimedQuestion {
    TimedQuestion {
        settings: Settings {
            tolerance: args.tolerance,
            margin: args.margin,
            budget: args.budget,
            deadline: args.deadline,
            ..Settings::DEFAULT
        },
        ..TimedQuestion::default()
    }
}

/// The pages in a folder, and the claim that excludes other processes from the folder.
type PageFolder<'a> = (Pages<'a>, ccd_file::Claim);

fn pages<'a>(args: &AuditArgs, pair: &'a Pair) -> Result<Option<PageFolder<'a>>, CannotWrite> {
    let Some(folder) = &args.pages else {
        return Ok(None);
    };
    let asked = Asked {
        claim: Claim::First,
        margin: args.margin,
        clearance: None,
    };
    // If several folders of the path are missing, only the last one is created.
    let create = || {
        check_folder(folder)?;
        let pages = Pages::create(pair.bodies(), asked, title(&args.bodies), folder)?;
        Ok((pages, ccd_file::Claim::new(folder.join(".pages"))?))
    };
    create()
        .map(Some)
        .map_err(|source| CannotWrite::at(folder, source))
}

struct Audit<'a> {
    args: &'a AuditArgs,
    batch_run: BatchRun<'a>,
    out: Table,
    pages: Option<PageFolder<'a>>,
    counts: StatusCounts,
}

impl Audit<'_> {
    fn all(&mut self, rows: &mut Rows) -> Result<()> {
        loop {
            let Some(batch) = self.batch_run.next(rows, usize::MAX) else {
                return Ok(());
            };
            for row in &batch.rows {
                let answered = self.batch_run.answered_row(row);
                self.record_row(&answered)?;
            }
            self.out.flush()?;
            if let Some(error) = batch.table_error {
                return Err(error).with_context(|| input_name(&self.args.motions));
            }
        }
    }

    /// Counts a row by its status, and writes it unless it is free.
    fn record_row(&mut self, AnsweredRow { course, row, .. }: &AnsweredRow<'_>) -> Result<()> {
        self.counts.add(row.status);
        if row.status == Status::Free {
            return Ok(());
        }
        let page = match (&mut self.pages, course) {
            (Some((pages, _)), Some(course))
                if row.status != Status::Error && pages.count() < self.args.most_pages =>
            {
                page_path(pages.write(course, row))?
            }
            _ => None,
        };
        let line = Line(&COLUMNS, row);
        match &self.args.pages {
            Some(_) => self.out.row(&(line, page))?,
            None => self.out.row(&line)?,
        }
        Ok(())
    }

    fn finish(self) -> Result<Exit> {
        drop(self.batch_run.progress);
        self.out.finish()?;
        self.batch_run.bad_rows.print_total();
        let (rows, free) = (self.counts.rows(), self.counts.of(Status::Free));
        if !self.args.quiet {
            let others = self.counts.nonzero_counts();
            let others: String = others
                .filter(|(status, _)| *status != Status::Free)
                .map(|(status, count)| format!(", {count} {}", status.name()))
                .collect();
            print_error(&format!(
                "{free} of {rows} rows are free: that is proven{others}"
            ));
            if let Some((pages, _)) = self
                .pages
                .filter(|(pages, _)| pages.count() == self.args.most_pages)
            {
                print_error(&format!(
                    "wrote {} pages, and no more: see --most-pages",
                    pages.count()
                ));
            }
        }
        Ok(match (self.counts.of(Status::Error), rows - free) {
            (0, 0) => Exit::AllAnswered,
            (0, _) => Exit::SomeRowsNotFree,
            _ => Exit::SomeRowsBad,
        })
    }
}

/// Returns the path of a page as text; `None` for a row that cannot be drawn.
fn page_path(written: Result<PathBuf, PagesError>) -> Result<Option<String>, CannotWrite> {
    match written {
        Ok(path) => Ok(Some(path.display().to_string())),
        Err(PagesError::Page(PageError::Write { path, source })) => Err(CannotWrite {
            place: path.display().to_string(),
            source,
        }),
        Err(error) => {
            print_error(&error.to_string());
            Ok(None)
        }
    }
}
