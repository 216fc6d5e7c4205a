//! Measures the worst rounding errors of the tree search: of discs in f32 against their points in f64, and of the found
//! point. The error of f64 is a five hundred millionth of that of f32.

use super::{Disc, DiscGroup, LANES, SupportTree};
use crate::math::order::greater;
use crate::rounding::{DISC_HEIGHT_ERROR_F32, DISC_TILT_ERROR_F32, HEIGHT_ERROR_F64};
use crate::tests::rational::Exact3;
use crate::tests::scene::random_direction;
use crate::tests::worst::{RandomCase, WorstCaseSearch, error_fraction};
use glam::{DVec3, Vec3};

/// Draws points in a ball of radius 1, and a direction along which a point at or near the rim of their disc is
/// farthest.
fn points(tape: &mut RandomCase) -> (Vec<DVec3>, DVec3) {
    let half = random_direction(tape) * tape.size(-10..=-1);
    let middle = random_direction(tape) * (tape.next_fraction() * (1.0 - half.length()));
    let aside = random_direction(tape) * half.length() * tape.size(-40..=-2);
    let along = (half + random_direction(tape) * half.length() * tape.size(-40..=0)).normalize();
    let shares = [1.0, -1.0, 0.5, -0.5, 0.1, -0.1, 0.2, 0.0];
    let point = |(k, share): (usize, f64)| middle + half * share + aside * ((k / 2 % 2) as f64);
    (shares.into_iter().enumerate().map(point).collect(), along)
}

/// Scales a direction so that its largest component is 1, and returns it in f64 and rounded to f32.
fn unit_in_max_norm(d: DVec3) -> (DVec3, Vec3) {
    let d = d / d.abs().max_element();
    (d, d.as_vec3())
}

#[test]
fn worst_disc() {
    let found = WorstCaseSearch::new("DISC_F32", 20_000).search(|tape| {
        let (points, along) = points(tape);
        let (exact, d) = unit_in_max_norm(along);
        let discs = DiscGroup::new(&points, LANES);
        let bound = f64::from(discs.height_upper_bounds(d)[0]) - f64::from(DISC_HEIGHT_ERROR_F32);
        let highest = points.iter().map(|p| p.dot(exact));
        let highest = highest.fold(f64::NEG_INFINITY, greater);
        Some(error_fraction(
            highest - bound,
            DISC_HEIGHT_ERROR_F32.into(),
        ))
    });
    found.assert_tight_bound(100.0);
}

#[test]
fn worst_tilt() {
    let found = WorstCaseSearch::new("DISC_TILT_F32", 40_000).search(|tape| {
        let (exact, d) = unit_in_max_norm(random_direction(tape));
        let aside = random_direction(tape) * tape.size(-30..=0);
        // The direction is near the normal: the component across it is a difference of equal squares.
        let toward = (exact.normalize() + aside).normalize();
        let Disc { normal: m, .. } = Disc::enclosing(&[toward, DVec3::ZERO]);
        let m = if tape.index_below(2) == 0 {
            toward.as_vec3()
        } else {
            m
        };
        let along = m.x * d.x + (m.y * d.y + m.z * d.z);
        let across = f64::from(d.length_squared() - along * along);
        let truth = m.as_dvec3();
        let truth = (exact - truth * exact.dot(truth)).length_squared();
        let allowed = f64::from(DISC_TILT_ERROR_F32) * exact.length_squared();
        Some(error_fraction(truth - across, allowed))
    });
    found.assert_tight_bound(20.0);
}

/// Measures how much lower than the highest point the found point may be, among points of nearly equal height.
#[test]
fn worst_farthest() {
    let found =
        WorstCaseSearch::new("HEIGHT_F64, twice: the farthest point", 6_000).search(|tape| {
            let along = random_direction(tape);
            let (east, north) = along.any_orthonormal_pair();
            let (middle, wide) = (DVec3::from(tape.vector(-8..=2)), tape.size(-20..=2));
            let points: [DVec3; 12] = std::array::from_fn(|_| {
                let aside = east * tape.any_number(-2..=0) + north * tape.any_number(-2..=0);
                middle + (aside + along * tape.any_number(-58..=-48)) * wide
            });
            let chosen = SupportTree::new(&points).extremal_point(along) as usize;
            let exact = Exact3::from_coordinates(along);
            let above = |p: &DVec3| {
                let way =
                    Exact3::from_coordinates(*p).minus(&Exact3::from_coordinates(points[chosen]));
                exact.dot(&way).to_f64().value()
            };
            let missed = points.iter().map(above).fold(0.0, greater);
            let reach = points.iter().map(|p| p.abs().max_element());
            let reach = reach.fold(0.0, greater);
            let allowed = 2.0 * HEIGHT_ERROR_F64 * along.abs().element_sum() * reach;
            Some(error_fraction(missed, allowed))
        });
    found.assert_tight_bound(20.0);
}
