//! The command `ccd-bench stability`: finds where each method fails.

use super::chart::select_by_name;
use super::print_summary;
use crate::method::Method;
use crate::method::guarded::MethodPrograms;
use crate::method::script::ScriptMethod;
use crate::run::contest::Journal;
use crate::show::write_text_file;
use crate::stability::{
    Findings, Survey, cost_growth_heat_map, families, first_failure_table, solved_range_heat_map,
    summary,
};
use anyhow::{Result, ensure};
use clap::Args;
use rigid_ccd_cli::RunOutcome;
use std::path::PathBuf;

/// Find where each method fails: families of scenes that get harder step by step
#[derive(Debug, Args)]
#[command(after_help = AFTER_HELP)]
pub(super) struct StabilityArgs {
    /// Ask about every parameter value of each family, not only about three
    #[arg(long)]
    full: bool,
    /// Ask only about these families
    #[arg(long, value_name = "NAME", value_delimiter = ',')]
    families: Vec<String>,
    /// Ask only these methods
    #[arg(long, value_name = "NAME", value_delimiter = ',')]
    methods: Vec<String>,
    #[command(flatten)]
    programs: MethodPrograms,
    /// Only redraw the tables and charts from the answers in the folder, even those of another build; run no method
    #[arg(long)]
    redraw: bool,
    /// Write the tables to this folder; answers that are in it already are drawn, but not asked again. Those of another
    /// build are moved aside
    #[arg(long, value_name = "DIR", default_value = "target/ccd-stability")]
    out: PathBuf,
}

const AFTER_HELP: &str = "\
Each family has one parameter that makes it harder, and exact answers. Every method runs in a process of
its own, which is stopped after 3 seconds on a query.

Verdicts: right; early and false are contacts that are none, within reach or not; unresolved is a time
until which nothing touches; refused; late and missed are contacts that were passed; undecided, if the exact
answer is not known that well; died is a process that ended; cut off one that was stopped, so that a busy
machine cuts off more.

Files: trials.csv has every answer, chart.csv every step; limits.md and stability.svg show how far each method follows, growth.svg how its cost grows.

Examples:
  ccd-bench stability
  ccd-bench stability --full --methods 'best-first direct,C2A'
  ccd-bench stability --full --families 'bullet and paper,margin'";

pub(super) fn run(args: &StabilityArgs) -> Result<RunOutcome> {
    // The folder may contain more than the requested answers.
    let mut drawn = Method::known_methods();
    drawn.retain(|method| *method != Method::Script(ScriptMethod::CoalDistance));
    let has_program =
        |method: &Method| args.programs.script.is_some() || !matches!(method, Method::Script(_));
    let methods = drawn.iter().copied().filter(has_program).collect();
    let survey = Survey {
        families: select_by_name(families(), &args.families, "family", |f| f.name.to_owned())?,
        methods: select_by_name(methods, &args.methods, "method", Method::to_string)?,
        full: args.full,
        programs: args.programs.clone(),
        folder: args.out.clone(),
    };
    let journal = if args.redraw {
        Journal::read(&args.out)
    } else {
        survey.run()?
    };
    let findings = Findings::new(families(), drawn, &journal);
    ensure!(
        !findings.is_empty(),
        "{} holds no answers to draw",
        args.out.display()
    );
    let reach = solved_range_heat_map(&findings).draw()?;
    let growth = cost_growth_heat_map(&findings).draw()?;
    let limits = format!("{}\n", first_failure_table(&findings));
    let files = [
        ("limits.md", &limits),
        ("stability.svg", &reach),
        ("growth.svg", &growth),
    ];
    for (name, text) in files {
        write_text_file(&args.out.join(name), text)?;
    }
    print_summary(&summary(&findings))?;
    Ok(RunOutcome::AllAnswered)
}
