//! `ccd acm`: decides which pairs of a robot's links can touch.

use crate::console::progress::Progress;
use crate::console::{RunOutcome, interruption, print_error, print_escaped_to_stderr};
use crate::files::output::Output;
use crate::files::refuse_shared_files;
use crate::files::table::TableWriter;
use crate::options::numbers::parse_seconds;
use crate::robots::loading::RobotArgs;
use anyhow::Result;
use clap::Args;
use rigid_ccd_robot::{LinkContactClass, LinkContactSettings, Robot};
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

/// Decide which pairs of a robot's links can touch, and write an SRDF that disables the pairs without need of a check
#[derive(Clone, Debug, Args)]
#[command(mut_arg("urdf", |urdf| urdf.required(true)), after_help = AFTER_HELP)]
pub(crate) struct AcmArgs {
    #[command(flatten)]
    robot: RobotArgs,
    /// Examine at most N boxes of configurations for each pair on average; a larger number decides more pairs, but none that
    /// touch without overlap, such as parts that slide on each other
    #[arg(long, value_name = "N", default_value_t = 100_000, value_parser = clap::value_parser!(u32).range(1..))]
    boxes: u32,
    /// Leave the pairs undecided that are not decided after this time, in seconds [default: none]
    #[arg(long, value_name = "SECONDS", value_parser = parse_seconds, allow_hyphen_values = true)]
    deadline: Option<Duration>,
    /// Write the pairs that need no check to this file, SRDF; - writes to standard output
    #[arg(long, value_name = "SRDF", default_value = "-")]
    out: PathBuf,
    /// Write a table of all pairs to this file, CSV
    #[arg(long, value_name = "CSV")]
    report: Option<PathBuf>,
    /// Print only warnings and errors on standard error
    #[arg(long, short)]
    quiet: bool,
}

const AFTER_HELP: &str = "\
The SRDF disables pairs that are proven to touch never or always, over all configurations within the limits of the joints.
It also disables neighbours, unless the robot's file has them checked, as MJCF does for links next to the world. Pairs that
never touch may still come near each other: check them if they must keep a clearance.

Table of pairs (--report):
  link1, link2       the links
  class              never, always, always-as-enclosed, sometimes or undecided; always-as-enclosed: the bodies always touch,
                     but this is not proven of the shapes inside them; such a pair is not disabled
  apart_fraction     fraction of the configurations that are proven apart
  undecided_fraction, least_distance
                     fraction of the configurations for which nothing is proven, and the least distance that was found; both
                     for undecided pairs alone
  touching_JOINT, apart_JOINT
                     a configuration in which the links touch, and one in which they are apart

Ctrl-C ends the search as --deadline does: what is decided by then is written. A second Ctrl-C ends the command.

Exit code: 0 if all pairs were examined, even if some stay undecided; 3 if Ctrl-C ended the search; 2 for bad input; 1 if
nothing can be written.

Examples:
  ccd acm arm.urdf --out arm.srdf
  ccd acm arm.urdf --boxes 1000 --out arm.srdf --report pairs.csv";

/// Runs `ccd acm`.
pub(crate) fn run(args: &AcmArgs) -> Result<RunOutcome> {
    let mut outputs = vec![("--out", args.out.as_path())];
    outputs.extend(args.report.iter().map(|path| ("--report", path.as_path())));
    refuse_shared_files(args.robot.files(), &outputs)?;
    let out = Output::claim(&args.out)?;
    let report = args
        .report
        .as_deref()
        .map(Output::claim_table)
        .transpose()?;
    let robot = args.robot.load(args.quiet)?;
    let stop = interruption::flag()?;
    let pairs = args.robot.link_pairs_printed(&robot, args.quiet)?;
    let classes = classify(&robot, args, &stop)?;
    let srdf = robot.to_srdf(&pairs, &classes);
    out.write(|writer| writer.write_all(srdf.as_bytes()))?;
    if let Some(report) = report {
        write_report(&robot, &classes, report)?;
    }
    if !args.quiet {
        print_escaped_to_stderr(&summary(&classes));
    }
    let all_decided = classes.iter().all(|(_, class)| class.is_decided());
    Ok(if stop.load(Ordering::Relaxed) && !all_decided {
        print_error("interrupted: what was decided by then is written");
        RunOutcome::SomeRowsUnproven
    } else {
        RunOutcome::AllAnswered
    })
}

/// Classifies all pairs, and shows how many are decided.
fn classify(
    robot: &Robot,
    args: &AcmArgs,
    stop: &Arc<AtomicBool>,
) -> Result<Vec<([usize; 2], LinkContactClass)>> {
    let settings = LinkContactSettings {
        max_boxes: args.boxes as usize,
        deadline: args.deadline,
        stop: Some(Arc::clone(stop)),
    };
    let progress = Progress::start_single_step("examining pairs of links", args.quiet);
    let show = |decided: usize, pair_count: usize| {
        progress.set_message(&format!(
            "{decided} of {pair_count} pairs of links are decided; Ctrl-C, --deadline or fewer --boxes leave the others undecided"
        ));
    };
    Ok(robot.classify_link_contacts(&settings, show)?)
}

fn summary(classes: &[([usize; 2], LinkContactClass)]) -> String {
    let class_names = [
        "never",
        "sometimes",
        "always",
        "always-as-enclosed",
        "undecided",
    ];
    let counts = class_names.map(|name| {
        let of_class = classes.iter().filter(|(_, class)| class.name() == name);
        match (name, of_class.count()) {
            ("undecided", count) => format!("{count} are undecided"),
            ("always-as-enclosed", count) => {
                format!("{count} always touch as enclosures, their shapes perhaps not")
            }
            (_, count) => format!("{count} {name} touch"),
        }
    });
    format!("{} pairs of links: {}", classes.len(), counts.join(", "))
}

/// Writes a row for each pair.
fn write_report(
    robot: &Robot,
    classes: &[([usize; 2], LinkContactClass)],
    report: Output,
) -> Result<()> {
    let joints: Vec<&str> = robot.independent_joint_names().collect();
    let mut header = [
        "link1",
        "link2",
        "class",
        "apart_fraction",
        "undecided_fraction",
        "least_distance",
    ]
    .map(str::to_owned)
    .to_vec();
    for prefix in ["touching", "apart"] {
        header.extend(joints.iter().map(|joint| format!("{prefix}_{joint}")));
    }
    let header: Vec<&str> = header.iter().map(String::as_str).collect();
    let mut table = TableWriter::start(report, &header)?;
    for (links, class) in classes {
        let (numbers, configurations) = match class {
            LinkContactClass::Never => ([Some(1.0), None, None], [None, None]),
            LinkContactClass::Always | LinkContactClass::AlwaysAsEnclosed => {
                ([Some(0.0), None, None], [None, None])
            }
            LinkContactClass::Sometimes {
                touching_configuration,
                apart_configuration,
            } => (
                [None; 3],
                [Some(touching_configuration), Some(apart_configuration)],
            ),
            LinkContactClass::Undecided {
                proven_apart_fraction,
                undecided_fraction,
                least_distance,
                touching_configuration,
                apart_configuration,
            } => (
                [
                    Some(*proven_apart_fraction),
                    Some(*undecided_fraction),
                    Some(*least_distance),
                ],
                [
                    touching_configuration.as_ref(),
                    apart_configuration.as_ref(),
                ],
            ),
        };
        let names = links.map(|link| robot.links()[link].name.clone());
        let mut cells = names.to_vec();
        cells.push(class.name().to_owned());
        let text = |number: Option<f64>| number.map_or(String::new(), |number| number.to_string());
        cells.extend(numbers.map(text));
        for configuration in configurations {
            cells.extend((0..joints.len()).map(|joint| {
                configuration.map_or(String::new(), |positions| positions[joint].to_string())
            }));
        }
        table.add_row(&cells)?;
    }
    Ok(table.finish()?)
}
