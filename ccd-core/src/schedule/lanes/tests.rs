//! The planes themselves: every gap, rate and time in f32 against f64, along the very same axis.

use super::axis::Axis;
use super::*;
use crate::tests::scene::{Pcg64, RngExt, direction, magnitude, rng, rotation, within};
use crate::tolerance::{
    ATTACHED_TIME, CLOCK_F32, LEAST_GAP_F32, MUCH_LARGER, PLACES_F32, RATE_F32, REACH_F32, WAY_F32,
};
use crate::tree::{Below, BoxGroup, Node, TriangleGroup, unit_normal, up};
use glam::{DMat3, DQuat, DVec3};

/// Some points, and the body they belong to.
struct Solid {
    points: Vec<DVec3>,
    /// What it turns about, and how fast.
    centre: DVec3,
    spin: DVec3,
}

impl Solid {
    /// `max n·x(τ)`, or `min` with a negative sign, at `τ` on.
    fn highest(&self, n: DVec3, tau: f64) -> f64 {
        let turn = DQuat::from_scaled_axis(self.spin * tau);
        let heights = self.points.iter().map(|&x| n.dot(turn * (x - self.centre)));
        heights.fold(f64::NEG_INFINITY, f64::max) + n.dot(self.centre)
    }

    /// The fastest that a point rises along `n` now, due to turning.
    fn fastest(&self, n: DVec3) -> f64 {
        let m = n.cross(self.spin);
        let rates = self.points.iter().map(|&x| m.dot(x - self.centre));
        rates.fold(f64::NEG_INFINITY, f64::max)
    }

    /// The largest second derivative along `n` at any time.
    fn bend(&self, n: DVec3) -> f64 {
        let arm = |x: &DVec3| (self.spin.cross(*x - self.centre)).length();
        n.cross(self.spin).length() * self.points.iter().map(arm).fold(0.0, f64::max)
    }

    fn far(&self) -> f64 {
        let reach = self.points.iter().map(|x| x.length()).fold(0.0, f64::max);
        (reach + 2.0 * self.centre.length()) * (1.0 + self.spin.length())
    }
}

/// A group and another node, in f32 and in f64; `P` and `C` as in the bounds.
struct Meeting<C, P> {
    group: C,
    other: P,
    closing: Closing<Turning, Turning>,
    /// What rounding may do to a gap, as far as the slack allows for it.
    allowed: f32,
    children: Vec<Solid>,
    far: Solid,
    /// Of the children's centre of rotation relative to the other's.
    velocity: DVec3,
}

/// What the samples came to: the largest error found, as a share of what is allowed for.
#[derive(Debug, Default)]
struct Worst {
    support: f64,
    rate: f64,
    across: f64,
    clock: f64,
    /// By how much a gap at the end of a free time exceeds what is kept, relative to the start.
    tightest: f64,
    /// How many free times of planes that stand still, and of such that turn.
    still: usize,
    attached: usize,
}

#[test]
fn planes_hold_and_allowances_suffice_for_boxes() {
    let mut rng = rng(1);
    let mut worst = Worst::new();
    for _ in 0..6_000 {
        let other = Shape::new(&mut rng).boxed();
        let meeting = Setting::new(&mut rng, &other).boxes(&mut rng, &other);
        meeting.audit(&mut rng, &mut worst);
    }
    worst.assert();
}

#[test]
fn planes_hold_and_allowances_suffice_for_triangles() {
    let mut rng = rng(2);
    let mut worst = Worst::new();
    for _ in 0..6_000 {
        let other = Shape::new(&mut rng).triangle();
        let meeting = Setting::new(&mut rng, &other).triangles(&mut rng, &other);
        meeting.audit(&mut rng, &mut worst);
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
        // Samples that come nowhere near the bounds would not tell.
        assert!(self.tightest < 0.01, "{self:?}");
        assert!(self.still > 20_000 && self.attached > 2_000, "{self:?}");
    }
}

impl<C: Children, P: Other> Meeting<C, P> {
    fn audit(&self, rng: &mut Pcg64, worst: &mut Worst) {
        let pairing = Pairing::new(&self.group, &self.other, &self.closing);
        let reach = (0..LANES)
            .map(|k| self.group.centre(k).length() + self.group.radius(k))
            .fold(0.0, f32::max);
        for lane in 0..LANES {
            let pair = pairing.lane(lane);
            let travel = pair.velocity * self.closing.horizon;
            let axes = [
                axis::widest(&self.group, &self.other, lane, pair.way),
                axis::passing(&self.group, &self.other, lane, pair.way, travel),
                self.axis_along(lane, pair.way, direction(rng).as_vec3()),
            ];
            for axis in axes {
                self.sample_allowances(&pair, axis, worst);
                let free = pairing.free(&pair, axis);
                self.check_still(lane, axis, free, worst);
                if reach > MUCH_LARGER * self.other.radius() {
                    let free = pairing.free_with_split(axis);
                    self.check_attached(lane, axis, free, Larger::Split, worst);
                } else if self.other.radius() > MUCH_LARGER * reach {
                    let free = pairing.free_with_other(&pair, axis);
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
        let (closing, n) = (&self.closing, axis.n.as_dvec3());
        let child = &self.children[pair.lane];
        let [m, o] = [closing.split.across(axis.n), closing.other.across(axis.n)];
        let rate =
            dot(axis.n, pair.velocity) + self.group.reach(pair.lane, m) + self.other.reach(o);
        let exact = n.dot(self.velocity) + child.fastest(n) + self.far.fastest(-n);
        let below = exact - f64::from(rate);
        worst.rate = worst.rate.max(below / f64::from(closing.rate_slack));

        let gap = -self.far.highest(-n, 0.0) - child.highest(n, 0.0);
        let above = f64::from(axis.gap) - gap;
        worst.support = worst.support.max(above / f64::from(self.allowed));

        for (turning, body) in [(closing.split, child), (closing.other, &self.far)] {
            let across = n.cross(body.spin).length();
            let below = across - f64::from(length(turning.across(axis.n)) * BEND_F32);
            let allowed = f64::from(ACROSS_F32 * turning.rate);
            worst.across = worst.across.max(below / allowed);
        }

        let apart = axis.gap - closing.slack;
        let bend = (child.bend(n) + self.far.bend(n)) as f32 + LEAST_BEND_F32;
        let free = f64::from(clock::free_time(apart, closing.closed, rate, bend));
        if free > 0.0 && free < 1e30 {
            let [apart, rate, bend] = [apart, rate, bend].map(f64::from);
            let root = (rate * rate + 2.0 * bend * apart).sqrt();
            let exact = match rate > 0.0 {
                true => 2.0 * apart / (rate + root),
                false => (root - rate) / bend,
            };
            let factor = f64::from(CLOCK_F32);
            let above = free / factor / exact - 1.0;
            worst.clock = worst.clock.max(above / (1.0 - factor));
        }
    }

    /// A plane that stands still keeps the pair apart for as long as it says.
    fn check_still(&self, lane: usize, axis: Axis, free: f32, worst: &mut Worst) {
        let n = axis.n.as_dvec3();
        let gap = |tau: f64| {
            let child = self.children[lane].highest(n, tau) + n.dot(self.velocity) * tau;
            (-self.far.highest(-n, tau) - child) / n.length()
        };
        worst.still += usize::from(self.check(lane, free, gap, worst));
    }

    /// So does a plane that turns with one of the bodies.
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

    /// Whether there was a free time to check.
    fn check(&self, lane: usize, free: f32, gap: impl Fn(f64) -> f64, worst: &mut Worst) -> bool {
        if !(free > 0.0) {
            return false;
        }
        let kept = f64::from(self.closing.kept);
        let size = self.children[lane].far() + self.far.far() + self.velocity.length();
        let until = f64::from(free).min(1.0);
        for k in 0..=16 {
            let tau = until * f64::from(k) / 16.0;
            let found = gap(tau);
            assert!(
                found >= kept - 1e-14 * size,
                "{found:e} at {tau:e} of {free:e}, {kept:e} promised; {:?}",
                self.closing,
            );
        }
        let rest = (gap(until) - kept) / (gap(0.0) - kept);
        worst.tightest = worst.tightest.min(rest);
        true
    }
}

/// The points of a node in its body's frame.
struct Shape {
    points: Vec<DVec3>,
    node: Node,
}

impl Shape {
    /// A box of any proportions, or a needle, or next to nothing.
    fn new(rng: &mut Pcg64) -> Self {
        let size = magnitude(rng, -4.0, 4.0);
        Shape::of_size(rng, size, DVec3::ZERO)
    }

    fn of_size(rng: &mut Pcg64, size: f64, centre: DVec3) -> Self {
        let frame = DMat3::from_quat(rotation(rng));
        let mut ratio = || match rng.random_range(0..3) {
            0 => 1e-7,
            _ => rng.random_range(0.1..1.0),
        };
        let half = size * DVec3::new(1.0, ratio(), ratio());
        let corner = |k: usize| {
            let sign = |bit: usize| if k >> bit & 1 == 1 { 1.0 } else { -1.0 };
            centre + frame * (half * DVec3::new(sign(0), sign(1), sign(2)))
        };
        let points: Vec<DVec3> = (0..8).map(corner).collect();
        let axes = [frame.x_axis, frame.y_axis, frame.z_axis].map(DVec3::as_vec3);
        let farthest = |measure: &dyn Fn(DVec3) -> f64| {
            up(points
                .iter()
                .map(|&p| measure(p - centre))
                .fold(0.0, f64::max))
            .next_up()
        };
        let node = Node {
            centre,
            axes,
            half: axes.map(|u| farthest(&|way| way.dot(u.as_dvec3()).abs())),
            radius: farthest(&DVec3::length),
            below: Below::Boxes(0),
        };
        Shape { points, node }
    }

    fn boxed(self) -> Self {
        self
    }

    /// Three corners of it; the node stays about them.
    fn triangle(mut self) -> Self {
        self.points.truncate(3);
        let mean = (self.points[0] + self.points[1] + self.points[2]) / 3.0;
        for point in &mut self.points {
            *point -= mean;
        }
        self
    }
}

/// Where the other node is, and how both bodies move.
struct Setting {
    /// Takes the other body's frame to the split one's.
    turn: DMat3,
    place: DVec3,
    /// The children's size, and where the group is in the split body's frame.
    size: f64,
    origin: DVec3,
    velocity: DVec3,
    spins: [DVec3; 2],
    centres: [DVec3; 2],
}

impl Setting {
    fn new(rng: &mut Pcg64, other: &Shape) -> Self {
        let radius = f64::from(other.node.radius);
        let size = radius * magnitude(rng, -3.0, 3.0);
        let far = (radius + size) * rng.random_range(0.5..4.0);
        let place = direction(rng) * far;
        let spin = |rng: &mut Pcg64| match rng.random_bool(0.7) {
            true => direction(rng) * magnitude(rng, -3.0, 1.6),
            false => DVec3::ZERO,
        };
        let centre = |rng: &mut Pcg64, at: DVec3, size: f64| {
            let reach = size * magnitude(rng, -1.0, 4.0);
            match rng.random_bool(0.3) {
                true => at,
                false => at + within(rng, reach),
            }
        };
        let fast = far * magnitude(rng, -3.0, 2.0);
        let offset = size * magnitude(rng, 0.0, 6.0);
        Setting {
            turn: DMat3::from_quat(rotation(rng)),
            place,
            size,
            origin: within(rng, offset),
            velocity: match rng.random_bool(0.8) {
                true => direction(rng) * fast,
                false => DVec3::ZERO,
            },
            spins: [spin(rng), spin(rng)],
            centres: [centre(rng, DVec3::ZERO, size), centre(rng, place, radius)],
        }
    }

    fn child(&self, points: &[DVec3]) -> Solid {
        Solid {
            points: points.iter().map(|&p| p - self.origin).collect(),
            centre: self.centres[0],
            spin: self.spins[0],
        }
    }

    fn far(&self, other: &Shape) -> Solid {
        Solid {
            points: other
                .points
                .iter()
                .map(|&p| self.turn * p + self.place)
                .collect(),
            centre: self.centres[1],
            spin: self.spins[1],
        }
    }

    fn child_shape(&self, rng: &mut Pcg64) -> Shape {
        let size = self.size * magnitude(rng, -2.0, 0.0);
        let centre = self.origin + within(rng, self.size);
        Shape::of_size(rng, size, centre)
    }

    fn boxes(&self, rng: &mut Pcg64, other: &Shape) -> Meeting<BoxGroup, OtherBox> {
        let shapes: Vec<Shape> = (0..LANES).map(|_| self.child_shape(rng)).collect();
        let nodes: Vec<Node> = shapes.iter().map(|s| s.node.clone()).collect();
        let group = BoxGroup::new(&nodes, 0, self.origin);
        let children = shapes.iter().map(|s| self.child(&s.points)).collect();
        let [x, y, z] = [self.turn.x_axis, self.turn.y_axis, self.turn.z_axis].map(DVec3::as_vec3);
        let node = &other.node;
        let boxed = OtherBox {
            centre: (self.turn * node.centre + self.place).as_vec3(),
            axes: node.axes.map(|u| x * u.x + y * u.y + z * u.z),
            half: node.half,
            radius: node.radius,
        };
        let reach = group.members.reach;
        self.meeting(group, boxed, reach, children, self.far(other))
    }

    fn triangles(&self, rng: &mut Pcg64, other: &Shape) -> Meeting<TriangleGroup, OtherTriangle> {
        let shapes: Vec<Shape> = (0..LANES).map(|_| self.child_shape(rng)).collect();
        let corners: Vec<[DVec3; 3]> = shapes
            .iter()
            .map(|s| [s.points[0], s.points[1], s.points[6]])
            .collect();
        let group = TriangleGroup::new(&corners, 0, self.origin);
        let children = corners.iter().map(|t| self.child(t)).collect();
        let far = self.far(other);
        let [a, b, c] = [far.points[0], far.points[1], far.points[2]];
        let centre = (a + b + c) / 3.0;
        let arms = [a - centre, b - centre, c - centre];
        let triangle = OtherTriangle {
            centre: centre.as_vec3(),
            corners: arms.map(DVec3::as_vec3),
            normal: unit_normal([a, b, c]),
            radius: up(arms.map(DVec3::length).into_iter().fold(0.0, f64::max)).next_up(),
        };
        let reach = group.members.reach;
        self.meeting(group, triangle, reach, children, far)
    }

    /// The allowances as an expansion makes them.
    fn meeting<C, P: Other>(
        &self,
        group: C,
        other: P,
        reach: f32,
        children: Vec<Solid>,
        far: Solid,
    ) -> Meeting<C, P> {
        let turning = |k: usize| Turning {
            spin: self.spins[k].as_vec3(),
            rate: up(self.spins[k].length()),
            centre: self.centres[k].as_vec3(),
        };
        let (split, turning_far) = (turning(0), turning(1));
        let velocity = self.velocity.as_vec3();
        let [x, y, z] = other.centre().abs().to_array();
        let allowed = WAY_F32 * (x + y + z) + REACH_F32 * (other.radius() + reach);
        let places = other.centre().length() + turning_far.arm(Vec3::ZERO);
        let far_arm = turning_far.arm(other.centre()) + PLACES_F32 * places;
        let speed = velocity.length()
            + split.rate * (reach + split.arm(Vec3::ZERO))
            + turning_far.rate * (other.radius() + far_arm);
        let kept = 1e-3 * other.radius();
        Meeting {
            closing: Closing {
                velocity,
                split,
                other: turning_far,
                horizon: 1.0,
                slack: (kept + allowed).next_up(),
                kept,
                closed: LEAST_GAP_F32,
                rate_slack: RATE_F32 * speed,
            },
            group,
            other,
            allowed,
            children,
            far,
            velocity: self.velocity,
        }
    }
}
