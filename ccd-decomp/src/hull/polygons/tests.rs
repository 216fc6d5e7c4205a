use super::*;
use crate::hull::exact_hull::ExactHull;
use ccd_core::glam::dvec3;
use proptest::prelude::*;

#[test]
fn the_squares_of_a_box_are_polygons() {
    let points: Vec<DVec3> = (0..27)
        .map(|k| dvec3(f64::from(k % 3), f64::from(k / 3 % 3), f64::from(k / 9)))
        .collect();
    let triangles = ExactHull::facets_of(&points).unwrap();
    let polygons = merged_polygons(&points, &triangles);
    assert_eq!(polygons.len(), 6);
    for corners in polygons.iter() {
        assert_eq!(corners.len(), 4, "middles of edges are no corners");
    }
}

proptest! {
    /// Tests that every triangle is in exactly one polygon, that no two adjacent polygons are coplanar, and that
    /// polygons have no corner of 180°.
    #[test]
    fn polygons_are_as_large_as_can_be(cells in prop::collection::vec([0..3i32, 0..3i32, 0..3i32], 4..20)) {
        let points: Vec<DVec3> = cells.iter().map(|c| DVec3::from_array(c.map(f64::from))).collect();
        let Some(triangles) = ExactHull::facets_of(&points) else { return Ok(()) };
        let (mut polygons, mut all) = (Vec::new(), Vec::new());
        for_each_merged_polygon(&points, &triangles, |corners, group| {
            polygons.push(corners.to_vec());
            all.extend(group.to_vec());
        });
        all.sort_unstable();
        prop_assert!(all.into_iter().eq(0..triangles.len() as u32));
        let at = |v: u32| points[v as usize];
        for (k, polygon) in polygons.iter().enumerate() {
            let n = polygon.len();
            let corner = |i: usize| at(polygon[i % n]);
            let normal = (corner(1) - corner(0)).cross(corner(2) - corner(0));
            for i in 0..n {
                let turn = (corner(i + 1) - corner(i)).cross(corner(i + 2) - corner(i + 1));
                prop_assert!(turn.dot(normal) > 0.0);
            }
            for other in &polygons[..k] {
                let coplanar = other.iter().all(|&v| normal.dot(at(v) - corner(0)) == 0.0);
                prop_assert!(!coplanar);
            }
        }
    }
}
