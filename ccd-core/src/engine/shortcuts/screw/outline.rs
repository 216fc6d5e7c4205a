//! The projection of a triangle along a screw motion: its corners as points (`r`, `ζ`), with the distance `r` from the
//! axis and the height `ζ` along the screw.
//!
//! The distance `r` from the axis is a convex function. On a triangle, any `a r + b ζ` with a linear `ζ` is greatest
//! at a corner. Everywhere `r` is at least `o·x`, with `x` from the axis and any unit vector `o` across it. The `o`
//! in the middle of the triangle's azimuths loses least.

use super::super::placed::PlacedNode;
use crate::math::order::{greater, lesser};
use crate::math::vector::{length, unit};
use crate::rounding::profile_rounding;
use glam::{DVec2, DVec3};

/// The projection of a triangle along a screw motion to the plane of `r` and `ζ`.
#[derive(Debug)]
pub(crate) struct HelicalProjection {
    /// The corners as (`r`, `ζ`), distance from the axis and height along the screw. Their triangle reaches at least as far out
    /// as the triangle itself.
    outer_bound_corners: [DVec2; 3],
    /// The projected corners with a lower bound of the distance from the axis as `r`; the bound is a linear function
    /// over the triangle.
    inner_bound_corners: [DVec2; 3],
    /// A bound of the deviation of `ζ` from a linear function over the triangle.
    zeta_nonlinearity_bound: f64,
    /// The distance of the node's center from the origin of the axis, and the node's radius; rounding is proportional
    /// to them.
    center_distance_and_radius: [f64; 2],
    helix_slope: f64,
}

/// The linear approximation of `ζ` near a node, with bounds of its deviation from `ζ`.
pub(crate) struct ZetaApproximation {
    /// A point on the axis, and the direction of the axis.
    pub(crate) axis_point_and_direction: [DVec3; 2],
    /// The value of `ζ` at the node's center.
    pub(crate) center_zeta: f64,
    /// The gradient of `ζ` at the node's center.
    pub(crate) zeta_gradient: DVec3,
    pub(crate) zeta_nonlinearity_bound: f64,
    pub(crate) rounding_lengths: [f64; 2],
    pub(crate) helix_slope: f64,
}

impl HelicalProjection {
    /// Projects a triangle along the screw; `None` if the node is not a single triangle.
    pub(crate) fn new(node: &PlacedNode, linear: &ZetaApproximation) -> Option<Self> {
        let corners = node.triangle_corners_from_center()?;
        let [origin, along] = linear.axis_point_and_direction;
        let across = |x: DVec3| {
            let x = x - x.dot(along) * along;
            x - x.dot(along) * along
        };
        let middle = across(node.center - origin);
        let across = corners.map(|w| middle + across(w));
        // The outward direction in the middle of the corners' azimuths.
        let [a, b, c] = across.map(|x| x / length(x));
        let pairs = [[a, b], [b, c], [c, a]];
        let [x, y] = pairs
            .into_iter()
            .min_by(|[a, b], [c, d]| a.dot(*b).total_cmp(&c.dot(*d)))?;
        let facing = unit(x + y)?;
        let zeta = |w: DVec3| linear.center_zeta + w.dot(linear.zeta_gradient);
        Some(HelicalProjection {
            outer_bound_corners: [0, 1, 2].map(|k| DVec2::new(length(across[k]), zeta(corners[k]))),
            inner_bound_corners: [0, 1, 2]
                .map(|k| DVec2::new(across[k].dot(facing), zeta(corners[k]))),
            zeta_nonlinearity_bound: linear.zeta_nonlinearity_bound,
            center_distance_and_radius: linear.rounding_lengths,
            helix_slope: linear.helix_slope,
        })
    }

    /// Returns an interval that contains all values of `n.x r + n.y ζ` over the triangle.
    pub(crate) fn projection_interval(&self, n: DVec2) -> [f64; 2] {
        let (least, most) = if n.x < 0.0 {
            (&self.outer_bound_corners, &self.inner_bound_corners)
        } else {
            (&self.inner_bound_corners, &self.outer_bound_corners)
        };
        let slack = n.y.abs() * self.zeta_nonlinearity_bound
            + profile_rounding(
                n.abs().to_array(),
                self.center_distance_and_radius,
                self.helix_slope,
            );
        let low = least.iter().map(|c| n.dot(*c)).fold(f64::INFINITY, lesser);
        let high = most
            .iter()
            .map(|c| n.dot(*c))
            .fold(f64::NEG_INFINITY, greater);
        [low - slack, high + slack]
    }

    /// Returns the surfaces `a r + b ζ = const` along the triangle's edges, as unit vectors (`a`, `b`) with `b ≥ 0`.
    pub(crate) fn edge_normals(&self) -> impl Iterator<Item = DVec2> {
        let [a, b, c] = self.outer_bound_corners;
        let edges = [b - a, c - b, a - c];
        let across = edges.map(|edge| edge.perp() / edge.length());
        // An edge along the turn has no direction here. Written so that NaN gives none.
        let known = across.into_iter().filter(|n| n.length_squared() > 0.5);
        known.map(|n| if n.y < 0.0 { -n } else { n })
    }
}
