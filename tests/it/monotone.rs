//! Tests that a smaller tolerance gives a later contact, or none.

use ccd_core::{Answer, Outcome, Settings};
use ccd_tests::backends::default_backend_answer;
use ccd_tests::strategies::{cases, check_cases};
use std::cell::Cell;

#[test]
fn a_smaller_tolerance_is_never_earlier() {
    let later = Cell::new(0);
    check_cases(400, cases(), |case| {
        let query = case.query();
        let mut last: Option<(f64, Answer)> = None;
        for tolerance in [1e-1, 1e-3, 1e-5, 1e-7] {
            let config = Settings {
                tolerance,
                ..case.config()
            };
            let answer = default_backend_answer(&query, &config);
            let time = contact_time(&answer)?;
            if let Some((before, coarse)) = last.replace((time, answer)) {
                if time < before {
                    return Err(format!("{time} < {before}\n{coarse:?}\n{answer:?}"));
                }
                later.set(later.get() + u32::from(time > before));
            }
        }
        Ok(())
    });
    assert!(later.get() > 400, "{later:?}");
}

/// Returns the time of the reported contact; infinity for bodies that stay free, 0 for bodies in contact at the start.
fn contact_time(answer: &Answer) -> Result<f64, String> {
    match answer.outcome {
        Outcome::Contact { time, .. } => Ok(time),
        Outcome::Free { .. } => Ok(f64::INFINITY),
        Outcome::Touching { .. } | Outcome::Overlapping { .. } => Ok(0.0),
        _ => Err(format!("{answer:?}")),
    }
}
