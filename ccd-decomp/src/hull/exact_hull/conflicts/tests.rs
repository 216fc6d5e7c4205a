use super::*;
use crate::test_meshes::star_bipyramid;

/// Tests that the construction of the hull of two cones creates at most eight facets per point of their common rim. An
/// apex sees up to half of all facets when it is inserted, and so does a point of the rim.
#[test]
fn few_facets_are_made_for_any_points() {
    for (corners, inner) in [(2_000, 1.0), (2_000, 0.5), (16_000, 1.0)] {
        let mesh = star_bipyramid(corners, inner);
        let hull = HullBuilder::hull_of_points(mesh.vertices(), [0, 2, 4, corners + 1]);
        let made = hull.facets.len();
        assert!(made <= 8 * corners as usize, "{made} of {corners}");
        // At the end no facet has conflict points, nor have removed facets.
        assert!(
            hull.facets
                .iter()
                .all(|facet| facet.conflict_points.is_empty())
        );
        let last_tested: usize = hull
            .facets
            .iter()
            .map(|f| f.conflict_points.capacity())
            .sum();
        assert!(
            last_tested <= 8 * corners as usize,
            "{last_tested} of {corners}"
        );
    }
}
