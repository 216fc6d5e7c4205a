//! A spherical quadrangle `[SHOEMAKE87]`, and bounds on its derivatives.
//!
//! With `p(u)` and `r(u)` at constant rates on the unit sphere of quaternions, and `h = 2u (1 − u)`, it is
//! `σ = slerp(p, r, h) = E p + g d`, where `d = r − p`, `Ω` is the angle between `p` and `r`, and
//!
//! `E = cos((½ − h) Ω) / cos(½ Ω)`, `g = sin(h Ω) / sin Ω`.
//!
//! The angular velocity is twice the vector part of `σ' σ*`, the angular acceleration that of `σ'' σ*`. Parts
//! along `σ` do not count. As `p = (σ − g d)/E` and `E ≥ 1`, parts along `p` count by `g |d|`:
//!
//! `|ω| ≤ 2 (|E'| g|d| + E|p'| + |g'||d| + g|d'|)`
//!
//! `|ω̇| ≤ 2 (|E''| g|d| + 2|E'||p'| + |p'|² g|d| + |g''||d| + 2|g'||d'| + g|d''|)`
//!
//! Both functions depend on `h` and on `z = sin²(½ Ω) = ¼|d|²`, with `|z'| ≤ ½|d||d'|` and
//! `|z''| ≤ ½(|d'|² + |d||d''|)`; `|d'| ≤ |p'| + |r'|`, `|d''| ≤ |p'|² + |r'|²`. With `x = ½ Ω`, and for `h` from 0
//! to ½:
//! - `|E_h| ≤ 2x²/cos x`, `|E_hh| ≤ 4x²/cos x`, and as `cos(κx)/cos x` is a power series in `z` of terms that are
//!   not negative, and largest for κ = 0: `E_z ≤ ½ (1−z)^(−3/2)`, `E_zz ≤ ¾ (1−z)^(−5/2)`;
//!   `|E_hz| ≤ x/sin x (2/cos²x + x sin x/cos³x)`;
//! - with `G = Ω/sin Ω`: `g ≤ hG`, `|g_h| ≤ G`, `|g_hh| ≤ Ω² hG`, and as `g/h` is such a series, largest for h = 0:
//!   `g_z ≤ hG'`, `g_zz ≤ hG''`; `|g_hz| ≤ G' + 2h²G²`, as `g_h = G cos(hΩ)`. `G` and its derivatives by `z` are convex:
//!   they are below the chords between their values 1, 2/3, 16/15 at z = 0 and π/2, 2, 2π at z = ½.

use crate::trajectory::rotation::logarithm;
use ccd_core::glam::{DQuat, DVec3};
use ccd_core::order::greater;
use ccd_core::vector::length;
use std::f64::consts::PI;

/// Returns the inner control orientation of squad at the middle one of three orientations.
pub(super) fn control_orientation(before: DQuat, at: DQuat, after: DQuat) -> DQuat {
    let log = |other: DQuat| logarithm(at.conjugate() * other);
    (at * exponential(-0.25 * (log(before) + log(after)))).normalize()
}

/// A spherical quadrangle that is passed in a given duration, with bounds on its derivatives.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Squad {
    p: Arc,
    r: Arc,
    duration: f64,
    speed: f64,
    acceleration: f64,
}

/// A rotation at a constant rate about a fixed axis of the body, for u from 0 to 1.
#[derive(Clone, Debug, PartialEq)]
struct Arc {
    start: DQuat,
    /// The angular velocity per unit of u, in radians along the body's axes.
    spin: DVec3,
}

impl Arc {
    fn new([start, end]: [DQuat; 2]) -> Self {
        Arc {
            start,
            spin: logarithm(start.conjugate() * end),
        }
    }

    fn at(&self, u: f64) -> DQuat {
        self.start * exponential(u * self.spin)
    }

    /// Returns the speed on the unit sphere of quaternions, half the angular speed.
    fn speed(&self) -> f64 {
        0.5 * length(self.spin)
    }
}

impl Squad {
    /// Creates the quadrangle from its ends and its inner orientations; `None` if they are too far apart.
    pub(super) fn new(ends: [DQuat; 2], inner: [DQuat; 2], duration: f64) -> Option<Self> {
        let [p, r] = [Arc::new(ends), Arc::new(inner)];
        let apart = |u: f64| {
            let [p, r] = [p.at(u), r.at(u)];
            (r - p).length()
        };
        // Between two samples the distance grows by at most the rate times half of their spacing.
        let looks = (0..=ARC_SAMPLES).map(|k| apart(f64::from(k) / f64::from(ARC_SAMPLES)));
        let change = p.speed() + r.speed();
        let apart = looks.fold(0.0, greater) + 0.5 * change / f64::from(ARC_SAMPLES);
        // The comparison treats NaN as too far.
        if !(apart * apart <= 2.0) {
            return None;
        }
        let [speed, acceleration] = bounds(apart, [p.speed(), r.speed()]);
        Some(Squad {
            p,
            r,
            duration,
            speed: speed / duration,
            acceleration: acceleration / (duration * duration),
        })
    }

    pub(super) fn speed(&self) -> f64 {
        self.speed
    }

    pub(super) fn acceleration(&self) -> f64 {
        self.acceleration
    }

    /// Returns the orientation after a time, and the angular velocity in the world frame.
    pub(super) fn at(&self, passed: f64) -> (DQuat, DVec3) {
        let u = passed / self.duration;
        let (h, rate) = (2.0 * u * (1.0 - u), 2.0 - 4.0 * u);
        let [p, r] = [self.p.at(u), self.r.at(u)];
        let between = p.conjugate() * r;
        let way = logarithm(between);
        // The rate of the arc from p to r, in the frame of r, and that of its logarithm.
        let spin = self.r.spin - between.conjugate() * self.p.spin;
        let change = inverse_jacobian(way, spin);
        let part = exponential(h * way);
        let own = jacobian(h * way, rate * way + h * change);
        let orientation = (p * part).normalize();
        let spin = part.conjugate() * self.p.spin + own;
        (orientation, orientation * spin / self.duration)
    }
}

/// The number of samples from which the distance between both arcs is bounded.
const ARC_SAMPLES: u32 = 16;

/// Bounds the angular speed and acceleration per unit of u, for arcs with these speeds that are at most `d` apart.
fn bounds(d: f64, [p1, r1]: [f64; 2]) -> [f64; 2] {
    let z = 0.25 * d * d;
    let x = z.sqrt().asin();
    let (sin, cos) = x.sin_cos();
    let over_sin = if x > 0.0 { x / sin } else { 1.0 };
    let omega = 2.0 * x;
    // The function G and its derivatives, bounded by their chords.
    let chord = |at_0: f64, at_half: f64| at_0 + (at_half - at_0) * 2.0 * z;
    let big_g = [
        chord(1.0, 0.5 * PI),
        chord(2.0 / 3.0, 2.0),
        chord(16.0 / 15.0, 2.0 * PI),
    ];
    let (h, h1, h2) = (0.5, 2.0, 4.0);
    let (d1, d2) = (p1 + r1, p1 * p1 + r1 * r1);
    let (z1, z2) = (0.5 * d * d1, 0.5 * (d1 * d1 + d * d2));
    let e = Function {
        h: 2.0 * x * x / cos,
        z: 0.5 * (1.0 - z).powf(-1.5),
        hh: 4.0 * x * x / cos,
        hz: over_sin * (2.0 / (cos * cos) + x * sin / (cos * cos * cos)),
        zz: 0.75 * (1.0 - z).powf(-2.5),
    };
    let g = Function {
        h: big_g[0],
        z: h * big_g[1],
        hh: omega * omega * h * big_g[0],
        hz: big_g[1] + 2.0 * h * h * big_g[0] * big_g[0],
        zz: h * big_g[2],
    };
    let most_g = h * big_g[0];
    let [e1, e2] = e.derivatives([h1, h2], [z1, z2]);
    let [g1, g2] = g.derivatives([h1, h2], [z1, z2]);
    let speed = e1 * most_g * d + p1 / cos + g1 * d + most_g * d1;
    let acceleration = e2 * most_g * d
        + 2.0 * e1 * p1
        + p1 * p1 * most_g * d
        + g2 * d
        + 2.0 * g1 * d1
        + most_g * d2;
    // The rounding error is far smaller.
    [speed, acceleration].map(|bound| 2.0 * (1.0 + 1e-9) * bound)
}

/// Bounds on the partial derivatives of a function of h and z, named by the variables.
struct Function {
    h: f64,
    z: f64,
    hh: f64,
    hz: f64,
    zz: f64,
}

impl Function {
    /// Bounds the first and second derivative with respect to u.
    fn derivatives(&self, [h1, h2]: [f64; 2], [z1, z2]: [f64; 2]) -> [f64; 2] {
        [
            self.h * h1 + self.z * z1,
            self.hh * h1 * h1
                + 2.0 * self.hz * h1 * z1
                + self.zz * z1 * z1
                + self.h * h2
                + self.z * z2,
        ]
    }
}

fn exponential(turn: DVec3) -> DQuat {
    DQuat::from_scaled_axis(turn)
}

/// Returns the angular velocity, along the body's axes, of the rotation vector `turn` that changes at the rate
/// `change`.
fn jacobian(turn: DVec3, change: DVec3) -> DVec3 {
    let angle = turn.length();
    // The first terms of both series; the next ones are below rounding.
    let [first, second] = if angle < 1e-4 {
        [0.5, 1.0 / 6.0]
    } else {
        let square = angle * angle;
        let half = (0.5 * angle).sin();
        [
            2.0 * half * half / square,
            (angle - angle.sin()) / (square * angle),
        ]
    };
    change - first * turn.cross(change) + second * turn.cross(turn.cross(change))
}

/// Returns the rate of change of a rotation vector for an angular velocity along the body's axes: the inverse of
/// [`jacobian`].
fn inverse_jacobian(turn: DVec3, spin: DVec3) -> DVec3 {
    let angle = turn.length();
    let second = if angle < 1e-4 {
        1.0 / 12.0
    } else {
        let square = angle * angle;
        (1.0 - 0.5 * angle / (0.5 * angle).tan()) / square
    };
    spin + 0.5 * turn.cross(spin) + second * turn.cross(turn.cross(spin))
}
