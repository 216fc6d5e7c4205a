use super::Slab;
use crate::math::order::greater;
use crate::rounding::UNIT_ROUNDOFF_F64;
use crate::tests::double::{DoubleDouble, DoubleDouble3};
use crate::tests::worst::{WorstCaseSearch, error_fraction};
use glam::DVec3;

/// Measures by how much a slab without its allowance of 16u is too thin for the exact heights of its corners.
#[test]
fn worst_slab() {
    let found = WorstCaseSearch::new("Slab::about: 16u", 20_000).search(|tape| {
        let [u, v, center] = [(); 3].map(|()| DVec3::from(tape.vector(-20..=10)));
        let corners = [(); 6].map(|()| {
            let at = center + u * tape.any_number(-10..=0) + v * tape.any_number(-10..=0);
            DVec3::from(at.to_array().map(|x| x + x * tape.any_number(-54..=-45)))
        });
        let slab = Slab::fit_to(&corners, center)?;
        let normal = DoubleDouble3::from(slab.normal);
        let height = |&p: &DVec3| {
            normal
                .dot(DoubleDouble3::from(p) - DoubleDouble3::from(center))
                .get()
                .abs()
        };
        let size = |&p: &DVec3| (p - center).abs().max_element();
        let size = corners.iter().map(size).fold(0.0, greater);
        let highest = corners.iter().map(height).fold(0.0, greater);
        let found = DoubleDouble::from(slab.half_thickness)
            - DoubleDouble::from(16.0 * UNIT_ROUNDOFF_F64 * size);
        Some(error_fraction(
            (DoubleDouble::from(highest) - found).get(),
            16.0 * UNIT_ROUNDOFF_F64 * size,
        ))
    });
    found.assert_tight_bound(30.0);
}
