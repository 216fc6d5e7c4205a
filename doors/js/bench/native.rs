//! Answers random queries natively, with the best vector instructions and with 128-bit ones, and writes them with times and
//! answers as JSON, for `doors/js/bench/bench.mjs`.

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use rigid_ccd::glam::DQuat;
use rigid_ccd::schedule::{EngineOptions, VectorInstructions};
use rigid_ccd::{Body, Motion, Outcome, Pose, Query, Question, Settings, Solver, load};
use serde_json::{Value, json};
use std::error::Error;
use std::io::Write;
use std::time::Instant;

const QUERY_COUNT: usize = 400;
const ROUND_COUNT: usize = 40;
const KNOT: &str = concat!(
    env!("CARGO_MANIFEST_DIR"),
    "/../../rigid-ccd/tests/data/knot216.obj"
);

/// A motion in the order of JavaScript: position, quaternion x, y, z, w, velocity, and angular velocity.
type Numbers = ([f64; 3], [f64; 4], [f64; 3], [f64; 3]);

fn main() -> Result<(), Box<dyn Error>> {
    let knot = load(KNOT)?;
    let families = [
        family("two boxes", (Body::cuboid([0.5, 0.3, 0.2])?, "box"), 1.0)?,
        family("a capsule", (Body::capsule(0.2, 0.5)?, "capsule"), 1.0)?,
        family("two knots", (knot, "knot"), 8.0)?,
    ];
    let text = serde_json::to_vec(
        &json!({ "knot": std::fs::read_to_string(KNOT)?, "families": families }),
    )?;
    Ok(std::io::stdout().write_all(&text)?)
}

/// Returns queries that throw a body at another one of its kind, or a capsule at a box, from about the distance `far`.
fn family(name: &str, (body, kind): (Body, &str), far: f64) -> Result<Value, Box<dyn Error>> {
    let target = match kind {
        "capsule" => Body::cuboid([0.5, 0.3, 0.2])?,
        _ => body.clone(),
    };
    let mut random = Pcg64Mcg::seed_from_u64(11);
    let mut within = |half: f64| [0; 3].map(|_| random.random_range(-half..half));
    let numbers: Vec<Numbers> = std::iter::repeat_with(|| {
        let (place, aim, spin, [x, y, z]) = (
            within(2.0 * far),
            within(0.6 * far),
            within(4.0),
            within(1.0),
        );
        let velocity = [0, 1, 2].map(|k| 1.5 * (aim[k] - place[k]));
        (place, [x, y, z, 1.0], velocity, spin)
    })
    .take(QUERY_COUNT)
    .collect();
    let motions = numbers.iter().map(|&(place, quaternion, velocity, spin)| {
        let start = Pose::new(place, DQuat::from_array(quaternion))?;
        Motion::new(start, velocity, spin)
    });
    let motions: Vec<Motion> = motions.collect::<Result<_, _>>()?;
    let ask = |instructions| -> Result<_, Box<dyn Error>> {
        let options = EngineOptions {
            vector_instructions: instructions,
            ..EngineOptions::DEFAULT
        };
        let mut solver = Solver::new();
        let mut answers = Vec::new();
        // The least time of all rounds, because other load of the machine only adds time.
        let mut micros = Vec::new();
        for _ in 0..ROUND_COUNT {
            answers.clear();
            let begun = Instant::now();
            for &motion in &motions {
                let at_rest = (&target, Motion::STILL);
                let query = Query::new((&body, motion), at_rest, 1.0, &Settings::DEFAULT)?;
                let query = query.with_engine_options(options);
                let answer = solver.answer_query(Question::FirstContact, &query)?;
                answers.push(answer.outcome);
            }
            micros.push(1e6 * begun.elapsed().as_secs_f64() / QUERY_COUNT as f64);
        }
        Ok((micros.into_iter().min_by(f64::total_cmp), answers))
    };
    let (micros, answers) = ask(VectorInstructions::Best)?;
    let (micros_128, _) = ask(VectorInstructions::Baseline)?;
    let times = answers.iter().map(|outcome| match outcome {
        Outcome::Free { .. } => Value::Null,
        outcome => json!(outcome.time()),
    });
    let times: Vec<Value> = times.collect();
    Ok(json!({
        "name": name,
        "kind": kind,
        "motions": numbers,
        "micros": micros,
        "micros128": micros_128,
        "times": times,
    }))
}
