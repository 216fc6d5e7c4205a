//! Measures the cost of every question relative to that of the first contact, row by row.
//!
//! Asks each row for the first contact, for any contact and for the closest approach in turn, several times,
//! and compares the least times of each row. The verdicts have to agree.
//!
//! ```sh
//! cargo run --release -p ccd-bench --example questions -- A.obj B.obj motions.csv [TOLERANCE [ROUNDS]]
//! ```

use anyhow::{Context, bail, ensure};
use rigid_ccd::batch::median;
use rigid_ccd::oracle::Direct;
use rigid_ccd::schedule::{BestFirst, DepthFirst, Schedule};
use rigid_ccd::table::motions::{MotionTable, Motions};
use rigid_ccd::{Answer, Body, InputError, Outcome, Settings, load};
use std::fs::File;
use std::io::Write;
use std::time::{Duration, Instant};

fn main() -> anyhow::Result<()> {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let [a, b, motions, rest @ ..] = &args[..] else {
        bail!("give A.obj B.obj motions.csv [TOLERANCE [ROUNDS]]");
    };
    let number =
        |index: usize, default: f64| rest.get(index).map_or(Ok(default), |text| text.parse());
    let (tolerance, rounds) = (number(0, 1e-3)?, number(1, 5.0)? as usize);
    let bodies = (&load(a)?, &load(b)?);
    let table = MotionTable::read(File::open(motions).context("motions")?)?;
    ensure!(table.errors.is_empty(), "the table has bad rows");
    let config = Settings {
        tolerance,
        ..Settings::DEFAULT
    };
    let mut solvers = Solvers::default();
    let mut rows = Vec::new();
    for (id, query) in &table.rows {
        let row = solvers.row(bodies, query, &config, rounds)?;
        row.check().with_context(|| format!("row {id:?}"))?;
        rows.push(row);
    }
    print(&rows)
}

#[derive(Default)]
struct Solvers {
    best_first: BestFirst<Direct>,
    depth_first: DepthFirst<Direct>,
    oracle: Direct,
}

/// The answers to all questions about one row, each with its shortest time.
struct Row {
    first: (Outcome, Duration),
    any: (Outcome, Duration),
    closest: (Outcome, Duration),
    tolerance: f64,
}

impl Solvers {
    fn row(
        &mut self,
        (a, b): (&Body, &Body),
        query: &Motions,
        config: &Settings,
        rounds: usize,
    ) -> anyhow::Result<Row> {
        let query = rigid_ccd::Query::new((a, query.a), (b, query.b), query.duration, config)?;
        let Solvers {
            best_first,
            depth_first,
            oracle,
        } = self;
        Ok(Row {
            first: least(rounds, || best_first.first_contact(&query, oracle))?,
            any: least(rounds, || depth_first.any_contact(&query, oracle))?,
            closest: least(rounds, || depth_first.closest_approach(&query, oracle))?,
            tolerance: query.tolerance(),
        })
    }
}

/// Returns the outcome and the shortest time of several calls, after an untimed one.
fn least(
    rounds: usize,
    mut call: impl FnMut() -> Result<Answer, InputError>,
) -> Result<(Outcome, Duration), InputError> {
    let mut answer = call()?;
    let mut taken = Duration::MAX;
    for _ in 0..rounds {
        let start = Instant::now();
        answer = call()?;
        taken = taken.min(start.elapsed());
    }
    Ok((answer.outcome, taken))
}

impl Row {
    fn is_hit(&self) -> bool {
        !matches!(self.first.0, Outcome::Free { .. })
    }

    fn check(&self) -> anyhow::Result<()> {
        let any_hit = !matches!(self.any.0, Outcome::Free { .. });
        let closest = &self.closest.0;
        let width = closest.upper() - closest.lower();
        ensure!(
            width <= self.tolerance,
            "the bracket is {width:e} wide: {closest:?}"
        );
        // Near misses within the tolerance may have either outcome.
        let near_miss = closest.lower() > 0.0 && closest.upper() <= self.tolerance;
        ensure!(
            any_hit == self.is_hit() || near_miss,
            "{:?} and {:?}",
            self.first.0,
            self.any.0
        );
        let apart = closest.lower() > 0.0;
        ensure!(
            apart != self.is_hit() || closest.upper() <= 2.0 * self.tolerance,
            "{:?} and {closest:?}",
            self.first.0
        );
        Ok(())
    }
}

/// Prints for each question the median of its times, relative to the first contact's.
fn print(rows: &[Row]) -> anyhow::Result<()> {
    let mut out = std::io::stdout().lock();
    writeln!(
        out,
        "rows,count,any over first,closest over first,first micros"
    )?;
    let (hits, free): (Vec<&Row>, Vec<&Row>) = rows.iter().partition(|row| row.is_hit());
    for (name, some) in [
        ("all", rows.iter().collect()),
        ("contact", hits),
        ("free", free),
    ] {
        let middle = |value: fn(&Row) -> f64| {
            let mut values: Vec<f64> = some.iter().map(|row| value(row)).collect();
            median(&mut values)
        };
        let any = middle(|row| row.any.1.div_duration_f64(row.first.1));
        let closest = middle(|row| row.closest.1.div_duration_f64(row.first.1));
        let first = middle(|row| row.first.1.as_secs_f64() * 1e6);
        writeln!(
            out,
            "{name},{},{any:.3},{closest:.3},{first:.2}",
            some.len()
        )?;
    }
    Ok(())
}
