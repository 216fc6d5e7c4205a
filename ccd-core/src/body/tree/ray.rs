//! Computes the winding number of a body's surface about a point by counting the crossings of a ray.

use super::point_query::leaves_in_region;
use super::{Node, Tree};
use crate::body::pieces::Pieces;
use crate::math::order::{greater, lesser};
use crate::rounding::{DETERMINANT_ERROR_F64, UNIT_ROUNDOFF_F64};
use crate::tuning::MAX_RAYS;
use glam::DVec3;
use std::f64::consts::TAU;

/// The sums of a ray's signed crossings with a surface: 1 where the ray leaves the solid, −1 where it enters.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RayCrossingSums {
    /// The sum of the signs of the crossings beyond the ray's start. For a closed surface this is the winding number about points
    /// just ahead of the start.
    pub(crate) sum_ahead: i32,
    /// The sum of the crossings that coincide with the start up to rounding.
    pub(crate) sum_at_start: i32,
    /// The number of triangles that contain the start, up to rounding.
    pub(crate) triangle_count_at_start: u32,
    /// The direction of the ray in the body's frame, of unit length.
    pub(crate) direction: DVec3,
}

/// Counts the crossings along a ray from a point that certainly meets no edge; `None` if no such ray is found. A
/// triangle contains the point if the triangle's plane is at most `slack` away.
///
/// # Guarantee
/// The count of crossings ahead of the point by more than rounding is that of exact arithmetic, and no crossing
/// behind the point is counted. The surface of pieces that are not triangles consists of the mesh's faces on them.
pub(crate) fn sum_signed_crossings(
    tree: &Tree,
    pieces: &Pieces,
    from: DVec3,
    slack: f64,
) -> Option<RayCrossingSums> {
    let start = RayStart { from, slack };
    (0..MAX_RAYS)
        .find_map(|k| sum_signed_crossings_along(tree, pieces, start, evenly_spread_direction(k)))
}

/// The start point of a ray, and the distance up to which a triangle counts as containing it.
#[derive(Clone, Copy)]
struct RayStart {
    from: DVec3,
    slack: f64,
}

/// Returns the `k`-th direction of a sequence that is spread evenly over the sphere.
fn evenly_spread_direction(k: u32) -> DVec3 {
    // Multiples of these two fractions are spread evenly over a square.
    let [x, y] = [0.754_877_666_246_693, 0.569_840_290_998_053].map(|f| (f64::from(k) + 0.5) * f);
    let height = 1.0 - 2.0 * x.fract();
    let (sin, cos) = (TAU * y.fract()).sin_cos();
    let radius = greater(0.0, 1.0 - height * height).sqrt();
    DVec3::new(radius * cos, radius * sin, height)
}

fn sum_signed_crossings_along(
    tree: &Tree,
    pieces: &Pieces,
    start: RayStart,
    along: DVec3,
) -> Option<RayCrossingSums> {
    let mut found = RayCrossingSums {
        sum_ahead: 0,
        sum_at_start: 0,
        triangle_count_at_start: 0,
        direction: along,
    };
    let mut add = |triangle| found.add(triangle, start).is_some();
    leaves_in_region(tree, |node| may_hit(node, start.from, along))
        .all(|leaf| leaf.all_triangles_satisfy(pieces, &mut add))
        .then_some(found)
}

/// Returns whether a ray may hit a node's box; false only if it certainly misses the box.
fn may_hit(node: &Node, from: DVec3, along: DVec3) -> bool {
    let way = from - node.center;
    let (mut enter, mut leave) = (0.0f64, f64::INFINITY);
    for k in 0..3 {
        let axis = node.axes[k].as_dvec3();
        // Positions along the ray are off by the rounding of the distance to the box.
        let half = node.widened_half_extent(k) + 32.0 * UNIT_ROUNDOFF_F64 * way.abs().element_sum();
        let (start, speed) = (axis.dot(way), axis.dot(along));
        let (near, far) = ((-half - start) / speed, (half - start) / speed);
        // A ray parallel to a slab, within it, gives an infinity on either side. NaN counts as met.
        enter = greater(enter, lesser(near, far));
        leave = lesser(leave, greater(near, far));
    }
    !(enter > leave)
}

/// The sign of a computed number, or unclear if rounding leaves it uncertain.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Sign {
    Negative,
    Unclear,
    Positive,
}

impl Sign {
    /// Returns the sign of a number whose rounding error is at most [`DETERMINANT_ERROR_F64`] times `size`.
    fn of_number(number: f64, size: f64) -> Sign {
        // Written so that NaN is unclear. Products that underflow are off by less than the added term.
        let rounding = DETERMINANT_ERROR_F64 * size + f64::MIN_POSITIVE;
        match () {
            () if number > rounding => Sign::Positive,
            () if number < -rounding => Sign::Negative,
            () => Sign::Unclear,
        }
    }
}

impl RayCrossingSums {
    /// Adds the crossing of the ray with a triangle, if any; `None` if rounding leaves it uncertain whether they cross.
    fn add(&mut self, triangle: [DVec3; 3], start: RayStart) -> Option<()> {
        let along = self.direction;
        let corners = triangle.map(|p| p - start.from);
        let size = |p: DVec3| p.abs().element_sum();
        let ahead = corners.map(|p| Sign::of_number(along.dot(p), size(p)));
        if ahead == [Sign::Negative; 3] {
            return Some(());
        }
        let [a, b, c] = corners;
        // The volumes of the ray with each edge have one sign if the line passes inside.
        let sides = [(a, b), (b, c), (c, a)]
            .map(|(p, q)| Sign::of_number(along.dot(p.cross(q)), size(p) * size(q)));
        if sides.contains(&Sign::Positive) && sides.contains(&Sign::Negative) {
            return Some(());
        }
        if sides.contains(&Sign::Unclear) {
            // The ray may pass a triangle that is too small or too thin for its edges to decide.
            let reach = greater(size(b - a), size(c - a))
                + DETERMINANT_ERROR_F64 * (size(a) + size(b) + size(c));
            return (a.cross(along).abs().max_element() > 2.0 * reach).then_some(());
        }
        let sign = match sides[0] {
            Sign::Positive => 1,
            _ => -1,
        };
        let height = f64::from(sign) * a.dot(b.cross(c));
        let normal = size((b - a).cross(c - a));
        let height = if ahead == [Sign::Positive; 3] {
            Sign::Positive
        } else if height.abs() <= start.slack * normal {
            Sign::Unclear
        } else {
            match Sign::of_number(height, size(a) * size(b) * size(c)) {
                Sign::Unclear => ray_parameter_sign(triangle, corners, sign),
                clear => clear,
            }
        };
        match height {
            Sign::Positive => self.sum_ahead += sign,
            Sign::Negative => {}
            Sign::Unclear => {
                self.sum_at_start += sign;
                self.triangle_count_at_start += 1;
            }
        }
        Some(())
    }
}

/// Returns whether a triangle is ahead of a ray's start or behind it, computed from the triangle's edges. The edges may
/// be far shorter than the vectors to the corners.
fn ray_parameter_sign(triangle: [DVec3; 3], corners: [DVec3; 3], sign: i32) -> Sign {
    let size = |p: DVec3| p.abs().element_sum();
    let signs = [0, 1, 2].map(|k| {
        let (next, last) = ((k + 1) % 3, (k + 2) % 3);
        let [way, p, q] = [
            corners[k],
            triangle[next] - triangle[k],
            triangle[last] - triangle[k],
        ];
        let height = f64::from(sign) * way.dot(p.cross(q));
        Sign::of_number(height, size(way) * size(p) * size(q))
    });
    let clear = signs.into_iter().find(|&sign| sign != Sign::Unclear);
    clear.unwrap_or(Sign::Unclear)
}
