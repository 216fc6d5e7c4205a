//! Times of the scenes with closed-form answers, whose motions are given as a user's own trajectories, over those
//! of the same motions as such.
//!
//! ```sh
//! cargo run --release -p ccd-tests --example general_path -- [ROUNDS]
//! ```

use ccd_core::schedule::{BestFirst, Schedule};
use ccd_core::{Answer, Config, Journey, Outcome};
use ccd_distance_gjk::Direct;
use ccd_tests::analytic::{Scene, scenes};
use ccd_tests::questions::Own;
use std::io::Write;
use std::time::{Duration, Instant};

/// The time for which each side of a scene is repeated in a round.
const WHILE: Duration = Duration::from_millis(2);

fn main() -> std::io::Result<()> {
    let rounds = std::env::args().nth(1);
    let rounds: usize = rounds.map_or(9, |rounds| rounds.parse().expect("a number of rounds"));
    let mut out = std::io::stdout().lock();
    writeln!(
        out,
        "{:<44} {:>9} {:>9} {:>6}",
        "scene", "µs", "own, µs", "ratio"
    )?;
    let mut ratios = Vec::new();
    let mut differ = 0;
    for scene in scenes() {
        let (mut plain, mut own) = (Vec::new(), Vec::new());
        let mut sides = Sides::new(&scene);
        differ += usize::from(!sides.agree());
        for _ in 0..rounds {
            plain.push(micros(|| sides.plain()));
            own.push(micros(|| sides.own()));
        }
        let (plain, own) = (median(plain), median(own));
        ratios.push(own / plain);
        let name = scene.name.chars().take(44).collect::<String>();
        writeln!(
            out,
            "{name:<44} {plain:>9.2} {own:>9.2} {:>6.2}",
            own / plain
        )?;
    }
    let count = ratios.len();
    ratios.sort_by(f64::total_cmp);
    writeln!(
        out,
        "{count} scenes, {differ} with other answers; ratio: median {:.2}, 90 % below {:.2}, largest {:.2}",
        ratios[count / 2],
        ratios[count * 9 / 10],
        ratios[count - 1]
    )
}

/// Both ways to ask about a scene.
struct Sides<'s> {
    scene: &'s Scene,
    bodies: ccd_tests::query::Bodies,
    schedule: BestFirst<Direct>,
    oracle: Direct,
    config: Config,
}

impl<'s> Sides<'s> {
    fn new(scene: &'s Scene) -> Self {
        let mut all = scene.query.all_bodies();
        Sides {
            scene,
            bodies: all.swap_remove(0),
            schedule: BestFirst::default(),
            oracle: Direct::default(),
            config: Config::default(),
        }
    }

    fn plain(&mut self) -> Answer {
        let problem = self.scene.query.problem(&self.bodies, &self.config);
        self.schedule.solve(&problem, &mut self.oracle)
    }

    fn own(&mut self) -> Answer {
        let query = &self.scene.query;
        let (a, b) = (Own(query.a.motion), Own(query.b.motion));
        let (a, b) = ((self.bodies.a(), &a), (self.bodies.b(), &b));
        let journey = Journey::new(a, b, query.duration, &self.config).expect("a valid query");
        let answer = (self.schedule).first_contact_along(&journey, &mut self.oracle);
        answer.expect("motions within range")
    }

    /// Returns true if both answers are of one kind, or of a near miss.
    fn agree(&mut self) -> bool {
        let kind = |answer: &Answer| std::mem::discriminant(&answer.outcome);
        let (plain, own) = (self.plain(), self.own());
        let near = |answer: &Answer| {
            matches!(
                answer.outcome,
                Outcome::Contact { .. } | Outcome::Touching { .. }
            )
        };
        kind(&plain) == kind(&own) || near(&plain) && near(&own)
    }
}

/// Returns the mean time of a call, in microseconds.
fn micros(mut call: impl FnMut() -> Answer) -> f64 {
    let begin = Instant::now();
    let mut calls = 0;
    while begin.elapsed() < WHILE || calls == 0 {
        std::hint::black_box(call());
        calls += 1;
    }
    begin.elapsed().as_secs_f64() * 1e6 / f64::from(calls)
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}
