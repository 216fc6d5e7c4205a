//! `ccd query`: two bodies and a table of motions in, a table of results out.

mod args;

pub(super) use args::QueryArgs;

use super::files::{Output, input_name, is_standard, read_motions, refuse_overwriting};
use super::{Verdict, complain, same_file};
use crate::contacts::{self, ContactRow};
use crate::engine::{BoundKind, Method};
use crate::motions::{MotionTable, Place, Query, RowError, RowProblem};
use crate::progress::{Progress, Spinner};
use crate::query::{Bodies, Settings, Timed, run as answer};
use crate::results::{self, Extent, ResultRow};
use crate::summary::Summary;
use anyhow::{Context, Result, bail};
use ccd_core::{Body, Config, InputError};
use ccd_decomp::{BodySource, Prepared, build_hull_tree};
use std::io::{self, Write};
use std::num::NonZeroUsize;
use std::path::Path;

/// Answers all rows that can be; the others are told on standard error.
pub(super) fn run(args: &QueryArgs) -> Result<Verdict> {
    check(args)?;
    let pair = Pair::load(args)?;
    let table = read_motions(&args.motions)?;
    // Before the work, not after it, is when to learn that its results have nowhere to go.
    let out = Output::open(&args.out)?;
    let contacts_out = args.contacts.as_deref();
    let contacts_out = contacts_out
        .map(|path| open_beside(path, args))
        .transpose()?;
    let settings = settings(args);
    if settings.method.bound == BoundKind::Published {
        complain("--bound published: times are not certified, contacts may be late or missed");
    }
    let queries: Vec<&Query> = table.rows.iter().map(|(_, query)| query).collect();
    let progress = if args.quiet {
        Progress::hidden()
    } else {
        Progress::new(queries.len())
    };
    let answers = answer(pair.bodies(), &queries, &settings, &progress)?;
    drop(progress);

    let (good, errors) = sort_out(table, answers);
    let rows = good.iter().map(|answered| &answered.row);
    out.write(|writer| results::write(writer, args.extent(), rows))?;
    let mut complete = errors.is_empty();
    if let Some(out) = contacts_out {
        let (rows, told) = all_contacts(args, pair.bodies(), &settings.config, &good);
        out.write(|writer| contacts::write(writer, &rows))?;
        complete &= told == Told::All;
    }
    for error in &errors {
        complain(&format!("{}, {error}", input_name(&args.motions)));
    }
    if !args.quiet {
        summarise(args, &good);
    }
    Ok(match complete {
        true => Verdict::AllAnswered,
        false => Verdict::SomeRowsBad,
    })
}

/// Refuses what does not go together.
fn check(args: &QueryArgs) -> Result<()> {
    refuse_overwriting(("--motions", &args.motions), ("--out", &args.out))?;
    if let Some(contacts) = &args.contacts {
        refuse_overwriting(("--motions", &args.motions), ("--contacts", contacts))?;
        if is_standard(contacts) && is_standard(&args.out) {
            bail!("--contacts - and --out - are both standard output; give one of them a file");
        }
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

/// Opens the table of contacts; that of results is there already, under whatever name.
fn open_beside(contacts: &Path, args: &QueryArgs) -> Result<Output> {
    refuse_overwriting(("--out", &args.out), ("--contacts", contacts))?;
    Ok(Output::open(contacts)?)
}

/// Whether there is something that could not be told.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Told {
    All,
    Some,
}

/// The contacts of all rows; those of a row that cannot be listed are told on standard error.
fn all_contacts(
    args: &QueryArgs,
    bodies: Bodies<'_>,
    config: &Config,
    good: &[Answered],
) -> (Vec<ContactRow>, Told) {
    let (mut all, mut told) = (Vec::new(), Told::All);
    for Answered {
        place,
        query,
        timed,
        ..
    } in good
    {
        match contacts::rows(bodies, query, config, &timed.answer.outcome) {
            Ok(rows) => all.extend(rows),
            Err(error) => {
                let Place { row, line } = place;
                let table = input_name(&args.motions);
                complain(&format!(
                    "{table}, row {row} (line {line}): contacts: {error}"
                ));
                told = Told::Some;
            }
        }
    }
    (all, told)
}

fn summarise(args: &QueryArgs, good: &[Answered]) {
    let timed = good.iter().map(|answered| &answered.timed);
    let summary = Summary::new(timed, args.tolerance);
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
    let at_least_one = |n| NonZeroUsize::new(n).unwrap_or(NonZeroUsize::MIN);
    Settings {
        method: Method {
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
        repeat: at_least_one(args.repeat as usize),
        threads: at_least_one(usize::from(args.threads)),
    }
}

/// A row of motions and what came of it.
struct Answered {
    place: Place,
    query: Query,
    timed: Timed,
    row: ResultRow,
}

/// The results, and all bad rows in the order of the table.
fn sort_out(
    table: MotionTable,
    answers: Vec<Result<Timed, InputError>>,
) -> (Vec<Answered>, Vec<RowError>) {
    let (mut good, mut errors) = (Vec::with_capacity(answers.len()), table.errors);
    for ((place, query), answer) in table.rows.into_iter().zip(answers) {
        match answer {
            Ok(timed) => good.push(Answered {
                row: ResultRow::new(&query.id, query.duration, &timed.answer, timed.micros),
                place,
                query,
                timed,
            }),
            Err(error) => errors.push(row_error(place, error)),
        }
    }
    errors.sort_by_key(|error| error.place.row);
    (good, errors)
}

fn row_error(place: Place, error: InputError) -> RowError {
    RowError {
        place,
        problem: RowProblem::from(error),
    }
}

/// The bodies of a query; B is none of its own when it comes from where A comes from.
struct Pair {
    a: Body,
    b: Option<Body>,
}

impl Pair {
    fn load(args: &QueryArgs) -> Result<Self> {
        let source = |text: &str| text.parse::<BodySource>();
        let source_a = source(&args.a).context("--a")?;
        let source_b = source(&args.b).context("--b")?;
        let detail = args.pieces.detail()?;
        let load = |option: &str, source: &BodySource, text: &str| -> Result<Body> {
            let spinner = match args.quiet {
                true => Spinner::hidden(),
                false => Spinner::new(&format!("preparing {text}")),
            };
            let Prepared { mut body, report } =
                source.load(detail).with_context(|| option.to_owned())?;
            if args.schedule.uses_hull_trees() && body.hull_tree().is_none() {
                body = grow_hull_tree(body).with_context(|| format!("{option} {text}"))?;
            }
            drop(spinner);
            if !args.quiet {
                let _ = writeln!(io::stderr(), "{option} {text}: {report}");
            }
            Ok(body)
        };
        Ok(Pair {
            a: load("--a", &source_a, &args.a)?,
            b: match same(&source_a, &source_b) {
                true => None,
                false => Some(load("--b", &source_b, &args.b)?),
            },
        })
    }

    fn bodies(&self) -> Bodies<'_> {
        Bodies {
            a: &self.a,
            b: self.b.as_ref().unwrap_or(&self.a),
        }
    }
}

fn grow_hull_tree(body: Body) -> Result<Body> {
    let tree = build_hull_tree(body.pieces())?;
    Ok(body.with_hull_tree(tree)?)
}

fn same(a: &BodySource, b: &BodySource) -> bool {
    match (a, b) {
        (BodySource::Mesh(a), BodySource::Mesh(b))
        | (BodySource::Stored(a), BodySource::Stored(b)) => same_file(a, b),
        _ => a == b,
    }
}
