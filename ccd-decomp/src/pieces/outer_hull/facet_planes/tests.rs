use crate::rational::Exact3;
use crate::tolerance::{DISTANCE_ERROR_BOUND_PER_HALF_DIAGONAL, MIN_CORNER_SINE};
use crate::worst::{WorstCaseSearch, error_fraction};
use ccd_core::glam::DVec3;
use ccd_core::vector::unit;

/// Tests that the unit normal of an accepted facet has a rounding error of at most `DISTANCE_ERROR_BOUND_PER_HALF_DIAGONAL`.
#[test]
fn worst_normal() {
    let found = WorstCaseSearch::new("MIN_CORNER_SINE, a normal", 20_000).search(|tape| {
        let along = DVec3::from(tape.vector(-20..=0));
        let aside = DVec3::from(tape.vector(-8..=0)) * (2.0 * MIN_CORNER_SINE * tape.size(0..=20));
        let corners = [DVec3::ZERO, along, along * tape.any_number(-3..=0) + aside];
        let far = DVec3::from(tape.vector(-20..=0));
        let [a, b, c] = corners.map(|p| p + far);
        let (u, v) = (b - a, c - a);
        let across = u.cross(v);
        // The condition for accepting a plane.
        let good = across.length() > MIN_CORNER_SINE * u.length() * v.length();
        let found = unit(across).filter(|_| good)?;
        let [a, b, c] = [a, b, c].map(Exact3::from_coordinates);
        let exact = b.minus(&a).cross(&c.minus(&a));
        // The rounding here is far below the tested error.
        let exact = exact.0.map(|x| x.to_f64().value());
        let exact = unit(DVec3::from_array(exact))?;
        Some(error_fraction(
            exact.distance(found),
            DISTANCE_ERROR_BOUND_PER_HALF_DIAGONAL,
        ))
    });
    found.assert_tight_bound(60.0);
}
