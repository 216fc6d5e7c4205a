//! Compares free times of pieces with samples of the gap along the axis and of the distance.

mod directed;
mod planes;

use super::*;
use crate::distance::separation;
use crate::engine::meter::Meter;
use crate::tests::nearest::nearest_points;
use crate::tests::oracle::ExhaustiveOracle;
use crate::tests::scene::{RngExt, SceneKind, random_direction, random_power_of_ten, rng, scene};

const SAMPLE_COUNT: u32 = 32;

#[test]
fn an_axis_separates_for_as_long_as_it_says() {
    let mut rng = rng(1);
    let (mut some, mut forever, mut used) = (0, 0, 0);
    for number in 0..20_000 {
        let kind = SceneKind::passing(number);
        let scene = scene(&mut rng, kind, 2);
        let problem = scene.problem();
        let clock = scene.clock * rng.random_range(0.0..1.0);
        let placed = PlacedPair::new(&problem, [0, 0], clock);
        let mut normal = random_direction(&mut rng);
        let heights = |s: f64, normal: DVec3| {
            let now = PlacedPair::new(&problem, [0, 0], s);
            let axis = now.frames[0].inverse_transform_vector(normal);
            separation::support_gap(&now.pieces, axis, now.pieces.a.points[0])
        };
        if heights(clock, normal) < heights(clock, -normal) {
            normal = -normal;
        }
        let gap = heights(clock, normal);
        // The slack is the part of the gap that may be used up.
        let slack = gap.abs() * random_power_of_ten(&mut rng, -3.0, 0.0);
        let free = placed.fixed_plane_free_time(normal, slack).bounded();
        let until = free.map_or(1.0, |free| clock + free);
        let least = gap - slack - 3.0 * problem.rounding;
        for k in 0..=SAMPLE_COUNT {
            let s = clock + (until - clock) * f64::from(k) / f64::from(SAMPLE_COUNT);
            let found = heights(s, normal);
            assert!(
                found >= least,
                "{number}: {found:e} < {least:e} at {s} of {until}"
            );
        }
        match free {
            None => forever += 1,
            Some(free) => {
                assert!(free > 0.0 && clock + free <= 1.0);
                some += 1;
                used += usize::from(heights(until, normal) < gap - 0.5 * slack);
            }
        }
    }
    assert!(some > 2_000 && forever > 2_000, "{some} {forever}");
    // Most of the slack is used up, most of the time.
    assert!(4 * used > 3 * some, "{used} of {some}");
}

#[test]
fn pieces_stay_apart_for_as_long_as_the_better_axis_says() {
    let mut rng = rng(2);
    let (mut some, mut forever) = (0, 0);
    for number in 0..20_000 {
        let kind = SceneKind::passing(number);
        let scene = scene(&mut rng, kind, 2);
        let problem = scene.problem();
        let clock = scene.clock * rng.random_range(0.9..1.0);
        let placed = PlacedPair::new(&problem, [0, 0], clock);
        let mut meter = Meter::new(&problem);
        let checked = placed
            .query_oracle(&mut ExhaustiveOracle, &mut (), &mut meter)
            .unwrap();
        assert_eq!(meter.stats.oracle_calls, 1);
        let kept = problem.kept_gap();
        if checked.lower <= kept {
            continue;
        }
        let free = placed.free_time(&checked, kept).bounded();
        let until = free.map_or(1.0, |free| clock + free);
        for k in 0..=SAMPLE_COUNT {
            let s = clock + (until - clock) * f64::from(k) / f64::from(SAMPLE_COUNT);
            let frames = [&problem.a, &problem.b].map(|side| side.path.frame(s));
            let a = problem
                .a
                .body
                .pieces()
                .triangle(0)
                .map(|p| frames[0].transform_point(p));
            let b = problem
                .b
                .body
                .pieces()
                .triangle(0)
                .map(|p| frames[1].transform_point(p));
            let found = nearest_points(&a, &b).distance;
            assert!(
                found > kept - problem.rounding,
                "{number}: {found:e} at {s} of {until}, {kept:e} promised"
            );
        }
        match free {
            None => forever += 1,
            Some(_) => some += 1,
        }
    }
    assert!(some > 2_000 && forever > 2_000, "{some} {forever}");
}

/// Tests that the free time along an axis is 0 if the slack is not positive, or if the slack or the axis is NaN.
#[test]
fn no_slack_is_no_time() {
    let mut rng = rng(3);
    for _ in 0..500 {
        let scene = scene(&mut rng, SceneKind::RandomMotion, 1);
        let problem = scene.problem();
        let placed = PlacedPair::new(&problem, [0, 0], 0.5);
        for slack in [0.0, -1.0, f64::NAN, f64::NEG_INFINITY] {
            let free = placed.fixed_plane_free_time(random_direction(&mut rng), slack);
            assert_eq!(free, FreeTime::NONE, "{slack}");
        }
        let free = placed.fixed_plane_free_time(DVec3::NAN, 1.0);
        assert_eq!(free, FreeTime::NONE);
    }
}
