use super::*;
use proptest::prelude::*;

proptest! {
    /// Tests that the filtered side test gives the result of the exact predicate, for points near a plane that may be
    /// far from the origin.
    #[test]
    fn heights_agree_with_the_predicate(
        points in prop::collection::vec(prop::array::uniform3(-2_i8..=2), 4..12),
        off in prop::collection::vec(prop::array::uniform3(-1.0..1.0), 12),
        size in prop::sample::select(vec![0.0, 1e-16, 1e-14, 1e-12, 0.1]),
        far in prop::sample::select(vec![0.0, 0.1, 1e3, 1e9]),
    ) {
        let shaken = |(p, off): (&[i8; 3], &[f64; 3])| {
            let p = DVec3::from_array(p.map(f64::from));
            p + size * DVec3::from_array(*off) + far
        };
        let points: Vec<DVec3> = points.iter().zip(&off).map(shaken).collect();
        let local = LocalPoints::new(&points);
        for corners in [[0, 1, 2], [3, 1, 2], [1, 3, 0]] {
            let plane = local.plane(corners);
            for v in 0..points.len() as u32 {
                let exact = side_of(&points, corners, v) == Ordering::Greater;
                prop_assert_eq!(local.is_in_front(&plane, corners, v), exact);
            }
        }
    }
}
