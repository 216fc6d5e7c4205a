//! `ccd view`: writes a page that shows queries, or a scene of many bodies.

mod args;
mod chosen;

pub(crate) use args::ViewArgs;
pub(crate) use chosen::ChosenRows;

use crate::bodies::pair::BodiesArgs;
use crate::bodies::scene_table;
use crate::console::{RunOutcome, print_error, print_remarks};
use crate::files::html::write_page;
use crate::files::output::Output;
use crate::files::{input_name, open_movement_rows, refuse_shared_files};
use crate::options::solver_kind::SolverKind;
use crate::picture::{Painter, QueryContext, TimeMeaning, scene_view};
use crate::robots::{CellArgs, RobotPainter, RobotPaths, SelectedPaths};
use crate::rows::timed::{TimedQuestion, answer_timed};
use anyhow::{Context, Result, bail};
use ccd_core::Settings;
use ccd_tables::paths::Grouping;
use ccd_tables::results::{self, ResultRow};
use ccd_view::page_html;
use rigid_ccd::Question;
use std::collections::{HashMap, VecDeque};
use std::ffi::OsStr;
use std::num::NonZeroUsize;
use std::path::Path;

/// The maximum number of printed messages about paths of a robot that cannot be shown.
const MAX_PRINTED_PROBLEMS: usize = 5;

/// The maximum number of rows that are read to choose a few of them for the page.
const MAX_ROWS_READ: usize = 10_000;

/// Runs `ccd view`: writes the page of a table of motions or of a scene.
pub(crate) fn run(args: &ViewArgs) -> Result<RunOutcome> {
    if args.cell.robot.is_given() {
        return view_robot(args, &args.cell);
    }
    match (&args.scene, args.bodies_and_motions()) {
        (Some(scene), _) => view_scene(args, scene),
        (None, Some((bodies, motions))) => view_rows(args, &bodies, motions),
        // The parser prevents this.
        (None, None) => bail!("give --a, --b and --motions, or --scene, or a URDF"),
    }
}

fn view_rows(args: &ViewArgs, bodies: &BodiesArgs, motions: &Path) -> Result<RunOutcome> {
    let mut read = bodies.files_with_options()?;
    read.push(("--motions", motions.to_owned()));
    read.extend(args.results.iter().map(|path| ("--results", path.clone())));
    let read = read.iter().map(|(option, path)| (*option, path.as_path()));
    refuse_shared_files(read, &[("--out", &args.out)])?;
    let (mut rows, _) = open_movement_rows(motions, Grouping::of_question(Question::FirstContact))?;
    let out = Output::claim(&args.out)?;
    let pair = bodies.load(SolverKind::default(), args.quiet)?;
    let mut results_by_id = args.results.as_deref().map(read_results).transpose()?;
    let mut chosen_rows = ChosenRows::new(args.ids.clone());
    let timing = TimedQuestion {
        question: Question::FirstContact,
        method: SolverKind::default(),
        settings: settings(args),
        repetitions: NonZeroUsize::MIN,
    };
    let query_context = QueryContext {
        time_meaning: results_by_id
            .as_ref()
            .map_or(TimeMeaning::FirstContact, |_| TimeMeaning::TableTime),
        query_margin: args.margin,
        clearance: None,
    };
    let mut solver = timing.method.solver();
    for row in rows.by_ref().take(MAX_ROWS_READ) {
        let movements = match row.with_context(|| input_name(motions))? {
            Ok((_, movements)) => movements,
            Err(error) => {
                chosen_rows.note_undrawable_row(error.to_string());
                continue;
            }
        };
        if chosen_rows.is_requested(movements.id()) == Some(false) {
            continue;
        }
        let row = match &mut results_by_id {
            Some(results_by_id) => results_by_id
                .get_mut(movements.id())
                .and_then(VecDeque::pop_front),
            None => {
                let answer = answer_timed(pair.bodies(), &movements, &timing, solver.as_mut());
                let (question, settings) = (timing.question, &timing.settings);
                Some(
                    pair.bodies()
                        .result_row(question, settings, &movements, &answer),
                )
            }
        };
        if let Some(row) = row {
            chosen_rows.add_if_wanted(&movements, &row);
        }
        if chosen_rows.needs_no_more_rows() {
            break;
        }
    }
    if args.results.is_none() && !args.quiet {
        pair.print_remarks(args.tolerance(), &rows);
    }
    if let (Some(results), true) = (&args.results, chosen_rows.is_empty()) {
        let (motions, results) = (input_name(motions), results.display());
        bail!("no row of {motions} is in {results}");
    }
    let painter = Painter::new(pair.bodies(), query_context);
    write_rows_page((&title(bodies), painter), chosen_rows, out, args.quiet)
}

/// Returns the title of a page about two bodies: their names without folders, and the unit.
pub(crate) fn title(bodies: &BodiesArgs) -> String {
    let [a, b] = [&bodies.a, &bodies.b].map(|text| {
        let name = Path::new(text).file_name();
        name.map_or(text.into(), OsStr::to_string_lossy)
    });
    let unit = bodies.meshes.unit();
    let unit = unit.map_or_else(String::new, |unit| format!(", lengths in {unit}"));
    format!("{a} and {b}{unit}")
}

/// Writes the page of the chosen rows under a title. If no row can be shown, writes no page and prints a message.
pub(crate) fn write_rows_page(
    (title, mut painter): (&str, Painter<'_>),
    mut chosen_rows: ChosenRows,
    out: Output,
    quiet: bool,
) -> Result<RunOutcome> {
    let has_all_ids = chosen_rows.ids_without_row().next().is_none();
    for id in chosen_rows.ids_without_row() {
        print_error(&format!("no row has the id {id:?}"));
    }
    let mut views = Vec::new();
    for (movements, row) in chosen_rows.take_rows() {
        match painter.animate_row(&movements, &row) {
            Ok(view) => views.push(view),
            Err(error) => chosen_rows.note_undrawable_row(format!("row {}: {error}", row.id)),
        }
    }
    if let Some(message) = chosen_rows.describe_faults() {
        print_error(&message);
    }
    if views.is_empty() {
        print_error("there is no row to show, so no page is written");
        return Ok(RunOutcome::SomeRowsBad);
    }
    let html = page_html(title, painter.meshes(), views)?;
    write_page(&html, out, quiet)?;
    Ok(if has_all_ids && chosen_rows.are_all_rows_drawable() {
        RunOutcome::AllAnswered
    } else {
        RunOutcome::SomeRowsBad
    })
}

/// Reads a table of results into lists by id; rows with the same id stay in their order.
fn read_results(path: &Path) -> Result<HashMap<String, VecDeque<ResultRow>>> {
    let name = || path.display().to_string();
    let file = ccd_file::open(path).with_context(name)?;
    let rows = results::read(file).with_context(name)?;
    let mut results_by_id: HashMap<String, VecDeque<ResultRow>> = HashMap::new();
    for row in rows {
        results_by_id
            .entry(row.id.clone())
            .or_default()
            .push_back(row);
    }
    Ok(results_by_id)
}

fn settings(args: &ViewArgs) -> Settings {
    Settings {
        tolerance: args.tolerance(),
        margin: args.margin,
        ..Settings::DEFAULT
    }
}

fn view_robot(args: &ViewArgs, robot: &CellArgs) -> Result<RunOutcome> {
    if !args.meshes.are_default() {
        bail!(
            "the options of mesh files are for --a, --b and --scene; --geometry and --meshes say what a robot's links are"
        );
    }
    let robot_paths = RobotPaths {
        table: args.path.as_deref(),
        joints: &args.joints,
        ids: &args.ids,
    };
    let table = robot_paths.table.map(|path| ("--path", path));
    refuse_shared_files(robot.files().chain(table), &[("--out", &args.out)])?;
    let out = Output::claim(&args.out)?;
    let cell = robot.load(args.quiet)?;
    if !args.quiet {
        print_remarks(cell.remark_on_tolerance(args.tolerance()));
    }
    let mut solver = cell.solver().with_settings(Settings {
        margin: args.clearance,
        ..settings(args)
    });
    let painter = RobotPainter::new(&cell)?;
    let SelectedPaths {
        paths,
        mut problems,
    } = robot_paths.read(&cell)?;
    let mut views = Vec::new();
    for path in &paths {
        match painter.animation(&mut solver, path, args.clearance) {
            Ok(view) => views.push(view),
            Err(error) => problems.push(format!("path {:?}: {error}", path.id)),
        }
    }
    for problem in problems.iter().take(MAX_PRINTED_PROBLEMS) {
        print_error(&format!("not shown: {problem}"));
    }
    if problems.len() > MAX_PRINTED_PROBLEMS {
        print_error(&format!("{} paths are not shown in all", problems.len()));
    }
    if views.is_empty() {
        print_error("there is no row to show, so no page is written");
        return Ok(RunOutcome::SomeRowsBad);
    }
    if let ([view], false) = (&views[..], args.quiet) {
        print_error(&view.verdict);
    }
    let title = input_name(robot.robot.path());
    let html = page_html(&title, painter.meshes(), views)?;
    write_page(&html, out, args.quiet)?;
    Ok(if problems.is_empty() {
        RunOutcome::AllAnswered
    } else {
        RunOutcome::SomeRowsBad
    })
}

fn view_scene(args: &ViewArgs, path: &Path) -> Result<RunOutcome> {
    let table = scene_table::read(("--scene", path), (&args.meshes, args.duration), &args.out)?;
    if !args.quiet {
        table.print_load_report(args.tolerance());
    }
    let out = Output::claim(&args.out)?;
    let bodies = table.bodies_to_draw();
    let contacts = table.contacts(settings(args));
    let title = input_name(path);
    let (meshes, view) = scene_view(&title, &bodies, &contacts, table.duration);
    if !args.quiet {
        print_error(&view.verdict);
    }
    let html = page_html(&title, &meshes, vec![view])?;
    write_page(&html, out, args.quiet)?;
    Ok(RunOutcome::AllAnswered)
}
