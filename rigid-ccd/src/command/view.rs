//! `ccd view`: writes a page that shows queries, or a scene of many bodies.

mod args;
mod bodies;
mod chosen;

pub(super) use args::ViewArgs;
use args::{SceneArgs, Subject};
pub(super) use chosen::Chosen;

use super::files::{input_name, open_courses, refuse_overwriting};
use super::pair::{BodiesArgs, Loading, Pair};
use super::{Exit, complain};
use crate::Scene;
use crate::batch::{Question, Settings, SolverKind, time};
use crate::picture::{Painter, scene_view};
use crate::table::courses::Course;
use crate::table::results::{self, ResultRow};
use anyhow::{Context, Result, bail};
use ccd_core::{Config, Instructions};
use ccd_view::{Group, Page, View};
use std::collections::HashMap;
use std::fs::File;
use std::num::NonZeroUsize;
use std::path::Path;

/// The most rows that are looked at for a choice of some.
const LOOKED_AT: usize = 10_000;

/// Writes the page.
pub(super) fn run(args: &ViewArgs) -> Result<Exit> {
    match args.subject() {
        Some(Subject::Rows(bodies, motions)) => view_rows(args, &bodies, motions)?,
        Some(Subject::Scene(path, how)) => view_scene(args, path, how)?,
        None => bail!("give either --a, --b and --motions, or --scene"),
    }
    Ok(Exit::AllAnswered)
}

fn view_rows(args: &ViewArgs, bodies: &BodiesArgs, motions: &Path) -> Result<()> {
    let mut read = bodies.files()?;
    read.push(("--motions", motions.to_owned()));
    read.extend(args.results.iter().map(|path| ("--results", path.clone())));
    for (option, path) in &read {
        refuse_overwriting((option, path), ("--out", &args.out))?;
    }
    let (rows, _) = open_courses(motions, Question::FirstContact.grouping())?;
    let pair = Pair::load(Loading {
        bodies,
        method: SolverKind::default(),
        quiet: args.quiet,
    })?;
    let known = args.results.as_deref().map(read_results).transpose()?;
    let mut chosen = Chosen::new(args.ids.clone());
    let settings = settings(args);
    let mut solver = settings.method.solver(Instructions::Best);
    for row in rows.take(LOOKED_AT) {
        let course = match row.with_context(|| input_name(motions))? {
            Ok((_, course)) => course,
            Err(fault) => {
                chosen.leave_out(fault.to_string());
                continue;
            }
        };
        if chosen.is_named(course.id()) == Some(false) {
            continue;
        }
        let row = match &known {
            Some(known) => known.get(course.id()).cloned(),
            None => Some(answered(&pair, &course, &settings, solver.as_mut())),
        };
        if let Some(row) = row {
            chosen.offer(&course, &row);
        }
        if chosen.is_full() {
            break;
        }
    }
    let title = title(bodies);
    write_rows(&title, &pair, chosen, &args.out, args.quiet)
}

/// Returns the title of a page about two bodies: their names without folders.
pub(super) fn title(bodies: &BodiesArgs) -> String {
    let name = |text: &str| {
        let name = Path::new(text).file_name();
        name.map_or_else(
            || text.to_owned(),
            |name| name.to_string_lossy().into_owned(),
        )
    };
    format!("{} and {}", name(&bodies.a), name(&bodies.b))
}

fn answered(
    pair: &Pair,
    course: &Course,
    settings: &Settings,
    solver: &mut dyn crate::batch::Solve,
) -> ResultRow {
    match time(pair.bodies(), course, settings, solver) {
        Ok(timed) => ResultRow::new(course, &timed.answer, timed.micros, None),
        Err(problem) => ResultRow::error(course.id(), &problem),
    }
}

/// Writes the page of chosen rows.
pub(super) fn write_rows(
    title: &str,
    pair: &Pair,
    mut chosen: Chosen,
    out: &Path,
    quiet: bool,
) -> Result<()> {
    for id in chosen.missing() {
        complain(&format!("no row has the id {id:?}"));
    }
    let mut painter = Painter::new(pair.bodies());
    let mut views = Vec::new();
    for (course, row) in chosen.take_rows() {
        match painter.view(&course, &row) {
            Ok(view) => views.push(view),
            Err(error) => chosen.leave_out(format!("row {}: {error}", row.id)),
        }
    }
    if let Some(faults) = chosen.faults() {
        complain(&faults);
    }
    if views.is_empty() {
        bail!("there is no row to show");
    }
    let page = Page {
        title,
        groups: vec![group(views)],
        meshes: painter.into_meshes(),
    };
    page.write(out)?;
    told(out, quiet);
    Ok(())
}

fn group(views: Vec<View>) -> Group {
    Group {
        name: String::new(),
        views,
    }
}

fn told(out: &Path, quiet: bool) {
    if !quiet {
        complain(&format!("open {} in a browser", out.display()));
    }
}

/// Reads a table of results, by id.
fn read_results(path: &Path) -> Result<HashMap<String, ResultRow>> {
    let name = || path.display().to_string();
    let file = File::open(path).with_context(name)?;
    let rows = results::read(file).with_context(name)?;
    Ok(rows.into_iter().map(|row| (row.id.clone(), row)).collect())
}

fn settings(args: &ViewArgs) -> Settings {
    Settings {
        question: Question::FirstContact,
        method: SolverKind::default(),
        config: Config {
            tolerance: args.tolerance,
            margin: args.margin,
            ..Config::default()
        },
        repeat: NonZeroUsize::MIN,
    }
}

fn view_scene(args: &ViewArgs, path: &Path, how: SceneArgs<'_>) -> Result<()> {
    refuse_overwriting(("--scene", path), ("--out", &args.out))?;
    let table = bodies::read(path, how)?;
    for (option, path) in table.files() {
        refuse_overwriting((option, path), ("--out", &args.out))?;
    }
    let shown = table.shown();
    let mut scene = Scene::new().with_config(settings(args).config);
    for body in &shown {
        scene.add(body.body, body.motion);
    }
    let contacts = scene.contacts(args.duration);
    let title = input_name(path);
    let (meshes, view) = scene_view(&title, &shown, &contacts, args.duration);
    let page = Page {
        title: &title,
        meshes,
        groups: vec![group(vec![view])],
    };
    page.write(&args.out)?;
    told(&args.out, args.quiet);
    Ok(())
}
