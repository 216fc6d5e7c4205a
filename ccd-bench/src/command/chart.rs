//! The command `ccd-bench chart`: measures methods on the paper's scenes, and writes tables, a chart and a page.

use super::print_summary;
use crate::method::Method;
use crate::method::PAPER_TOLERANCE;
use crate::method::guarded::MethodPrograms;
use crate::method::peer::PeerKind;
use crate::run::contest::MeasurementLimits;
use crate::run::evaluation::MeasurementPlan;
use crate::run::export::export_scenes;
use crate::scene::scene_descriptions;
use crate::show::presentation::write_report;
use anyhow::{Result, ensure};
use clap::Args;
use rigid_ccd_cli::{RunOutcome, parse_seconds};
use std::path::PathBuf;
use std::time::Duration;

/// The arguments of `ccd-bench chart`: what to measure, and where to write it.
#[derive(Debug, Args)]
#[command(after_help = AFTER_HELP)]
pub(super) struct ChartArgs {
    /// Measure everything: every scene, method and row, at nine tolerances (about half an hour)
    #[arg(long)]
    full: bool,
    /// Use the meshes in this folder (bunny70k.obj, bunny26k.obj, santa.obj, knot2880.obj, …) instead of the models
    /// made by code
    #[arg(long, value_name = "DIR")]
    models: Option<PathBuf>,
    /// Write tables, charts and the page to this folder; measurements that it holds already are not
    /// repeated
    #[arg(long, value_name = "DIR", default_value = "target/ccd-report")]
    out: PathBuf,
    /// Measure only these scenes
    #[arg(long, value_name = "NAME", value_delimiter = ',')]
    scenes: Vec<String>,
    /// Measure only these methods
    #[arg(long, value_name = "NAME", value_delimiter = ',')]
    methods: Vec<String>,
    /// Measure only at these tolerances
    #[arg(long, value_name = "LENGTH", value_delimiter = ',')]
    tolerances: Vec<f64>,
    /// Seconds for each method on each scene at each tolerance; after that, no more queries are started
    #[arg(long, value_name = "SECONDS", value_parser = parse_seconds)]
    cell_time: Option<Duration>,
    /// Seconds that a peer library may take for a query before it is stopped
    #[arg(long = "patience", value_name = "SECONDS", value_parser = parse_seconds)]
    query_time_limit: Option<Duration>,
    #[command(flatten)]
    programs: MethodPrograms,
    /// Draw the measurements that are already in the folder, and measure nothing
    #[arg(long, conflicts_with_all = ["full", "export"])]
    redraw: bool,
    /// Write the meshes and motions of the scenes to this folder, for programs elsewhere, and
    /// measure nothing
    #[arg(long, value_name = "DIR")]
    export: Option<PathBuf>,
}

const AFTER_HELP: &str = "\
Measurements of the same program and settings are kept, so that an interrupted run resumes where it
stopped. An unknown name is answered with the list of known ones.

Examples:
  ccd-bench chart                           # a few rows of everything, in a minute
  ccd-bench chart --full --out full         # everything
  ccd-bench chart --scenes santa --tolerances 1e-3,1e-6
  ccd-bench chart --export scenes           # meshes and motions, for other programs";

/// The tolerances at which methods are measured, from coarse to fine, for bodies of size 1.
const FULL_TOLERANCES: [f64; 9] = [1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9];
/// The tolerances at which methods are measured without `--full`.
const QUICK_TOLERANCES: [f64; 2] = [PAPER_TOLERANCE, 1e-6];

/// The limits of each measurement with `--full`, chosen so that everything takes about half an hour.
const FULL_MEASUREMENT_LIMITS: MeasurementLimits = MeasurementLimits {
    cell_time: Duration::from_millis(600),
    patience: Duration::from_secs(4),
    max_rows: usize::MAX,
    min_rows: 10,
    preparation_limit: Duration::from_secs(20),
};
/// The limits of each measurement without `--full`, chosen so that a few queries of everything take about a minute.
const QUICK_LIMITS: MeasurementLimits = MeasurementLimits {
    cell_time: Duration::from_millis(40),
    patience: Duration::from_millis(200),
    max_rows: 40,
    min_rows: 3,
    preparation_limit: Duration::from_millis(400),
};

pub(super) fn run(args: &ChartArgs) -> Result<RunOutcome> {
    let mut plan = plan_measurements(args)?;
    if args.programs.script.is_some() {
        plan.methods.extend(Method::script_methods());
    }
    plan.scene_descriptions =
        select_by_name(plan.scene_descriptions, &args.scenes, "scene", |l| {
            l.name.clone()
        })?;
    plan.methods = select_by_name(plan.methods, &args.methods, "method", Method::to_string)?;
    if !args.tolerances.is_empty() {
        for tolerance in &args.tolerances {
            ensure!(
                *tolerance > 0.0 && tolerance.is_finite(),
                "--tolerances: {tolerance} is not a positive length"
            );
        }
        plan.tolerances.clone_from(&args.tolerances);
    }
    if let Some(folder) = &args.export {
        export_scenes(&plan.scene_descriptions, plan.model_folder, folder)?;
        return Ok(RunOutcome::AllAnswered);
    }
    let evaluated = if args.redraw {
        plan.load_measurements()?
    } else {
        plan.run()?
    };
    let (safety, page) = write_report(&evaluated, &args.out)?;
    let page = page.display();
    print_summary(&format_args!(
        "{safety}\n\nThe report, with scenes in motion, a chart and tables: {page}"
    ))?;
    Ok(RunOutcome::AllAnswered)
}

/// Returns the plan that the arguments ask for: a full one, or a quick one with fewer queries and only the fast
/// methods.
fn plan_measurements(args: &ChartArgs) -> Result<MeasurementPlan> {
    if let Some(directory) = &args.models {
        ensure!(
            directory.is_dir(),
            "{} is not a directory; --models takes one that holds meshes such as bunny70k.obj",
            directory.display()
        );
    }
    let (allowance, tolerances) = if args.full {
        (FULL_MEASUREMENT_LIMITS, &FULL_TOLERANCES[..])
    } else {
        (QUICK_LIMITS, &QUICK_TOLERANCES[..])
    };
    let methods = Method::built_in_methods().into_iter();
    let methods = methods.filter(|method| args.full || is_in_quick_plan(*method));
    Ok(MeasurementPlan {
        scene_descriptions: scene_descriptions()?,
        methods: methods.collect(),
        tolerances: tolerances.to_vec(),
        limits: MeasurementLimits {
            cell_time: args.cell_time.unwrap_or(allowance.cell_time),
            patience: args.query_time_limit.unwrap_or(allowance.patience),
            ..allowance
        },
        programs: args.programs.clone(),
        model_folder: args.models.clone(),
        folder: args.out.clone(),
    })
}

/// Returns true if the method answers a few queries within seconds, so that the quick plan includes it. Peers take time
/// to start, since they run in other processes, so only one of them is included.
fn is_in_quick_plan(method: Method) -> bool {
    match method {
        Method::ThisProject(..) | Method::Rival(_) => true,
        Method::Peer(kind) => kind == PeerKind::ParryF64,
        Method::Script(_) => false,
    }
}

/// Returns the items with the given names, or all items if no names are given.
pub(super) fn select_by_name<T>(
    all: Vec<T>,
    names: &[String],
    what: &str,
    name_of: impl Fn(&T) -> String,
) -> Result<Vec<T>> {
    let known: Vec<String> = all.iter().map(&name_of).collect();
    let names: Vec<&str> = names.iter().map(|name| name.trim()).collect();
    for name in &names {
        ensure!(
            known.iter().any(|known| known == name),
            "there is no {what} {name}; there are: {}",
            known.join(", ")
        );
    }
    let wanted = |item: &T| names.is_empty() || names.contains(&name_of(item).as_str());
    Ok(all.into_iter().filter(wanted).collect())
}
