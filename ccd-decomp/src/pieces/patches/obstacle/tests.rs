use super::*;
use crate::exact::predicates::side_of_plane;
use proptest::prelude::*;

/// Returns whether any plane through three of the points separates the triangle from the hull, by trying all planes.
fn is_separated_by_any_plane(points: &[DVec3], hull: &ExactHull, triangle: [u32; 3]) -> bool {
    let obstacle = HullInteriorTest::new(points, hull);
    let all: Vec<u32> = hull.corners().iter().copied().chain(triangle).collect();
    let planes = all.iter().flat_map(|&a| {
        let all = &all;
        all.iter()
            .flat_map(move |&b| all.iter().map(move |&c| [a, b, c]))
    });
    planes
        .into_iter()
        .any(|plane| obstacle.separates(plane, triangle))
}

fn any_grid_point() -> impl Strategy<Value = DVec3> {
    [0..5i32, 0..5i32, 0..5i32].prop_map(|x| DVec3::from_array(x.map(f64::from)))
}

proptest! {
    #[test]
    fn agrees_with_all_planes(
        hull in prop::collection::vec(any_grid_point(), 4..9),
        triangle in [any_grid_point(), any_grid_point(), any_grid_point()],
    ) {
        let mut points = hull;
        let facets = ExactHull::facets_of(&points);
        let Some(hull) = facets.map(ExactHull::from_facets) else { return Ok(()) };
        let first = points.len() as u32;
        points.extend(triangle);
        let triangle = [first, first + 1, first + 2];
        let expected = is_separated_by_any_plane(&points, &hull, triangle);
        prop_assert_eq!(HullInteriorTest::new(&points, &hull).is_separated_from(triangle), expected);
    }

    /// Tests that a triangle with a point strictly inside the hull is not reported as separated from the hull. The
    /// coordinates make the point exact.
    #[test]
    fn triangles_inside_are_not_apart(
        hull in prop::collection::vec(any_grid_point(), 4..9),
        triangle in [any_grid_point(), any_grid_point(), any_grid_point()],
        weights in [1..8i32, 1..8i32],
    ) {
        let mut points = hull;
        let facets = ExactHull::facets_of(&points);
        let Some(hull) = facets.map(ExactHull::from_facets) else { return Ok(()) };
        let [s, t] = weights.map(|w| f64::from(w) / 16.0);
        let p = (1.0 - s - t) * triangle[0] + s * triangle[1] + t * triangle[2];
        let at = |v: u32| points[v as usize];
        let inside = hull.facets().iter().all(|f| side_of_plane(f.map(at), p) == Ordering::Less);
        let first = points.len() as u32;
        points.extend(triangle);
        let apart = HullInteriorTest::new(&points, &hull).is_separated_from([first, first + 1, first + 2]);
        prop_assert!(!(inside && apart));
    }
}
