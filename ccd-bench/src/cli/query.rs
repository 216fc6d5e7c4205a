//! `ccd query`: two bodies and a table of motions in, a table of results out.

mod args;

pub(super) use args::QueryArgs;

use super::{CannotWrite, Verdict, complain, same_file};
use crate::engine::Method;
use crate::motions::{MotionTable, Place, Query, RowError, RowProblem};
use crate::progress::{Progress, Spinner};
use crate::query::{Bodies, Settings, Timed, run as answer};
use crate::results::{ResultRow, write};
use crate::summary::Summary;
use anyhow::{Context, Result, anyhow, bail};
use ccd_core::{Body, Config, InputError};
use ccd_decomp::{BodySource, Prepared, build_hull_tree};
use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::num::NonZeroUsize;
use std::path::Path;

/// Answers all rows that can be; the others are told on standard error.
pub(super) fn run(args: &QueryArgs) -> Result<Verdict> {
    if !is_standard(&args.out) && same_file(&args.motions, &args.out) {
        bail!("--out names the file of --motions, which it would overwrite; give it another");
    }
    let pair = Pair::load(args)?;
    let table = read_motions(&args.motions)?;
    // Before the work, not after it, is when to learn that its results have nowhere to go.
    let out = Output::open(&args.out)?;
    let settings = settings(args);
    let queries: Vec<&Query> = table.rows.iter().map(|(_, query)| query).collect();
    let progress = if args.quiet {
        Progress::hidden()
    } else {
        Progress::new(queries.len())
    };
    let answers = answer(pair.bodies(), &queries, &settings, &progress)?;
    drop(progress);

    let (good, errors) = sort_out(table, answers);
    out.write(good.iter().map(|(row, _)| row))?;
    for error in &errors {
        complain(&format!("{}, {error}", name(&args.motions)));
    }
    if !args.quiet {
        let timed = good.iter().map(|(_, timed)| timed);
        let _ = writeln!(io::stderr(), "{}", Summary::new(timed, args.tolerance));
    }
    Ok(match errors.is_empty() {
        true => Verdict::AllAnswered,
        false => Verdict::SomeRowsBad,
    })
}

fn settings(args: &QueryArgs) -> Settings {
    let at_least_one = |n| NonZeroUsize::new(n).unwrap_or(NonZeroUsize::MIN);
    Settings {
        method: Method {
            schedule: args.schedule,
            oracle: args.oracle,
        },
        config: Config {
            tolerance: args.tolerance,
            margin: args.margin,
            start: args.start.into(),
            budget: args.budget,
        },
        repeat: at_least_one(args.repeat as usize),
        threads: at_least_one(usize::from(args.threads)),
    }
}

/// The results, and all bad rows in the order of the table.
fn sort_out(
    table: MotionTable,
    answers: Vec<Result<Timed, InputError>>,
) -> (Vec<(ResultRow, Timed)>, Vec<RowError>) {
    let (mut good, mut errors) = (Vec::with_capacity(answers.len()), table.errors);
    for ((place, query), answer) in table.rows.into_iter().zip(answers) {
        match answer {
            Ok(timed) => {
                let row = ResultRow::new(&query.id, query.duration, &timed.answer, timed.micros);
                good.push((row, timed));
            }
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

fn read_motions(path: &Path) -> Result<MotionTable> {
    let table = if is_standard(path) {
        MotionTable::read(io::stdin().lock())
    } else {
        let file = File::open(path).map_err(|error| {
            anyhow!("{error}; give --motions a CSV file, or - for standard input")
        });
        MotionTable::read(io::BufReader::new(file.with_context(|| name(path))?))
    };
    table.with_context(|| name(path))
}

/// Where the results go.
struct Output {
    name: String,
    writer: Box<dyn Write>,
}

impl Output {
    fn open(path: &Path) -> Result<Self, CannotWrite> {
        let name = match is_standard(path) {
            true => "standard output".to_owned(),
            false => path.display().to_string(),
        };
        if is_standard(path) {
            let writer = Box::new(io::stdout().lock());
            return Ok(Output { name, writer });
        }
        match File::create(path) {
            Ok(file) => Ok(Output {
                name,
                writer: Box::new(BufWriter::new(file)),
            }),
            Err(source) => Err(CannotWrite {
                place: name,
                source,
            }),
        }
    }

    fn write<'r>(self, rows: impl IntoIterator<Item = &'r ResultRow>) -> Result<(), CannotWrite> {
        write(self.writer, rows).map_err(|error| CannotWrite {
            place: self.name,
            source: match error.into_kind() {
                csv::ErrorKind::Io(error) => error,
                other => io::Error::other(format!("{other:?}")),
            },
        })
    }
}

fn is_standard(path: &Path) -> bool {
    path.as_os_str() == "-"
}

fn name(path: &Path) -> String {
    match is_standard(path) {
        true => "standard input".to_owned(),
        false => path.display().to_string(),
    }
}
