//! Exports scenes to other programs, and imports the trials that they measured.

use crate::method::solver::Claim;
use crate::method::{Method, MotionKind};
use crate::run::contest::{Contest, Judged, Truths, Verdict, judge, summarise};
use crate::run::evaluation::Evaluated;
use crate::run::measured::{Trial, read};
use crate::scene::{Listing, Models, Scene};
use anyhow::{Context, Result, bail, ensure};
use ccd_decomp::{TriangleMesh, write_obj};
use rigid_ccd::command::Progress;
use rigid_ccd::table::motions::{self, Motions};
use serde::Deserialize;
use std::path::{Path, PathBuf};
use std::{fs, io};

/// A trial that another program measured.
#[derive(Clone, Debug, Deserialize)]
pub struct ForeignTrial {
    scene: String,
    method: String,
    tolerance: f64,
    id: String,
    micros: f64,
    steps: u64,
    status: String,
    time: Option<f64>,
}

/// Writes each scene into a folder with its name: `a.obj`, `b.obj`, `motions.csv`.
///
/// # Errors
/// If a scene cannot be made or a file cannot be written.
pub fn export(listings: &[Listing], models: Option<PathBuf>, folder: &Path) -> Result<()> {
    let mut models = Models::new(models);
    for listing in listings {
        let scene = listing.make(&mut models)?;
        let directory = folder.join(&scene.name);
        fs::create_dir_all(&directory).with_context(|| directory.display().to_string())?;
        let meshes = [scene.a.mesh(), scene.b.mesh()];
        write_inputs(&directory, meshes, &scene.queries)
            .with_context(|| directory.display().to_string())?;
    }
    Ok(())
}

/// Writes two meshes and their motions into a folder: `a.obj`, `b.obj`, `motions.csv`.
///
/// # Errors
/// A file cannot be written.
pub(crate) fn write_inputs(
    folder: &Path,
    meshes: [&TriangleMesh; 2],
    queries: &[Motions],
) -> io::Result<()> {
    for (mesh, name) in meshes.into_iter().zip(["a.obj", "b.obj"]) {
        ccd_file::write(folder.join(name), |out| write_obj(mesh, out))?;
    }
    let write = |out: &mut dyn io::Write| motions::write(out, queries).map_err(io::Error::other);
    ccd_file::write(folder.join("motions.csv"), write)
}

/// Reads a table of trials measured elsewhere.
///
/// # Errors
/// If the file is no such table, or names a method of this program.
pub fn read_trials(file: &Path) -> Result<Vec<ForeignTrial>> {
    let foreign: Vec<ForeignTrial> = read(file)?;
    let own: Vec<String> = Method::all().iter().map(ToString::to_string).collect();
    for trial in &foreign {
        ensure!(
            !own.contains(&trial.method),
            "{} is measured here; give it another name",
            trial.method
        );
        let _ = claim_or_verdict(trial)?;
    }
    Ok(foreign)
}

/// Judges trials that other programs measured, and adds them to the evaluation. They replace earlier trials of the same
/// methods.
///
/// # Errors
/// If a trial names an unknown scene or query.
pub fn join(evaluated: &mut Evaluated, mut foreign: Vec<ForeignTrial>) -> Result<()> {
    for trial in &foreign {
        if evaluated
            .journal
            .cells()
            .iter()
            .any(|c| c.method == trial.method)
        {
            evaluated.journal.forget(&trial.method)?;
        }
    }
    while let Some(first) = foreign.first() {
        let key = (first.scene.clone(), first.method.clone(), first.tolerance);
        let (group, rest): (Vec<_>, Vec<_>) = foreign
            .into_iter()
            .partition(|f| (&f.scene, &f.method, f.tolerance) == (&key.0, &key.1, key.2));
        foreign = rest;
        let Some(scene) = evaluated.scenes.iter().find(|s| s.name == key.0) else {
            bail!("there is no scene {}, or it was not measured here", key.0);
        };
        let trials = judged_trial(scene, &group, &mut evaluated.truths)?;
        evaluated.journal.add(summarise(&trials), trials)?;
    }
    Ok(())
}

fn judged_trial(scene: &Scene, group: &[ForeignTrial], truths: &mut Truths) -> Result<Vec<Trial>> {
    let contest = Contest::new(scene)?;
    let row_of = |foreign: &ForeignTrial| {
        let row = scene.queries.iter().position(|q| q.id == foreign.id);
        row.with_context(|| format!("scene {} has no query {}", scene.name, foreign.id))
    };
    let rows = group.iter().map(row_of).collect::<Result<Vec<_>>>()?;
    truths.find(&contest, MotionKind::Given, &rows, &Progress::hidden());
    let truth = truths.of_scene(&contest, MotionKind::Given);
    let mut trials = Vec::new();
    for (foreign, &row) in group.iter().zip(&rows) {
        let (query, tolerance) = (&scene.queries[row], foreign.tolerance);
        let judged = claim_or_verdict(foreign)?.map_or_else(Judged::without_error, |claim| {
            judge(&contest.referee(), query, truth(row), claim, tolerance)
        });
        trials.push(Trial {
            scene: scene.name.clone(),
            method: foreign.method.clone(),
            tolerance: foreign.tolerance,
            row,
            id: foreign.id.clone(),
            micros: foreign.micros,
            steps: foreign.steps,
            verdict: judged.verdict.to_string(),
            error: judged.error.unwrap_or(f64::NAN),
            time: foreign.time.unwrap_or(f64::NAN),
            note: String::new(),
        });
    }
    Ok(trials)
}

/// Returns the claim of a trial, or the verdict on a trial that has no claim.
fn claim_or_verdict(foreign: &ForeignTrial) -> Result<Result<Claim, Verdict>> {
    let time = || {
        let time = foreign.time.filter(|time| time.is_finite());
        time.with_context(|| format!("{} of {} has no time", foreign.status, foreign.id))
    };
    Ok(match foreign.status.as_str() {
        "contact" => Ok(Claim::Contact { time: time()? }),
        "free" => Ok(Claim::Free),
        "unresolved" => Ok(Claim::Unresolved {
            safe_until: foreign.time.unwrap_or(0.0),
        }),
        "cut off" => Err(Verdict::CutOff),
        "died" => Err(Verdict::Died),
        "static" => Err(Verdict::NotJudged),
        other => {
            bail!("status {other}: it has to be contact, free, unresolved, cut off, died or static")
        }
    })
}
