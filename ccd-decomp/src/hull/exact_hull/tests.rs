use super::*;
use crate::exact::predicates::side_of_plane;
use ccd_core::glam::dvec3;
use proptest::prelude::*;

/// Generates points on a coarse grid, so that many points lie in one plane or on one line.
fn coarse_grid_points() -> impl Strategy<Value = Vec<DVec3>> {
    let point = [0..4i32, 0..4i32, 0..4i32].prop_map(|x| DVec3::from_array(x.map(f64::from)));
    prop::collection::vec(point, 1..24)
}

fn hull_of(points: &[DVec3]) -> Option<ExactHull> {
    ExactHull::facets_of(points).map(ExactHull::from_facets)
}

fn check(points: &[DVec3], hull: &ExactHull) -> Result<(), TestCaseError> {
    let mut edges = Vec::new();
    for &[a, b, c] in hull.facets() {
        edges.extend([(a, b), (b, c), (c, a)]);
        let triangle = [a, b, c].map(|v| points[v as usize]);
        prop_assert!(!is_degenerate(triangle));
        for &p in points {
            prop_assert!(
                side_of_plane(triangle, p) != Ordering::Greater,
                "{p} is outside"
            );
        }
    }
    edges.sort_unstable();
    for (k, &(a, b)) in edges.iter().enumerate() {
        prop_assert!(k == 0 || edges[k - 1] != (a, b), "edge {a}-{b} twice");
        prop_assert!(edges.binary_search(&(b, a)).is_ok(), "edge {a}-{b} open");
    }
    Ok(())
}

proptest! {
    #[test]
    fn hulls_are_closed_and_hold_all_points(points in coarse_grid_points()) {
        let in_plane = |t: [DVec3; 3]| points.iter().all(|&p| side_of_plane(t, p) == Ordering::Equal);
        let all_flat = points.iter().all(|&a| points.iter().all(|&b| {
            points.iter().all(|&c| in_plane([a, b, c]))
        }));
        match hull_of(&points) {
            Some(hull) => check(&points, &hull)?,
            None => prop_assert!(all_flat),
        }
    }

    /// Tests that the hulls before and after an insertion differ only within the reported box.
    #[test]
    fn changes_stay_within_their_box(points in coarse_grid_points(), new in [-2.0..6.0, -2.0..6.0, -2.0..6.0]) {
        let mut points = points;
        let Some(mut hull) = hull_of(&points) else { return Ok(()) };
        points.push(DVec3::from_array(new));
        let last = points.len() as u32 - 1;
        let before = hull.facets().to_vec();
        match hull.insert(&points, last) {
            None => prop_assert!(before.iter().all(|f| side_of(&points, *f, last) != Ordering::Greater)),
            Some(changed) => {
                let lost = before.iter().filter(|f| !hull.facets().contains(f));
                let gained = hull.facets().iter().filter(|f| !before.contains(f));
                prop_assert!(lost.clone().count() > 0 && gained.clone().count() >= 3);
                let mut corners = lost.chain(gained).flatten().map(|&v| points[v as usize]);
                prop_assert!(corners.all(|p| changed.meets(&BoundingBox::enclosing([p]))));
                check(&points, &hull)?;
                prop_assert!(hull.corners().contains(&last));
            }
        }
    }
}

#[test]
fn a_polygon_grows_to_either_side() {
    let points = [
        DVec3::ZERO,
        DVec3::X,
        dvec3(1.0, 1.0, 0.0),
        DVec3::Y,
        dvec3(0.5, 0.5, -1.0),
        dvec3(0.5, 0.5, 1.0),
    ];
    let mut hull = ExactHull::from_polygon(&[0, 1, 2, 3]);
    assert_eq!(hull.facets().len(), 4);
    hull.insert(&points, 4).unwrap();
    assert_eq!(hull.facets().len(), 6);
    hull.insert(&points, 5).unwrap();
    assert_eq!(hull.facets().len(), 8);
    check(&points, &hull).unwrap();
}
