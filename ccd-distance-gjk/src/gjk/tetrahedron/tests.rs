use super::{TOUCHING_ULPS, VOLUME_ULPS};
use crate::rational::{Exact3, error_of, exact_fraction};
use crate::worst::{RandomCase, WorstCaseSearch, error_fraction};
use ccd_core::glam::DVec3;
use ccd_core::order::greater;

/// Draws four corners of a tetrahedron, which may be flat, near the origin or far from it.
fn corners(tape: &mut RandomCase) -> [DVec3; 4] {
    let (middle, small) = (DVec3::from(tape.vector(-8..=0)), tape.size(-30..=4));
    [(); 4].map(|()| middle + DVec3::from(tape.vector(-8..=0)) * small)
}

/// Tests that the heights of the origin and of the opposite corner above a face, times twice its area, are accurate to
/// `VOLUME_ULPS`.
#[test]
fn worst_volume() {
    let found = WorstCaseSearch::new("VOLUME_ULPS", 10_000).search(|tape| {
        let [a, b, c, apex] = corners(tape);
        let (ab, ac, up) = (b - a, c - a, apex - a);
        let normal = ab.cross(ac);
        let allowed = VOLUME_ULPS * f64::EPSILON * ab.length() * ac.length();
        let [a3, b, c, apex] = [a, b, c, apex].map(Exact3::from_coordinates);
        let exact_normal = b.minus(&a3).cross(&c.minus(&a3));
        let origin = error_of(a.dot(normal), &a3.dot(&exact_normal));
        let height = error_of(up.dot(normal), &apex.minus(&a3).dot(&exact_normal));
        Some(greater(
            error_fraction(origin, allowed * a.length()),
            error_fraction(height, allowed * up.length()),
        ))
    });
    found.assert_tight_bound(20.0);
}

/// Tests that a weighted sum of four corners is accurate to `TOUCHING_ULPS`.
#[test]
fn worst_combination() {
    let found = WorstCaseSearch::new("TOUCHING_ULPS", 10_000).search(|tape| {
        let corners = corners(tape);
        let weights = [(); 4].map(|()| tape.next_fraction());
        let total: f64 = weights.iter().sum();
        if !(total > 0.0) {
            return None;
        }
        let weights = weights.map(|weight| weight / total);
        let terms = corners.iter().zip(weights);
        let sum = terms.fold(DVec3::ZERO, |sum, (&corner, weight)| sum + corner * weight);
        let truth = |axis: usize| {
            let terms = corners.iter().zip(weights);
            terms.fold(exact_fraction(0.0), |sum, (corner, weight)| {
                sum + exact_fraction(corner[axis]) * exact_fraction(weight)
            })
        };
        let off = DVec3::from([0, 1, 2].map(|k| error_of(sum[k], &truth(k)))).length();
        let reach = corners.iter().map(|corner| corner.length());
        let allowed = TOUCHING_ULPS * f64::EPSILON * reach.fold(0.0, greater);
        Some(error_fraction(off, allowed))
    });
    found.assert_tight_bound(20.0);
}
