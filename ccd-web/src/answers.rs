//! Computes answers natively, so that the page can compare them with the answers that it computes in the browser.

use ccd_web::{Part, Throw, WebError};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use serde_json::{Value, json};
use std::f64::consts::TAU;

/// The number of random throws whose answers the page checks.
const THROW_COUNT: u32 = 400;
/// The number of equal time steps into which each throw is divided.
const TIME_STEP_COUNT: u32 = 60;

/// Returns random throws as JSON, each with its certified first contact and with tests at discrete time steps.
pub(crate) fn random_throw_results() -> Result<Value, WebError> {
    let mut random = Pcg64Mcg::seed_from_u64(7);
    let (parts, targets) = Part::NAMES.split_at(5);
    let mut answer = || {
        let part = parts[random.random_range(0..parts.len())];
        let target = [targets, &["knot"]].concat()[random.random_range(0..=targets.len())];
        let mut within = |half: f64| [0; 3].map(|_| random.random_range(-half..half));
        let (place, aim, spin) = (within(1.5), within(0.4), within(2.0 * TAU));
        let speed = random.random_range(1.0..4.0);
        let throw = Throw {
            place,
            velocity: [0, 1, 2].map(|k| speed * (aim[k] - place[k])),
            spin,
        };
        let (one, other) = (Part::from_name(part)?, Part::from_name(target)?);
        let found = throw.first_contact(&one, &other)?;
        let seen = throw.steps(&one, &other, TIME_STEP_COUNT)?;
        let numbers = [throw.place, throw.velocity, throw.spin].concat();
        Ok(json!({
            "part": part,
            "target": target,
            "throw": numbers,
            "verdict": found.verdict,
            "time": found.time,
            "steps": seen,
        }))
    };
    (0..THROW_COUNT).map(|_| answer()).collect()
}
