//! Tests against sampled poses that enclosures contain the motions, that separated boxes never meet, and that first
//! touches of triangles are not late.

use crate::method::rival::contact::boxes::motion_spread_unless_separated;
use crate::method::rival::contact::clock::{HalvedInterval, MotionEncloser};
use crate::method::rival::contact::elementary::{TrianglePair, TriangleWithNormals};
use crate::method::rival::contact::leaf::{FirstTouch, first_touch};
use crate::method::rival::contact::relative::{MotionEnclosure, RelativeMotion, TimeSpan};
use crate::method::rival::obb_tree::Obb;
use crate::method::rival::tests::samples::{RandomSource, distance};
use crate::method::rival::triangles_cross::triangles_cross;
use crate::method::rival::{Placement, RivalMotion};
use ccd_core::glam::{DMat3, DVec3};
use ccd_core::order::greater;

fn random_relative_motion(samples: &mut RandomSource, speed: f64, spin: f64) -> RelativeMotion {
    let query = samples.query(speed, spin);
    let (a, b) = (RivalMotion::new(&query.a), RivalMotion::new(&query.b));
    RelativeMotion::new((&a, samples.vector(1.0)), (&b, samples.vector(1.0)))
}

/// Returns the distance by which a placement, or a rate, lies outside an enclosure.
fn distance_outside(enclosure: &MotionEnclosure, rotation: DMat3, offset: DVec3) -> f64 {
    let column = |k: usize| {
        let off = (rotation.col(k) - enclosure.rotation.middle.col(k)).abs();
        (off - enclosure.rotation.radius.col(k)).max_element()
    };
    let off = (offset - enclosure.offset.middle).abs() - enclosure.offset.radius;
    (0..3).map(column).fold(off.max_element(), greater)
}

fn random_span(samples: &mut RandomSource) -> TimeSpan {
    let start = samples.uniform_number(0.0, 1.0);
    let width = samples.uniform_number(0.0, 1.0).powi(3);
    TimeSpan {
        start,
        end: start + width,
    }
}

fn sample_times(span: TimeSpan, count: u32) -> impl Iterator<Item = f64> {
    (0..=count).map(move |k| span.start + span.width() * f64::from(k) / f64::from(count))
}

#[test]
fn placements_are_those_of_the_motions() {
    let mut samples = RandomSource::new(1);
    for _ in 0..200 {
        let query = samples.query(3.0, 5.0);
        let (a, b) = (RivalMotion::new(&query.a), RivalMotion::new(&query.b));
        let (from_a, from_b) = (samples.vector(1.0), samples.vector(1.0));
        let relative = RelativeMotion::new((&a, from_a), (&b, from_b));
        let (point, time) = (samples.vector(2.0), samples.uniform_number(0.0, 1.0));
        let world = query.a.pose(time).transform_point(point);
        let seen = relative.placement_at(time).apply(point - from_a) + from_b;
        let back = query.b.pose(time).transform_point(seen);
        assert!(back.distance(world) < 1e-12);
    }
}

#[test]
fn enclosures_contain_all_placements_and_rates_between() {
    let mut samples = RandomSource::new(2);
    for k in 0..2000 {
        // Some cases have the second body at rest, some have whole turns.
        let mut relative =
            random_relative_motion(&mut samples, 3.0, if k % 3 == 0 { 30.0 } else { 3.0 });
        if k % 2 == 0 {
            let query = samples.query(3.0, 3.0);
            let still = ccd_core::Motion::still(query.b.start());
            let (a, b) = (RivalMotion::new(&query.a), RivalMotion::new(&still));
            relative = RelativeMotion::new((&a, samples.vector(1.0)), (&b, samples.vector(1.0)));
        }
        let span = random_span(&mut samples);
        let (placements, rates) = (
            relative.enclosure_over(span),
            relative.rate_enclosure_over(span),
        );
        for time in sample_times(span, 20) {
            let at = relative.placement_at(time);
            assert!(distance_outside(&placements, at.rotation, at.translation) < 1e-12);
            let (before, after) = (
                relative.placement_at(time - 1e-5),
                relative.placement_at(time + 1e-5),
            );
            let rotation = (after.rotation - before.rotation) * 0.5e5;
            let offset = (after.translation - before.translation) * 0.5e5;
            // Central differences are off by h²/6 of the third derivative, here about 1e-10 · 60³ · 4.
            assert!(distance_outside(&rates, rotation, offset) < 1e-4);
        }
    }
}

#[test]
fn enclosures_shrink_with_the_interval() {
    let mut samples = RandomSource::new(3);
    for _ in 0..100 {
        let relative = random_relative_motion(&mut samples, 3.0, 3.0);
        let start = samples.uniform_number(0.0, 1.0);
        let width = |width: f64| {
            let over = relative.enclosure_over(TimeSpan {
                start,
                end: start + width,
            });
            (0..3)
                .map(|k| over.rotation.radius.col(k).length())
                .sum::<f64>()
                + over.offset.radius.length()
        };
        assert!(width(0.0) == 0.0 && width(1e-6) < 1e-4 && width(1e-3) < 1e-1);
    }
}

fn random_box(samples: &mut RandomSource) -> Obb {
    Obb {
        axes: DMat3::from_quat(samples.rotation()),
        center: samples.vector(1.0),
        half_extents: samples.vector(0.5).abs(),
    }
}

/// Returns true if a point of a grid over either box lies in the other box.
fn boxes_share_grid_point(a: &Obb, b: &Obb, at: &Placement) -> bool {
    const GRID_COORDINATES: [f64; 5] = [-1.0, -0.5, 0.0, 0.5, 1.0];
    let grid = |o: &Obb| {
        let o = *o;
        let points = GRID_COORDINATES.iter().flat_map(|&x| {
            let lines = GRID_COORDINATES.iter().map(move |&y| (x, y));
            lines.flat_map(|(x, y)| GRID_COORDINATES.iter().map(move |&z| DVec3::new(x, y, z)))
        });
        points.map(move |p| o.center + o.axes * (p * o.half_extents))
    };
    let holds = |o: &Obb, p: DVec3| {
        let along = o.axes.transpose_mul_vec3(p - o.center).abs();
        (along - o.half_extents).max_element() <= 0.0
    };
    let back = at.rotation.transpose();
    grid(a).any(|p| holds(b, at.apply(p))) || grid(b).any(|p| holds(a, back * (p - at.translation)))
}

#[test]
fn separated_boxes_never_meet() {
    let mut samples = RandomSource::new(4);
    let (mut apart, mut near, mut met) = (0, 0, 0);
    for _ in 0..6000 {
        let relative = random_relative_motion(&mut samples, 2.0, 3.0);
        let (a, b) = (random_box(&mut samples), random_box(&mut samples));
        let start = samples.uniform_number(0.0, 1.0);
        let span = TimeSpan {
            start,
            end: start + samples.uniform_number(0.0, 0.2),
        };
        let meet = sample_times(span, 8)
            .any(|time| boxes_share_grid_point(&a, &b, &relative.placement_at(time)));
        met += usize::from(meet);
        match motion_spread_unless_separated(&a, &b, &relative.enclosure_over(span)) {
            None => {
                assert!(!meet);
                apart += 1;
            }
            Some(spread) => {
                assert!(spread >= 0.0);
                near += 1;
            }
        }
    }
    // Most pairs that do not meet are separated.
    assert!(
        apart > 3000 && met > 50,
        "{apart} apart, {near} near, {met} met"
    );
    assert!(f64::from(near) < 0.45 * 6000.0, "{near}");
}

#[test]
fn boxes_at_rest_are_separated_exactly_where_a_face_separates_them() {
    let at = Placement {
        rotation: DMat3::IDENTITY,
        translation: DVec3::ZERO,
    };
    let enclosure = |offset: DVec3| {
        let still = crate::method::rival::tests::samples::resting_motion(DVec3::ZERO);
        let course = RivalMotion::new(&still);
        let relative = RelativeMotion::new((&course, -offset), (&course, DVec3::ZERO));
        assert_eq!(relative.placement_at(0.3).rotation, at.rotation);
        relative.enclosure_over(TimeSpan {
            start: 0.0,
            end: 1.0,
        })
    };
    let cube = Obb {
        axes: DMat3::IDENTITY,
        center: DVec3::ZERO,
        half_extents: DVec3::splat(0.5),
    };
    for axis in DVec3::AXES {
        let ask =
            |offset: f64| motion_spread_unless_separated(&cube, &cube, &enclosure(offset * axis));
        assert_eq!(ask(1.0 + 1e-9), None);
        assert_eq!(ask(-1.0 - 1e-9), None);
        assert_eq!(ask(1.0 - 1e-9), Some(0.0));
    }
}

/// An upper bound of the relative speed of the triangles' points in this test. Centers move by √3 (2 + 4), points up to
/// 3 √3 from them by √3 times as much, twice.
const RELATIVE_SPEED_BOUND: f64 = 30.0;

/// Returns a random relative motion in which the first body flies towards the start of the second.
fn random_approaching_motion(samples: &mut RandomSource) -> RelativeMotion {
    let query = samples.query(1.0, 1.0);
    let (mut a, b) = (RivalMotion::new(&query.a), RivalMotion::new(&query.b));
    a.velocity += query.b.start().translation() - query.a.start().translation();
    RelativeMotion::new((&a, samples.vector(1.0)), (&b, samples.vector(1.0)))
}

#[test]
fn triangles_touch_when_samples_first_cross() {
    let mut samples = RandomSource::new(5);
    let (mut hits, mut free) = (0, 0);
    for k in 0..1500 {
        let relative = random_approaching_motion(&mut samples);
        let (a, b) = (samples.triangle(), samples.triangle());
        let at = |time: f64| a.map(|p| relative.placement_at(time).apply(p));
        if triangles_cross(&at(0.0), &b) {
            continue;
        }
        let tolerance = [1e-2, 1e-4, 1e-8][k % 3];
        let triangles = TrianglePair {
            a: TriangleWithNormals::new(&a),
            b: TriangleWithNormals::new(&b),
        };
        let mut clock = MotionEncloser::new(relative, tolerance / RELATIVE_SPEED_BOUND, 1 << 20);
        let touch = first_touch(&triangles, HalvedInterval::whole_duration(1.0), &mut clock);
        let span = TimeSpan {
            start: 0.0,
            end: 1.0,
        };
        let crossing = sample_times(span, 500).find(|&time| triangles_cross(&at(time), &b));
        match touch {
            FirstTouch::AtTime(time) => {
                assert!(crossing.is_none_or(|crossing| time <= crossing));
                let gap = distance(&at(time), &b);
                assert!(gap <= tolerance, "{gap} at {time}, tolerance {tolerance}");
                hits += 1;
            }
            FirstTouch::NotInInterval => {
                assert_eq!(crossing, None);
                free += 1;
            }
            FirstTouch::LimitReached => panic!("the work ran out"),
        }
    }
    assert!(hits > 200 && free > 200, "{hits} hits, {free} free");
}
