//! Every method on every scene, held against each other, as a table.

mod agreement;
mod table;

pub use agreement::disagreements;

use crate::engine::{Method, OracleKind, ScheduleKind};
use crate::progress::Progress;
use crate::query::{Bodies, Settings, Timed, run};
use crate::scene::{Models, SCENES, Scene, SceneError};
use crate::summary::Summary;
use ccd_core::InputError;
use std::io;
use std::path::PathBuf;
use std::time::Instant;

/// What the demo can be told.
#[derive(Clone, Debug, Default)]
pub struct DemoOptions {
    /// Where to look for mesh files in place of the models made by code.
    pub models: Option<PathBuf>,
}

/// One method on one scene.
#[derive(Clone, Debug)]
pub struct Measurement {
    /// The method.
    pub method: Method,
    /// What it answered and how fast.
    pub summary: Summary,
    /// How many answers contradict those of the scene's first method; none for that one itself.
    pub disagreements: Option<usize>,
}

/// Why the demo ended early.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum DemoError {
    /// A scene cannot be made.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// A query cannot be posed.
    #[error("scene {scene}: {source}")]
    Query {
        /// The scene.
        scene: String,
        /// Why.
        source: InputError,
    },
    /// Threads cannot be had.
    #[error(transparent)]
    Threads(#[from] rayon::ThreadPoolBuildError),
    /// The table cannot be written.
    #[error("the table cannot be written: {0}")]
    Output(#[from] io::Error),
}

/// A schedule without a tree is only run where pairs of pieces times queries come to at most this; it
/// looks at all pairs in every step.
const MOST_FOR_NAIVE: u64 = 2_000_000;

/// Runs every method on every scene, one query after another on one thread, and writes the table.
///
/// # Errors
/// [`DemoError`].
pub fn demo(options: &DemoOptions, output: &mut dyn io::Write) -> Result<(), DemoError> {
    let start = Instant::now();
    let scenes = scenes(options)?;
    let built = start.elapsed();
    let rows = |scene: &Scene| methods(scene).count() * scene.queries.len();
    let progress = Progress::new(scenes.iter().map(rows).sum());
    let mut measured = Vec::with_capacity(scenes.len());
    for scene in &scenes {
        measured.push(measure(scene, &progress)?);
    }
    drop(progress);
    let measured: Vec<(&Scene, Vec<Measurement>)> = scenes.iter().zip(measured).collect();
    writeln!(output, "{}", table::table(&measured))?;
    table::write_notes(&measured, output)?;
    writeln!(
        output,
        "Scenes made in {:.1} s, all queries answered in {:.1} s.",
        built.as_secs_f64(),
        (start.elapsed() - built).as_secs_f64()
    )?;
    Ok(())
}

fn scenes(options: &DemoOptions) -> Result<Vec<Scene>, SceneError> {
    let progress = Progress::new(SCENES.len());
    let mut models = Models::new(options.models.clone());
    SCENES
        .iter()
        .map(|make| {
            progress.say("making the scenes");
            let scene = make(&mut models);
            progress.step();
            scene
        })
        .collect()
}

/// The methods that a scene is small enough for, the one that others are held against first. Large
/// hulls, which closed forms are not for, are left to the oracles that are made for them.
fn methods(scene: &Scene) -> impl Iterator<Item = (Method, Bodies<'_>)> {
    let all_pairs = scene.pairs() * scene.queries.len() as u64 <= MOST_FOR_NAIVE;
    let suits = move |method: &Method| match method.schedule {
        ScheduleKind::BestFirst => true,
        ScheduleKind::HullFirst | ScheduleKind::Fast => {
            matches!(method.oracle, OracleKind::Gjk | OracleKind::Vmarch)
        }
        ScheduleKind::Naive => all_pairs,
    };
    let with_bodies = |method: Method| Some((method, scene.bodies_for(method.schedule)?));
    Method::all().filter(suits).filter_map(with_bodies)
}

fn measure(scene: &Scene, progress: &Progress) -> Result<Vec<Measurement>, DemoError> {
    let queries: Vec<_> = scene.queries.iter().collect();
    let mut reference: Option<Vec<Timed>> = None;
    let mut measurements = Vec::new();
    for (method, bodies) in methods(scene) {
        progress.say(&format!(
            "{}: {} {}",
            scene.name, method.schedule, method.oracle
        ));
        let settings = Settings {
            method,
            ..Settings::default()
        };
        let timed = run(bodies, &queries, &settings, progress)?
            .into_iter()
            .collect::<Result<Vec<Timed>, InputError>>()
            .map_err(|source| DemoError::Query {
                scene: scene.name.clone(),
                source,
            })?;
        measurements.push(Measurement {
            method,
            summary: Summary::new(&timed, settings.config.tolerance),
            disagreements: reference
                .as_ref()
                .map(|reference| disagreements(&scene.queries, reference, &timed)),
        });
        reference.get_or_insert(timed);
    }
    Ok(measurements)
}
