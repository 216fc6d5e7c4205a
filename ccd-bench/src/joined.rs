//! Scenes for programs elsewhere, and what those measured on them.

use crate::contender::Claim;
use crate::contest::{Contest, Judged, Path, Truths, Verdict, judge, sum_up};
use crate::evaluation::Evaluated;
use crate::measured::{Trial, read};
use crate::motions;
use crate::scene::{Listing, Models, Scene};
use anyhow::{Context, Result, bail};
use ccd_decomp::write_obj;
use serde::Deserialize;
use std::fs::{self, File};
use std::io::BufWriter;
use std::path;

/// A trial measured elsewhere.
#[derive(Debug, Deserialize)]
struct Foreign {
    scene: String,
    method: String,
    tolerance: f64,
    id: String,
    micros: f64,
    steps: u64,
    status: String,
    time: Option<f64>,
}

/// What a program elsewhere says of a query.
enum Said {
    Claim(Claim),
    CutOff,
    /// That it measured something else, such as a single distance: there is nothing to judge.
    Nothing,
}

/// Writes each scene into a folder of its name: `a.obj`, `b.obj`, `motions.csv`.
///
/// # Errors
/// When a scene cannot be made or a file not be written.
pub fn export(
    listings: &[Listing],
    models: Option<path::PathBuf>,
    folder: &path::Path,
) -> Result<()> {
    let mut models = Models::new(models);
    for listing in listings {
        let scene = listing.make(&mut models)?;
        let place = folder.join(&scene.name);
        fs::create_dir_all(&place).with_context(|| place.display().to_string())?;
        let file = |name: &str| {
            let path = place.join(name);
            let file = File::create(&path).with_context(|| path.display().to_string());
            file.map(BufWriter::new)
        };
        write_obj(scene.a.mesh(), file("a.obj")?)?;
        write_obj(scene.b.mesh(), file("b.obj")?)?;
        motions::write(file("motions.csv")?, &scene.queries)?;
    }
    Ok(())
}

/// Judges the trials of a file and adds them to what was measured here.
///
/// # Errors
/// When the file is no table of trials, or is about scenes or queries that there are not.
pub fn join(evaluated: &mut Evaluated, file: &path::Path) -> Result<()> {
    let mut foreign: Vec<Foreign> = read(file)?;
    while let Some(first) = foreign.first() {
        let key = (first.scene.clone(), first.method.clone(), first.tolerance);
        let (group, rest): (Vec<_>, Vec<_>) = foreign
            .into_iter()
            .partition(|f| (&f.scene, &f.method, f.tolerance) == (&key.0, &key.1, key.2));
        foreign = rest;
        if evaluated.journal.has(&key.0, &key.1, key.2) {
            continue;
        }
        let Some(scene) = evaluated.scenes.iter().find(|s| s.name == key.0) else {
            bail!("there is no scene {}, or it was not measured here", key.0);
        };
        let trials = judged(scene, &group, &mut evaluated.truths)?;
        if !trials.is_empty() {
            evaluated.journal.add(sum_up(&trials), trials)?;
        }
    }
    Ok(())
}

fn judged(scene: &Scene, group: &[Foreign], truths: &mut Truths) -> Result<Vec<Trial>> {
    let contest = Contest::new(scene)?;
    let rows: Result<Vec<usize>> = group
        .iter()
        .map(|foreign| {
            let row = scene.queries.iter().position(|q| q.id == foreign.id);
            row.with_context(|| format!("scene {} has no query {}", scene.name, foreign.id))
        })
        .collect();
    let rows = rows?;
    truths.find(
        &contest,
        Path::Given,
        &rows,
        &crate::progress::Progress::hidden(),
    );
    let truth = truths.of(&contest, Path::Given);
    let mut trials = Vec::new();
    for (foreign, &row) in group.iter().zip(&rows) {
        let judged = match said(foreign)? {
            Said::Claim(claim) => judge(
                &contest.referee(),
                &scene.queries[row],
                truth(row),
                claim,
                foreign.tolerance,
            ),
            Said::CutOff => Judged {
                verdict: Verdict::CutOff,
                error: None,
            },
            Said::Nothing => Judged {
                verdict: Verdict::NotJudged,
                error: None,
            },
        };
        trials.push(Trial {
            scene: scene.name.clone(),
            method: foreign.method.clone(),
            tolerance: foreign.tolerance,
            id: foreign.id.clone(),
            micros: foreign.micros,
            steps: foreign.steps,
            verdict: judged.verdict.to_string(),
            error: judged.error.unwrap_or(f64::NAN),
        });
    }
    Ok(trials)
}

fn said(foreign: &Foreign) -> Result<Said> {
    let time = || {
        let time = foreign.time.filter(|time| time.is_finite());
        time.with_context(|| format!("{} of {} has no time", foreign.status, foreign.id))
    };
    Ok(match foreign.status.as_str() {
        "contact" => Said::Claim(Claim::Contact { time: time()? }),
        "free" => Said::Claim(Claim::Free),
        "unresolved" => Said::Claim(Claim::Unresolved {
            safe_until: foreign.time.unwrap_or(0.0),
        }),
        "cut off" => Said::CutOff,
        "distance" => Said::Nothing,
        other => {
            bail!("status {other}: it has to be contact, free, unresolved, cut off or distance")
        }
    })
}
