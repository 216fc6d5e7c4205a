//! Builds a tree of swept spheres: fits a swept rectangle to a set of triangles, and splits the set in two.

use super::{Node, RssTree, mean_and_principal_axes};
use crate::method::rival::Placement;
use crate::method::rival::tree::{NodeContent, build_binary_tree};
use crate::method::rival::triangles_apart::Triangle;
use ccd_core::glam::{DVec2, DVec3};
use ccd_core::order::greater;

/// The relative increase of radii, which covers the rounding here and in computations with the tree.
const RADIUS_INFLATION: f64 = 1e-14;

/// Builds the tree over triangles, and sorts these into the order of the leaves.
pub(super) fn build_tree(mut triangles: Vec<Triangle>) -> RssTree {
    let nodes = build_binary_tree(
        &mut triangles,
        |triangles, parent: Option<&(Placement, Node)>| {
            let (frame, lengths, radius) = fit_swept_rectangle(triangles);
            let node = Node {
                frame_in_parent: parent.map_or(frame, |(parent, _)| frame.relative_to(parent)),
                side_lengths: lengths,
                radius,
                content: NodeContent::Triangle(0),
            };
            (frame, node)
        },
        |triangles, (frame, _)| partition_triangles(triangles, frame.rotation.x_axis),
    );
    let node = |((frame, node), content)| (Node { content, ..node }, frame);
    let (nodes, frames) = nodes.into_iter().map(node).unzip();
    RssTree {
        nodes,
        node_frames: frames,
        triangles,
    }
}

/// Splits triangles by their centers along an axis, and returns the number of triangles in the first part. The split is
/// at the mean, or in the middle of the order if that would be lopsided.
fn partition_triangles(part: &mut [Triangle], axis: DVec3) -> usize {
    /// The smallest fraction of the triangles that either part of a split may get.
    const MIN_SPLIT_FRACTION: f64 = 1.0 / 16.0;

    let along = |t: &Triangle| (t[0] + t[1] + t[2]).dot(axis);
    let count = part.len();
    let mean = part.iter().map(along).sum::<f64>() / count as f64;
    part.sort_unstable_by(|s, t| along(s).total_cmp(&along(t)));
    let below = part.partition_point(|t| along(t) < mean);
    let few = greater(1.0, MIN_SPLIT_FRACTION * count as f64) as usize;
    if (few..=count - few).contains(&below) {
        below
    } else {
        count / 2
    }
}

/// Fits a rectangle across the direction in which the triangles are thinnest, and returns its frame, its side lengths
/// and the required radius \[PQP99 §3\].
fn fit_swept_rectangle(triangles: &[Triangle]) -> (Placement, DVec2, f64) {
    let (_, axes) = mean_and_principal_axes(triangles.iter().flatten().copied());
    let to_axes = axes.transpose();
    let points = || triangles.iter().flatten().map(|&p| to_axes * p);
    let (low, high) = points().fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), p| {
        (low.min(p), high.max(p))
    });
    let radius = 0.5 * (high.z - low.z);
    let middle = 0.5 * (high.z + low.z);
    let mut shape = GrowingRectangle {
        low: DVec2::INFINITY,
        high: DVec2::NEG_INFINITY,
        plane_z: middle,
        radius,
    };
    points().for_each(|p| shape.extend_sides(p));
    shape.repair_crossed_sides();
    points().for_each(|p| shape.extend_corner(p));
    let farthest = points().map(|p| shape.distance(p)).fold(radius, greater);
    let extent = triangles
        .iter()
        .flatten()
        .fold(0.0, |most, p| greater(most, p.abs().max_element()));
    let frame = Placement {
        rotation: axes,
        translation: axes * shape.low.extend(middle),
    };
    (
        frame,
        shape.high - shape.low,
        farthest + RADIUS_INFLATION * extent,
    )
}

/// A rectangle in the plane z = `plane_z` that grows until it has all points within the radius.
struct GrowingRectangle {
    low: DVec2,
    high: DVec2,
    plane_z: f64,
    radius: f64,
}

impl GrowingRectangle {
    /// Returns the greatest distance from a point's foot in the plane at which the rectangle may end and still have the
    /// point within the radius.
    fn reach_in_plane(&self, point: DVec3) -> f64 {
        let up = point.z - self.plane_z;
        greater(0.0, self.radius * self.radius - up * up).sqrt()
    }

    /// Moves each side outwards until a point is within the radius of the line along that side.
    fn extend_sides(&mut self, point: DVec3) {
        let reach = self.reach_in_plane(point);
        self.low = self.low.min(point.truncate() + reach);
        self.high = self.high.max(point.truncate() - reach);
    }

    /// Moves two opposite sides that have passed each other to the middle between them: every position there is valid.
    fn repair_crossed_sides(&mut self) {
        let middle = 0.5 * (self.low + self.high);
        self.low = self.low.min(middle);
        self.high = self.high.max(middle);
    }

    /// Moves the corner nearest to a point outwards along its diagonal until the point is within the radius.
    fn extend_corner(&mut self, point: DVec3) {
        let flat = point.truncate();
        let side = DVec2::select(
            flat.cmpgt(0.5 * (self.low + self.high)),
            DVec2::ONE,
            DVec2::NEG_ONE,
        );
        let corner = DVec2::select(side.cmpgt(DVec2::ZERO), self.high, self.low);
        let out = (flat - corner) * side;
        if out.min_element() > 0.0 {
            let along = 0.5 * (out.x + out.y);
            let aside = out - along;
            let reach = self.reach_in_plane(point);
            let spare = greater(0.0, reach * reach - aside.length_squared());
            // The diagonal's direction is (1, 1) / √2.
            let push = along - (0.5 * spare).sqrt();
            if push > 0.0 {
                let moved = corner + push * side;
                self.low = self.low.min(moved);
                self.high = self.high.max(moved);
            }
        }
    }

    fn distance(&self, point: DVec3) -> f64 {
        let nearest = point.truncate().clamp(self.low, self.high);
        point.distance(nearest.extend(self.plane_z))
    }
}
