//! Measures all combinations of methods, scenes and tolerances, one after another, into a journal.

use crate::method::guarded::Programs;
use crate::method::{Method, MotionKind};
use crate::run::contest::{Allowance, Contest, Journal, Session, Truths, program_stamp};
use crate::scene::{Listing, Models, Pieces, Scene, SceneBody};
use crate::show::chart::PAPER_TOLERANCE;
use anyhow::Result;
use rayon::iter::{IntoParallelIterator, ParallelIterator};
use rigid_ccd::command::{Progress, Total};
use std::path::PathBuf;
use std::sync::Arc;

/// The measurements to make.
#[derive(Clone, Debug)]
pub struct Plan {
    /// The scenes.
    pub listings: Vec<Listing>,
    /// The methods.
    pub methods: Vec<Method>,
    /// The tolerances.
    pub tolerances: Vec<f64>,
    /// The limits of each method on each scene; a peer may run a single row, and prepares nothing on first use.
    pub allowance: Allowance,
    /// The programs that run the methods.
    pub programs: Programs,
    /// The folder of mesh files that replace the models made by code.
    pub models: Option<PathBuf>,
    /// The folder of the measurements.
    pub folder: PathBuf,
}

/// The measurements, with their scenes and truths.
pub struct Evaluated {
    /// The scenes.
    pub scenes: Vec<Scene>,
    /// The cells and trials.
    pub journal: Journal,
    /// The truths that the answers were compared with.
    pub truths: Truths,
}

/// The file of the known truths, in the folder of the measurements.
const TRUTHS: &str = "truth.csv";

/// The tolerance of methods without a tolerance of their own.
pub const USUAL_TOLERANCE: f64 = PAPER_TOLERANCE;

impl Plan {
    /// Returns the measurements in the folder, whatever their settings, and measures nothing.
    ///
    /// # Errors
    /// If a scene cannot be made, or the truths cannot be read.
    pub fn recall(&self) -> Result<Evaluated> {
        let mut models = Models::new(self.models.clone());
        let scenes = self.listings.iter().map(|l| l.make(&mut models));
        Ok(Evaluated {
            scenes: scenes.collect::<Result<_>>()?,
            journal: Journal::read(&self.folder),
            truths: Truths::read(&self.folder.join(TRUTHS))?,
        })
    }

    /// Measures whatever is missing in the folder.
    ///
    /// # Errors
    /// If a scene cannot be made, a method cannot be run, or a file cannot be kept; earlier measurements are kept.
    pub fn run(&self) -> Result<Evaluated> {
        for &method in &self.methods {
            self.programs.check(method)?;
        }
        let mut journal = Journal::open(&self.folder, &self.stamp(), &[TRUTHS])?;
        let truths_file = self.folder.join(TRUTHS);
        let mut truths = Truths::read(&truths_file)?;
        let mut models = Models::new(self.models.clone());
        let scenes = self.scenes(&mut models)?;
        let cells: usize = self
            .methods
            .iter()
            .map(|&method| self.tolerances_of(method).count())
            .sum();
        let progress = Progress::new(Total::Steps(scenes.len() * cells));
        for scene in &scenes {
            let contest = Contest::new(scene)?;
            progress.say(&format!("{}: the truth", scene.name));
            let rows = contest.order(self.allowance.rows);
            for motion in self.motions() {
                if truths.find(&contest, motion, &rows, &progress) > 0 {
                    truths.write(&truths_file)?;
                }
            }
            self.run_scene(&contest, &truths, &mut journal, &progress)?;
        }
        drop(progress);
        Ok(Evaluated {
            scenes,
            journal,
            truths,
        })
    }

    fn run_scene(
        &self,
        contest: &Contest<'_>,
        truths: &Truths,
        journal: &mut Journal,
        progress: &Progress,
    ) -> Result<()> {
        let scene = &contest.scene().name;
        for &method in &self.methods {
            let name = method.to_string();
            let least_rows = match method {
                Method::Peer(_) | Method::Script(_) => 1,
                Method::Ours(..) | Method::Rival(_) => self.allowance.least_rows,
            };
            let allowance = Allowance {
                least_rows,
                ..self.allowance
            };
            let mut session = None;
            for tolerance in self.tolerances_of(method) {
                progress.step();
                if journal.has(scene, &name, tolerance) {
                    continue;
                }
                progress.say(&format!("{scene}: {name}, {tolerance:e}"));
                if session.is_none() {
                    session = Session::open(method, contest.scene(), &self.programs)?;
                }
                let Some(session) = &mut session else {
                    continue;
                };
                if let Some((cell, trials)) = contest.run(session, tolerance, &allowance, truths)? {
                    journal.add(cell, trials)?;
                }
            }
        }
        Ok(())
    }

    fn scenes(&self, models: &mut Models) -> Result<Vec<Scene>> {
        let progress = Progress::new(Total::Steps(self.listings.len()));
        let make = |listing: &Listing| {
            progress.say(&format!("making {}", listing.name));
            let scene = listing.make(models);
            progress.step();
            scene
        };
        let scenes: Result<Vec<Scene>> = self.listings.iter().map(make).collect();
        let scenes = scenes?;
        progress.say("making pieces");
        self.make_pieces(&scenes);
        Ok(scenes)
    }

    /// Prepares the pieces of all bodies that some method needs, on all processors.
    fn make_pieces(&self, scenes: &[Scene]) {
        let mut wanted: Vec<(&SceneBody, Pieces)> = Vec::new();
        for body in scenes.iter().flat_map(|scene| [&scene.a, &scene.b]) {
            for &method in &self.methods {
                let Method::Ours(_, pieces) = method else {
                    continue;
                };
                let same = |(b, p): &(&SceneBody, Pieces)| {
                    *p == pieces && Arc::ptr_eq(&b.body, &body.body)
                };
                if !wanted.iter().any(same) {
                    wanted.push((body, pieces));
                }
            }
        }
        wanted.into_par_iter().for_each(|(body, pieces)| {
            body.body_of(pieces);
        });
    }

    /// Returns the tolerances for a method: all, or the usual one if it takes none.
    fn tolerances_of(&self, method: Method) -> impl Iterator<Item = f64> {
        self.tolerances
            .iter()
            .copied()
            .filter(move |&tolerance| method.takes_tolerances() || tolerance == USUAL_TOLERANCE)
    }

    /// Returns the kinds of motion that some method uses.
    fn motions(&self) -> Vec<MotionKind> {
        let mut motions = Vec::new();
        for motion in self.methods.iter().map(|method| method.motion_kind()) {
            if !motions.contains(&motion) {
                motions.push(motion);
            }
        }
        motions
    }

    /// Describes the settings that determine all measurements: this program, and the allowances.
    fn stamp(&self) -> String {
        format!(
            "{}models {}\nmethods {:?}\n",
            program_stamp(),
            self.models
                .as_ref()
                .map_or("by code".into(), |folder| folder.display().to_string()),
            self.allowance
        )
    }
}
