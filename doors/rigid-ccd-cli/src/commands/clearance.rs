//! `ccd clearance`: proves where a mechanism keeps a clearance.

mod page;
mod report;

use crate::console::{RunOutcome, print_error, print_remarks};
use crate::files::html::write_page;
use crate::files::output::{self, Output, is_standard_output};
use crate::files::{input_name, refuse_shared_files};
use crate::robots::joint_values::{JointsArgs, length, tolerance_length};
use crate::robots::loading::CellArgs;
use crate::robots::page::{RobotPainter, halvings};
use crate::robots::path_table::TablePath;
use crate::robots::robot_paths::{RobotPaths, SelectedPaths};
use anyhow::{Result, bail};
use ccd_view::page_html;
use clap::Args;
use report::Report;
use rigid_ccd::Settings;
use rigid_ccd::answer::ClearanceVerdict;
use rigid_ccd_robot::{Cell, RangeSettings};
use std::path::PathBuf;

/// Prove where a mechanism keeps a clearance, over the range of a joint or along a path
#[derive(Clone, Debug, Args)]
#[command(
    mut_arg("urdf", |urdf| urdf.required(true)),
    mut_arg("degrees", |degrees| degrees.requires("path")),
    after_help = AFTER_HELP
)]
pub(crate) struct ClearanceArgs {
    #[command(flatten)]
    cell: CellArgs,
    #[command(flatten)]
    joints: JointsArgs,
    /// Table with one path, CSV or Parquet, in the format of `ccd edges`; it replaces ranges of --joint, for instance
    /// for closed loops of joints
    #[arg(long, value_name = "TABLE")]
    path: Option<PathBuf>,
    /// Greatest distance of points of links from where the path places them, such as 0.1mm
    #[arg(long, value_name = "LENGTH", default_value = "0", value_parser = length)]
    pose_error: f64,
    /// Clearance that all pairs have to keep, such as 0.3mm
    #[arg(long, value_name = "LENGTH", value_parser = length)]
    require: Option<f64>,
    /// Greatest difference between the bounds of a distance, such as 0.001mm
    #[arg(long, value_name = "LENGTH", default_value = "0.000001", value_parser = tolerance_length)]
    tolerance: f64,
    /// Length of the shortest ranges that are examined, as a fraction of the path from one configuration to the next
    #[arg(long, value_name = "SHARE", default_value_t = RangeSettings::DEFAULT.resolution)]
    resolution: f64,
    /// Print one JSON object, with the curve of the distance
    #[arg(long)]
    json: bool,
    /// Write a page that shows the mechanism and its distances to this file, HTML
    #[arg(long, value_name = "HTML")]
    html: Option<PathBuf>,
    /// Print only warnings and errors on standard error
    #[arg(long, short)]
    quiet: bool,
}

const AFTER_HELP: &str = "\
Prints bounds of the least distance of all pairs that are checked, with the nearest pair and its place on the path. With
--require it also prints the ranges in which all pairs certainly keep the clearance, in which a pair certainly violates
it, and the undecided ranges. Joint limits at the ends of kept ranges would keep the clearance.
Paddings and clearances of the cell do not count, as in `ccd edges --question closest-approach`; but a clearance between two
neighbouring links has the pair checked. Times are those of column `t` of --path; without it, each segment takes 1. The curve
of --json has at most 512 ranges, each with bounds of the least distance in it. Without --joint and --path, a robot of one
joint moves over the whole range of the joint.

Exit codes:
  0  the clearance is kept everywhere, or none is required
  1  the output cannot be written
  2  bad input
  3  the clearance is violated somewhere, or unverified

Examples:
  ccd clearance arm.urdf --joint elbow=-30deg:60deg --rest
  ccd clearance arm.urdf --joint elbow=-30deg:60deg --joint shoulder=20deg --cell cell.toml --require 5mm --json
  ccd clearance arm.urdf --path path.csv --pose-error 0.1mm
  ccd clearance arm.urdf --path path.csv --html clearance.html";

/// Runs `ccd clearance`.
pub(crate) fn run(args: &ClearanceArgs) -> Result<RunOutcome> {
    if let Some(html) = &args.html {
        if is_standard_output(html) {
            bail!("--html - and the report are both standard output; give --html a file");
        }
        let path = args.path.iter().map(|path| ("--path", path.as_path()));
        refuse_shared_files(args.cell.files().chain(path), &[("--html", html)])?;
    }
    let html = args.html.as_deref().map(Output::claim).transpose()?;
    let mut cell = args.cell.load(args.quiet)?;
    if cell.remove_paddings_and_clearances() {
        print_error(
            "the distances of [padding] and [[clearance]] do not count: the distances of the bodies are measured; \
             `ccd edges` asks whether paddings and clearances are kept",
        );
    }
    print_remarks(cell.remark_on_tolerance(args.tolerance));
    let path = args.read_path(&cell)?;
    let mut solver = cell.solver().with_settings(args.settings(0.0));
    let closest = solver.closest_approach(&path.configurations)?;
    let tolerance = closest.tolerance;
    if tolerance > args.tolerance {
        print_error(&format!(
            "--tolerance {:e} m cannot be certified at these coordinates: raised to {tolerance:.2e} m",
            args.tolerance
        ));
    }
    let mut ranges = Vec::new();
    if let Some(clearance) = args.require {
        let range_settings = RangeSettings {
            resolution: args.resolution,
            max_pose_error: args.pose_error,
        };
        solver.set_settings(args.settings(clearance));
        ranges = solver.clearance_ranges(&path.configurations, range_settings)?;
    }
    let report = Report {
        cell: &cell,
        path: &path,
        pose_error: args.pose_error,
        required: args.require,
        closest: closest.outcome,
        tolerance,
        ranges,
    };
    if args.json {
        let halvings = halvings(path.configurations.len() - 1);
        let curve = solver.distance_curve(&path.configurations, halvings)?;
        output::print(report.to_json(&curve))?;
    } else {
        output::print(&report)?;
    }
    if let Some(html) = html {
        // A violation is no contact: the page shows where the least distance is.
        solver.set_settings(args.settings(0.0));
        let painter = RobotPainter::new(&cell)?;
        let title = input_name(args.cell.robot.path());
        let mut view = painter.animation(&mut solver, &path, 0.0)?;
        page::show_report(&report, &mut view);
        let page = page_html(&title, painter.meshes(), vec![view])?;
        write_page(&page, html, args.quiet)?;
    }
    Ok(outcome(&report))
}

fn outcome(report: &Report<'_>) -> RunOutcome {
    match report.verdict() {
        Some(ClearanceVerdict::Violated) => RunOutcome::SomeRowsUnproven,
        Some(ClearanceVerdict::Unverified) => {
            print_error(
                "the clearance is unverified in a part of the path; a smaller --resolution or --tolerance may decide",
            );
            RunOutcome::SomeRowsUnproven
        }
        Some(ClearanceVerdict::Kept) | None => RunOutcome::AllAnswered,
    }
}

impl ClearanceArgs {
    fn settings(&self, margin: f64) -> Settings {
        Settings {
            tolerance: self.tolerance,
            margin,
            ..Settings::DEFAULT
        }
    }

    /// Reads the path to examine.
    fn read_path(&self, cell: &Cell) -> Result<TablePath> {
        let robot_paths = RobotPaths {
            table: self.path.as_deref(),
            joints: &self.joints,
            ids: &[],
        };
        let SelectedPaths {
            mut paths,
            problems,
        } = robot_paths.read(cell)?;
        if let Some(problem) = problems.into_iter().next() {
            bail!(problem);
        }
        match (paths.pop(), paths.is_empty()) {
            (Some(path), true) => Ok(path),
            _ => bail!("--path: has several paths; give a table of one"),
        }
    }
}
