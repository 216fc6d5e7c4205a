//! Compares tracks with their defining formula, and bounds of heights and velocities with samples.

mod sin_cos;

use super::{AngleSinCos, HeightFunction, MotionAlongAxis};
use crate::math::order::{greater, lesser};
use crate::math::vector::{length, unit};
use crate::motion::bound::{Velocities, published_bound, sound_bound};
use crate::motion::gap::{Gap, first_possible_crossing};
use crate::rounding::RATE_ERROR_F64;
use crate::tests::double::DoubleDouble;
use crate::tests::scene::{
    Pcg64, RngExt, random_direction, random_point_in_ball, random_power_of_ten, rng,
};
use crate::tests::worst::{WorstCaseSearch, error_fraction};
use glam::{DQuat, DVec3};
use std::f64::consts::TAU;

impl HeightFunction {
    /// Creates the track along `n` of a point that starts at `height`, with the vector `arm` from the motion's center.
    fn new(motion: &Velocities, n: DVec3, height: f64, arm: DVec3) -> Self {
        let axis = unit(motion.spin).unwrap_or(DVec3::ZERO);
        MotionAlongAxis::new(motion.linear_velocity, axis, length(motion.spin), n)
            .height_function_of_point(height, arm)
    }

    /// Returns the height after `tau`.
    fn height_after(&self, tau: f64) -> f64 {
        self.height_at(tau, AngleSinCos::new(self.angular_speed * tau))
    }
}

/// Draws a motion, an axis and an arm of about unit size.
fn random_motion_axis_and_arm(rng: &mut Pcg64) -> (Velocities, DVec3, DVec3) {
    let turn = match rng.random_range(0..5) {
        0 => 0.0,
        1 => random_power_of_ten(rng, -9.0, -1.0),
        _ => random_power_of_ten(rng, -1.0, 1.6),
    };
    let fast = match rng.random_range(0..4) {
        0 => 0.0,
        _ => random_power_of_ten(rng, -3.0, 2.0),
    };
    let motion = Velocities {
        linear_velocity: random_direction(rng) * fast,
        spin: random_direction(rng) * turn,
    };
    (
        motion,
        random_direction(rng),
        random_point_in_ball(rng, 1.0),
    )
}

fn height(motion: &Velocities, n: DVec3, height: f64, arm: DVec3, tau: f64) -> f64 {
    let turned = DQuat::from_scaled_axis(motion.spin * tau) * arm;
    height + n.dot(motion.linear_velocity * tau + turned - arm)
}

#[test]
fn a_track_is_the_height_of_a_turning_point() {
    let mut rng = rng(1);
    for _ in 0..10_000 {
        let (motion, n, arm) = random_motion_axis_and_arm(&mut rng);
        let track = HeightFunction::new(&motion, n, 0.3, arm);
        let tau = rng.random_range(0.0..1.0);
        let size = 2.0 + motion.linear_velocity.length() + motion.spin.length();
        let off = track.height_after(tau) - height(&motion, n, 0.3, arm, tau);
        assert!(off.abs() < 1e-14 * size, "{off:e} {motion:?}");
    }
}

/// Returns the highest point of a track over `[0, tau]`, from dense samples refined by golden section search.
fn sampled_max_height(track: &HeightFunction, turns: f64, tau: f64) -> f64 {
    let samples = 64 + (64.0 * turns) as usize;
    let at = |k: usize| tau * k as f64 / samples as f64;
    let best = (0..=samples).max_by(|&i, &j| {
        track
            .height_after(at(i))
            .total_cmp(&track.height_after(at(j)))
    });
    let best = best.unwrap();
    let (mut low, mut high) = (at(best.saturating_sub(1)), at((best + 1).min(samples)));
    for _ in 0..100 {
        let (first, second) = (low + 0.382 * (high - low), low + 0.618 * (high - low));
        if track.height_after(first) < track.height_after(second) {
            low = first;
        } else {
            high = second;
        }
    }
    greater(
        track.height_after(0.5 * (low + high)),
        track.height_after(at(best)),
    )
}

/// Returns the time within a duration of 1 at which a track may reach a limit; `None` if it stays below.
fn possible_crossing_time(track: &HeightFunction, limit: f64) -> Option<f64> {
    first_possible_crossing(1.0, 64, |tau| {
        let angle = AngleSinCos::new(track.angular_speed * tau);
        Gap {
            gap: limit - track.height_at(tau, angle),
            rate: track.rate_at(tau, angle),
            second_derivative: track.second_derivative_bound(),
        }
        .free_time()
    })
    .bounded()
}

#[test]
fn the_first_crossing_is_never_late_and_near() {
    let mut rng = rng(3);
    let (mut crossings, mut near) = (0, 0);
    for _ in 0..10_000 {
        let (motion, n, arm) = random_motion_axis_and_arm(&mut rng);
        let track = HeightFunction::new(&motion, n, 0.0, arm);
        let limit = random_power_of_ten(&mut rng, -6.0, 0.3);
        let samples = 64 + (64.0 * motion.spin.length()) as usize;
        let at = |k: usize| k as f64 / samples as f64;
        let truth = (1..=samples).find(|&k| track.height_after(at(k)) >= limit);
        let found = possible_crossing_time(&track, limit);
        let until = found.unwrap_or(1.0);
        let before = sampled_max_height(&track, motion.spin.length() * until, until);
        let size = 1.0 + motion.linear_velocity.length() + motion.spin.length();
        assert!(
            before <= limit + 1e-14 * size,
            "{before:e} > {limit:e}: {motion:?}"
        );
        let Some(k) = truth else { continue };
        let found = found.expect("a crossing that samples find");
        assert!(found <= at(k));
        crossings += 1;
        // The rest is not worth a round.
        let (mut low, mut high) = (at(k - 1), at(k));
        for _ in 0..100 {
            let middle = 0.5 * (low + high);
            if track.height_after(middle) < limit {
                low = middle;
            } else {
                high = middle;
            }
        }
        near += usize::from(found >= low * (1.0 - 1e-1) || found >= at(k - 1));
    }
    assert!(crossings > 2_000, "{crossings}");
    assert!(100 * near >= 95 * crossings, "{near} of {crossings}");
}

#[test]
fn a_zero_gap_or_nan_gets_no_free_time() {
    let free = |gap: f64, rate: f64, second_derivative: f64| {
        Gap {
            gap,
            rate,
            second_derivative,
        }
        .free_time()
    };
    for rate in [-1.0, 0.0, 1.0, f64::NAN] {
        for second_derivative in [0.0, 1.0, f64::NAN] {
            for gap in [0.0, -0.0, -1.0, f64::NEG_INFINITY, f64::NAN] {
                assert_eq!(
                    free(gap, rate, second_derivative),
                    0.0,
                    "{gap} {rate} {second_derivative}"
                );
            }
        }
    }
    assert_eq!(free(1.0, -1.0, 0.0), f64::INFINITY);
    assert_eq!(free(1.0, f64::NAN, 1.0), 0.0);
    assert_eq!(free(1.0, 1.0, f64::NAN), 0.0);
}

#[test]
fn free_times_use_up_the_gap_and_no_more() {
    let mut rng = rng(4);
    for _ in 0..10_000 {
        let sign = [-1.0, 0.0, 1.0][rng.random_range(0..3)];
        let gap = Gap {
            gap: random_power_of_ten(&mut rng, -9.0, 3.0),
            rate: sign * random_power_of_ten(&mut rng, -6.0, 6.0),
            second_derivative: random_power_of_ten(&mut rng, -6.0, 6.0),
        };
        let tau = gap.free_time();
        let rest = gap.gap - gap.rate * tau - 0.5 * gap.second_derivative * tau * tau;
        let scale = gap.gap + (gap.rate * tau).abs() + gap.second_derivative * tau * tau;
        assert!(rest >= -1e-15 * scale, "{gap:?}: {rest:e}");
        assert!(rest <= 1e-14 * scale, "{gap:?}: {rest:e}");
    }
}

/// Returns the arm that is farthest along a direction.
fn farthest_arm_along(arms: &[DVec3], c: DVec3) -> DVec3 {
    let farther = |a: &DVec3, b: &DVec3| c.dot(*a).total_cmp(&c.dot(*b));
    arms.iter().copied().max_by(farther).unwrap()
}

/// Tests that no point moves along `n` faster than the bound of [`sound_bound`], at any time.
#[test]
fn the_sound_bound_holds_over_intervals() {
    let mut rng = rng(6);
    let mut beaten = 0;
    for _ in 0..2_000 {
        let (motion, n, _) = random_motion_axis_and_arm(&mut rng);
        let arms: Vec<DVec3> = (0..8)
            .map(|_| random_point_in_ball(&mut rng, 1.0))
            .collect();
        let axis = motion.spin.normalize_or_zero();
        let reach = arms.iter().map(|r| r.reject_from_normalized(axis).length());
        let bound = sound_bound(&motion, n, reach.fold(0.0, greater));
        let instant = published_bound(&motion, n, |c| farthest_arm_along(&arms, c));
        let turning = instant - motion.linear_velocity.dot(n).abs();
        let most = greater(0.0, bound - motion.linear_velocity.dot(n));
        assert!(turning <= most + 1e-12 * (1.0 + bound.abs() + instant));
        let mut fastest = f64::NEG_INFINITY;
        for &arm in &arms {
            for k in 1..=32 {
                let tau = f64::from(k) / 32.0;
                let rise = height(&motion, n, 0.0, arm, tau);
                let slack = 1e-13 * (1.0 + motion.linear_velocity.length() + motion.spin.length());
                assert!(rise <= bound * tau + slack, "{rise} > {bound} × {tau}");
                fastest = greater(fastest, rise / tau);
            }
        }
        beaten += usize::from(fastest > instant + 1e-9);
    }
    // Random motions show that the published bound does not hold over an interval.
    assert!(beaten > 100, "{beaten}");
}

/// Tests that the published bound lets an arm turn through a wall, and that the sound bound does not. The arm of length
/// 2 hangs down and turns about its end towards the wall above. The published bound counts only the sideways motion of
/// its tip.
#[test]
fn the_published_bound_lets_the_mace_through_the_wall() {
    let (length, width, wall) = (2.0, 0.02, 1.0);
    let motion = Velocities {
        linear_velocity: DVec3::ZERO,
        spin: 3.0 * DVec3::Z,
    };
    let tips = [-width, width].map(|x| DVec3::new(x, -length, 0.0));
    let ball = 0.1;
    let gap = wall - ball;
    // The bound is the fastest advance of the tips, and of the ball about the center, which does not advance.
    let allowed = gap / published_bound(&motion, DVec3::Y, |c| farthest_arm_along(&tips, c));
    let reach = tips[0].length();
    let contact = (length.atan2(width) + (wall / reach).asin()) / 3.0;
    assert!(allowed > 1.0, "a step of {allowed} passes the whole motion");
    assert!(contact < 0.7);
    let step = gap / sound_bound(&motion, DVec3::Y, reach);
    assert!(step < contact);
    let tracks = tips.map(|tip| HeightFunction::new(&motion, DVec3::Y, tip.y, tip));
    let turns = motion.spin.length() * step;
    assert!(
        tracks
            .iter()
            .all(|track| sampled_max_height(track, turns, step) < wall)
    );
    let first = tracks
        .iter()
        .filter_map(|track| possible_crossing_time(track, wall));
    let first = first.fold(f64::INFINITY, lesser);
    assert!(
        first <= contact && first > 0.98 * contact,
        "{first} of {contact}"
    );
}

#[test]
fn a_turning_point_is_never_below_its_least_height_and_reaches_it() {
    let mut rng = rng(12);
    let (mut past_trough, mut before_trough) = (0, 0);
    for _ in 0..20_000 {
        let (mut motion, n, arm) = random_motion_axis_and_arm(&mut rng);
        motion.linear_velocity = DVec3::ZERO;
        let track = HeightFunction::new(&motion, n, 0.3, arm);
        let horizon = rng.random_range(0.0..1.0);
        let least =
            track.least_rotational_height(horizon, AngleSinCos::new(track.angular_speed * horizon));
        let times = (0..=400).map(|k| horizon * f64::from(k) / 400.0);
        let seen = times
            .map(|tau| track.height_after(tau))
            .fold(f64::INFINITY, lesser);
        // Samples are rounded, too.
        let rounding = 1e-15 * (1.0 + track.angular_speed);
        assert!(least <= seen + rounding, "{least} {seen} {track:?}");
        // Between two samples the track deviates by this much from a straight line.
        let step = horizon / 400.0;
        let missed =
            track.second_derivative_bound() * step * step + 1e-13 * (1.0 + track.angular_speed);
        assert!(seen - least <= missed, "{seen} {least} {track:?}");
        if least < track.height_after(horizon) - missed && least < track.height_after(0.0) - missed
        {
            past_trough += 1;
        } else {
            before_trough += 1;
        }
    }
    assert!(
        past_trough > 1_000 && before_trough > 1_000,
        "{past_trough} {before_trough}"
    );
}

/// Compares the bound of a turning point's least height with the exact least height. Earlier rounding is an error of
/// heights, and is allowed for there.
#[test]
fn worst_least_until() {
    let found = WorstCaseSearch::new("RATE_F64, least heights of points", 40_000).search(|tape| {
        let track = HeightFunction {
            height: 0.0,
            linear_rate: 0.0,
            linear_acceleration: 0.0,
            p: tape.any_number(-60..=10),
            q: tape.any_number(-60..=10),
            angular_speed: tape.size(-40..=4),
        };
        // The angle is arbitrary, or next to the lowest point of the circle.
        let trough = (-track.q).atan2(-track.p).rem_euclid(TAU);
        let horizon = match tape.index_below(2) {
            0 => tape.next_fraction(),
            _ => lesser(1.0, tape.number_near(trough / track.angular_speed)),
        };
        let turn = track.angular_speed * horizon;
        let least = track.least_rotational_height(horizon, AngleSinCos::new(turn));
        let [p, q, omega, time] =
            [track.p, track.q, track.angular_speed, horizon].map(DoubleDouble::from);
        let swing = (p * p + q * q).sqrt();
        let half = omega * time * DoubleDouble::from(0.5);
        let (sin, cos) = half.sin_cos();
        let two = DoubleDouble::from(2.0);
        let at_end = two * sin * (cos * q - sin * p);
        // A turn that all but reaches the lowest point reaches the same height.
        let exact = if turn >= trough {
            -p - swing
        } else {
            at_end.min(DoubleDouble::ZERO)
        };
        let allowance = RATE_ERROR_F64 * swing.get() * (1.0 + turn);
        let above = (DoubleDouble::from(least) + DoubleDouble::from(allowance) - exact).get();
        (swing.get() > 0.0 && horizon > 0.0).then(|| error_fraction(above, allowance))
    });
    found.assert_tight_bound(30.0);
}

/// Compares the bound of the second derivative of a track, as stored, with the exact largest second derivative. Earlier
/// rounding is an error of heights: it moves no height by more than twice as much, whatever the rotation.
#[test]
fn worst_bend() {
    let found = WorstCaseSearch::new("RATE_F64, bends of points", 40_000).search(|tape| {
        let track = HeightFunction {
            height: 0.0,
            linear_rate: 0.0,
            linear_acceleration: 0.0,
            p: tape.any_number(-100..=20),
            q: tape.any_number(-100..=20),
            angular_speed: tape.size(-100..=20),
        };
        let [p, q, omega] = [track.p, track.q, track.angular_speed].map(DoubleDouble::from);
        let exact = omega * omega * (p * p + q * q).sqrt();
        let lost = exact - DoubleDouble::from(track.second_derivative_bound());
        (exact.get() > 0.0).then(|| error_fraction(lost.get(), RATE_ERROR_F64 * exact.get()))
    });
    found.assert_tight_bound(16.0);
}
