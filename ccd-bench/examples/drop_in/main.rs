//! Answers rows of other libraries' suites through parry's signatures, beside parry itself, in both precisions.
//!
//! `cargo run --release -p ccd-bench --example drop_in -- SUITE.json [--suites parry,jolt,box3d] [--verbose]`. The file
//! is that of the example `suites`; its expected times are the measure, by the rule in `judge.rs`. `cast_shapes` is asked
//! where no body turns, and alone where there is a margin, as parry's nonlinear cast has none.
//!
//! A table for each suite, precision and function counts the rows: `same` if both answers are right, `better` if only
//! this project's is, `contract` if bodies are to be let go at the start and the answers differ, `worse` and
//! `both wrong`.
//! The faults of parry are told apart. `ours late` has to be 0. `--verbose` prints every row.
//!
//! parry is asked in a process of its own: some casts never return, some panic.

mod closing;
mod judge;
mod rows;
mod table;
mod theirs;

use anyhow::{Context, Result};
use closing::closing_speed;
use judge::{Allowance, Reply};
use rows::Row;
use std::io::Write;
use table::{Table, Tally};
use theirs::Theirs;

/// In double precision.
#[expect(clippy::unnecessary_cast, clippy::useless_conversion)]
#[path = ""]
mod double {
    use ccd_bench::method::peer::parry::double::shapes;
    use parry3d_f64 as library;
    use rigid_ccd_parry::f64 as drop_in;

    #[path = "answers.rs"]
    pub(crate) mod answers;
}

/// In single precision: the same source over the other crate.
#[path = ""]
mod single {
    use ccd_bench::method::peer::parry::single::shapes;
    use parry3d as library;
    use rigid_ccd_parry::f32 as drop_in;

    #[path = "answers.rs"]
    #[expect(clippy::duplicate_mod)]
    pub(crate) mod answers;
}

/// A function of parry's.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Call {
    Nonlinear,
    Linear,
}

/// A number type.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Precision {
    Single,
    Double,
}

fn main() -> Result<()> {
    let mut arguments: Vec<String> = std::env::args().skip(1).collect();
    let verbose = arguments
        .iter()
        .position(|argument| argument == "--verbose");
    let verbose = verbose.map(|at| arguments.remove(at)).is_some();
    let named = arguments.iter().position(|argument| argument == "--suites");
    let suites = named.map(|at| arguments.drain(at..).nth(1));
    let suites = suites
        .flatten()
        .unwrap_or_else(|| "parry,jolt,box3d".to_owned());
    let path = arguments
        .first()
        .context("usage: drop_in SUITE.json [--suites NAMES] [--verbose]")?;
    let file = serde_json::from_str(&std::fs::read_to_string(path)?)?;
    let suites: Vec<&str> = suites.split(',').collect();
    let rows = rows::read(&file, &suites)?;
    if let [_, job] = &arguments[..] {
        return theirs::work(&rows, job);
    }
    let mut out = std::io::stdout().lock();
    for call in [Call::Nonlinear, Call::Linear] {
        for precision in [Precision::Single, Precision::Double] {
            let theirs = Theirs::ask(path, &suites, &rows, call, precision)?;
            let mut table = Table::new(call, precision);
            for suite in &suites {
                let mut tally = Tally::default();
                for (row, theirs) in rows
                    .iter()
                    .zip(&theirs)
                    .filter(|(row, _)| row.suite == *suite)
                {
                    let Some(theirs) = *theirs else { continue };
                    let verdict = tally.add(
                        row,
                        ours(row, call, precision)?,
                        theirs,
                        allowance(row, precision),
                    );
                    if verbose {
                        writeln!(
                            out,
                            "{suite} {call:?} {precision:?}: {}: {verdict}",
                            row.test
                        )?;
                    }
                }
                table.push(suite, &tally);
            }
            writeln!(out, "{table}")?;
        }
    }
    Ok(())
}

/// Returns whether a function is asked about a row.
fn is_for(row: &Row, call: Call) -> bool {
    match call {
        Call::Nonlinear => row.margin == 0.0,
        Call::Linear => !row.turns(),
    }
}

fn ours(row: &Row, call: Call, precision: Precision) -> Result<Reply> {
    Ok(match precision {
        Precision::Single => single::answers::Question::new(row)?.ours(call),
        Precision::Double => double::answers::Question::new(row)?.ours(call),
    })
}

fn allowance(row: &Row, precision: Precision) -> Allowance {
    match precision {
        Precision::Single => Allowance::single(row, closing_speed(row)),
        Precision::Double => Allowance::double(row, closing_speed(row)),
    }
}
