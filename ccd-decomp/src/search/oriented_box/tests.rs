//! Tests oriented boxes against exact fractions. A random search looks for the largest rounding error.

use super::OrientedBox;
use crate::rational::{Exact3, exact_fraction};
use crate::search::element::Element;
use crate::tolerance::box_rounding_bound;
use crate::worst::{RandomCase, WorstCaseSearch, error_fraction};
use ccd_core::glam::DVec3;
use ccd_core::order::greater;

/// Draws a box around a triangle, and a point; all may be far from the origin.
fn random_box_and_point(tape: &mut RandomCase) -> (OrientedBox, DVec3) {
    let scale = tape.size(-300..=39);
    let middle = DVec3::from(tape.vector(-8..=0));
    let small = tape.size(-50..=0);
    let mut point = || (middle + DVec3::from(tape.vector(-8..=0)) * small) * scale;
    let element = Element {
        corners: [point(), point(), point()],
        face: 0,
    };
    (OrientedBox::enclosing_elements(&[element]), point())
}

/// Tests that the offset of a point along an axis of a box has a rounding error of at most `box_rounding`.
#[test]
fn worst_beside() {
    let found = WorstCaseSearch::new("box_rounding, beside a box", 10_000).search(|tape| {
        let (of, point) = random_box_and_point(tape);
        let k = tape.index_below(3);
        let axis = of.axes[k];
        let way = axis.dot(point - of.center);
        let truth = Exact3::from_coordinates(axis)
            .dot(&Exact3::from_coordinates(point).minus(&Exact3::from_coordinates(of.center)));
        let error = (exact_fraction(way) - truth).to_f64().value();
        let reach = greater(of.max_abs_coordinate, point.abs().max_element());
        Some(error_fraction(error.abs(), box_rounding_bound(axis, reach)))
    });
    found.assert_tight_bound(120.0);
}
