//! A node as seen from the axis of a screw: what does not change while it moves along the screw.
//!
//! Along a way past points at least `ρ` from the axis, `f = a r + b ζ` changes by at most `√(a² + b²
//! (1 + p²/ρ²))` per length. Over a convex set, beyond a plane at `ρ` from the axis that faces it, it
//! differs from its linearisation as `r` does, by at least 0 and at most `y²/(2ρ)` at `y` along the
//! turn, and as `ζ` does, by at most `R²/2` times its second derivative, `p/ρ²`, at `R` from the centre.

use super::placed::Placed;
use crate::math::order::{greater, lesser};
use crate::math::vector::length;
use crate::motion::trig::sin_cos;
use crate::tolerance::{LEAST_INNER, MAX_TURNS, RATE_F64, TURNS_F64, profile_rounding};
use glam::{DVec2, DVec3};
use std::f64::consts::{PI, TAU};

/// The number of surfaces tried, evenly over all slopes. With a thread's flanks at any slope, eleven
/// degrees between them cost a tenth of a node's width at most.
const SURFACES: usize = 16;

/// The surface `ζ = constant`.
const ACROSS: usize = SURFACES / 2;

/// The axis of a screw, at the start.
#[derive(Debug)]
pub(super) struct ScrewAxis {
    origin: DVec3,
    unit: DVec3,
    /// The advance along the axis, per radian.
    advance: f64,
    /// The coefficients of `r` and `ζ` for each surface.
    surfaces: [DVec2; SURFACES],
    /// The directions of the azimuths 0 and a right angle.
    azimuths: [DVec3; 2],
}

/// The intervals of a node's `f` for each surface, and how fast they change near it.
#[derive(Debug)]
pub(super) struct Profile {
    low: [f64; SURFACES],
    high: [f64; SURFACES],
    /// The azimuth of the centre, and by how much that of other points may differ.
    azimuth: f64,
    width: f64,
    /// Ways from the node are at least this far from the axis, if they are no longer.
    close: f64,
    /// The most by which any `f` changes per length on such ways.
    steepest: f64,
}

impl ScrewAxis {
    pub(super) fn new(origin: DVec3, unit: DVec3, advance: f64) -> Self {
        let surfaces = std::array::from_fn(|k| {
            let (sin, cos) = sin_cos(PI * k as f64 / SURFACES as f64);
            DVec2::new(cos, sin)
        });
        let (x, y) = unit.any_orthonormal_pair();
        ScrewAxis {
            origin,
            unit,
            advance,
            surfaces,
            azimuths: [x, y],
        }
    }
}

impl Profile {
    /// Returns the profile of a node; none if it surrounds the axis, or nearly.
    pub(super) fn new(node: &Placed, axis: &ScrewAxis) -> Option<Self> {
        Profile::beside(node, axis, None)
    }

    /// Returns the profile that contains those of all parts, of which there is at least one; none if
    /// one of them surrounds the axis, or nearly.
    pub(super) fn about(mut parts: impl Iterator<Item = Placed>, axis: &ScrewAxis) -> Option<Self> {
        let mut all = Profile::new(&parts.next()?, axis)?;
        for part in parts {
            let part = Profile::beside(&part, axis, Some(all.azimuth))?;
            for k in 0..SURFACES {
                all.low[k] = lesser(all.low[k], part.low[k]);
                all.high[k] = greater(all.high[k], part.high[k]);
            }
            let off = (part.azimuth - all.azimuth).abs();
            all.width = greater(all.width, off + part.width);
            all.close = lesser(all.close, part.close);
            all.steepest = greater(all.steepest, part.steepest);
        }
        Some(all)
    }

    /// Returns the profile with the azimuth that is nearest to a given one.
    fn beside(node: &Placed, axis: &ScrewAxis, near: Option<f64>) -> Option<Self> {
        let way = node.centre - axis.origin;
        let height = way.dot(axis.unit);
        let across = way - height * axis.unit;
        // What rounding leaves of the height would tilt the gradients of tall nodes.
        let across = across - across.dot(axis.unit) * axis.unit;
        let distance = length(across);
        let outward = across / distance;
        let onward = axis.unit.cross(outward);
        let inner = distance - node.reach(-outward);
        // Written so that NaN is not far.
        if !(inner > LEAST_INNER * distance) {
            return None;
        }
        let [x, y] = axis.azimuths;
        let azimuth = across.dot(y).atan2(across.dot(x));
        let azimuth = azimuth - near.map_or(0.0, |near| TAU * ((azimuth - near) / TAU).round());
        let zeta = height - axis.advance * azimuth;
        let ahead = axis.unit - axis.advance / distance * onward;
        let (arm, steep) = (length(way), axis.advance / (0.5 * inner));
        let aside = greater(node.reach(onward), node.reach(-onward));
        let mut profile = Profile {
            low: [0.0; SURFACES],
            high: [0.0; SURFACES],
            azimuth,
            width: aside / inner,
            close: 0.5 * inner,
            steepest: (1.0 + steep * steep).sqrt() * (1.0 + RATE_F64),
        };
        let bulge = 0.5 * aside * aside / inner;
        let twist = 0.5 * axis.advance.abs() * (node.radius / inner) * (node.radius / inner);
        for (k, &n) in axis.surfaces.iter().enumerate() {
            let at = n.x * distance + n.y * zeta;
            let gradient = n.x * outward + n.y * ahead;
            let tilt = axis.advance / distance;
            let rounding = profile_rounding(n.abs().to_array(), [arm, node.radius], tilt);
            let reach = |sign: f64| {
                let bend = greater(0.0, sign * n.x) * bulge + n.y.abs() * twist;
                node.reach(sign * gradient) + bend + rounding
            };
            profile.low[k] = at - reach(-1.0);
            profile.high[k] = at + reach(1.0);
        }
        Some(profile)
    }

    /// Returns the widest gap to another node, along any surface, with the other's `ζ` raised by
    /// `shift`.
    fn widest_gap(&self, other: &Profile, axis: &ScrewAxis, shift: f64) -> f64 {
        let gap = |k: usize| {
            let rise = axis.surfaces[k].y * shift;
            let above = (other.low[k] + rise) - self.high[k];
            greater(above, self.low[k] - (other.high[k] + rise))
        };
        (0..SURFACES).map(gap).fold(0.0, greater)
    }

    /// Returns the numbers of whole turns that the still node's azimuth may be ahead of its own while
    /// the turning node passes it: the least and the most.
    fn turns(&self, still: &Profile, way: &Way) -> [f64; 2] {
        let ahead = still.azimuth - self.azimuth;
        let width = self.width + still.width + way.needed / greater(self.close, still.close);
        let [from, to] = way.angles;
        let by_azimuth = [from - width - ahead, to + width - ahead].map(|angle| angle / TAU);
        if !(way.pitch.abs() > 0.0) {
            return outward(by_azimuth);
        }
        // Far surfaces across the axis need no look.
        let gap = way.needed * greater(self.steepest, still.steepest);
        let ends = [
            still.low[ACROSS] - self.high[ACROSS] - gap,
            still.high[ACROSS] - self.low[ACROSS] + gap,
        ];
        let [one, other] = ends.map(|rise| rise / way.pitch);
        let [least, most] = outward(by_azimuth);
        let [lower, upper] = outward([lesser(one, other), greater(one, other)]);
        [greater(least, lower), lesser(most, upper)]
    }
}

/// Rounds to the whole numbers in an interval, which is widened by far more than rounding.
fn outward([least, most]: [f64; 2]) -> [f64; 2] {
    let width = TURNS_F64 * (1.0 + greater(least.abs(), most.abs()));
    [(least - width).ceil(), (most + width).floor()]
}

/// The way of the turning node, and the distance that is to be kept on it.
#[derive(Debug)]
pub(super) struct Way {
    /// The advance per turn.
    pub(super) pitch: f64,
    /// The angles from the start at which it begins and ends.
    pub(super) angles: [f64; 2],
    pub(super) needed: f64,
}

/// Returns whether a node that turns and one that stands still certainly keep more than the needed
/// distance.
pub(super) fn keep_apart(turning: &Profile, still: &Profile, axis: &ScrewAxis, way: &Way) -> bool {
    let near = match still.close > turning.close {
        true => still,
        false => turning,
    };
    let [least, most] = turning.turns(still, way);
    // Written so that NaN proves nothing.
    if !(near.close > way.needed && most - least <= MAX_TURNS) {
        return false;
    }
    let mut count = least;
    while count <= most {
        let gap = turning.widest_gap(still, axis, -count * way.pitch);
        if !(gap > way.needed * near.steepest) {
            return false;
        }
        count += 1.0;
    }
    true
}

#[cfg(test)]
mod tests;
