//! Draws one query of a family, and answers it by several methods, with a time limit.

use crate::case::{Case, MeshClass};
use crate::draw::RandomSource;
use crate::engine::{Method, PieceKind};
use crate::families::Family;
use crate::judge::Fault;
pub use ccd_fuzz::trial::{Failure, Trial, run_and_judge, shrink};
use std::collections::HashMap;
use std::process;
use std::sync::{Arc, Mutex};
use std::thread::{self, ThreadId};
use std::time::{Duration, Instant};

/// The time after which a query counts as hanging.
const HANG_TIME: Duration = Duration::from_secs(20);

pub fn run(family: Family, seed: u64, number: u64, watch: &Watchdog) -> Trial {
    let mut draw = RandomSource::new(seed, number);
    let case = family.draw(&mut draw);
    let asked = methods(&mut draw, &case);
    watch.begin_query(number);
    run_and_judge(case, asked, || watch.end_query())
}

/// Chooses the kinds of pieces and the methods for a case: always the default, and some others.
fn methods(draw: &mut RandomSource, case: &Case) -> Vec<(PieceKind, Method)> {
    let mut asked = vec![(PieceKind::Triangles, Method::Direct)];
    let form = |form: MeshClass| case.shapes.iter().any(|s| s.mesh_class == form);
    let small = case.shapes.iter().all(|s| s.faces.len() < 200);
    if draw.bool_with_probability(0.4) {
        asked.push((
            PieceKind::Triangles,
            draw.pick(&[Method::Gjk, Method::Vmarch]),
        ));
    }
    let pieces = match (form(MeshClass::Convex), form(MeshClass::Solid)) {
        (true, _) => draw.pick(&[PieceKind::Hull, PieceKind::Patches]),
        (false, true) => PieceKind::Patches,
        _ => PieceKind::Triangles,
    };
    if pieces != PieceKind::Triangles && draw.bool_with_probability(0.6) {
        asked.push((
            pieces,
            draw.pick(&[Method::Direct, Method::Gjk, Method::Vmarch]),
        ));
    }
    let turn: f64 = case
        .motions
        .iter()
        .map(|c| c.max_rotation_angle(case.duration))
        .sum();
    if small && turn < 20.0 && draw.bool_with_probability(0.15) {
        asked.push((draw.pick(&[PieceKind::Triangles, pieces]), Method::Naive));
    }
    // Trees need exact predicates, which the finest coordinates do not allow.
    if small && turn < 20.0 && draw.bool_with_probability(0.1) {
        asked.push((pieces, Method::Fast));
    }
    asked
}

/// Returns the report of a failure, with the command that repeats its query.
pub fn report(failure: &Failure, family: Family, seed: u64, number: u64, case: &Case) -> String {
    let name = format!("{family:?}").to_lowercase();
    let command = format!("fuzz --family {name} --seed {seed} --only {number}");
    failure.report(&command, case)
}

/// A watchdog over all threads, which ends the program if one of them hangs.
#[derive(Clone)]
pub struct Watchdog(Arc<Mutex<HashMap<ThreadId, (u64, Instant)>>>);

impl Watchdog {
    pub fn start(family: Family, seed: u64) -> Self {
        let watch = Watchdog(Arc::default());
        let all = Arc::downgrade(&watch.0);
        thread::spawn(move || {
            while let Some(all) = all.upgrade() {
                let late = all.lock().ok().and_then(|all| {
                    all.values()
                        .find(|(_, since)| since.elapsed() > HANG_TIME)
                        .map(|&(n, _)| n)
                });
                drop(all);
                if let Some(number) = late {
                    let case = family.draw(&mut RandomSource::new(seed, number));
                    eprintln!(
                        "{:?}: {family:?} --seed {seed} --only {number}",
                        Fault::Hang
                    );
                    eprintln!("{}", case.reproducer());
                    process::exit(1);
                }
                thread::sleep(Duration::from_millis(500));
            }
        });
        watch
    }

    fn begin_query(&self, number: u64) {
        if let Ok(mut all) = self.0.lock() {
            all.insert(thread::current().id(), (number, Instant::now()));
        }
    }

    fn end_query(&self) {
        if let Ok(mut all) = self.0.lock() {
            all.remove(&thread::current().id());
        }
    }
}
