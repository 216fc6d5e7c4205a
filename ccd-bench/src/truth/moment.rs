//! Both bodies about an instant: where their points are, how fast, and what rounding leaves open.
//!
//! All is seen from a frame that has B's place and orientation at the instant m, and from then on moves
//! along straight with B's centre but does not turn. There, for |s| ≤ h,
//!
//! - a point p of A is at a(m) + s ȧ(m) to within ½|ω|²ρh², the deviation of a circle from its tangent,
//! - and so is a point of B, with q itself at m.
//!
//! For any fixed direction n, n·(a(m) + s ȧ(m)) is linear in s: over the span it is least at an end. So
//! two sets are apart over the whole span when along one n they are apart at both its ends, by more than
//! `slack`. No direction need be right for that, as long as one is found.

use super::enclosure::{Matrix, Vector, exact};
use super::rounding::{ROUNDED, ROUNDED_UP, UNIT_ROUNDOFF, larger};
use super::surface::{Node, Triangle};
use super::track::Track;
use ccd_core::glam::{DMat3, DVec3};
use ccd_core::order::greater;
use inari::Interval;

/// A stretch of time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Span {
    pub(super) start: f64,
    pub(super) end: f64,
}

/// A and B over a span of time.
#[derive(Clone, Debug)]
pub(super) struct Moment {
    /// A's body frame to the common one.
    place: Affine,
    /// The velocity of A's points, relative to B's centre.
    rate_a: Affine,
    /// The velocity of B's points, relative to B's centre.
    rate_b: Affine,
    /// h: the time to either end of the span.
    half: f64,
    /// What all gaps must exceed: rounding, and what the motion departs from a straight one.
    slack: f64,
    /// How much of it is due to the motion.
    bend: f64,
    /// The same, by boxes along the axes of B, and of A.
    along_b: Extents,
    along_a: Extents,
    /// From B's centre of rotation to A's, and how fast it changes.
    centres: DVec3,
    centres_rate: DVec3,
    /// How far the bodies reach from these centres, together.
    reaches: f64,
}

/// How far a box reaches along the axes of a frame, at most, over the span: `A halfₐ + B half_b`.
#[derive(Clone, Copy, Debug)]
struct Extents {
    a: DMat3,
    b: DMat3,
}

/// What two boxes do over the span.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Boxes {
    /// They stay apart.
    Apart,
    /// They may meet; by how much they move relative to each other.
    Near { travel: f64 },
}

impl Moment {
    pub(super) fn new([a, b]: [&Track; 2], [size_a, size_b]: [f64; 2], span: Span) -> Self {
        let time = span.start.midpoint(span.end);
        let half = greater(time - span.start, span.end - time) * ROUNDED_UP;
        let exactly = Enclosed::new(a, b, time);
        let place = Affine::new(&exactly.place, size_a);
        let rate_a = Affine::new(&exactly.rate_a, size_a);
        let rate_b = Affine::new(&exactly.rate_b, size_b);
        let bend = 0.5 * half * half * (a.acceleration + b.acceleration) * ROUNDED_UP;
        let errors = place.error + half * (rate_a.error + rate_b.error);
        let sizes = place.size + size_b + half * (rate_a.size + rate_b.size);
        let centre = |v: &Vector| DVec3::from_array(v.0.map(Interval::mid));
        let (r, w_a, w_b) = (place.matrix, rate_a.matrix * half, rate_b.matrix * half);
        let back = r.transpose();
        Moment {
            half,
            bend,
            slack: bend * ROUNDED_UP + errors * ROUNDED_UP + ROUNDINGS * UNIT_ROUNDOFF * sizes,
            along_b: Extents {
                a: largest(r, w_a),
                b: largest(DMat3::IDENTITY, w_b),
            },
            along_a: Extents {
                a: largest(back * r, back * w_a),
                b: largest(back, back * w_b),
            },
            place,
            rate_a,
            rate_b,
            centres: centre(&exactly.centres),
            centres_rate: centre(&exactly.velocity),
            reaches: a.reach + b.reach,
        }
    }

    /// Whether the bodies stay apart wherever they turn, since their centres are far from each other.
    pub(super) fn is_far(&self) -> bool {
        let (d, w) = (self.centres, self.half * self.centres_rate);
        // The nearest that 0 comes to the segment d − w, d + w.
        let s = (-d.dot(w) / w.length_squared()).clamp(-1.0, 1.0);
        let nearest = if s.is_nan() { d } else { d + s * w };
        nearest.length() * (1.0 - ROUNDED)
            > (self.reaches + self.slack - self.bend) * ROUNDED_UP
                + ROUNDED * (d.length() + w.length())
    }

    /// Whether two boxes stay apart, by the six directions of their faces.
    pub(super) fn boxes(&self, a: &Node, b: &Node) -> Boxes {
        let apart = self.place.apply(a.centre) - b.centre;
        let moved = self.half * (self.rate_a.apply(a.centre) - self.rate_b.apply(b.centre));
        let gaps_b = self.along_b.gaps(apart, moved, a, b);
        if gaps_b.max_element() > self.slack {
            return Boxes::Apart;
        }
        let gaps_a = self.along_a.gaps(self.back(apart), self.back(moved), a, b);
        if gaps_a.max_element() > self.slack {
            return Boxes::Apart;
        }
        Boxes::Near {
            travel: moved.length() + self.bend,
        }
    }

    /// What two boxes are apart at least, at the instant; of no use for a span.
    pub(super) fn boxes_distance(&self, a: &Node, b: &Node) -> f64 {
        let apart = self.place.apply(a.centre) - b.centre;
        let none = DVec3::ZERO;
        let gaps_b = self.along_b.gaps(apart, none, a, b).max(none);
        let gaps_a = self.along_a.gaps(self.back(apart), none, a, b).max(none);
        let distance = greater(gaps_b.length(), gaps_a.length());
        distance * (1.0 - ROUNDED) - 2.0 * self.slack
    }

    /// The corners of two triangles in the common frame, at both ends of the span.
    pub(super) fn ends(&self, a: &Triangle, b: &Triangle) -> [[Triangle; 2]; 2] {
        let moved_a = a.map(|p| self.half * self.rate_a.apply(p));
        let moved_b = b.map(|q| self.half * self.rate_b.apply(q));
        let a = a.map(|p| self.place.apply(p));
        let at = |end: f64, from: &Triangle, moved: &Triangle| {
            [0, 1, 2].map(|i| from[i] + end * moved[i])
        };
        [-1.0, 1.0].map(|end| [at(end, &a, &moved_a), at(end, b, &moved_b)])
    }

    /// A's triangle in the common frame at the instant.
    pub(super) fn placed(&self, a: &Triangle) -> Triangle {
        a.map(|p| self.place.apply(p))
    }

    /// What a gap computed along a unit direction must exceed to be one.
    pub(super) fn slack(&self) -> f64 {
        self.slack
    }

    fn back(&self, v: DVec3) -> DVec3 {
        self.place.matrix.transpose() * v
    }
}

impl Extents {
    /// By how much two boxes are apart along each axis, at the end of the span where that is less.
    fn gaps(&self, apart: DVec3, moved: DVec3, a: &Node, b: &Node) -> DVec3 {
        apart.abs() - moved.abs() - self.a * a.half - self.b * b.half
    }
}

/// Entry by entry the larger of |m + w| and |m − w|, which is convex in between.
fn largest(m: DMat3, w: DMat3) -> DMat3 {
    let entry = |m: DVec3, w: DVec3| m.abs() + w.abs();
    DMat3::from_cols(
        entry(m.x_axis, w.x_axis),
        entry(m.y_axis, w.y_axis),
        entry(m.z_axis, w.z_axis),
    )
}

/// `p ↦ matrix p + offset`, rounded, and by how much that can be wrong.
#[derive(Clone, Copy, Debug)]
struct Affine {
    matrix: DMat3,
    offset: DVec3,
    /// As a length, for points no farther than the body reaches from its origin.
    error: f64,
    /// The length of the largest image.
    size: f64,
}

impl Affine {
    /// Each coordinate of an image is Σⱼ mⱼpⱼ + o, four roundings deep: off by at most 4u(|m||p| + |o|),
    /// to which the widths of the intervals add √3 rad(m)|p| + rad(o).
    fn new((matrix, offset): &(Matrix, Vector), farthest: f64) -> Self {
        let rows = matrix
            .0
            .map(|row| DVec3::from_array(row.map(Interval::mid)));
        let entries = matrix.0.iter().flatten();
        let width = entries.fold(0.0, |width, entry| larger(width, entry.rad()));
        let offset_width = offset.0.iter().fold(0.0, |w, x| larger(w, x.rad()));
        let offset = DVec3::from_array(offset.0.map(Interval::mid));
        let row = rows
            .iter()
            .fold(0.0, |longest: f64, row| larger(longest, row.length()));
        let coordinate = row * farthest + offset.length();
        let widths = width * SQRT_3 * farthest + offset_width;
        Affine {
            matrix: DMat3::from_cols(rows[0], rows[1], rows[2]).transpose(),
            offset,
            error: SQRT_3 * (widths + 5.0 * UNIT_ROUNDOFF * coordinate) * ROUNDED_UP,
            size: SQRT_3 * coordinate * ROUNDED_UP,
        }
    }

    fn apply(&self, p: DVec3) -> DVec3 {
        self.matrix * p + self.offset
    }
}

/// What the affine maps are, to within intervals.
pub(super) struct Enclosed {
    pub(super) place: (Matrix, Vector),
    rate_a: (Matrix, Vector),
    rate_b: (Matrix, Vector),
    centres: Vector,
    velocity: Vector,
}

impl Enclosed {
    pub(super) fn new(a: &Track, b: &Track, time: f64) -> Self {
        let (at_a, at_b) = (a.at(time), b.at(time));
        let back = at_b.rotation.transpose();
        let rotation = &back * &at_a.rotation;
        let centres = &back * &(at_a.centre - at_b.centre);
        // a = R (p − c_a) + (C_a − C_b) + c_b
        let offset = centres - &rotation * &a.centre + b.centre;
        let velocity = &back * &(a.velocity - b.velocity);
        // ȧ = v + ω_a × R (p − c_a), ḃ = ω_b × (q − c_b); the constant of B goes to A's side.
        let swirl_a = &(&back * &a.spin).cross_matrix() * &rotation;
        let swirl_b = (&back * &b.spin).cross_matrix();
        let drift = velocity - &swirl_a * &a.centre + &swirl_b * &b.centre;
        Enclosed {
            place: (rotation, offset),
            rate_a: (swirl_a, drift),
            rate_b: (swirl_b, Vector([exact(0.0); 3])),
            centres,
            velocity,
        }
    }
}

/// How often, at most, a gap is rounded relative to the sizes that enter it: the sum of position and
/// motion (3), the dot product with n (3 products and 2 sums: 3 deep), its difference (1), for each of A
/// and B; n itself, of length 1 to 4 roundings; for boxes √3 times the 4 roundings of an extent on each
/// side and twice as much along A's axes, which are rounded themselves. Doubled.
const ROUNDINGS: f64 = 96.0;
/// √3, rounded up.
const SQRT_3: f64 = 1.732_050_807_568_878;
