//! Checks prepared bodies: they are stored without loss, and queries on them agree.

use crate::engine::Method;
use ccd_core::glam::DVec3;
use ccd_core::{Answer, Body, Motion, MovingBody, Outcome, Pose, Settings};
use ccd_decomp::StoredBodyContent;

/// The work budget of each query, in iterations.
const BUDGET: u64 = 4000;

/// Checks that a stored model reads back to the same bytes, and that queries on its body agree.
pub(super) fn check_storing(model: &StoredBodyContent) {
    let bytes = stored_bytes(model);
    let again = StoredBodyContent::read(&bytes[..]).expect("a model that was stored");
    assert!(stored_bytes(&again) == bytes, "stored again, it differs");
    // A model that cannot be a body, for its number of pieces or their size, names the reason.
    match (model.body(), again.body()) {
        (Ok(body), Ok(_)) => check_methods_agree(&body),
        (Err(one), Err(other)) => assert_eq!(one.to_string(), other.to_string()),
        (one, other) => panic!("{:?} and {:?}", one.err(), other.err()),
    }
}

pub(super) fn stored_bytes(model: &StoredBodyContent) -> Vec<u8> {
    let mut bytes = Vec::new();
    model.write(&mut bytes).expect("memory takes all bytes");
    bytes
}

/// Runs all methods on a ball that flies past the body, and checks that no two answers contradict each other.
pub(super) fn check_methods_agree(body: &Body) {
    let points = body.pieces().points();
    let (Some(&first), Some(&last)) = (points.first(), points.last()) else {
        panic!("a body without points");
    };
    let size = points.iter().fold(0.0, |size, p| {
        let far = (*p - first).abs().max_element();
        if far > size { far } else { size }
    });
    let Ok(ball) = Body::sphere(0.125 * size + 1e-3) else {
        return;
    };
    // The ball flies from an arbitrary side at a point of the body, and beyond it.
    let way = DVec3::new(0.75, 0.5, 0.25) * (size + 1e-3);
    let Some(falls) = linear_motion(last - 2.0 * way, 4.0 * way) else {
        return;
    };
    let config = Settings {
        tolerance: 1e-3 * size + 1e-6,
        budget: BUDGET,
        ..Settings::DEFAULT
    };
    let ball = MovingBody::from((&ball, falls));
    let still = MovingBody::from((body, Motion::STILL));
    let Ok(problem) = ccd_core::Query::new(ball, still, 1.0, &config) else {
        return;
    };
    check_answers_agree(&problem, body.hull_tree().is_some());
}

fn linear_motion(from: DVec3, velocity: DVec3) -> Option<Motion> {
    Motion::new(Pose::at(from).ok()?, velocity, DVec3::ZERO).ok()
}

fn check_answers_agree(problem: &ccd_core::Query<'_>, hull_tree: bool) {
    let mut methods = vec![Method::Direct, Method::Gjk, Method::Vmarch, Method::Naive];
    methods.extend(hull_tree.then_some(Method::Fast));
    let answers: Vec<(Method, Answer)> = methods
        .into_iter()
        .map(|method| (method, method.solve(problem)))
        .collect();
    for (_, one) in &answers {
        for (_, other) in &answers {
            assert!(
                !contradicts(one, other),
                "{answers:#?}",
                answers = answers
                    .iter()
                    .map(|(m, a)| format!("{m}: {:?}", a.outcome))
                    .collect::<Vec<_>>()
            );
        }
    }
}

/// Returns whether the answer `free` proves that the answer `contact` is false. The contact is then well within the
/// tolerance, at a time before which `free` proves that there is none.
fn contradicts(free: &Answer, contact: &Answer) -> bool {
    let safe_until = match free.outcome {
        Outcome::Contact { time, .. } => time,
        Outcome::Free { .. } => f64::INFINITY,
        Outcome::Unresolved(known) => known.safe_until,
        _ => 0.0,
    };
    match contact.outcome {
        Outcome::Contact { time, contact } => {
            time < safe_until && contact.separation.upper < 0.25 * free.tolerance
        }
        Outcome::Overlapping { .. } => matches!(
            free.outcome,
            Outcome::Free { .. } | Outcome::Contact { .. } | Outcome::Touching { .. }
        ),
        _ => false,
    }
}
