use super::*;
use ccd_core::glam::DVec3;

fn ball(radius: f64) -> ShapeGeometry {
    let mut geometry = ShapeGeometry::EMPTY;
    geometry.push_hull_of_points([DVec3::ZERO], radius, 0);
    geometry
}

fn triangle_strip_geometry(triangles: usize, last: f64) -> ShapeGeometry {
    let mut geometry = ShapeGeometry::EMPTY;
    for k in 0..triangles {
        let x = k as f64;
        let y = if k + 1 == triangles { last } else { 1.0 };
        let corners = [DVec3::X * x, DVec3::X * (x + 1.0), DVec3::new(x, y, 0.0)];
        geometry.push_triangles(corners, &[[0, 1, 2]], [k as u32]);
    }
    geometry
}

#[test]
fn equal_forms_share_a_body_and_others_do_not() {
    let mut body_cache = BodyCache::default();
    let first = body_cache
        .body(triangle_strip_geometry(100, 1.0))
        .expect("a body");
    let again = body_cache
        .body(triangle_strip_geometry(100, 1.0))
        .expect("a body");
    let other = body_cache
        .body(triangle_strip_geometry(100, 1.0f64.next_up()))
        .expect("a body");
    assert!(Arc::ptr_eq(&first, &again) && !Arc::ptr_eq(&first, &other));
    assert_eq!(body_cache.len(), 2);
}

#[test]
fn the_longest_unused_goes_first() {
    let mut body_cache = BodyCache::default();
    let used = body_cache.body(ball(0.5)).expect("a body");
    for k in 0..2 * MAX_CACHED_BODIES {
        body_cache.body(ball(1.0 + k as f64)).expect("a body");
        let again = body_cache.body(ball(0.5)).expect("a body");
        assert!(Arc::ptr_eq(&used, &again));
        assert!(body_cache.len() <= MAX_CACHED_BODIES);
    }
    assert_eq!(body_cache.len(), MAX_CACHED_BODIES);
}

#[test]
fn bodies_stay_within_the_memory() {
    let mut body_cache = BodyCache {
        max_bytes: 1 << 20,
        ..BodyCache::default()
    };
    for k in 0..10 {
        body_cache
            .body(triangle_strip_geometry(1000, f64::from(k)))
            .expect("a body");
        let held: usize = body_cache.bodies.iter().map(|kept| kept.bytes).sum();
        assert!(held <= 1 << 20 && body_cache.len() >= 1, "{held}");
    }
    assert!(
        body_cache.len() > 2 && body_cache.len() < 10,
        "{}",
        body_cache.len()
    );
    // A body that alone exceeds the limit is made, but not cached.
    let before = body_cache.len();
    body_cache
        .body(triangle_strip_geometry(20_000, 1.0))
        .expect("a body");
    assert!(body_cache.len() <= before);
}

#[test]
fn refused_bodies_are_not_cached() {
    let mut body_cache = BodyCache::default();
    assert!(body_cache.body(ball(f64::NAN)).is_err());
    assert!(body_cache.body(ShapeGeometry::EMPTY).is_err());
    assert_eq!(body_cache.len(), 0);
}
