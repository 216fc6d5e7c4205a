use super::*;
use ccd_core::glam::DVec3;

fn ball(radius: f64) -> Form {
    let mut form = Form::EMPTY;
    form.push_hull(vec![DVec3::ZERO], radius, &[]);
    form
}

fn strip(triangles: usize, last: f64) -> Form {
    let mut form = Form::EMPTY;
    for k in 0..triangles {
        let x = k as f64;
        let y = if k + 1 == triangles { last } else { 1.0 };
        form.push_triangle(
            [DVec3::X * x, DVec3::X * (x + 1.0), DVec3::new(x, y, 0.0)],
            k as u32,
        );
    }
    form
}

#[test]
fn equal_forms_share_a_body_and_others_do_not() {
    let mut shelf = Shelf::default();
    let first = shelf.body(strip(100, 1.0)).expect("a body");
    let again = shelf.body(strip(100, 1.0)).expect("a body");
    let other = shelf.body(strip(100, 1.0f64.next_up())).expect("a body");
    assert!(Arc::ptr_eq(&first, &again) && !Arc::ptr_eq(&first, &other));
    assert_eq!(shelf.len(), 2);
}

#[test]
fn the_longest_unused_goes_first() {
    let mut shelf = Shelf::default();
    let used = shelf.body(ball(0.5)).expect("a body");
    for k in 0..2 * KEPT_BODIES {
        shelf.body(ball(1.0 + k as f64)).expect("a body");
        let again = shelf.body(ball(0.5)).expect("a body");
        assert!(Arc::ptr_eq(&used, &again));
        assert!(shelf.len() <= KEPT_BODIES);
    }
    assert_eq!(shelf.len(), KEPT_BODIES);
}

#[test]
fn bodies_stay_within_the_memory() {
    let mut shelf = Shelf {
        most_bytes: 1 << 20,
        ..Shelf::default()
    };
    for k in 0..10 {
        shelf.body(strip(1000, f64::from(k))).expect("a body");
        let held: usize = shelf.bodies.iter().map(|kept| kept.bytes).sum();
        assert!(held <= 1 << 20 && shelf.len() >= 1, "{held}");
    }
    assert!(shelf.len() > 2 && shelf.len() < 10, "{}", shelf.len());
    // A body that alone exceeds the limit is made, but not cached.
    let before = shelf.len();
    shelf.body(strip(20_000, 1.0)).expect("a body");
    assert!(shelf.len() <= before);
}

#[test]
fn refused_bodies_are_not_cached() {
    let mut shelf = Shelf::default();
    assert!(shelf.body(ball(f64::NAN)).is_err());
    assert!(shelf.body(Form::EMPTY).is_err());
    assert_eq!(shelf.len(), 0);
}
