//! Tests that the referee brackets first contacts and distances that are known exactly.

use super::super::{DistanceBounds, Surface, Truth, TruthSolver};
use super::{cuboid, judge, pose_at, query, still_motion};
use ccd_core::Motion;
use ccd_core::glam::{DQuat, DVec3};
use ccd_tables::motions::Motions;
use std::f64::consts::{FRAC_PI_4, PI};

/// The allowed change of a contact time due to the rounding of a scene's numbers, as a fraction of the duration.
const RELATIVE_CONTACT_TIME_TOLERANCE: f64 = 1e-14;

fn assert_hit_at(bodies: [&Surface; 2], query: &Motions, exact: f64) {
    let truth = judge(bodies, query);
    let Truth::Hit { lo, hi } = truth else {
        panic!("{truth:?}, expected {exact}");
    };
    let off = RELATIVE_CONTACT_TIME_TOLERANCE * query.duration;
    assert!(
        lo <= exact + off && exact - off <= hi,
        "{lo} {hi}, expected {exact}"
    );
    assert!(
        hi - lo <= 1e-11 * query.duration,
        "{lo} {hi}: {:e}",
        hi - lo
    );
    // The roles of the bodies are symmetric.
    let swapped = super::query(query.b, query.a, query.duration);
    let Truth::Hit { lo: l, hi: h } = judge([bodies[1], bodies[0]], &swapped) else {
        panic!("no hit with the roles swapped");
    };
    assert!(lo <= h && l <= hi, "{lo} {hi} and {l} {h}");
}

fn falling_motion(rotation: DQuat, height: f64, spin: DVec3) -> Motion {
    let start = pose_at(DVec3::new(0.03, 0.11, height), rotation);
    Motion::new(start, -4.0 * DVec3::Z, spin).unwrap()
}

fn spinning_motion(position: DVec3, spin: DVec3) -> Motion {
    Motion::new(pose_at(position, DQuat::IDENTITY), DVec3::ZERO, spin).unwrap()
}

#[test]
fn a_cube_falls_flat_on_a_slab() {
    let (cube, slab) = (cuboid(0.5, 0.5, 0.5), cuboid(9.0, 9.0, 1.0));
    for spin in [0.0, 1.0, 50.0, -300.0] {
        let fall = falling_motion(DQuat::IDENTITY, 3.0, spin * DVec3::Z);
        assert_hit_at(
            [&cube, &slab],
            &query(fall, still_motion(0.0, 0.0, -1.0), 1.0),
            0.625,
        );
    }
    // Corners fall on the diagonal that divides the slab's top.
    let straight = Motion::new(
        pose_at(3.0 * DVec3::Z, DQuat::IDENTITY),
        -4.0 * DVec3::Z,
        DVec3::ZERO,
    );
    let straight = query(straight.unwrap(), still_motion(0.0, 0.0, -1.0), 1.0);
    assert_hit_at([&cube, &slab], &straight, 0.625);
}

#[test]
fn a_cube_falls_far_from_the_origin_or_for_long() {
    let (cube, slab) = (cuboid(0.5, 0.5, 0.5), cuboid(9.0, 9.0, 1.0));
    for far in [1e3, 1e6] {
        let start = pose_at(DVec3::new(far, far, far + 3.0), DQuat::IDENTITY);
        let fall = Motion::new(start, DVec3::new(0.0, 0.0, -0.004), DVec3::ZERO).unwrap();
        let query = query(fall, still_motion(far, far, far - 1.0), 1000.0);
        let Truth::Hit { lo, hi } = judge([&cube, &slab], &query) else {
            panic!("no hit at {far}");
        };
        assert!(
            lo <= 625.0 && 625.0 <= hi && hi - lo <= 1e-13 * far * 1000.0,
            "{lo} {hi}"
        );
    }
}

#[test]
fn a_rod_turns_down_onto_a_slab() {
    let (l, w, h) = (2.0, 0.05, 1.2);
    let rod = cuboid(l, 0.3, w);
    let exact = (f64::asin(h / f64::hypot(l, w)) - f64::atan2(w, l)) / PI;
    assert!((exact - 0.196802112).abs() < 1e-9);
    let turn = spinning_motion(h * DVec3::Z, PI * DVec3::Y);
    let query = query(turn, still_motion(0.0, 0.0, -1.0), 1.0);
    assert_hit_at([&rod, &cuboid(9.0, 9.0, 1.0)], &query, exact);
}

#[test]
fn a_rod_turns_to_a_wall_at_any_speed() {
    let (l, w, h) = (2.0, 0.05, 1.2);
    let (rod, wall) = (cuboid(w, 0.3, l), cuboid(1.0, 9.0, 9.0));
    for half_turns in [1.0, 1.9, 2.0, 7.3, 40.0] {
        let exact = (f64::asin(h / f64::hypot(l, w)) - f64::atan2(w, l)) / (half_turns * PI);
        let turn = spinning_motion(DVec3::ZERO, half_turns * PI * DVec3::Y);
        assert_hit_at(
            [&rod, &wall],
            &query(turn, still_motion(h + 1.0, 0.0, 0.0), 1.0),
            exact,
        );
    }
}

#[test]
fn a_rod_all_but_misses_a_wall_or_just_misses_it() {
    let (l, w) = (2.0, 0.05);
    let (rod, wall) = (cuboid(w, 0.3, l), cuboid(1.0, 9.0, 9.0));
    let turn = spinning_motion(DVec3::ZERO, PI * DVec3::Y);
    let reach = f64::hypot(l, w);
    for part in [1e-3, 1e-6] {
        let exact = (f64::asin(1.0 - part) - f64::atan2(w, l)) / PI;
        let near = query(
            turn,
            still_motion(reach * (1.0 - part) + 1.0, 0.0, 0.0),
            1.0,
        );
        let Truth::Hit { lo, hi } = judge([&rod, &wall], &near) else {
            panic!("no hit at {part}");
        };
        // The wall's position is rounded, and it is met at a shallow angle.
        let off = 1e-15 / part.sqrt();
        assert!(
            lo - off <= exact && exact <= hi + off && hi - lo < 1e-9,
            "{lo} {exact} {hi}"
        );
        let far = query(
            turn,
            still_motion(reach * (1.0 + part) + 1.0, 0.0, 0.0),
            1.0,
        );
        assert_eq!(judge([&rod, &wall], &far), Truth::Free);
    }
}

#[test]
fn an_edge_meets_a_parallel_edge() {
    let (l, w, r, psi) = (2.0, 0.05, 1.3, 1.0_f64);
    let (rod, post) = (cuboid(l, w, 0.1), cuboid(0.1, 0.1, 1.0));
    let exact = (psi - f64::asin(w / r)) / 1.5;
    assert!((exact - 0.641019315).abs() < 1e-9);
    let (ahead, edge) = (
        DVec3::new(-psi.sin(), psi.cos(), 0.0),
        DVec3::new(psi.cos(), psi.sin(), 0.0),
    );
    let position = r * edge + 0.1 * f64::sqrt(2.0) * ahead;
    let post_motion = Motion::still(pose_at(position, DQuat::from_rotation_z(psi + FRAC_PI_4)));
    let turn = spinning_motion(DVec3::ZERO, 1.5 * DVec3::Z);
    assert_hit_at([&rod, &post], &query(turn, post_motion, 1.0), exact);
}

#[test]
fn edges_cross_and_a_corner_comes_down() {
    let cube = cuboid(0.5, 0.5, 0.5);
    let above = falling_motion(DQuat::from_rotation_x(FRAC_PI_4), 3.0, DVec3::ZERO);
    let below = Motion::still(pose_at(DVec3::ZERO, DQuat::from_rotation_y(FRAC_PI_4)));
    let crossing = query(above, below, 1.0);
    assert_hit_at([&cube, &cube], &crossing, (3.0 - f64::sqrt(2.0)) / 4.0);
    let corner_down = DQuat::from_rotation_arc(DVec3::ONE.normalize(), -DVec3::Z);
    let corner = query(
        falling_motion(corner_down, 3.0, DVec3::ZERO),
        still_motion(0.0, 0.0, -1.0),
        1.0,
    );
    let exact = (3.0 - f64::sqrt(3.0) / 2.0) / 4.0;
    assert_hit_at([&cube, &cuboid(9.0, 9.0, 1.0)], &corner, exact);
}

#[test]
fn two_rods_turn_towards_each_other() {
    let (l, w, apart) = (2.0, 0.05, 3.0);
    let rod = cuboid(w, 0.3, l);
    let exact = (f64::asin(apart / 2.0 / f64::hypot(l, w)) - f64::atan2(w, l)) / 2.0;
    assert!((exact - 0.411356590).abs() < 1e-9);
    let turn = |side: f64| spinning_motion(side * apart / 2.0 * DVec3::X, -side * 2.0 * DVec3::Y);
    assert_hit_at([&rod, &rod], &query(turn(-1.0), turn(1.0), 1.0), exact);
}

#[test]
fn parallel_motions_are_free_and_flush_ones_graze() {
    let (cube, slab) = (cuboid(0.5, 0.5, 0.5), cuboid(9.0, 9.0, 1.0));
    let slide = |height: f64| {
        let start = pose_at(DVec3::new(-10.5, 0.0, height), DQuat::IDENTITY);
        let motion = Motion::new(start, 20.0 * DVec3::X, DVec3::ZERO).unwrap();
        judge(
            [&cube, &slab],
            &query(motion, still_motion(0.0, 0.0, -1.0), 1.0),
        )
    };
    for gap in [1e-6, 1e-9, 1e-12] {
        assert_eq!(slide(0.5 + gap), Truth::Free, "{gap}");
    }
    // Its front is at −10 first, the slab's side at −9.
    let flush = slide(0.5);
    assert!(
        matches!(flush, Truth::Graze { lo } if lo <= 0.05 && 0.05 - lo < 1e-13),
        "{flush:?}"
    );
    let along = |x: f64| {
        Motion::new(
            pose_at(x * DVec3::X, DQuat::IDENTITY),
            1e3 * DVec3::X,
            DVec3::ZERO,
        )
    };
    let side_by_side = query(along(0.0).unwrap(), along(1.0 + 1e-9).unwrap(), 1.0);
    assert_eq!(judge([&cube, &cube], &side_by_side), Truth::Free);
}

#[test]
fn contact_at_the_start_is_found_and_the_inside_is_free() {
    let (cube, shell) = (cuboid(0.5, 0.5, 0.5), cuboid(2.0, 2.0, 2.0));
    let start = |x: f64| {
        judge(
            [&cube, &cube],
            &query(still_motion(x, 0.1, 0.2), still_motion(0.0, 0.0, 0.0), 1.0),
        )
    };
    assert_eq!(
        [start(0.9), start(1.0), start(1.0 + 1e-9)],
        [Truth::ContactAtStart, Truth::ContactAtStart, Truth::Free]
    );
    let inside = query(
        still_motion(0.0, 0.0, 0.0),
        still_motion(0.1, 0.2, 0.3),
        1.0,
    );
    assert_eq!(judge([&cube, &shell], &inside), Truth::Free);
    let distance = TruthSolver::new(&cube, &shell).distance_bounds(&inside, 0.5);
    let DistanceBounds {
        distance_lower_bound: lower,
        upper_distance: upper,
    } = distance;
    assert!(
        lower <= 1.2 && 1.2 <= upper && upper - lower < 1e-12,
        "{distance:?}"
    );
}

#[test]
fn invalid_durations_are_undecided() {
    let cube = cuboid(0.5, 0.5, 0.5);
    for duration in [f64::NAN, f64::INFINITY, -1.0] {
        let query = query(
            still_motion(3.0, 0.0, 0.0),
            still_motion(0.0, 0.0, 0.0),
            duration,
        );
        assert_eq!(judge([&cube, &cube], &query), Truth::Undecided { lo: 0.0 });
    }
    let query = query(
        still_motion(3.0, 0.0, 0.0),
        still_motion(0.0, 0.0, 0.0),
        0.0,
    );
    assert_eq!(judge([&cube, &cube], &query), Truth::Free);
}
