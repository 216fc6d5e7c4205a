//! Contacts of patches are named as contacts of the triangles that they are made of.

use ccd_core::{Config, Feature, Outcome};
use ccd_tests::backends::Backend;
use ccd_tests::models::Kind;
use ccd_tests::strategies::{cases, check_cases};
use std::cell::Cell;

/// Only behind the surface, on a virtual facet, there is nothing of the mesh to name.
#[test]
fn contacts_of_patches_name_the_mesh() {
    let (named, unnamed) = (Cell::new(0), Cell::new(0));
    check_cases(500, cases(), |case| {
        let query = case.query();
        let shapes = [&query.a.shape, &query.b.shape];
        if !shapes.iter().all(|shape| shape.can_be(Kind::Patches)) {
            return Ok(());
        }
        let bodies = query.bodies([Kind::Patches; 2]);
        let config = Config {
            tolerance: 1e-6,
            ..Config::default()
        };
        let answer = Backend::DEFAULT.solve(&query.problem(&bodies, &config));
        if let Outcome::Contact { contact, .. } = answer.outcome {
            for feature in [contact.feature_a, contact.feature_b] {
                let count = match feature {
                    Feature::Piece(_) => &unnamed,
                    _ => &named,
                };
                count.set(count.get() + 1);
            }
        }
        Ok(())
    });
    let (named, unnamed) = (named.get(), unnamed.get());
    assert!(named > 100 && 50 * unnamed < named, "{named}, {unnamed}");
}
