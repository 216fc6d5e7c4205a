use super::*;
use crate::method::rival::tests::samples::RandomSource;

/// Returns true if an edge of one triangle passes through the other. Two triangles in general position cross only in
/// that way.
fn any_edge_pierces(a: &[DVec3; 3], b: &[DVec3; 3]) -> bool {
    let pierces = |edge: [DVec3; 2], t: &[DVec3; 3]| {
        let normal = (t[1] - t[0]).cross(t[2] - t[0]);
        let [from, to] = edge.map(|p| (p - t[0]).dot(normal));
        if from * to > 0.0 {
            return false;
        }
        let point = edge[0].lerp(edge[1], from / (from - to));
        (0..3).all(|k| normal.cross(t[(k + 1) % 3] - t[k]).dot(point - t[k]) >= 0.0)
    };
    (0..3).any(|k| {
        let edge = |t: &[DVec3; 3]| [t[k], t[(k + 1) % 3]];
        pierces(edge(a), b) || pierces(edge(b), a)
    })
}

#[test]
fn the_test_agrees_with_edges_through_triangles() {
    let mut samples = RandomSource::new(1);
    let mut crossings = 0;
    for _ in 0..20_000 {
        let (a, b) = (samples.triangle(), samples.triangle());
        let cross = triangles_cross(&a, &b);
        assert_eq!(cross, any_edge_pierces(&a, &b), "{a:?} {b:?}");
        assert_eq!(cross, triangles_cross(&b, &a));
        crossings += usize::from(cross);
    }
    assert!((2000..18_000).contains(&crossings), "{crossings}");
}

#[test]
fn triangles_in_one_plane() {
    let at = |x: f64, y: f64| DVec3::new(x, y, 0.0);
    let a = [at(0.0, 0.0), at(1.0, 0.0), at(0.0, 1.0)];
    let shifted = |x: f64, y: f64| a.map(|p| p + at(x, y));
    let mirrored = |s: f64| a.map(|p| at(s, s) - p);
    for other in [
        shifted(0.3, 0.3),
        shifted(1.0, 0.0),
        mirrored(0.9),
        mirrored(1.0),
    ] {
        assert!(triangles_cross(&a, &other), "{other:?}");
    }
    for other in [
        shifted(1.01, 0.0),
        shifted(0.6, 0.6),
        mirrored(1.01),
        mirrored(-0.01),
    ] {
        assert!(!triangles_cross(&a, &other), "{other:?}");
    }
}

#[test]
fn triangles_without_area_are_segments_and_points() {
    let a = [DVec3::ZERO, DVec3::X, DVec3::Y];
    let segment = |from: DVec3, to: DVec3| [from, to, from];
    let inside = DVec3::new(0.2, 0.2, 0.0);
    assert!(triangles_cross(
        &a,
        &segment(inside - DVec3::Z, inside + DVec3::Z)
    ));
    assert!(!triangles_cross(
        &a,
        &segment(inside + 0.1 * DVec3::Z, inside + DVec3::Z)
    ));
    let outside = DVec3::new(0.6, 0.6, 0.0);
    assert!(!triangles_cross(
        &a,
        &segment(outside - DVec3::Z, outside + DVec3::Z)
    ));
    assert!(triangles_cross(&a, &[inside; 3]) && !triangles_cross(&a, &[inside + DVec3::Z; 3]));
}
