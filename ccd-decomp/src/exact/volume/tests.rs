use super::*;
use ccd_core::glam::dvec3;

/// A square rod of unit cells: its volume is small compared to the products in its sum.
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
        let mut volume = SignedVolume::default();
        triangles.for_each(|triangle| volume.add(triangle, DVec3::ZERO));
        volume.is_positive()
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
    // The same where no coordinate is a round number.
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
