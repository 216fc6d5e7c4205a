//! Searches for the worst rounding errors of the bounds in f32, with every set of vector instructions.
//!
//! References are in f64, whose own error is a five hundred millionth of that of f32.

use super::setting::{PairConfiguration, Shape};
use super::shares::{ErrorShares, free_time_error_share};
use super::{AxisValues, EightPairSample, free_times};
use crate::body::tree::LANES;
use crate::engine::nodes::shape::{Children, OtherNode};
use crate::math::order::greater;
use crate::math::simd::Vec3x8;
use crate::rounding::{
    CROSS_PRODUCT_ERROR_F32, FREE_TIME_FACTOR_F32, LEAST_AXIS_LENGTH_F32, LEAST_GAP_F32,
    LEAST_SECOND_DERIVATIVE_F32, SECOND_DERIVATIVE_FACTOR_F32, UNIT_ROUNDOFF_F32,
};
use crate::settings::VectorInstructions;
use crate::tests::scene::{RngExt, random_direction, random_power_of_ten};
use crate::tests::worst::{RandomCase, WorstCaseSearch, error_fraction};
use crate::vectorize;
use glam::{DVec3, Vec3};

/// A search among random settings for the largest rounding error, as a share of its allowance.
#[derive(Clone, Copy)]
struct Search {
    name: [&'static str; 2],
    draw_configuration: fn(&mut RandomCase, &Shape) -> PairConfiguration,
    select_share: fn(&ErrorShares) -> f64,
    max_looseness: f64,
}

impl Search {
    /// Runs the search over boxes, then over triangles, and checks the largest shares.
    fn run(self) {
        let boxes = WorstCaseSearch::new(self.name[0], 3_000).search(|tape| {
            let other = Shape::new(tape);
            let sample = (self.draw_configuration)(tape, &other).box_sample(tape, &other);
            Some(self.max_error_share(tape, &sample))
        });
        boxes.assert_tight_bound(self.max_looseness);
        let triangles = WorstCaseSearch::new(self.name[1], 3_000).search(|tape| {
            let other = Shape::new(tape).triangle();
            let sample = (self.draw_configuration)(tape, &other).triangle_sample(tape, &other);
            Some(self.max_error_share(tape, &sample))
        });
        triangles.assert_tight_bound(self.max_looseness);
    }

    /// Returns the largest share of the allowance among eight pairs and three axes.
    fn max_error_share<C: Children, P: OtherNode>(
        self,
        tape: &mut RandomCase,
        sample: &EightPairSample<C, P>,
    ) -> f64 {
        let some = random_direction(tape).as_vec3() * 2f32.powi(tape.random_range(-40..40));
        let of = |found: &AxisValues, lane: usize| {
            (self.select_share)(&sample.error_shares(found, &sample.axis_free_times(found), lane))
        };
        let found = sample.cross_checked_axis_values(some);
        let all = found
            .iter()
            .flat_map(|axis| (0..LANES).map(move |k| of(axis, k)));
        all.fold(f64::NEG_INFINITY, greater)
    }
}

/// Tests the errors of gaps between nodes that are far apart. Their size contributes less than a hundredth of the
/// allowance.
#[test]
fn way_f32() {
    Search {
        name: [
            "GAP_PER_DISTANCE_F32, boxes",
            "GAP_PER_DISTANCE_F32, triangles",
        ],
        draw_configuration: |tape, other| {
            let far = random_power_of_ten(tape, 3.0, 5.0);
            PairConfiguration::new(tape, other).with_relative_distance(far, other)
        },
        select_share: |of| of.gap,
        max_looseness: 12.0,
    }
    .run();
}

/// Tests the errors of gaps between nodes that are close. Their distance contributes less than a hundredth of the
/// allowance.
#[test]
fn reach_f32() {
    Search {
        name: ["GAP_PER_RADIUS_F32, boxes", "GAP_PER_RADIUS_F32, triangles"],
        draw_configuration: |tape, other| {
            let far = random_power_of_ten(tape, -5.0, -2.0);
            PairConfiguration::new(tape, other).with_relative_distance(far, other)
        },
        select_share: |of| of.gap,
        max_looseness: 40.0,
    }
    .run();
}

#[test]
fn rate_f32() {
    Search {
        name: ["RATE_F32, boxes", "RATE_F32, triangles"],
        draw_configuration: PairConfiguration::new,
        select_share: |of| of.rate,
        max_looseness: 40.0,
    }
    .run();
}

/// Tests the rounding of closing rates of a node that turns about its own middle, far from the eight children it is
/// paired with. The speed from which the allowance is computed is tiny, except for the share of the node's position.
#[test]
fn places() {
    Search {
        name: [
            "ARM_DISTANCE_SHARE of RATE_F32, boxes",
            "ARM_DISTANCE_SHARE of RATE_F32, triangles",
        ],
        draw_configuration: |tape, other| {
            let (far, spin) = (random_power_of_ten(tape, 3.0, 5.0), random_direction(tape));
            let setting = PairConfiguration::new(tape, other).with_relative_distance(far, other);
            let arm = random_direction(tape) * setting.size();
            setting.with_only_other_turning(spin * random_power_of_ten(tape, -3.0, 1.6), arm)
        },
        select_share: |of| of.rate,
        max_looseness: 40.0,
    }
    .run();
}

/// Computes a value with every set of vector instructions, and checks that all results are equal.
fn compute_on_all_instruction_sets<T: PartialEq + std::fmt::Debug>(
    of: impl Fn(fearless_simd::Level) -> T,
) -> T {
    let [best, baseline] =
        [VectorInstructions::Best, VectorInstructions::Baseline].map(|set| of(set.simd_level()));
    assert_eq!(best, baseline);
    best
}

/// Returns the lengths of the cross products of `n` and `spin`.
fn cross_product_lengths(n: [Vec3; LANES], spin: Vec3) -> [f32; LANES] {
    let rows = [0, 1, 2].map(|k| n.map(|n| n[k]));
    compute_on_all_instruction_sets(|level| {
        vectorize!(level, level => {
            *Vec3x8::load(level, &rows).cross(Vec3x8::splat(level, spin)).length()
        })
    })
}

/// Draws eight unit axes and an angular velocity, to which some of the axes are nearly parallel.
fn random_axes_and_spin(tape: &mut RandomCase) -> Option<([DVec3; LANES], DVec3)> {
    let spin = DVec3::from(tape.vector(-20..=5));
    let aside = tape.size(-30..=0);
    let axes = [(); LANES].map(|()| match tape.index_below(2) {
        0 => random_direction(tape),
        // The axis is next to parallel.
        _ => (spin.normalize_or(DVec3::X) + random_direction(tape) * aside).normalize(),
    });
    (spin.length() > 1e-6).then_some((axes, spin))
}

#[test]
fn across_f32() {
    let found = WorstCaseSearch::new("CROSS_PRODUCT_F32", 40_000).search(|tape| {
        let (axes, spin) = random_axes_and_spin(tape)?;
        let lengths = cross_product_lengths(axes.map(DVec3::as_vec3), spin.as_vec3());
        let allowed = f64::from(CROSS_PRODUCT_ERROR_F32) * spin.length();
        let error = |k: usize| axes[k].cross(spin).length() - f64::from(lengths[k]);
        let errors = (0..LANES).map(|k| error_fraction(error(k), allowed));
        Some(errors.fold(f64::NEG_INFINITY, greater))
    });
    found.assert_tight_bound(8.0);
}

/// Measures the relative error of products of two lengths `|n × ω|`, each above half of its upper bound.
#[test]
fn bend_f32() {
    let found = WorstCaseSearch::new("SECOND_DERIVATIVE_FACTOR_F32", 40_000).search(|tape| {
        let (axes, spin) = random_axes_and_spin(tape)?;
        let arms = [(); LANES].map(|()| random_direction(tape));
        let [one, other] =
            [axes, arms].map(|of| cross_product_lengths(of.map(DVec3::as_vec3), spin.as_vec3()));
        let share = |k: usize| {
            let exact = [axes[k], arms[k]].map(|n| n.cross(spin).length());
            let long = exact.iter().all(|&length| length > 0.5 * spin.length());
            let lost = exact[0] * exact[1] - f64::from(one[k] * other[k]);
            let allowed = f64::from(SECOND_DERIVATIVE_FACTOR_F32) - 1.0;
            long.then(|| error_fraction(lost / (exact[0] * exact[1]), allowed))
        };
        let all = (0..LANES).filter_map(share);
        Some(all.fold(f64::NEG_INFINITY, greater)).filter(|share| share.is_finite() || *share > 0.0)
    });
    found.assert_tight_bound(40.0);
}

#[test]
fn clock_f32() {
    let found = WorstCaseSearch::new("FREE_TIME_FACTOR_F32", 40_000).search(|tape| {
        let row = |tape: &mut RandomCase, of: fn(&mut RandomCase) -> f64| {
            [(); LANES].map(|()| of(tape) as f32)
        };
        let apart = row(tape, |tape| tape.size(-30..=30));
        let rate = row(tape, |tape| tape.any_number(-30..=30));
        let second_derivative = row(tape, |tape| tape.size(-30..=30));
        let free = compute_on_all_instruction_sets(|level| {
            free_times(level, &apart, &rate, &second_derivative, LEAST_GAP_F32)
        });
        let shares = (0..LANES)
            .map(|k| free_time_error_share([free[k], apart[k], rate[k], second_derivative[k]]));
        Some(shares.fold(f64::NEG_INFINITY, greater))
    });
    found.assert_tight_bound(16.0);
}

/// Measures by how much a free time uses up more than the whole gap, for gaps just above the least gap. The excess is
/// due to underflow, and is a share of the allowance for the rounding of the free time.
#[test]
fn least_gap_f32() {
    let found = WorstCaseSearch::new("LEAST_GAP_F32", 40_000).search(|tape| {
        let row = |tape: &mut RandomCase, of: fn(&mut RandomCase) -> f64| {
            [(); LANES].map(|()| of(tape) as f32)
        };
        let apart = row(tape, |tape| {
            f64::from(LEAST_GAP_F32.next_up()) * tape.size(0..=40) + tape.size(-120..=-90)
        });
        let rate = row(tape, |tape| tape.any_number(-120..=-30));
        let second_derivative = row(tape, |tape| {
            tape.size(-120..=-30) + f64::from(LEAST_SECOND_DERIVATIVE_F32)
        });
        let free = compute_on_all_instruction_sets(|level| {
            free_times(level, &apart, &rate, &second_derivative, LEAST_GAP_F32)
        });
        let share = |k: usize| {
            let until = if free[k] < 1.0 { free[k] } else { 1.0 };
            let [until, apart, rate, second_derivative] =
                [until, apart[k], rate[k], second_derivative[k]].map(f64::from);
            let used = (rate * until + 0.5 * second_derivative * until * until) / apart;
            // The time at which no gap is left is later by the factor; a curved gap by twice the factor.
            error_fraction(
                used - 1.0 + 2.0 * f64::from(1.0 - FREE_TIME_FACTOR_F32),
                2.0 * f64::from(1.0 - FREE_TIME_FACTOR_F32),
            )
        };
        Some((0..LANES).map(share).fold(f64::NEG_INFINITY, greater))
    });
    found.assert_tight_bound(16.0);
}

/// Tests that the lengths of the shortest vectors that give an axis are as accurate as those of longer vectors.
#[test]
fn least_axis_f32() {
    let found = WorstCaseSearch::new("LEAST_AXIS_F32", 40_000).search(|tape| {
        let v = [(); LANES].map(|()| DVec3::from(tape.vector(-79..=-58)).as_vec3());
        let rows = [0, 1, 2].map(|k| v.map(|v| v[k]));
        let inverse = compute_on_all_instruction_sets(
            |level| vectorize!(level, level => *Vec3x8::load(level, &rows).reciprocal_length()),
        );
        let share = |k: usize| {
            // Only vectors that are used count.
            let off = |inverse: f64| (v[k].as_dvec3().length() * inverse - 1.0).abs();
            error_fraction(off(inverse[k].into()), 4.0 * f64::from(UNIT_ROUNDOFF_F32))
        };
        let used = (0..LANES).filter(|&k| inverse[k] > 0.0);
        assert!(used.clone().all(|k| v[k].length() > LEAST_AXIS_LENGTH_F32));
        Some(used.map(share).fold(0.0, greater))
    });
    found.assert_tight_bound(4.0);
}
