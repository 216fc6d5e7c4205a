use super::*;
use crate::hull::exact_hull::{ExactHull, conflicts};
use crate::hull::polygons::merged_polygons;
use proptest::prelude::*;

proptest! {
    /// Tests that the hulls with and without a conflict graph have the same polygons, for points on grids and
    /// slightly off them.
    #[test]
    fn few_points_have_the_hull_of_many(
        points in prop::collection::vec(prop::array::uniform3(-2_i8..=2), 4..24),
        off in prop::collection::vec(prop::array::uniform3(-1.0..1.0), 24),
        size in prop::sample::select(vec![0.0, 1e-16, 1e-12, 0.5]),
    ) {
        let shaken = |(p, off): (&[i8; 3], &[f64; 3])| {
            DVec3::from_array(p.map(f64::from)) + size * DVec3::from_array(*off)
        };
        let points: Vec<DVec3> = points.iter().zip(&off).map(shaken).collect();
        let Some(simplex) = ExactHull::simplex(&points) else { return Ok(()) };
        let sorted = |triangles: Vec<[u32; 3]>| {
            let mut sorted: Vec<Vec<[u64; 3]>> = Vec::new();
            for polygon in merged_polygons(&points, &triangles).iter() {
                // Each hull may use any of several equal points.
                let place = |&v: &u32| points[v as usize].to_array().map(|x| (x + 0.0).to_bits());
                let mut corners: Vec<[u64; 3]> = polygon.iter().map(place).collect();
                let least = (0..corners.len()).min_by_key(|&k| corners[k]).unwrap();
                corners.rotate_left(least);
                sorted.push(corners);
            }
            sorted.sort();
            sorted
        };
        let few = sorted(facets(&points, simplex));
        prop_assert_eq!(few, sorted(conflicts::facets(&points, simplex)));
    }
}
