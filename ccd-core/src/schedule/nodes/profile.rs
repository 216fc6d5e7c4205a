//! A node as seen from the axis of a screw: what does not change while it moves along the screw.
//!
//! Along a way past points at least `ρ` from the axis, `f = a r + b ζ` changes by at most `√(a² + b²
//! (1 + p²/ρ²))` per length. Over a convex set, beyond a plane at `ρ` from the axis that faces it, it
//! differs from its linearisation as `r` does, by at least 0 and at most `y²/(2ρ)` at `y` along the
//! turn, and as `ζ` does, by at most `R²/2` times its second derivative, `p/ρ²`, at `R` from the centre.

use super::outline::{Linear, Outline};
use super::placed::Placed;
use crate::math::order::{greater, lesser};
use crate::math::vector::length;
use crate::motion::trig::sin_cos;
use crate::rounding::{RATE_F64, TURNS_F64, profile_rounding};
use crate::tuning::LEAST_INNER;
use glam::{DVec2, DVec3};
use std::f64::consts::{PI, TAU};

/// The number of surfaces tried, evenly over all slopes. With a thread's flanks at any slope, eleven
/// degrees between them cost a tenth of a node's width at most.
const SURFACES: usize = 16;

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
    /// Of a single triangle, which has intervals for any surface.
    outline: Option<Outline>,
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
            all.outline = None;
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
            outline: None,
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
        let linear = Linear {
            axis: [axis.origin, axis.unit],
            zeta,
            ahead,
            twist,
            scale: [arm, node.radius],
            tilt: axis.advance / distance,
        };
        profile.outline = Outline::new(node, &linear);
        if let Some(outline) = &profile.outline {
            for (k, &n) in axis.surfaces.iter().enumerate() {
                let [low, high] = outline.interval(n);
                profile.low[k] = greater(profile.low[k], low);
                profile.high[k] = lesser(profile.high[k], high);
            }
        }
        Some(profile)
    }

    /// Returns the interval of shifts by which another node's `ζ` may be raised so that no surface keeps
    /// more than the needed gap between both. It is empty if one does so for any shift.
    fn meeting(&self, other: &Profile, axis: &ScrewAxis, needed: f64) -> [f64; 2] {
        let common = axis.surfaces.iter().enumerate();
        let common = common.map(|(k, &n)| {
            (
                n,
                [self.low[k], self.high[k]],
                [other.low[k], other.high[k]],
            )
        });
        // Surfaces that suit two triangles.
        let outlines = self.outline.iter().zip(&other.outline);
        let own = outlines.flat_map(|(own, others)| {
            let surfaces = own.surfaces().chain(others.surfaces());
            surfaces.map(move |n| (n, own.interval(n), others.interval(n)))
        });
        let mut met = [f64::NEG_INFINITY, f64::INFINITY];
        for (n, [low, high], [other_low, other_high]) in common.chain(own) {
            let least = (low - other_high) - needed;
            let most = (high - other_low) + needed;
            met = match n.y > 0.0 {
                true => both(met, [least / n.y, most / n.y]),
                // No shift leads around it. Written so that NaN is no gap.
                false if least > 0.0 || most < 0.0 => return [f64::INFINITY, f64::NEG_INFINITY],
                false => met,
            };
            if met[0] > met[1] {
                return met;
            }
        }
        met
    }

    /// Returns the numbers of whole turns that the still node's azimuth may be ahead of its own while
    /// the turning node passes it: the least and the most.
    fn passes(&self, still: &Profile, way: &Way) -> [f64; 2] {
        let ahead = still.azimuth - self.azimuth;
        let width = self.width + still.width + way.needed / greater(self.close, still.close);
        let [from, to] = way.angles;
        outward([from - width - ahead, to + width - ahead].map(|angle| angle / TAU))
    }
}

/// Returns what is in two intervals.
fn both([a, b]: [f64; 2], [c, d]: [f64; 2]) -> [f64; 2] {
    [greater(a, c), lesser(b, d)]
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
///
/// A turn more raises the still node's `ζ`, as the turning one sees it, by a pitch less. No surface is between
/// them in a single interval of shifts, so that the number of turns does not count, only whether a whole one is
/// in there. Without a pitch all turns are alike.
pub(super) fn keep_apart(turning: &Profile, still: &Profile, axis: &ScrewAxis, way: &Way) -> bool {
    let near = if still.close > turning.close {
        still
    } else {
        turning
    };
    // Written so that NaN proves nothing.
    if !(near.close > way.needed) {
        return false;
    }
    let [least, most] = turning.meeting(still, axis, way.needed * near.steepest);
    if least > most {
        return true;
    }
    let met = match way.pitch.abs() > 0.0 {
        true => {
            let [one, other] = [least, most].map(|shift| -shift / way.pitch);
            outward([lesser(one, other), greater(one, other)])
        }
        false if least > 0.0 || most < 0.0 => return true,
        false => [f64::NEG_INFINITY, f64::INFINITY],
    };
    let [least, most] = both(turning.passes(still, way), met);
    least > most
}

#[cfg(test)]
mod tests;
