//! Compares every gap, rate and free time in f32 with its value in f64 along the same axis.

mod setting;
mod shares;
mod splits;
mod worst;

use super::*;
use crate::body::tree::LANES;
use crate::engine::nodes::axis::{self, AxesX8};
use crate::engine::nodes::clock;
use crate::math::order::{greater, lesser};
use crate::math::simd::{Vec3x8, load};
use crate::settings::VectorInstructions;
use crate::tests::scene::{Pcg64, RngExt, random_direction, rng};
use crate::tuning::{MAX_TURNING_PLANE_TIME, MIN_TURNING_PLANE_RADIUS_RATIO};
use crate::vectorize;
use fearless_simd::Level;
use glam::{DQuat, DVec3, Vec3};
use setting::{PairConfiguration, Shape};

/// A rigid set of points that turns about a center.
struct Solid {
    points: Vec<DVec3>,
    /// The position of the center of rotation.
    center: DVec3,
    spin: DVec3,
}

impl Solid {
    /// Returns the largest height of a point along `n` after `tau`.
    fn max_height(&self, n: DVec3, tau: f64) -> f64 {
        let turn = DQuat::from_scaled_axis(self.spin * tau);
        let heights = self.points.iter().map(|&x| n.dot(turn * (x - self.center)));
        heights.fold(f64::NEG_INFINITY, greater) + n.dot(self.center)
    }

    /// Returns the greatest present rate at which a point rises along `n` by rotation.
    fn max_rotational_rate(&self, n: DVec3) -> f64 {
        let m = n.cross(self.spin);
        let rates = self.points.iter().map(|&x| m.dot(x - self.center));
        rates.fold(f64::NEG_INFINITY, greater)
    }

    /// Returns an upper bound of the second derivative of the points' heights along `n`, at any time.
    fn second_derivative_bound(&self, n: DVec3) -> f64 {
        let arm = |x: &DVec3| (self.spin.cross(*x - self.center)).length();
        n.cross(self.spin).length() * self.points.iter().map(arm).fold(0.0, greater)
    }

    fn coordinate_scale(&self) -> f64 {
        let reach = self.points.iter().map(|x| x.length()).fold(0.0, greater);
        (reach + 2.0 * self.center.length()) * (1.0 + self.spin.length())
    }
}

/// A group of children and the other node: in f32, as the bounds take them, and as sets of points in f64. `C` and `P`
/// are the types of the group and of the other node.
struct EightPairSample<C, P> {
    group: C,
    other_node: P,
    motion: RelativeMotionF32,
    /// The gap to keep, which is the slack minus the rounding of a gap.
    kept_gap: f64,
    /// The part of the slack that allows for the rounding error of a gap.
    allowed_gap_error: f32,
    children: Vec<Solid>,
    other_node_solid: Solid,
    /// The velocity of the children's center of rotation relative to the other node's.
    velocity: DVec3,
    acceleration: DVec3,
}

/// The largest errors among the samples, as shares of their allowances.
#[derive(Debug, Default)]
struct WorstErrorShares {
    gap: f64,
    rate: f64,
    cross_product: f64,
    clock: f64,
    /// The smallest excess of a gap over the gap to keep at the end of a free time, as a share of the excess at its
    /// start.
    min_relative_excess: f64,
    /// The number of positive free times of fixed planes.
    fixed_plane_time_count: usize,
    turning_plane_time_count: usize,
    /// The number of free times of bodies that accelerate.
    accelerating_time_count: usize,
    unbounded_free_time_count: usize,
}

#[test]
fn planes_hold_and_allowances_suffice_for_boxes() {
    let mut rng = rng(1);
    let mut worst = WorstErrorShares::new();
    for _ in 0..6_000 {
        let other = Shape::new(&mut rng);
        let sample = PairConfiguration::new(&mut rng, &other).box_sample(&mut rng, &other);
        sample.check_random_axes(&mut rng, &mut worst);
    }
    worst.assert_within_allowances();
}

#[test]
fn planes_hold_and_allowances_suffice_for_triangles() {
    let mut rng = rng(2);
    let mut worst = WorstErrorShares::new();
    for _ in 0..6_000 {
        let other = Shape::new(&mut rng).triangle();
        let sample = PairConfiguration::new(&mut rng, &other).triangle_sample(&mut rng, &other);
        sample.check_random_axes(&mut rng, &mut worst);
    }
    worst.assert_within_allowances();
}

/// The values that the bounds compute along one axis, one number for each child.
#[derive(Clone, Copy, Debug)]
struct AxisValues {
    axis: [[f32; LANES]; 3],
    gap: [f32; LANES],
    rate: [f32; LANES],
    /// The lengths of `n × ω` for the split body and the other body.
    cross_product_lengths: [[f32; LANES]; 2],
    /// The free times of planes that are fixed, turn with the split body, or turn with the other body.
    free_times: [[f32; LANES]; 3],
}

impl AxisValues {
    fn normal(&self, lane: usize) -> DVec3 {
        DVec3::from_array(self.axis.map(|row| row[lane].into()))
    }

    /// Returns all values for comparison, with `None` for NaN, so that NaN values compare equal.
    fn comparable_values(&self) -> Vec<Option<f32>> {
        let rows = [
            &self.axis[..],
            &self.free_times,
            &self.cross_product_lengths,
            &[self.gap, self.rate],
        ];
        let all = rows.concat().concat();
        all.into_iter()
            .map(|x| (!x.is_nan()).then_some(x))
            .collect()
    }
}

impl WorstErrorShares {
    fn new() -> Self {
        WorstErrorShares {
            min_relative_excess: f64::INFINITY,
            ..WorstErrorShares::default()
        }
    }

    fn assert_within_allowances(&self) {
        assert!(self.gap < 1.0, "{self:?}");
        assert!(self.rate < 1.0, "{self:?}");
        assert!(self.cross_product < 1.0, "{self:?}");
        assert!(self.clock < 1.0, "{self:?}");
        // Samples that come nowhere near the bounds would prove nothing.
        assert!(self.min_relative_excess < 0.01, "{self:?}");
        assert!(
            self.fixed_plane_time_count > 20_000 && self.turning_plane_time_count > 2_000,
            "{self:?}"
        );
        assert!(
            self.accelerating_time_count > 5_000 && self.unbounded_free_time_count > 500,
            "{self:?}"
        );
    }
}

/// Computes the values along three axes: the two that the bounds try, and the axis `some`.
///
/// Nothing is inlined: in one function without vectors, the compiler would take minutes.
fn values_along_three_axes<L: Simd, C: Children, P: OtherNode>(
    level: L,
    sample: &EightPairSample<C, P>,
    some: Vec3,
) -> [AxisValues; 3] {
    let pairs = sample.pairs(level);
    let some = axis::OrientedAxes::new(Vec3x8::splat(level, some), pairs.offset).n;
    let axes = [
        slowest_closing_axis(&pairs),
        closest_approach_axis(&pairs),
        axis::unit_axes_and_gaps(pairs.children, pairs.other_node, pairs.offset, some),
    ];
    axes.map(|axis| values_along_axis(&pairs, axis))
}

type Pairs<'a, L, C, P> = EightPairs<'a, L, C, P>;

#[inline(never)]
fn slowest_closing_axis<L: Simd, C: Children, P: OtherNode>(
    pairs: &Pairs<'_, L, C, P>,
) -> AxesX8<L> {
    axis::slowest_closing_axis(
        pairs.children,
        pairs.other_node,
        pairs.offset,
        pairs.velocity,
        pairs.motion.required_gap,
    )
}

#[inline(never)]
fn closest_approach_axis<L: Simd, C: Children, P: OtherNode>(
    pairs: &Pairs<'_, L, C, P>,
) -> AxesX8<L> {
    axis::closest_approach_axis(
        pairs.children,
        pairs.other_node,
        pairs.offset,
        pairs.velocity,
        pairs.motion.remaining_time,
    )
}

#[inline(never)]
fn values_along_axis<L: Simd, C: Children, P: OtherNode>(
    pairs: &Pairs<'_, L, C, P>,
    axis: AxesX8<L>,
) -> AxisValues {
    let motion = pairs.motion;
    let (m, o) = (
        motion.split_body_rotation.cross_angular_velocity(axis.n),
        motion.other_rotation.cross_angular_velocity(axis.n),
    );
    let rate = axis.n.dot(pairs.velocity)
        + pairs.children.extent_along(m)
        + pairs.other_node.extent_along(o);
    AxisValues {
        axis: [*axis.n.x, *axis.n.y, *axis.n.z],
        gap: *axis.across.gap,
        rate: *rate,
        cross_product_lengths: [*m.length(), *o.length()],
        free_times: [
            fixed_plane_times(pairs, axis),
            free_times_turning_with_split_body(pairs, axis),
            free_times_turning_with_other_body(pairs, axis),
        ],
    }
}

#[inline(never)]
fn fixed_plane_times<L: Simd, C: Children, P: OtherNode>(
    pairs: &Pairs<'_, L, C, P>,
    axis: AxesX8<L>,
) -> [f32; LANES] {
    *pairs.fixed_plane_free_times(axis)
}

#[inline(never)]
fn free_times_turning_with_split_body<L: Simd, C: Children, P: OtherNode>(
    pairs: &Pairs<'_, L, C, P>,
    axis: AxesX8<L>,
) -> [f32; LANES] {
    *pairs.free_times_turning_with_split_body(axis)
}

#[inline(never)]
fn free_times_turning_with_other_body<L: Simd, C: Children, P: OtherNode>(
    pairs: &Pairs<'_, L, C, P>,
    axis: AxesX8<L>,
) -> [f32; LANES] {
    *pairs.free_times_of_planes_turning_with_other(axis)
}

/// Returns the [free times](clock::free_time) of eight pairs with these gaps, rates and second derivatives.
fn free_times(
    level: Level,
    aparts: &[f32; LANES],
    rates: &[f32; LANES],
    second_derivatives: &[f32; LANES],
    closed: f32,
) -> [f32; LANES] {
    vectorize!(level, level => {
        let [apart, rate, second_derivative] = [load(level, aparts), load(level, rates), load(level, second_derivatives)];
        *clock::free_time(apart, closed, rate, second_derivative)
    })
}

impl<C: Children, P: OtherNode> EightPairSample<C, P> {
    #[inline(never)]
    fn pairs<L: Simd>(&self, level: L) -> Pairs<'_, L, C, P> {
        EightPairs::new(level, &self.group, &self.other_node, &self.motion)
    }

    fn check_random_axes(&self, rng: &mut Pcg64, worst: &mut WorstErrorShares) {
        // Axes may have any length.
        let some = random_direction(rng).as_vec3() * 2f32.powi(rng.random_range(-40..40));
        let found = self.cross_checked_axis_values(some);
        let reach = vectorize!(VectorInstructions::Best.simd_level(), level => {
            *(self.group.center(level).length() + self.group.radius(level))
        });
        let reach = reach.into_iter().fold(0.0, greater);
        for found in &found {
            self.record_errors(found, worst);
            self.check_fixed_plane(found, worst);
            if reach > MIN_TURNING_PLANE_RADIUS_RATIO * self.other_node.radius() {
                self.check_turning_plane(found, LargerBody::BodyToSplit, worst);
            } else if self.other_node.radius() > MIN_TURNING_PLANE_RADIUS_RATIO * reach {
                self.check_turning_plane(found, LargerBody::OtherBody, worst);
            }
        }
    }

    /// Computes the values with all sets of vector instructions, and checks that they are equal.
    fn cross_checked_axis_values(&self, some: Vec3) -> [AxisValues; 3] {
        let [best, baseline] = [VectorInstructions::Best, VectorInstructions::Baseline]
            .map(|instructions| vectorize!(instructions.simd_level(), level => values_along_three_axes(level, self, some)));
        for (best, baseline) in best.iter().zip(&baseline) {
            assert_eq!(
                best.comparable_values(),
                baseline.comparable_values(),
                "{:?}",
                self.motion
            );
        }
        best
    }

    /// Compares each value in f32 with its value in f64, and records the largest errors in `worst`.
    fn record_errors(&self, found: &AxisValues, worst: &mut WorstErrorShares) {
        let frees = self.axis_free_times(found);
        for lane in 0..self.children.len() {
            let of = self.error_shares(found, &frees, lane);
            worst.gap = greater(worst.gap, of.gap);
            worst.rate = greater(worst.rate, of.rate);
            worst.cross_product = greater(worst.cross_product, of.cross_product);
            worst.clock = greater(worst.clock, of.clock);
        }
    }

    fn displacement(&self, tau: f64) -> DVec3 {
        (self.velocity + self.acceleration * (0.5 * tau)) * tau
    }

    /// Checks that a fixed plane keeps the pair apart for its whole free time.
    fn check_fixed_plane(&self, found: &AxisValues, worst: &mut WorstErrorShares) {
        let [free, ..] = found.free_times;
        for (lane, free) in free.into_iter().enumerate() {
            let n = found.normal(lane);
            let gap = |tau: f64| {
                let child = self.children[lane].max_height(n, tau) + n.dot(self.displacement(tau));
                (-self.other_node_solid.max_height(-n, tau) - child) / n.length()
            };
            worst.fixed_plane_time_count +=
                usize::from(self.check_gap_is_kept(lane, free, gap, worst));
        }
    }

    /// Checks that a plane that turns with a body keeps the pair apart for its whole free time.
    fn check_turning_plane(
        &self,
        found: &AxisValues,
        with: LargerBody,
        worst: &mut WorstErrorShares,
    ) {
        let [_, with_split, with_other] = found.free_times;
        let free = match with {
            LargerBody::BodyToSplit => with_split,
            LargerBody::OtherBody => with_other,
        };
        for (lane, child) in self.children.iter().enumerate() {
            assert!(free[lane] <= MAX_TURNING_PLANE_TIME);
            let spin = match with {
                LargerBody::BodyToSplit => child.spin,
                LargerBody::OtherBody => self.other_node_solid.spin,
            };
            let gap = |tau: f64| {
                let n = DQuat::from_scaled_axis(spin * tau) * found.normal(lane);
                let top = child.max_height(n, tau) + n.dot(self.displacement(tau));
                (-self.other_node_solid.max_height(-n, tau) - top) / n.length()
            };
            worst.turning_plane_time_count +=
                usize::from(self.check_gap_is_kept(lane, free[lane], gap, worst));
        }
    }

    /// Checks at sampled times that a gap is kept for a free time, and returns whether the free time is positive.
    fn check_gap_is_kept(
        &self,
        lane: usize,
        free: f32,
        gap: impl Fn(f64) -> f64,
        worst: &mut WorstErrorShares,
    ) -> bool {
        assert!(free >= 0.0, "{:?}", self.motion);
        if free == 0.0 {
            return false;
        }
        let kept = self.kept_gap;
        let travel = self.velocity.length() + self.acceleration.length();
        let size = self.children[lane].coordinate_scale()
            + self.other_node_solid.coordinate_scale()
            + travel;
        let until = lesser(1.0, f64::from(free));
        for k in 0..=16 {
            let tau = until * f64::from(k) / 16.0;
            let found = gap(tau);
            assert!(
                found >= kept - 1e-14 * size,
                "{found:e} at {tau:e} of {free:e}, {kept:e} promised; {:?}",
                self.motion,
            );
        }
        worst.accelerating_time_count += usize::from(self.motion.acceleration.is_some());
        worst.unbounded_free_time_count += usize::from(free == f32::INFINITY);
        let rest = (gap(until) - kept) / (gap(0.0) - kept);
        worst.min_relative_excess = lesser(worst.min_relative_excess, rest);
        true
    }
}
