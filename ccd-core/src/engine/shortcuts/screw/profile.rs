//! Bounds of a node in coordinates that do not change while the node moves along a screw: the distance from the axis
//! and the height along the screw.
//!
//! Along a path past points at least `ρ` from the axis, `f = a r + b ζ` changes by at most `√(a² + b² (1 + p²/ρ²))`
//! per length. Consider a convex set beyond a plane that faces the axis, at `ρ` from it. There `f` differs from its
//! linearisation by two terms. That of `r` is at least 0 and at most `y²/(2ρ)` at `y` along the turn. That of `ζ` is
//! at most `R²/2` times its second derivative, `p/ρ²`, at `R` from the center.

use super::super::placed::PlacedNode;
use super::outline::{HelicalProjection, ZetaApproximation};
use crate::math::order::{greater, lesser};
use crate::math::vector::length;
use crate::motion::track::sin_cos;
use crate::rounding::{RATE_ERROR_F64, TURN_COUNT_WIDENING, profile_rounding};
use crate::tuning::MIN_PROFILE_DISTANCE_SHARE;
use glam::{DVec2, DVec3};
use std::f64::consts::{PI, TAU};

/// The number of families of helical surfaces `a r + b ζ = const` that are tried to separate nodes; the directions (a,
/// b) are spread evenly over half a turn. Eleven degrees between neighbouring surfaces cost at most a tenth of a node's
/// width, for the flanks of a thread at any slope.
const SURFACE_FAMILY_COUNT: usize = 16;

/// The axis of a screw motion at the start of the query, with the families of helical surfaces about it that are tried
/// to separate nodes.
#[derive(Debug)]
pub(crate) struct ScrewAxis {
    origin: DVec3,
    direction: DVec3,
    /// The advance along the axis per radian of rotation.
    advance: f64,
    /// The coefficients (a, b) of each family of surfaces `a r + b ζ = const`.
    surfaces: [DVec2; SURFACE_FAMILY_COUNT],
    /// The unit vectors of azimuth 0 and of azimuth π/2, perpendicular to the axis.
    azimuth_axes: [DVec3; 2],
}

/// Bounds of a node in the coordinates of a screw: for each family of surfaces `f = const`, the interval of `f` over
/// the node, and how fast `f` changes nearby.
#[derive(Debug)]
pub(crate) struct NodeScrewBounds {
    low: [f64; SURFACE_FAMILY_COUNT],
    high: [f64; SURFACE_FAMILY_COUNT],
    /// The azimuth of the node's center.
    azimuth: f64,
    azimuth_half_width: f64,
    /// Half of a lower bound of the node's distance from the axis: a path from the node of at most this length stays at
    /// least this length away from the axis.
    half_min_axis_distance: f64,
    /// An upper bound of the gradient of every `f`, for all points within `half_min_axis_distance` of the node.
    max_gradient: f64,
    /// The projection of a node that is a single triangle, which gives intervals for any surface; `None` for other
    /// nodes.
    triangle_projection: Option<HelicalProjection>,
}

impl ScrewAxis {
    pub(crate) fn new(origin: DVec3, unit: DVec3, advance: f64) -> Self {
        let surfaces = std::array::from_fn(|k| {
            let (sin, cos) = sin_cos(PI * k as f64 / SURFACE_FAMILY_COUNT as f64);
            DVec2::new(cos, sin)
        });
        let (x, y) = unit.any_orthonormal_pair();
        ScrewAxis {
            origin,
            direction: unit,
            advance,
            surfaces,
            azimuth_axes: [x, y],
        }
    }
}

impl NodeScrewBounds {
    /// Computes the profile of a node; `None` if the node surrounds the axis, or nearly does.
    pub(crate) fn new(node: &PlacedNode, axis: &ScrewAxis) -> Option<Self> {
        NodeScrewBounds::with_azimuth_near(node, axis, None)
    }

    /// Computes the union of the profiles of one or more parts; `None` if one of them surrounds the axis, or nearly
    /// does.
    pub(crate) fn union_of(
        mut parts: impl Iterator<Item = PlacedNode>,
        axis: &ScrewAxis,
    ) -> Option<Self> {
        let mut all = NodeScrewBounds::new(&parts.next()?, axis)?;
        for part in parts {
            all.triangle_projection = None;
            let part = NodeScrewBounds::with_azimuth_near(&part, axis, Some(all.azimuth))?;
            for k in 0..SURFACE_FAMILY_COUNT {
                all.low[k] = lesser(all.low[k], part.low[k]);
                all.high[k] = greater(all.high[k], part.high[k]);
            }
            let off = (part.azimuth - all.azimuth).abs();
            all.azimuth_half_width = greater(all.azimuth_half_width, off + part.azimuth_half_width);
            all.half_min_axis_distance =
                lesser(all.half_min_axis_distance, part.half_min_axis_distance);
            all.max_gradient = greater(all.max_gradient, part.max_gradient);
        }
        Some(all)
    }

    /// Computes the profile of a node, with the azimuth within half a turn of `near` if that is given; `None` if the
    /// node surrounds the axis, or nearly does.
    fn with_azimuth_near(node: &PlacedNode, axis: &ScrewAxis, near: Option<f64>) -> Option<Self> {
        let way = node.center - axis.origin;
        let height = way.dot(axis.direction);
        let across = way - height * axis.direction;
        // The rest of the height, left by rounding, would tilt the gradients of tall nodes.
        let across = across - across.dot(axis.direction) * axis.direction;
        let distance = length(across);
        let outward = across / distance;
        let onward = axis.direction.cross(outward);
        let inner = distance - node.extent_along(-outward);
        // Written so that NaN is not far.
        if !(inner > MIN_PROFILE_DISTANCE_SHARE * distance) {
            return None;
        }
        let [x, y] = axis.azimuth_axes;
        let azimuth = across.dot(y).atan2(across.dot(x));
        let azimuth = azimuth - near.map_or(0.0, |near| TAU * ((azimuth - near) / TAU).round());
        let zeta = height - axis.advance * azimuth;
        let ahead = axis.direction - axis.advance / distance * onward;
        let (arm, steep) = (length(way), axis.advance / (0.5 * inner));
        let aside = greater(node.extent_along(onward), node.extent_along(-onward));
        let mut profile = NodeScrewBounds {
            low: [0.0; SURFACE_FAMILY_COUNT],
            high: [0.0; SURFACE_FAMILY_COUNT],
            azimuth,
            azimuth_half_width: aside / inner,
            half_min_axis_distance: 0.5 * inner,
            max_gradient: (1.0 + steep * steep).sqrt() * (1.0 + RATE_ERROR_F64),
            triangle_projection: None,
        };
        let bulge = 0.5 * aside * aside / inner;
        let twist = 0.5
            * axis.advance.abs()
            * (node.bounding_radius / inner)
            * (node.bounding_radius / inner);
        for (k, &n) in axis.surfaces.iter().enumerate() {
            let at = n.x * distance + n.y * zeta;
            let gradient = n.x * outward + n.y * ahead;
            let tilt = axis.advance / distance;
            let rounding = profile_rounding(n.abs().to_array(), [arm, node.bounding_radius], tilt);
            let reach = |sign: f64| {
                let nonlinear = greater(0.0, sign * n.x) * bulge + n.y.abs() * twist;
                node.extent_along(sign * gradient) + nonlinear + rounding
            };
            profile.low[k] = at - reach(-1.0);
            profile.high[k] = at + reach(1.0);
        }
        let linear = ZetaApproximation {
            axis_point_and_direction: [axis.origin, axis.direction],
            center_zeta: zeta,
            zeta_gradient: ahead,
            zeta_nonlinearity_bound: twist,
            rounding_lengths: [arm, node.bounding_radius],
            helix_slope: axis.advance / distance,
        };
        profile.triangle_projection = HelicalProjection::new(node, &linear);
        if let Some(outline) = &profile.triangle_projection {
            for (k, &n) in axis.surfaces.iter().enumerate() {
                let [low, high] = outline.projection_interval(n);
                profile.low[k] = greater(profile.low[k], low);
                profile.high[k] = lesser(profile.high[k], high);
            }
        }
        Some(profile)
    }

    /// Returns an interval of shifts of the other node's `ζ`: for shifts outside of it, a surface separates the nodes
    /// by more than the needed gap. The interval is empty if some surface separates them for any shift.
    fn unseparated_shift_range(
        &self,
        other: &NodeScrewBounds,
        axis: &ScrewAxis,
        needed_gap: f64,
    ) -> [f64; 2] {
        let common = axis.surfaces.iter().enumerate();
        let common = common.map(|(k, &n)| {
            (
                n,
                [self.low[k], self.high[k]],
                [other.low[k], other.high[k]],
            )
        });
        // The surfaces along the edges of two triangles.
        let outlines = self
            .triangle_projection
            .iter()
            .zip(&other.triangle_projection);
        let own = outlines.flat_map(|(own, others)| {
            let surfaces = own.edge_normals().chain(others.edge_normals());
            surfaces.map(move |n| (n, own.projection_interval(n), others.projection_interval(n)))
        });
        let mut met = [f64::NEG_INFINITY, f64::INFINITY];
        for (n, [low, high], [other_low, other_high]) in common.chain(own) {
            let least = (low - other_high) - needed_gap;
            let most = (high - other_low) + needed_gap;
            if n.y > 0.0 {
                met = intersection(met, [least / n.y, most / n.y]);
            } else if least > 0.0 || most < 0.0 {
                // This surface separates the nodes for any shift. Written so that NaN is no gap.
                return [f64::INFINITY, f64::NEG_INFINITY];
            }
            if met[0] > met[1] {
                return met;
            }
        }
        met
    }

    /// Returns the least and the greatest number of whole turns after which the turning node may pass the azimuth of
    /// the still node.
    fn turn_count_range(&self, still: &NodeScrewBounds, way: &ScrewPath) -> [f64; 2] {
        let ahead = still.azimuth - self.azimuth;
        let width = self.azimuth_half_width
            + still.azimuth_half_width
            + way.needed_gap / greater(self.half_min_axis_distance, still.half_min_axis_distance);
        let [from, to] = way.angle_range;
        whole_numbers_in([from - width - ahead, to + width - ahead].map(|angle| angle / TAU))
    }
}

/// Returns the intersection of two intervals.
fn intersection([a, b]: [f64; 2], [c, d]: [f64; 2]) -> [f64; 2] {
    [greater(a, c), lesser(b, d)]
}

/// Returns the least and the greatest whole number in an interval, after widening the interval to allow for rounding.
fn whole_numbers_in([least, most]: [f64; 2]) -> [f64; 2] {
    let width = TURN_COUNT_WIDENING * (1.0 + greater(least.abs(), most.abs()));
    [(least - width).ceil(), (most + width).floor()]
}

/// A part of a screw motion, and the distance that nodes have to keep during it.
#[derive(Debug)]
pub(crate) struct ScrewPath {
    /// The advance along the axis per turn.
    pub(crate) pitch: f64,
    /// The rotation angles of the turning body at the start and the end of the part, measured from the start of the
    /// query.
    pub(crate) angle_range: [f64; 2],
    pub(crate) needed_gap: f64,
}

/// Returns whether a turning node and a still node certainly stay farther apart than the needed distance along the path
/// `way`.
///
/// Each further turn lowers the still node's `ζ`, as seen from the turning node, by one pitch. The shifts for which
/// no surface separates the nodes form a single interval. The number of turns therefore does not matter, only whether
/// a whole number of pitches lies in it. Without a pitch all turns are alike.
pub(crate) fn profiles_keep_apart(
    turning: &NodeScrewBounds,
    still: &NodeScrewBounds,
    axis: &ScrewAxis,
    way: &ScrewPath,
) -> bool {
    let near = if still.half_min_axis_distance > turning.half_min_axis_distance {
        still
    } else {
        turning
    };
    // Written so that NaN proves nothing.
    if !(near.half_min_axis_distance > way.needed_gap) {
        return false;
    }
    let [least, most] =
        turning.unseparated_shift_range(still, axis, way.needed_gap * near.max_gradient);
    if least > most {
        return true;
    }
    let met = if way.pitch.abs() > 0.0 {
        let [one, other] = [least, most].map(|shift| -shift / way.pitch);
        whole_numbers_in([lesser(one, other), greater(one, other)])
    } else if least > 0.0 || most < 0.0 {
        return true;
    } else {
        [f64::NEG_INFINITY, f64::INFINITY]
    };
    let [least, most] = intersection(turning.turn_count_range(still, way), met);
    least > most
}

#[cfg(test)]
mod tests;
