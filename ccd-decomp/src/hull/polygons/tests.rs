use super::*;
use crate::hull::exact_hull::ExactHull;
use ccd_core::glam::dvec3;
use proptest::prelude::*;

#[test]
fn the_squares_of_a_box_are_polygons() {
    let points: Vec<DVec3> = (0..27)
        .map(|k| dvec3(f64::from(k % 3), f64::from(k / 3 % 3), f64::from(k / 9)))
        .collect();
    let hull = ExactHull::new(&points).unwrap();
    let polygons = polygons(&points, hull.facets());
    assert_eq!(polygons.len(), 6);
    for polygon in &polygons {
        assert_eq!(polygon.corners.len(), 4, "middles of edges are no corners");
    }
}

proptest! {
    /// Every triangle is in one polygon, no two polygons are coplanar neighbours, and all of a polygon's
    /// corners are strict.
    #[test]
    fn polygons_are_as_large_as_can_be(cells in prop::collection::vec([0..3i32, 0..3i32, 0..3i32], 4..20)) {
        let points: Vec<DVec3> = cells.iter().map(|c| DVec3::from_array(c.map(f64::from))).collect();
        let Some(hull) = ExactHull::new(&points) else { return Ok(()) };
        let polygons = polygons(&points, hull.facets());
        let total: usize = polygons.iter().map(|p| p.triangles.len()).sum();
        prop_assert_eq!(total, hull.facets().len());
        let at = |v: u32| points[v as usize];
        for (k, polygon) in polygons.iter().enumerate() {
            let n = polygon.corners.len();
            let corner = |i: usize| at(polygon.corners[i % n]);
            let normal = (corner(1) - corner(0)).cross(corner(2) - corner(0));
            for i in 0..n {
                let turn = (corner(i + 1) - corner(i)).cross(corner(i + 2) - corner(i + 1));
                prop_assert!(turn.dot(normal) > 0.0);
            }
            for other in &polygons[..k] {
                let coplanar = other.corners.iter().all(|&v| normal.dot(at(v) - corner(0)) == 0.0);
                prop_assert!(!coplanar);
            }
        }
    }
}
