//! `ccd query`: two bodies and a table of motions in, a table of results out.

mod args;
mod journal;
mod limits;
mod outputs;
mod pair;
mod summary;

pub(super) use args::QueryArgs;

use super::bad_rows::BadRows;
use super::files::CannotWrite;
use super::files::{Motions, input_name, is_standard, open_motions, refuse_overwriting};
use super::{Exit, complain};
use crate::batch::{Bodies, BoundKind, PairSolver, Settings, SolverKind, Threads, Timed};
use crate::command::progress::{Progress, Total};
use crate::table::contacts;
use crate::table::motions::{MotionRow, Query, RowError, RowPosition, RowProblem, TableError};
use crate::table::results::{self, Extent, ResultRow};
use anyhow::{Context, Result, bail};
use ccd_core::Config;
use ccd_decomp::BodySource;
use journal::{CONTENT, Mark, Settings as Asked};
use outputs::{Opened, Outputs};
use pair::Pair;
use std::io::{self, Write};
use std::num::NonZeroUsize;
use summary::Summary;

/// Answers all rows that can be; of the others the results say why not.
pub(super) fn run(args: &QueryArgs) -> Result<Exit> {
    check(args)?;
    let (mut rows, length) = open_motions(&args.motions)?;
    let pair = Pair::load(args)?;
    let (mut outputs, left) = match Opened::new(args, &asked(args, &pair))? {
        Opened::Begun(outputs) => (outputs, None),
        Opened::GoesOn(outputs, left) => (outputs, Some(left)),
        Opened::Whole(mark) => return leave(args, &mut rows, mark),
    };
    if args.resume {
        tell_resumed(args, left);
    }
    let begun = begin(args, &mut rows, left)?;
    outputs.keep(begun)?;
    let settings = settings(args);
    if settings.method.bound == BoundKind::Published {
        complain("--bound published: times are not certified, contacts may be late or missed");
    }
    let threads = Threads::new(args.threads.and_then(|n| NonZeroUsize::new(n.into())))?;
    let mut work = Work {
        args,
        bodies: pair.bodies(),
        config: settings.config,
        solver: PairSolver::new(pair.bodies(), settings, &threads),
        threads,
        outputs,
        summary: Summary::new(args.tolerance).going_on(begun.counts),
        bad_rows: BadRows::new(input_name(&args.motions)),
        progress: match args.quiet {
            true => Progress::hidden(),
            false => Progress::new(length.map_or(Total::Unknown, Total::Bytes)),
        },
    };
    let end = work.through(&mut rows, begun)?;
    work.outputs.finish(end)?;
    drop(work.progress);
    work.bad_rows.close();
    if work.summary.rows() == 0 && left.is_none() {
        tell_nothing(args, begun.rows);
    }
    if !args.quiet {
        summarise(args, &work.summary);
    }
    Ok(verdict(end))
}

fn verdict(end: Mark) -> Exit {
    match end.bad {
        0 => Exit::AllAnswered,
        _ => Exit::SomeRowsBad,
    }
}

/// Refuses what does not go together.
fn check(args: &QueryArgs) -> Result<()> {
    let mut read = vec![("--motions", args.motions.clone())];
    for (option, text) in [("--a", &args.a), ("--b", &args.b)] {
        let source: BodySource = text.parse().context(option)?;
        read.extend(pair::file(&source).map(|path| (option, path.to_owned())));
    }
    for (option, path) in &read {
        refuse_overwriting((option, path), ("--out", &args.out))?;
        if let Some(contacts) = &args.contacts {
            refuse_overwriting((option, path), ("--contacts", contacts))?;
        }
    }
    if let Some(contacts) = &args.contacts {
        if is_standard(contacts) && is_standard(&args.out) {
            bail!("--contacts - and --out - are both standard output; give one of them a file");
        }
        refuse_overwriting(("--out", &args.out), ("--contacts", contacts))?;
        refuse_overwriting(("--contacts", contacts), ("--out", &args.out))?;
    }
    if let Some(bound) = args.bound
        && !args.schedule.uses_a_bound()
    {
        bail!(
            "--bound {bound} is for schedules that take one step for all; give it --schedule fast or \
             naive"
        );
    }
    Ok(())
}

/// All that the tables depend on but the motions.
fn asked(args: &QueryArgs, pair: &Pair) -> Asked {
    let own = |(option, value): (&str, String)| (option.to_owned(), value);
    let mut asked = vec![own(("ccd", env!("CARGO_PKG_VERSION").to_owned()))];
    asked.extend(args.asked().into_iter().map(own));
    for (option, checksum) in &pair.checksums {
        asked.push((format!("{CONTENT}{option}"), checksum.clone()));
    }
    Asked(asked)
}

fn tell_resumed(args: &QueryArgs, left: Option<Mark>) {
    match left {
        Some(_) if args.quiet => {}
        Some(Mark { rows, .. }) => {
            complain(&format!("--resume: goes on with row {rows} of the motions"));
        }
        None => complain("--resume: there is nothing to go on with; begins at the beginning"),
    }
}

/// Nothing is left to do, if the motions are those that the finished run was given.
fn leave(args: &QueryArgs, rows: &mut Motions, whole: Mark) -> Result<Exit> {
    let (input, out) = (input_name(&args.motions), args.out.display());
    let passed = rows.pass(whole.rows).with_context(|| input.clone())?;
    let same = (passed, rows.checksum()) == (whole.rows, whole.checksum);
    let more = args.rows.end.is_none_or(|end| whole.rows < end);
    if !same || more && rows.pass(1).with_context(|| input.clone())? > 0 {
        bail!(
            "--resume: {input}: not the rows that the finished run was given; give it the same, or leave \
             out --resume to begin again"
        );
    }
    if !args.quiet {
        complain(&format!(
            "--resume: {out} has all rows of this query already and is left as it is"
        ));
        summarise(args, &Summary::new(args.tolerance).going_on(whole.counts));
    }
    Ok(verdict(whole))
}

/// Passes over the rows that are not asked for, or done with.
fn begin(args: &QueryArgs, rows: &mut Motions, left: Option<Mark>) -> Result<Mark> {
    let input = || input_name(&args.motions);
    let wanted = left.map_or(args.rows.start, |left| left.rows);
    let passed = rows.pass(wanted).with_context(input)?;
    let checksum = rows.checksum();
    match left {
        Some(left) if (passed, checksum) != (left.rows, left.checksum) => bail!(
            "--resume: {}: not the rows that the interrupted run was given; give it the same, or \
             delete {}.partial to begin again",
            input(),
            args.out.display()
        ),
        Some(left) => Ok(left),
        None => Ok(Mark {
            rows: passed,
            checksum,
            ..Mark::default()
        }),
    }
}

/// There is no row: bad_rows, since it is hardly what was meant.
fn tell_nothing(args: &QueryArgs, passed: usize) {
    let input = input_name(&args.motions);
    match args.rows.is_all() {
        true => complain(&format!("{input}: has a header, but no rows")),
        false => complain(&format!(
            "{input}: none of its {passed} rows is in --rows {}",
            args.rows
        )),
    }
}

/// A run, row by row.
struct Work<'a> {
    args: &'a QueryArgs,
    bodies: Bodies<'a>,
    config: Config,
    solver: PairSolver<'a>,
    threads: Threads,
    outputs: Outputs,
    summary: Summary,
    bad_rows: BadRows,
    progress: Progress,
}

impl Work<'_> {
    /// Answers the rows from there on; says how far that is.
    fn through(&mut self, rows: &mut Motions, begun: Mark) -> Result<Mark> {
        let mut mark = begun;
        loop {
            let left = self
                .args
                .rows
                .end
                .map_or(usize::MAX, |end| end.saturating_sub(mark.rows));
            let size = self.threads.batch().min(left);
            let (batch, broken) = read(rows, size);
            if batch.is_empty() && broken.is_none() {
                return Ok(mark);
            }
            self.answer(&batch)?;
            self.progress.read(rows.bytes());
            mark = Mark {
                rows: mark.rows + batch.len(),
                checksum: rows.checksum(),
                bad: begun.bad + self.bad_rows.count(),
                counts: self.summary.counts(),
                ..mark
            };
            self.outputs.keep(mark)?;
            if let Some(error) = broken {
                return Err(error).with_context(|| input_name(&self.args.motions));
            }
        }
    }

    fn answer(&mut self, batch: &[MotionRow]) -> Result<(), CannotWrite> {
        let (solver, progress) = (&self.solver, &self.progress);
        let answers = self.threads.work(batch, |thread, row| {
            let answer = match row {
                Ok((_, query)) => solver.answer(thread, query).map_err(RowProblem::from),
                Err(error) => Err(error.problem.clone()),
            };
            progress.step();
            answer
        });
        let mut good = Vec::new();
        for (row, answer) in batch.iter().zip(&answers) {
            let (place, id) = match row {
                Ok((place, query)) => (*place, &query.id),
                Err(error) => (error.place, &error.id),
            };
            let row = match (row, answer) {
                (Ok((place, query)), Ok(timed)) => {
                    self.summary.add(timed);
                    good.push((*place, query, timed));
                    self.result(query, timed)
                }
                (_, Err(problem)) | (Err(RowError { problem, .. }), _) => {
                    self.summary.add_error();
                    self.bad_rows.report(place, problem, &self.progress);
                    ResultRow::error(id, problem)
                }
            };
            let extent = self.args.extent();
            let results = &mut self.outputs.results;
            results.write(|writer| results::write(writer, extent, &row))?;
        }
        self.tell_contacts(&good)
    }

    fn result(&self, query: &Query, timed: &Timed) -> ResultRow {
        let row = ResultRow::new(&query.id, query.duration, &timed.answer, timed.micros);
        ResultRow {
            micros: row.micros.filter(|_| !self.args.no_micros),
            ..row
        }
    }

    /// The contacts of rows that are answered; those that cannot be listed are bad_rows.
    fn tell_contacts(&mut self, good: &[(RowPosition, &Query, &Timed)]) -> Result<(), CannotWrite> {
        let Some(table) = &mut self.outputs.contacts else {
            return Ok(());
        };
        let (bodies, config) = (self.bodies, &self.config);
        // A row may have very many.
        for few in good.chunks(ROWS_OF_CONTACTS) {
            let all = self.threads.map(few, |_, (_, query, timed)| {
                contacts::rows(bodies, query, config, &timed.answer.outcome)
            });
            for ((place, ..), rows) in few.iter().zip(all) {
                match rows {
                    Ok(rows) => {
                        for row in rows {
                            table.write(|writer| writer.serialize(row))?;
                        }
                    }
                    Err(error) => {
                        let problem = format!("contacts: {error}");
                        self.bad_rows.report(*place, &problem, &self.progress);
                    }
                }
            }
        }
        Ok(())
    }
}

/// How many rows' contacts are held at one time.
const ROWS_OF_CONTACTS: usize = 64;

/// So many rows, or fewer where the table ends, or cannot be read on.
fn read(rows: &mut Motions, count: usize) -> (Vec<MotionRow>, Option<TableError>) {
    let mut batch = Vec::new();
    for row in rows.take(count) {
        match row {
            Ok(row) => batch.push(row),
            Err(error) => return (batch, Some(error)),
        }
    }
    (batch, None)
}

fn summarise(args: &QueryArgs, summary: &Summary) {
    let standing = match args.bound {
        Some(BoundKind::Published) => "not certified: ",
        Some(BoundKind::Sound) | None => "",
    };
    let _ = writeln!(io::stderr(), "{standing}{summary}");
    if let (Extent::WithCounters, Some(means)) = (args.extent(), summary.means()) {
        let _ = writeln!(io::stderr(), "{means}");
    }
}

fn settings(args: &QueryArgs) -> Settings {
    Settings {
        method: SolverKind {
            schedule: args.schedule,
            oracle: args.oracle,
            bound: args.bound.unwrap_or_default(),
        },
        config: Config {
            tolerance: args.tolerance,
            margin: args.margin,
            start: args.start.into(),
            budget: args.budget,
            deadline: args.deadline,
        },
        repeat: NonZeroUsize::new(args.repeat as usize).unwrap_or(NonZeroUsize::MIN),
    }
}
