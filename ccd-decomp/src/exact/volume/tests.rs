use super::*;
use crate::rational::{Exact3, error_of, exact_fraction};
use crate::worst::{WorstCaseSearch, error_fraction};
use ccd_core::glam::dvec3;

/// Returns the surface triangles of a long square rod of unit cubes. Its volume is small compared to the products in
/// its sum.
fn rod(cells: u32) -> Vec<[DVec3; 3]> {
    let corner = |x: u32, k: usize| {
        let (y, z) = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)][k % 4];
        dvec3(f64::from(x), y, z)
    };
    let side = |x: u32, k: usize| {
        let [a, b] = [k, k + 1].map(|k| corner(x, k));
        let [c, d] = [k + 1, k].map(|k| corner(x + 1, k));
        [[a, d, c], [a, c, b]]
    };
    let cap = |x: u32| [0, 2].map(|k| [k, k + 1, k + 2].map(|k| corner(x, k)));
    let turned = |[a, b, c]: [DVec3; 3]| [a, c, b];
    let sides = (0..cells).flat_map(|x| (0..4).flat_map(move |k| side(x, k)));
    let caps = cap(0).map(turned).into_iter().chain(cap(cells));
    sides.chain(caps).collect()
}

#[test]
fn the_sign_of_a_long_solids_volume_is_certain() {
    let triangles = rod(20_000);
    let sign = |triangles: &mut dyn Iterator<Item = [DVec3; 3]>| {
        SignedVolume::from_triangles(triangles, DVec3::ZERO).is_positive()
    };
    let turned = |[a, b, c]: [DVec3; 3]| [a, c, b];
    let outward = sign(&mut triangles.iter().copied()).expect("a volume");
    let inward = sign(&mut triangles.iter().copied().map(turned));
    assert_eq!(inward, Some(!outward));
    // Each triangle and its back: a shell without volume.
    let both = triangles
        .iter()
        .flat_map(|&triangle| [triangle, turned(triangle)]);
    assert_eq!(sign(&mut both.clone()), None);
    // The same, with coordinates that are not round numbers.
    let tilted = |p: DVec3| {
        dvec3(
            p.x * 0.1 + p.y / 3.0,
            p.y * 0.7 - p.z / 7.0,
            p.z * 0.3 + p.x / 9.0,
        )
    };
    assert_eq!(sign(&mut both.map(|triangle| triangle.map(tilted))), None);
    let slanted = triangles.iter().map(|triangle| triangle.map(tilted));
    assert!(sign(&mut slanted.clone()).is_some());
}

/// Compares a sum of a few volumes, which may cancel, with its exact value as a fraction. The quadratic term of the
/// bound is dominated up to ten million volumes, and is not tested here.
#[test]
fn worst_volume() {
    let found = WorstCaseSearch::new("volume_rounding", 6_000).search(|tape| {
        let scale = tape.size(-200..=39);
        let mut point = |range| DVec3::from(tape.vector(range)) * scale;
        let (near, far) = (point(-8..=0), point(-8..=0));
        let corners: [DVec3; 5] = std::array::from_fn(|_| far + point(-30..=0));
        let mut volume = SignedVolume::default();
        let mut truth = exact_fraction(0.0);
        for face in [[0, 1, 2], [2, 1, 3], [0, 2, 3], [4, 1, 0]] {
            let [p, q, r] = face.map(|k| corners[k]);
            volume.add([p, q, r], near);
            let [near, p, q, r] = [near, p, q, r].map(Exact3::from_coordinates);
            truth += p.minus(&near).dot(&q.minus(&p).cross(&r.minus(&p)));
        }
        // The last sum is rounded as well.
        let error = error_of(volume.sum + volume.addition_error_sum, &truth);
        Some(error_fraction(
            error,
            volume_rounding_bound(volume.term_bound_sum, volume.term_count),
        ))
    });
    found.assert_tight_bound(40.0);
}
