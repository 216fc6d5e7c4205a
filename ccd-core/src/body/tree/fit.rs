//! Fits the box and the ball of a node.

use super::group::up;
use super::node::{Below, Node};
use crate::math::order::greater;
use crate::math::principal::principal_axes;
use crate::math::vector::{length, unit};
use crate::tolerance::FRAME_F64;
use glam::{DMat3, DVec3, Vec3};

/// The pieces below a node, as input of a fit.
pub(crate) struct Cloud<'a> {
    pub(crate) points: &'a [DVec3],
    /// The largest rounding radius among the pieces.
    pub(crate) radius: f64,
    /// True if the points are corners of triangles, three each.
    pub(crate) triangles: bool,
}

/// The number of tried frames about the mean normal, over a right angle in total.
const TURNS: usize = 6;

/// Fits the node to all points: tries several frames, and takes the one whose box has the least
/// surface.
pub(crate) fn fit(cloud: &Cloud<'_>, below: Below) -> Node {
    let mut best = Fitted::along(DMat3::IDENTITY, cloud.points);
    // A dropped frame only makes the box less tight; a frame that is not orthonormal would make it
    // too small.
    for frame in candidates(cloud).into_iter().filter(is_frame) {
        let fitted = Fitted::along(frame, cloud.points);
        // Written so that a frame with NaN loses.
        if fitted.surface() < best.surface() {
            best = fitted;
        }
    }
    best.node(cloud, below)
}

/// Returns whether the columns are orthonormal up to rounding: otherwise the box may not contain
/// its points.
fn is_frame(frame: &DMat3) -> bool {
    let off = frame.transpose() * *frame - DMat3::IDENTITY;
    // Written so that NaN is rejected.
    let within = |v: DVec3| v.abs().cmple(DVec3::splat(FRAME_F64)).all();
    within(off.x_axis) && within(off.y_axis) && within(off.z_axis)
}

/// A frame, and the extent of the points along its axes.
struct Fitted {
    frame: DMat3,
    low: DVec3,
    high: DVec3,
}

impl Fitted {
    fn along(frame: DMat3, points: &[DVec3]) -> Self {
        let turned = frame.transpose();
        let (low, high) = crate::body::hierarchy::bounds(points.iter().map(|&p| turned * p));
        Fitted { frame, low, high }
    }

    fn surface(&self) -> f64 {
        let size = self.high - self.low;
        size.x * size.y + size.y * size.z + size.z * size.x
    }

    /// Returns the node with the axes rounded to f32, longest first, and the sizes measured along
    /// these.
    fn node(&self, cloud: &Cloud<'_>, below: Below) -> Node {
        let size = self.high - self.low;
        let mut order = [0, 1, 2];
        order.sort_by(|&i, &j| size[j].total_cmp(&size[i]));
        let centre = self.frame * (0.5 * (self.low + self.high));
        let axes: [Vec3; 3] = order.map(|k| self.frame.col(k).as_vec3());
        let (mut half, mut radius) = ([0.0f64; 3], 0.0f64);
        for &point in cloud.points {
            let way = point - centre;
            for (half, axis) in half.iter_mut().zip(axes) {
                *half = greater(*half, way.dot(axis.as_dvec3()).abs());
            }
            radius = greater(radius, way.length_squared());
        }
        // Rounding in f64 is far below that of `up`; one more step up covers it.
        let outward = |x: f64| up(x).next_up();
        Node {
            centre,
            axes,
            half: half.map(outward),
            radius: outward(radius.sqrt() + cloud.radius),
            rounding: up(cloud.radius),
            below,
        }
    }
}

/// Returns the candidate frames: principal axes of the points, and, for triangles, principal axes
/// by area and frames about the mean normal.
fn candidates(cloud: &Cloud<'_>) -> Vec<DMat3> {
    let weights = || cloud.points.iter().map(|&p| (p, 1.0));
    let mut frames = vec![principal_axes(weights)];
    if cloud.triangles {
        let by_area = || {
            cloud.points.chunks_exact(3).map(|t| {
                let area = length((t[1] - t[0]).cross(t[2] - t[0]));
                ((t[0] + t[1] + t[2]) / 3.0, area)
            })
        };
        frames.push(principal_axes(by_area));
        let normals = cloud.points.chunks_exact(3);
        let sum: DVec3 = normals.map(|t| (t[1] - t[0]).cross(t[2] - t[0])).sum();
        if let Some(normal) = unit(sum) {
            let (x, y) = normal.any_orthonormal_pair();
            frames.extend((0..TURNS).map(|k| {
                let angle = k as f64 / TURNS as f64 * std::f64::consts::FRAC_PI_2;
                let (sin, cos) = angle.sin_cos();
                DMat3::from_cols(x * cos + y * sin, y * cos - x * sin, normal)
            }));
        }
    }
    frames
}
