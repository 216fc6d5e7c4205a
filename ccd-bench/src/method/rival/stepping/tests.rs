use super::*;
use crate::method::rival::tests::samples::{
    constant_velocity_motion, cuboid, query, resting_motion,
};
use ccd_core::glam::{DQuat, DVec3};

/// Returns a query in which a cube of side 1 falls from height 3 at speed 4 onto a slab whose top is at height 0.
fn falling_cube_query() -> Motions {
    let a = constant_velocity_motion(
        3.0 * DVec3::Z,
        DQuat::IDENTITY,
        -4.0 * DVec3::Z,
        DVec3::ZERO,
    );
    query(a, resting_motion(-0.5 * DVec3::Z))
}

fn stepping_solver() -> FixedTimeSteps {
    FixedTimeSteps::new(&cuboid(0.5, 0.5, 0.5), &cuboid(3.0, 3.0, 0.5))
}

#[test]
fn contacts_are_reported_at_the_next_sample() {
    for tolerance in [0.3, 0.01, 0.000_7] {
        let reply = stepping_solver().answer(&falling_cube_query(), tolerance);
        let ContactClaim::Contact { time } = reply.claim else {
            panic!("{reply:?}")
        };
        assert!(
            (0.625..0.625 + tolerance / 4.0 + 1e-12).contains(&time),
            "{time}"
        );
        let steps = (4.0 / tolerance).ceil();
        assert_eq!(reply.steps, (0.625 * steps).ceil() as u64 + 1);
    }
}

#[test]
fn a_contact_between_samples_is_missed() {
    let mut query = falling_cube_query();
    let (a, b) = (cuboid(0.5, 0.5, 0.01), cuboid(3.0, 3.0, 0.01));
    let ask = |tolerance: f64| FixedTimeSteps::new(&a, &b).answer(&query, tolerance);
    let missed = ask(2.0);
    assert_eq!((missed.claim, missed.steps), (ContactClaim::NoContact, 3));
    assert!(matches!(ask(0.01).claim, ContactClaim::Contact { .. }));
    query.duration = 0.5;
    let before = FixedTimeSteps::new(&a, &b).answer(&query, 0.01);
    assert_eq!((before.claim, before.steps), (ContactClaim::NoContact, 201));
}

#[test]
fn bodies_at_rest_are_tested() {
    let apart = query(resting_motion(1.1 * DVec3::Z), resting_motion(DVec3::ZERO));
    assert_eq!(
        stepping_solver().answer(&apart, 1e-3).claim,
        ContactClaim::NoContact
    );
    let across = query(resting_motion(0.9 * DVec3::Z), resting_motion(DVec3::ZERO));
    let contact = ContactClaim::Contact { time: 0.0 };
    assert_eq!(stepping_solver().answer(&across, 1e-3).claim, contact);
}

#[test]
fn the_number_of_samples_is_limited() {
    let reply = stepping_solver().answer(&falling_cube_query(), 1e-9);
    assert_eq!(reply.steps, MAX_SAMPLES);
    let ContactClaim::Unresolved { safe_until } = reply.claim else {
        panic!("{reply:?}")
    };
    let expected = (MAX_SAMPLES - 1) as f64 * 1e-9 / 4.0;
    assert!((safe_until - expected).abs() < 1e-12, "{safe_until}");
    for tolerance in [0.0, -1.0, f64::NAN] {
        let reply = stepping_solver().answer(&falling_cube_query(), tolerance);
        assert!(reply.steps <= MAX_SAMPLES, "{tolerance}: {reply:?}");
    }
}
