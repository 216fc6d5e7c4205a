//! Decodes queries from bytes, and judges their answers by the referee.

mod decode;
mod encode;
mod source;

use crate::case::Case;
use crate::engine::{Bodies, HullTrees, Method, PieceKind};
use crate::trial::run_and_judge;
use ccd_core::schedule::{EngineOptions, VectorInstructions};
use ccd_core::{ContactsError, Outcome};
pub use encode::encode;

/// A query, and the methods that answer it.
struct QueryAndMethods {
    case: Case,
    kinds_and_methods: Vec<(PieceKind, Method)>,
    /// Whether to check also that other vector instructions give equal bits, and that contacts can be listed.
    has_extra_checks: bool,
}

/// Decodes a query, answers it by its methods, and judges the answers.
///
/// # Panics
/// If an answer has a fault.
pub(super) fn run(bytes: &[u8]) {
    let question = decode::decode_query_and_methods(bytes);
    let trial = run_and_judge(question.case.clone(), question.kinds_and_methods, || {});
    if let Some(failure) = trial.failures.first() {
        panic!("{}", failure.report("", &trial.case));
    }
    if question.has_extra_checks && trial.refusal_reason.is_none() {
        run_extra_checks(&question.case);
    }
}

/// Checks that other vector instructions give answers of the same bits, and that contacts can be listed.
fn run_extra_checks(case: &Case) {
    let Ok(bodies) = Bodies::new(case, PieceKind::Triangles, HullTrees::NotBuilt) else {
        return;
    };
    let answer = |instructions| {
        let options = EngineOptions {
            vector_instructions: instructions,
            ..EngineOptions::DEFAULT
        };
        let problem = bodies.problem(case, &case.config).ok()?;
        let problem = problem.with_engine_options(options);
        let answer = Method::Direct.solve(&problem);
        if let Outcome::Contact { time, .. } = answer.outcome {
            let contacts = problem.contacts_at(time);
            let answered = matches!(contacts, Ok(_) | Err(ContactsError::TooManyPairs { .. }));
            assert!(answered, "{contacts:?}\n{}", case.reproducer());
        }
        // The text distinguishes all numbers, and NaN equals itself.
        Some(format!("{:?}", answer.outcome))
    };
    let [best, baseline] = [VectorInstructions::Best, VectorInstructions::Baseline].map(answer);
    assert_eq!(best, baseline, "{}", case.reproducer());
}
