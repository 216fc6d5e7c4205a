use super::*;
use ccd_core::glam::dvec3;

/// Tests which of random points on the edges of a triangle are kept: two of each edge. A removed point is between
/// them.
#[test]
fn only_the_ends_of_edges_are_kept() {
    let mut seed = 1_u32;
    let mut next = || {
        seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f64::from(seed >> 8) / f64::from(1 << 24)
    };
    let (mut kept, mut left_out) = (0, 0);
    for offset in [0.0, 1e3, 1e6] {
        for _ in 0..200 {
            let triangle: [DVec3; 3] =
                std::array::from_fn(|_| offset + dvec3(next(), next(), next()));
            let [a, b, c] = triangle;
            let mut points = vec![(a + b + c) / 3.0];
            for [from, to] in [[a, b], [b, c], [c, a]] {
                points.extend((0..8).map(|_| from + (0.1 + 0.8 * next()) * (to - from)));
            }
            let near = edge_tolerance(offset + 1.0);
            let found = remove_points_between(points.clone(), triangle, near);
            assert!(found.iter().all(|p| points.contains(p)));
            let lost = points.iter().filter(|p| !found.contains(p));
            for &point in lost {
                let is_between = |&[p, q]: &[DVec3; 2]| {
                    let along = unit(q - p).unwrap_or(DVec3::X);
                    let height = (point - p).dot(along).clamp(0.0, p.distance(q));
                    point.distance(p + height * along) <= 3.0 * near
                };
                let mut pairs = found
                    .iter()
                    .flat_map(|&p| found.iter().map(move |&q| [p, q]));
                assert!(pairs.any(|pair| is_between(&pair)), "{point}");
                left_out += 1;
            }
            kept += found.len();
        }
    }
    assert_eq!((kept, left_out), (600 * 7, 600 * 18));
}
