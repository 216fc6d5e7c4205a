//! Measures all combinations of methods, scenes and tolerances, one after another, and records them in a journal.

use crate::method::guarded::MethodPrograms;
use crate::method::{Method, PAPER_TOLERANCE};
use crate::run::contest::{
    Journal, MeasurementLimits, PreparedScene, Session, program_fingerprint,
};
use crate::scene::{ModelBodyCache, PieceKind, Scene, SceneBody, SceneDescription};
use anyhow::Result;
use rayon::iter::{IntoParallelIterator, ParallelIterator};
use rigid_ccd_cli::{Progress, TotalWork};
use std::collections::HashMap;
use std::path::PathBuf;
use std::sync::Arc;

/// The measurements to make: scenes, methods, tolerances and limits.
#[derive(Clone, Debug)]
pub struct MeasurementPlan {
    /// The descriptions of the scenes on which the methods run.
    pub scene_descriptions: Vec<SceneDescription>,
    /// The methods to measure on every scene.
    pub methods: Vec<Method>,
    /// The tolerances at which to measure each method.
    pub tolerances: Vec<f64>,
    /// The limits of the measurement of one method on one scene at one tolerance. For a peer, `min_rows` is 1, and
    /// `preparation` does not apply.
    pub limits: MeasurementLimits,
    /// The programs that run the methods: this program, and a script for some.
    pub programs: MethodPrograms,
    /// The folder of mesh files that replace the models made by code.
    pub model_folder: Option<PathBuf>,
    /// The folder into which the measurements are written.
    pub folder: PathBuf,
}

/// The measurements made, with their scenes.
pub struct Evaluation {
    /// The scenes that the methods were run on.
    pub scenes: Vec<Scene>,
    /// The measurements of all cells and trials.
    pub journal: Journal,
}

impl MeasurementPlan {
    /// Returns the measurements in the folder, whatever their settings, and measures nothing.
    ///
    /// # Errors
    /// If a scene cannot be made.
    pub fn load_measurements(&self) -> Result<Evaluation> {
        let mut models = ModelBodyCache::new(self.model_folder.clone());
        let scenes = self
            .scene_descriptions
            .iter()
            .map(|l| l.make_scene(&mut models));
        Ok(Evaluation {
            scenes: scenes.collect::<Result<_>>()?,
            journal: Journal::read(&self.folder),
        })
    }

    /// Makes the measurements that the folder does not have yet.
    ///
    /// # Errors
    /// If a scene cannot be made, a method cannot be run, or a file cannot be kept; earlier measurements are kept.
    pub fn run(&self) -> Result<Evaluation> {
        for &method in &self.methods {
            self.programs.check_script_starts(method)?;
        }
        let mut journal = Journal::open(&self.folder, &self.fingerprint())?;
        let mut models = ModelBodyCache::new(self.model_folder.clone());
        let scenes = self.scenes(&mut models)?;
        let cells: usize = self
            .methods
            .iter()
            .map(|&method| self.tolerances_of(method).count())
            .sum();
        let progress = Progress::new(TotalWork::Steps(scenes.len() * cells));
        for scene in &scenes {
            let contest = PreparedScene::new(scene)?;
            self.measure_scene(&contest, &mut journal, &progress)?;
        }
        drop(progress);
        Ok(Evaluation { scenes, journal })
    }

    fn measure_scene(
        &self,
        contest: &PreparedScene<'_>,
        journal: &mut Journal,
        progress: &Progress,
    ) -> Result<()> {
        let scene = &contest.scene().name;
        for &method in &self.methods {
            let name = method.to_string();
            let least_rows = match method {
                Method::Peer(_) | Method::Script(_) => 1,
                Method::ThisProject(..) | Method::Rival(_) => self.limits.min_rows,
            };
            let allowance = MeasurementLimits {
                min_rows: least_rows,
                ..self.limits
            };
            let mut session = None;
            for tolerance in self.tolerances_of(method) {
                progress.step();
                if journal.has_cell(scene, &name, tolerance) {
                    continue;
                }
                progress.set_message(&format!("{scene}: {name}, {tolerance:e}"));
                if session.is_none() {
                    session = Session::open(method, contest.scene(), &self.programs)?;
                }
                let Some(session) = &mut session else {
                    continue;
                };
                if let Some((cell, trials)) = contest.run(session, tolerance, &allowance)? {
                    journal.add(cell, trials)?;
                }
            }
        }
        Ok(())
    }

    fn scenes(&self, models: &mut ModelBodyCache) -> Result<Vec<Scene>> {
        let progress = Progress::new(TotalWork::Steps(self.scene_descriptions.len()));
        let make = |listing: &SceneDescription| {
            progress.set_message(&format!("making {}", listing.name));
            let scene = listing.make_scene(models);
            progress.step();
            scene
        };
        let scenes: Result<Vec<Scene>> = self.scene_descriptions.iter().map(make).collect();
        let scenes = scenes?;
        progress.set_message("making pieces");
        self.make_pieces(&scenes);
        Ok(scenes)
    }

    /// Makes the pieces of all bodies that some method needs, on all processors.
    fn make_pieces(&self, scenes: &[Scene]) {
        let kinds = self.methods.iter().filter_map(|method| match method {
            Method::ThisProject(_, pieces) => Some(*pieces),
            Method::Rival(_) | Method::Peer(_) | Method::Script(_) => None,
        });
        let bodies = scenes.iter().flat_map(|scene| [&scene.a, &scene.b]);
        // Bodies are shared between scenes.
        let wanted: HashMap<(usize, PieceKind), &SceneBody> = bodies
            .flat_map(|body| {
                let address = Arc::as_ptr(&body.body).addr();
                kinds.clone().map(move |pieces| ((address, pieces), body))
            })
            .collect();
        wanted.into_par_iter().for_each(|((_, pieces), body)| {
            body.body_with_pieces(pieces);
        });
    }

    /// Returns the tolerances at which to measure a method: all, or only the paper's if its answers do not depend on
    /// the tolerance.
    fn tolerances_of(&self, method: Method) -> impl Iterator<Item = f64> {
        self.tolerances.iter().copied().filter(move |&tolerance| {
            method.runs_at_all_tolerances() || tolerance == PAPER_TOLERANCE
        })
    }

    /// Returns a text that identifies the build of this program, the models and the limits, which determine all
    /// measurements.
    fn fingerprint(&self) -> String {
        format!(
            "{}models {}\nmethods {:?}\n",
            program_fingerprint(),
            self.model_folder
                .as_ref()
                .map_or("by code".into(), |folder| folder.display().to_string()),
            self.limits
        )
    }
}
