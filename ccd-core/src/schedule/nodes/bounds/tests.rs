//! The planes alone: every gap, rate and time in f32 against f64, along the same axis.

mod setting;

use super::*;
use crate::math::order::{greater, lesser};
use crate::schedule::nodes::axis::Axis;
use crate::schedule::nodes::clock;
use crate::schedule::nodes::eight_pairs::Lane;
use crate::schedule::nodes::turn::Turning;
use crate::schedule::nodes::vector_f32::{dot, length};
use crate::tests::scene::{Pcg64, direction, rng};
use crate::tolerance::{
    ACROSS_F32, ATTACHED_TIME, BEND_F32, CLOCK_F32, LEAST_BEND_F32, MUCH_LARGER,
};
use glam::{DQuat, DVec3, Vec3};
use setting::{Setting, Shape};

/// Some points, and the motion of their body.
struct Solid {
    points: Vec<DVec3>,
    /// The centre of rotation.
    centre: DVec3,
    spin: DVec3,
}

impl Solid {
    /// `max n·x(τ)`, or `min` with a negative sign, at `τ` on.
    fn highest(&self, n: DVec3, tau: f64) -> f64 {
        let turn = DQuat::from_scaled_axis(self.spin * tau);
        let heights = self.points.iter().map(|&x| n.dot(turn * (x - self.centre)));
        heights.fold(f64::NEG_INFINITY, greater) + n.dot(self.centre)
    }

    /// The fastest that a point rises along `n` now, due to turning.
    fn fastest(&self, n: DVec3) -> f64 {
        let m = n.cross(self.spin);
        let rates = self.points.iter().map(|&x| m.dot(x - self.centre));
        rates.fold(f64::NEG_INFINITY, greater)
    }

    /// The largest second derivative along `n` at any time.
    fn bend(&self, n: DVec3) -> f64 {
        let arm = |x: &DVec3| (self.spin.cross(*x - self.centre)).length();
        n.cross(self.spin).length() * self.points.iter().map(arm).fold(0.0, greater)
    }

    fn far(&self) -> f64 {
        let reach = self.points.iter().map(|x| x.length()).fold(0.0, greater);
        (reach + 2.0 * self.centre.length()) * (1.0 + self.spin.length())
    }
}

/// A group and another node, in f32 and in f64; `P` and `C` as in the bounds.
struct Sample<C, P> {
    group: C,
    other: P,
    motion: RelativeMotionF32<Turning, Turning>,
    /// The error of a gap for which the slack allows.
    allowed: f32,
    children: Vec<Solid>,
    far: Solid,
    /// The velocity of the children's centre of rotation relative to the other's.
    velocity: DVec3,
}

/// The largest error among the samples, as a share of its allowance.
#[derive(Debug, Default)]
struct Worst {
    support: f64,
    rate: f64,
    across: f64,
    clock: f64,
    /// The smallest excess of a gap over the kept one at the end of a free time, relative to the
    /// start.
    tightest: f64,
    /// The number of free times of fixed planes, and of turning ones.
    still: usize,
    attached: usize,
}

#[test]
fn planes_hold_and_allowances_suffice_for_boxes() {
    let mut rng = rng(1);
    let mut worst = Worst::new();
    for _ in 0..6_000 {
        let other = Shape::new(&mut rng);
        let sample = Setting::new(&mut rng, &other).boxes(&mut rng, &other);
        sample.audit(&mut rng, &mut worst);
    }
    worst.assert();
}

#[test]
fn planes_hold_and_allowances_suffice_for_triangles() {
    let mut rng = rng(2);
    let mut worst = Worst::new();
    for _ in 0..6_000 {
        let other = Shape::new(&mut rng).triangle();
        let sample = Setting::new(&mut rng, &other).triangles(&mut rng, &other);
        sample.audit(&mut rng, &mut worst);
    }
    worst.assert();
}

impl Worst {
    fn new() -> Self {
        Worst {
            tightest: f64::INFINITY,
            ..Worst::default()
        }
    }

    fn assert(&self) {
        assert!(self.support < 1.0, "{self:?}");
        assert!(self.rate < 1.0, "{self:?}");
        assert!(self.across < 1.0, "{self:?}");
        assert!(self.clock < 1.0, "{self:?}");
        // Samples that are nowhere near the bounds would prove nothing.
        assert!(self.tightest < 0.01, "{self:?}");
        assert!(self.still > 20_000 && self.attached > 2_000, "{self:?}");
    }
}

impl<C: Children, P: OtherNode> Sample<C, P> {
    fn audit(&self, rng: &mut Pcg64, worst: &mut Worst) {
        let pairs = EightPairs::new(&self.group, &self.other, &self.motion);
        let reach = (0..LANES)
            .map(|k| self.group.centre(k).length() + self.group.radius(k))
            .fold(0.0, greater);
        for lane in 0..LANES {
            let pair = pairs.lane(lane);
            let travel = pair.velocity * self.motion.horizon;
            let axes = [
                axis::widest(&self.group, &self.other, lane, pair.way),
                axis::passing(&self.group, &self.other, lane, pair.way, travel),
                self.axis_along(lane, pair.way, direction(rng).as_vec3()),
            ];
            for axis in axes {
                self.sample_allowances(&pair, axis, worst);
                let free = pairs.free(&pair, axis);
                self.check_still(lane, axis, free, worst);
                if reach > MUCH_LARGER * self.other.radius() {
                    let free = pairs.free_with_split(axis);
                    self.check_attached(lane, axis, free, Larger::Split, worst);
                } else if self.other.radius() > MUCH_LARGER * reach {
                    let free = pairs.free_with_other(&pair, axis);
                    self.check_attached(lane, axis, free, Larger::Other, worst);
                }
            }
        }
    }

    fn axis_along(&self, lane: usize, way: Vec3, n: Vec3) -> Axis {
        let n = if dot(n, way) < 0.0 { -n } else { n };
        let (split_reach, other_reach) = (self.group.reach(lane, n), self.other.reach(n));
        Axis {
            n,
            gap: dot(n, way) - split_reach - other_reach,
            split_reach,
            other_reach,
        }
    }

    /// Each rounded quantity against the same in f64.
    fn sample_allowances(&self, pair: &Lane, axis: Axis, worst: &mut Worst) {
        let (motion, n) = (&self.motion, axis.n.as_dvec3());
        let child = &self.children[pair.lane];
        let [m, o] = [motion.split.across(axis.n), motion.other.across(axis.n)];
        let rate =
            dot(axis.n, pair.velocity) + self.group.reach(pair.lane, m) + self.other.reach(o);
        let exact = n.dot(self.velocity) + child.fastest(n) + self.far.fastest(-n);
        let below = exact - f64::from(rate);
        worst.rate = greater(worst.rate, below / f64::from(motion.rate_slack));

        let gap = -self.far.highest(-n, 0.0) - child.highest(n, 0.0);
        let above = f64::from(axis.gap) - gap;
        worst.support = greater(worst.support, above / f64::from(self.allowed));

        for (turning, body) in [(motion.split, child), (motion.other, &self.far)] {
            let across = n.cross(body.spin).length();
            let below = across - f64::from(length(turning.across(axis.n)) * BEND_F32);
            let allowed = f64::from(ACROSS_F32 * turning.rate);
            worst.across = greater(worst.across, below / allowed);
        }

        let apart = axis.gap - motion.slack;
        let bend = (child.bend(n) + self.far.bend(n)) as f32 + LEAST_BEND_F32;
        let free = f64::from(clock::free_time(apart, motion.closed, rate, bend));
        if free > 0.0 && free < 1e30 {
            let [apart, rate, bend] = [apart, rate, bend].map(f64::from);
            let root = (rate * rate + 2.0 * bend * apart).sqrt();
            let exact = match rate > 0.0 {
                true => 2.0 * apart / (rate + root),
                false => (root - rate) / bend,
            };
            let factor = f64::from(CLOCK_F32);
            let above = free / factor / exact - 1.0;
            worst.clock = greater(worst.clock, above / (1.0 - factor));
        }
    }

    /// A fixed plane keeps the pair apart for its whole free time.
    fn check_still(&self, lane: usize, axis: Axis, free: f32, worst: &mut Worst) {
        let n = axis.n.as_dvec3();
        let gap = |tau: f64| {
            let child = self.children[lane].highest(n, tau) + n.dot(self.velocity) * tau;
            (-self.far.highest(-n, tau) - child) / n.length()
        };
        worst.still += usize::from(self.check(lane, free, gap, worst));
    }

    /// A plane that turns with one of the bodies does so too.
    fn check_attached(&self, lane: usize, axis: Axis, free: f32, with: Larger, worst: &mut Worst) {
        assert!(free <= ATTACHED_TIME);
        let child = &self.children[lane];
        let spin = match with {
            Larger::Split => child.spin,
            Larger::Other => self.far.spin,
        };
        let gap = |tau: f64| {
            let n = DQuat::from_scaled_axis(spin * tau) * axis.n.as_dvec3();
            let top = child.highest(n, tau) + n.dot(self.velocity) * tau;
            (-self.far.highest(-n, tau) - top) / n.length()
        };
        worst.attached += usize::from(self.check(lane, free, gap, worst));
    }

    /// Returns whether there was a free time to check.
    fn check(&self, lane: usize, free: f32, gap: impl Fn(f64) -> f64, worst: &mut Worst) -> bool {
        assert!(free >= 0.0, "{:?}", self.motion);
        if free == 0.0 {
            return false;
        }
        let kept = f64::from(self.motion.kept);
        let size = self.children[lane].far() + self.far.far() + self.velocity.length();
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
        let rest = (gap(until) - kept) / (gap(0.0) - kept);
        worst.tightest = lesser(worst.tightest, rest);
        true
    }
}
