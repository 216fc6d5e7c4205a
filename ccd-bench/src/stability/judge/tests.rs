use super::*;
use crate::method::solver::{ContactClaim, Reply, TimedReply};
use crate::run::contest::Verdict;
use crate::stability::families;
use crate::truth::Surface;
use rstest::rstest;

const NO_CONTACT_CLAIM: ContactClaim = ContactClaim::NoContact;

fn contact_claim(time: f64) -> ContactClaim {
    ContactClaim::Contact { time }
}

fn unresolved_claim(safe_until: f64) -> ContactClaim {
    ContactClaim::Unresolved { safe_until }
}

/// Tests the verdict on each kind of claim, on a scene with a contact at 0.5, a scene without contact, and a scene that
/// starts with one body inside the other.
#[rstest]
#[case("margin", contact_claim(0.5), Verdict::Right)]
#[case("margin", contact_claim(0.5 - 1e-7), Verdict::Right)]
#[case("margin", contact_claim(0.49), Verdict::Early)]
#[case("margin", contact_claim(0.5001), Verdict::Late)]
#[case("margin", contact_claim(f64::NAN), Verdict::Late)]
#[case("margin", NO_CONTACT_CLAIM, Verdict::Missed)]
#[case("margin", unresolved_claim(0.4), Verdict::Unresolved)]
#[case("margin", unresolved_claim(0.6), Verdict::Late)]
#[case("margin", ContactClaim::Refused, Verdict::Refused)]
#[case("cubes passing", NO_CONTACT_CLAIM, Verdict::Right)]
#[case("cubes passing", contact_claim(0.5), Verdict::FalseContact)]
#[case("cubes passing", unresolved_claim(0.9), Verdict::Unresolved)]
#[case("one inside the other", contact_claim(0.0), Verdict::Right)]
#[case("one inside the other", contact_claim(0.1), Verdict::Late)]
#[case("one inside the other", NO_CONTACT_CLAIM, Verdict::Missed)]
#[case("one inside the other", unresolved_claim(0.0), Verdict::Unresolved)]
#[case("one inside the other", unresolved_claim(0.1), Verdict::Late)]
#[case("one inside the other", contact_claim(f64::NAN), Verdict::Late)]
#[case("one inside the other", unresolved_claim(f64::NAN), Verdict::Late)]
#[case("one inside the other", ContactClaim::Refused, Verdict::Refused)]
fn claims_are_judged(#[case] family: &str, #[case] claim: ContactClaim, #[case] verdict: Verdict) {
    let family = families().into_iter().find(|f| f.name == family).unwrap();
    let scene = (family.make_scene)(family.parameter_values[1]).unwrap();
    let [a, b] = scene.meshes.each_ref().map(Surface::new);
    let outcome = QueryOutcome::Answered(TimedReply {
        reply: Reply::new(claim, 1),
        micros: 1.0,
    });
    for case in &scene.cases {
        let judged = judge(&scene, case, &TruthSolver::new(&a, &b), &outcome);
        assert_eq!(judged.verdict, verdict, "{claim:?}");
    }
}

/// Tests that an answer which is 0.04 too far away is right only if the method states a tolerance of at least 0.04.
#[rstest]
#[case(None, Verdict::Early)]
#[case(Some(0.02), Verdict::Early)]
#[case(Some(0.05), Verdict::Right)]
#[case(Some(f64::NAN), Verdict::Early)]
fn an_answer_is_judged_by_the_tolerance_that_it_states(
    #[case] tolerance: Option<f64>,
    #[case] verdict: Verdict,
) {
    let mut families = families().into_iter();
    let family = families.find(|f| f.name == "margin").unwrap();
    let scene = (family.make_scene)(0.0).unwrap();
    let [a, b] = scene.meshes.each_ref().map(Surface::new);
    let case = &scene.cases[0];
    let Truth::Hit { lo, .. } = case.expected_truth else {
        panic!("{:?}", case.expected_truth)
    };
    let reply = Reply {
        tolerance,
        ..Reply::new(contact_claim(lo - 0.01), 1)
    };
    let outcome = QueryOutcome::Answered(TimedReply { reply, micros: 1.0 });
    let judged = judge(&scene, case, &TruthSolver::new(&a, &b), &outcome);
    assert_eq!(judged.verdict, verdict);
}
