//! Tests the margin, a distance that the bodies must keep: a contact is where the distance falls to the margin.

use ccd_core::glam::DVec3;
use ccd_core::{Outcome, Settings};
use ccd_tests::backends::for_each_setup;
use ccd_tests::checks::Judge;
use ccd_tests::models::cuboid;
use ccd_tests::query::{MovingShape, Query};
use ccd_tests::strategies::{cases, check_cases};
use std::cell::Cell;

#[test]
fn random_cases_keep_any_margin() {
    for margin in [1e-2, 0.3, 2.0] {
        let contacts = Cell::new(0);
        check_cases(60, cases(), |case| {
            let query = case.query();
            let config = Settings {
                margin,
                ..case.config()
            };
            let judge = Judge::new(&query, &config);
            let mut law = Ok(());
            for_each_setup(&query, &config, |bodies, setup, answer| {
                let contact = matches!(answer.outcome, Outcome::Contact { .. });
                contacts.set(contacts.get() + u32::from(contact));
                if let Err(why) = judge.check(&answer, bodies) {
                    law = Err(format!("margin {margin}: {why}\n{setup:?}\n{answer:?}"));
                }
            });
            law
        });
        assert!(contacts.get() > 200, "margin {margin}: {contacts:?}");
    }
}

#[test]
fn a_falling_cube_stops_at_the_margin() {
    let query = Query::new(
        MovingShape::translating_shape(cuboid(DVec3::splat(0.5)), 3.0 * DVec3::Z, -4.0 * DVec3::Z),
        MovingShape::still(cuboid(DVec3::splat(0.5)), DVec3::ZERO),
    );
    for margin in [0.0, 1e-3, 0.25, 1.5] {
        let config = Settings {
            margin,
            tolerance: 1e-6,
            ..Settings::DEFAULT
        };
        for_each_setup(&query, &config, |_, setup, answer| {
            let Outcome::Contact { time, contact } = answer.outcome else {
                panic!("{setup:?}\n{answer:?}");
            };
            let (earliest, latest) = ((2.0 - margin - 1e-6) / 4.0, (2.0 - margin) / 4.0);
            assert!(
                (earliest - 1e-12..=latest).contains(&time),
                "{setup:?}\n{answer:?}"
            );
            assert!(
                contact.separation.lower >= margin - 1e-12,
                "{setup:?}\n{answer:?}"
            );
        });
    }
}
