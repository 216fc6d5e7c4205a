//! The command `ccd-bench cost`: what a query costs, with each choice of how the engine computes.

use super::inputs::QueryTableArgs;
use anyhow::{Context, Result, ensure};
use ccd_core::schedule::{EngineOptions, Shortcut, Shortcuts, VectorInstructions};
use ccd_core::{Body, DistanceOracle, Query, Question, Settings};
use ccd_decomp::{PieceChoice, body_from_mesh};
use ccd_distance_gjk::{ClosedForm, Gjk};
use ccd_tables::batch::median;
use ccd_tables::motions::Motions;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{Args, ValueEnum};
use rigid_ccd::Solver;
use rigid_ccd_cli::{RunOutcome, TableWriter, input_name, open_motions, tolerance};
use std::num::NonZeroU32;
use std::path::Path;
use std::time::Instant;

/// Measure what a query costs: visits of pairs of nodes, microseconds, nanoseconds a visit
#[derive(Debug, Args)]
#[command(after_help = AFTER_HELP)]
pub(super) struct CostArgs {
    #[command(flatten)]
    input: QueryTableArgs,
    /// The tolerance, in the scene's unit of length
    #[arg(long, value_name = "LENGTH", default_value = "1e-3", value_parser = tolerance)]
    tolerance: f64,
    /// Vector instructions to compute with: a row of the table for each
    #[arg(long, value_delimiter = ',', default_value = "best,baseline")]
    instructions: Vec<InstructionSet>,
    /// Shortcuts to search without
    #[arg(long, value_name = "SHORTCUT,...", value_delimiter = ',', value_parser = shortcut_parser())]
    without: Vec<Shortcut>,
    /// How often all queries are asked; the round of the least sum counts
    #[arg(long, default_value = "5")]
    rounds: NonZeroU32,
}

const AFTER_HELP: &str = "\
Cold: each query is answered once. Warm: the median of five answers. Let the machine be idle, and pin the process.

Example:
  ccd-bench cost --a knot.obj --b knot.obj --motions motions.csv --without balls,boxes --rounds 1";

/// The number of answers of which a warm time is the median.
const WARM_ANSWERS: usize = 5;

const COLUMNS: [&str; 11] = [
    "instructions",
    "rows",
    "visits_median",
    "visits_mean",
    "oracle_calls_mean",
    "cold_median_us",
    "cold_mean_us",
    "cold_ns_a_visit",
    "warm_median_us",
    "warm_mean_us",
    "warm_ns_a_visit",
];

#[derive(Clone, Copy, Debug, ValueEnum)]
enum InstructionSet {
    /// The best of this machine.
    Best,
    /// Those that every machine of this kind has.
    Baseline,
}

fn shortcut_parser() -> impl TypedValueParser<Value = Shortcut> {
    let named = |name: String| Shortcut::ALL.into_iter().find(|each| each.name() == name);
    PossibleValuesParser::new(Shortcut::ALL.map(Shortcut::name))
        .try_map(move |name| named(name).ok_or("there is no such shortcut"))
}

pub(super) fn run(args: &CostArgs) -> Result<RunOutcome> {
    let [a, b] = args.input.meshes.read_meshes()?;
    let body = |mesh| Ok::<_, anyhow::Error>(body_from_mesh(mesh, PieceChoice::Auto)?.body);
    let bodies = [body(&a)?, body(&b)?];
    let rows = read_rows(&args.input.motions)?;
    let shortcuts = (args.without.iter()).fold(Shortcuts::ALL, |left, &each| left.without(each));
    let settings = Settings {
        tolerance: args.tolerance,
        ..Settings::DEFAULT
    };
    let mut table = TableWriter::create(Path::new("-"), &COLUMNS)?;
    for set in &args.instructions {
        let options = EngineOptions {
            shortcuts,
            vector_instructions: match set {
                InstructionSet::Best => VectorInstructions::Best,
                InstructionSet::Baseline => VectorInstructions::Baseline,
            },
        };
        let [cold, warm] = [1, WARM_ANSWERS].map(|answers| -> Result<Costs> {
            let mut least: Option<Costs> = None;
            for _ in 0..args.rounds.get() {
                let costs = measure(&bodies, &rows, &settings, options, answers)?;
                if least.as_ref().is_none_or(|known| costs.sum() < known.sum()) {
                    least = Some(costs);
                }
            }
            least.context("no round")
        });
        let (mut cold, mut warm) = (cold?, warm?);
        let name = format!("{set:?}").to_lowercase();
        let of_visits = (
            median(&mut cold.visits.clone()),
            mean(&cold.visits),
            mean(&cold.oracle_calls),
        );
        let [cold, warm] = [&mut cold, &mut warm].map(Costs::summary);
        table.write_row(|writer| writer.serialize((name, rows.len(), of_visits, cold, warm)))?;
    }
    table.finish()?;
    Ok(RunOutcome::AllAnswered)
}

/// Reads a table of motions without bad rows.
fn read_rows(path: &Path) -> Result<Vec<Motions>> {
    let mut queries = Vec::new();
    for row in open_motions(path)?.0 {
        let row = row.with_context(|| input_name(path))?;
        queries.push(
            row.map_err(|error| anyhow::anyhow!("{}: {error}", input_name(path)))?
                .1,
        );
    }
    ensure!(!queries.is_empty(), "{}: no row", input_name(path));
    Ok(queries)
}

/// The costs of all rows.
#[derive(Debug, Default)]
struct Costs {
    visits: Vec<f64>,
    oracle_calls: Vec<f64>,
    micros: Vec<f64>,
}

impl Costs {
    fn sum(&self) -> f64 {
        self.micros.iter().sum()
    }

    /// Returns the median and the mean of the microseconds, and nanoseconds a visit.
    fn summary(&mut self) -> (f64, f64, f64) {
        let ns_a_visit = 1e3 * self.sum() / self.visits.iter().sum::<f64>();
        let mean = mean(&self.micros);
        (median(&mut self.micros), mean, ns_a_visit)
    }
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// Answers each row several times, and returns its work and the median of its times.
fn measure(
    [a, b]: &[Body; 2],
    rows: &[Motions],
    settings: &Settings,
    options: EngineOptions,
    answers: usize,
) -> Result<Costs> {
    let oracle = ClosedForm::new(options.vector_instructions).or_else(Gjk);
    let mut solver = Solver::with_oracle(oracle);
    let mut costs = Costs::default();
    for row in rows {
        let mut micros = Vec::with_capacity(answers);
        let mut stats = None;
        for _ in 0..answers {
            let start = Instant::now();
            let query = Query::new((a, row.a), (b, row.b), row.duration, settings)?;
            let query = query.with_engine_options(options);
            let answer = solver.answer_query(Question::FirstContact, &query)?;
            micros.push(1e6 * start.elapsed().as_secs_f64());
            stats = Some(answer.stats);
        }
        let stats = stats.context("no answer")?;
        costs.visits.push(stats.iterations as f64);
        costs.oracle_calls.push(stats.oracle_calls as f64);
        costs.micros.push(median(&mut micros));
    }
    Ok(costs)
}
