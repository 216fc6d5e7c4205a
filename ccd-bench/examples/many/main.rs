//! Compares the cost of two hundred bodies in free flight over a level of 28,322 triangles with parry's nonlinear casts
//! of the same pairs, at 60 steps a second.
//!
//! ```sh
//! cargo run --release -p ccd-bench --example many -- [STEPS [BODIES]]
//! ```
//!
//! Pairs are those whose ways meet. Either side does its own work on each step: ours with the broad phase, the
//! peer's casts alone.

mod flight;
mod peer;

use anyhow::Result;
use flight::{Flight, KINDS, Kind, STEP, Shape, shapes};
use peer::Tally;
use rigid_ccd::batch::median;
use rigid_ccd::scene::Impact;
use rigid_ccd::trajectory::Moving;
use rigid_ccd::{Motion, Pose, Scene, Settings};
use std::collections::HashMap;
use std::io::Write;
use std::num::NonZeroUsize;
use std::time::Instant;

fn main() -> Result<()> {
    let number = |index: usize, default: u32| {
        let text = std::env::args().nth(index);
        text.map_or(Ok(default), |text| text.parse())
    };
    let (steps, bodies) = (number(1, 40)?, number(2, 200)?);
    let shapes = shapes()?;
    let mut out = std::io::stdout().lock();
    writeln!(
        out,
        "scene,pairs,contacts,first ms,each ms,all ms,all worst ms,parry ms,ratio,agree,parry late,missed,early,hung,ours unconfirmed,ours later"
    )?;
    for kind in KINDS {
        let flight = Flight::new(kind, bodies as usize, shapes.len(), 7);
        let row = Row::measure(&flight, &shapes, steps)?;
        row.write(kind, &mut out)?;
    }
    Ok(())
}

/// The measurements of one scene.
#[derive(Default)]
struct Row {
    /// The milliseconds of each step, for the first contact of all, that of each body, and that of each pair.
    first: Vec<f64>,
    each: Vec<f64>,
    all: Vec<f64>,
    contacts: usize,
    tally: Tally,
}

impl Row {
    fn measure(flight: &Flight, shapes: &[Shape], steps: u32) -> Result<Self> {
        let mut row = Row::default();
        let config = Settings::DEFAULT;
        let mut scene = Scene::with_threads(NonZeroUsize::MIN).with_settings(config.clone());
        scene.add_fixed(&shapes[0].body, Pose::IDENTITY);
        for (shape, motion) in flight.step(0)? {
            scene.add(&shapes[shape].body, motion);
        }
        let mut impacts = Vec::new();
        for step in 0..steps {
            for (k, (_, motion)) in flight.step(step)?.into_iter().enumerate() {
                scene.set_movement(k + 1, motion)?;
            }
            let least = |question: &mut dyn FnMut()| {
                let times = (0..5).map(|_| {
                    let begun = Instant::now();
                    question();
                    1e3 * begun.elapsed().as_secs_f64()
                });
                times.min_by(f64::total_cmp).unwrap_or_default()
            };
            row.first
                .push(least(&mut || drop(scene.first_contact(STEP))));
            row.each
                .push(least(&mut || drop(scene.first_contact_of_each(STEP))));
            row.all.push(least(&mut || drop(scene.contacts(STEP))));
            let found: Vec<Impact> = scene.contacts(STEP).into_iter().collect::<Result<_, _>>()?;
            row.contacts += found.len();
            impacts.push(found);
        }
        // The peer comes last, because a cast that does not return occupies a core.
        for (step, found) in impacts.iter().enumerate() {
            row.cast(&flight.step(step as u32)?, shapes, found, &config)?;
        }
        Ok(row)
    }

    /// Runs the peer library's casts for all pairs of a step whose boxes meet.
    fn cast(
        &mut self,
        step: &[(usize, Motion)],
        shapes: &[Shape],
        found: &[Impact],
        config: &Settings,
    ) -> Result<()> {
        let found: HashMap<[usize; 2], &Impact> =
            found.iter().map(|impact| (impact.bodies, impact)).collect();
        let mut all = vec![(0, Motion::STILL)];
        all.extend(step);
        let boxes = all.iter().map(|&(shape, motion)| {
            Moving::from((&shapes[shape].body, motion)).swept_box(STEP, config)
        });
        let boxes = boxes.collect::<Result<Vec<_>, _>>()?;
        for b in 0..all.len() {
            for a in (0..b).filter(|&a| boxes[a].meets(&boxes[b])) {
                let ours = found.get(&[a, b]).copied();
                let pair = [&all[a], &all[b]];
                self.tally.add(
                    pair.map(|x| &x.1),
                    pair.map(|x| &shapes[x.0]),
                    ours,
                    config.tolerance,
                );
            }
        }
        Ok(())
    }

    fn write(self, kind: Kind, out: &mut impl Write) -> Result<()> {
        let Row {
            mut first,
            mut each,
            mut all,
            contacts,
            tally,
        } = self;
        let steps = all.len();
        let worst = all
            .iter()
            .copied()
            .max_by(f64::total_cmp)
            .unwrap_or_default();
        let theirs = 1e3 * tally.time.as_secs_f64() / steps as f64;
        let ours = all.iter().sum::<f64>() / steps as f64;
        writeln!(
            out,
            "{kind:?},{},{},{:.3},{:.3},{:.3},{worst:.3},{theirs:.1},{:.0},{},{},{},{},{},{},{}",
            tally.pairs / steps,
            contacts / steps,
            median(&mut first),
            median(&mut each),
            median(&mut all),
            theirs / ours,
            tally.agree,
            tally.late,
            tally.missed,
            tally.early,
            tally.hung,
            tally.unconfirmed,
            tally.later_than_peer,
        )?;
        Ok(())
    }
}
