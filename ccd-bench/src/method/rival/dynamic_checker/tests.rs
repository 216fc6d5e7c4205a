use super::DynamicChecker;
use crate::method::rival::tests::trials::{
    assert_contact_times_within_tolerance, assert_shots_are_conservative,
    assert_stops_at_work_limit, box_rotating_past_box, knot_216,
};
use crate::method::solver::{ContactClaim, Solver};
use crate::scene::model::cuboid;
use ccd_core::glam::{DQuat, DVec3};
use ccd_core::{Motion, Pose};
use ccd_tables::motions::Motions;

#[test]
fn exact_times_are_met() {
    for tolerance in [1e-3, 1e-6, 1e-9] {
        assert_contact_times_within_tolerance(tolerance, DynamicChecker::new);
    }
}

#[test]
fn shots_are_neither_missed_nor_late_nor_early() {
    for tolerance in [1e-2, 1e-5] {
        let mut rival = DynamicChecker::new(&knot_216(), &knot_216());
        assert_shots_are_conservative(tolerance, &mut rival);
    }
}

#[test]
fn work_without_end_is_given_up() {
    assert_stops_at_work_limit(DynamicChecker::new, |rival, patience| {
        rival.work_limit = patience;
    });
}

#[test]
fn motions_beyond_numbers_are_given_up() {
    let (a, b, mut query) = box_rotating_past_box();
    query.a = Motion::new(Pose::IDENTITY, DVec3::ZERO, 1e308 * DVec3::Z).unwrap();
    query.duration = 1e10;
    let reply = DynamicChecker::new(&a, &b).answer(&query, 1e-3);
    assert_eq!(reply.claim, ContactClaim::Unresolved { safe_until: 0.0 });
}

/// Tests that a contact in the middle of the duration is found, although all time before it may be proven free.
#[test]
fn a_touch_at_a_halving_is_a_contact() {
    let (cube, slab) = (cuboid(0.5, 0.5, 0.5), cuboid(9.0, 9.0, 1.0));
    let mut rival = DynamicChecker::new(&cube.unwrap(), &slab.unwrap());
    for k in 0..20 {
        let world = DQuat::from_rotation_x(0.1 * f64::from(k)) * DQuat::from_rotation_y(0.7);
        let pose = |z: f64| Pose::new(world * (z * DVec3::Z), world).unwrap();
        let query = Motions {
            id: String::new(),
            a: Motion::new(pose(2.5), world * (-4.0 * DVec3::Z), DVec3::ZERO).unwrap(),
            b: Motion::still(pose(-1.0)),
            duration: 1.0,
        };
        let ContactClaim::Contact { time } = rival.answer(&query, 1e-6).claim else {
            panic!("turned {k} times");
        };
        assert!((0.5 - 1e-6..=0.5 + 1e-12).contains(&time), "{time}");
    }
}
