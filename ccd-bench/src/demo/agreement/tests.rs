use super::*;
use ccd_core::{Feature, Limit, Overlap, Pose, Separation, Stats};

/// A moves along x at speed 2, B rests.
fn query() -> Query {
    Query {
        id: String::new(),
        a: Motion::new(Pose::IDENTITY, 2.0 * DVec3::X, DVec3::ZERO).unwrap(),
        b: Motion::still(Pose::IDENTITY),
        duration: 1.0,
    }
}

fn contact(normal: DVec3) -> Contact {
    Contact {
        separation: Separation {
            lower: 0.0,
            upper: 0.01,
            normal,
            witness_a: DVec3::ZERO,
            witness_b: DVec3::ZERO,
        },
        feature_a: Feature::Vertex(0),
        feature_b: Feature::Vertex(0),
        piece_a: 0,
        piece_b: 0,
    }
}

fn agrees(one: Outcome, other: Outcome) -> bool {
    let [one, other] = [one, other].map(|outcome| Answer {
        outcome,
        tolerance: 0.01,
        stats: Stats::default(),
    });
    let both_ways = agree(&query(), &one, &other);
    assert_eq!(both_ways, agree(&query(), &other, &one));
    both_ways
}

fn head_on(time: f64) -> Outcome {
    Outcome::Contact {
        time,
        contact: contact(DVec3::X),
    }
}

#[test]
fn contacts_agree_within_the_time_it_takes_to_cross_the_tolerance() {
    assert!(agrees(head_on(0.5), head_on(0.509)));
    assert!(!agrees(head_on(0.5), head_on(0.511)));
    assert!(!agrees(head_on(0.5), head_on(f64::NAN)));
    let sliding = |time| Outcome::Contact {
        time,
        contact: contact(DVec3::Y),
    };
    assert!(agrees(sliding(0.1), sliding(0.9)));
    let at_start = Outcome::Touching {
        contact: contact(DVec3::X),
    };
    assert!(agrees(at_start, head_on(1e-4)));
    assert!(!agrees(at_start, head_on(0.1)));
}

#[test]
fn a_contact_agrees_with_free_only_when_that_grazes() {
    assert!(agrees(head_on(0.5), Outcome::Free { clearance: 0.009 }));
    assert!(!agrees(head_on(0.5), Outcome::Free { clearance: 0.011 }));
    assert!(!agrees(
        head_on(0.5),
        Outcome::Free {
            clearance: f64::NAN
        }
    ));
}

#[test]
fn other_answers_agree_with_their_like_and_unresolved_with_none() {
    let free = Outcome::Free { clearance: 1.0 };
    let inside = Outcome::Overlapping {
        overlap: Overlap::AInsideB(DVec3::ZERO),
    };
    let open = Outcome::Unresolved {
        safe_until: 0.5,
        reason: Limit::Budget,
    };
    assert!(agrees(free, free) && agrees(inside, inside));
    assert!(!agrees(free, inside) && !agrees(inside, head_on(0.0)));
    assert!(!agrees(open, open) && !agrees(open, free) && !agrees(open, head_on(0.5)));
}

#[test]
fn points_of_a_turning_body_have_their_own_speed() {
    let centre = DVec3::X;
    let spin = Motion::about(Pose::IDENTITY, DVec3::Y, 3.0 * DVec3::Z, centre).unwrap();
    let of_centre = velocity(&spin, 0.5, DVec3::new(1.0, 0.5, 0.0));
    assert!(of_centre.distance(DVec3::Y) < 1e-12);
    let beside = velocity(&spin, 0.5, DVec3::new(2.0, 0.5, 0.0));
    assert!(beside.distance(DVec3::new(0.0, 4.0, 0.0)) < 1e-12);
}
