//! Builds a tree of swept spheres: fits them to triangles, and splits sets of triangles.

use super::{Node, NodeContent, SphereTree, principal_axes};
use crate::method::rival::Placement;
use crate::method::rival::triangles_apart::Triangle;
use ccd_core::glam::{DMat3, DVec2, DVec3};
use ccd_core::order::greater;
use std::ops::Range;

/// The relative increase of radii, which covers the rounding here and in computations with the tree.
const ROUNDING: f64 = 1e-14;

/// Builds the tree over triangles, and sorts these into the order of the leaves.
pub(super) fn build_tree(mut triangles: Vec<Triangle>) -> SphereTree {
    let mut tree = SphereTree {
        nodes: Vec::with_capacity(2 * triangles.len()),
        frames: Vec::with_capacity(2 * triangles.len()),
        triangles: Vec::new(),
    };
    let mut waiting = Vec::new();
    if !triangles.is_empty() {
        let frame = tree.push(&triangles, &WORLD);
        waiting.push((0, 0..triangles.len(), frame));
    }
    while let Some((node, range, frame)) = waiting.pop() {
        if range.len() == 1 {
            tree.nodes[node].below = NodeContent::Triangle(range.start as u32);
            continue;
        }
        let middle = partition(&mut triangles, range.clone(), frame.rotation.x_axis);
        let first = tree.nodes.len();
        tree.nodes[node].below = NodeContent::Children(first as u32);
        for (k, range) in [range.start..middle, middle..range.end]
            .into_iter()
            .enumerate()
        {
            let child = tree.push(&triangles[range.clone()], &frame);
            waiting.push((first + k, range, child));
        }
    }
    tree.triangles = triangles;
    tree
}

const WORLD: Placement = Placement {
    rotation: DMat3::IDENTITY,
    translation: DVec3::ZERO,
};

impl SphereTree {
    fn push(&mut self, triangles: &[Triangle], parent: &Placement) -> Placement {
        let (frame, lengths, radius) = fit(triangles);
        self.nodes.push(Node {
            placement: frame.seen_from(parent),
            lengths,
            radius,
            below: NodeContent::Triangle(0),
        });
        self.frames.push(frame);
        frame
    }
}

/// Moves triangles whose centres are below the mean along an axis to the front. Returns their number.
fn partition(triangles: &mut [Triangle], range: Range<usize>, axis: DVec3) -> usize {
    /// The smallest share of the triangles that a side may get.
    const LEAST_SHARE: f64 = 1.0 / 16.0;

    let part = &mut triangles[range.clone()];
    let along = |t: &Triangle| (t[0] + t[1] + t[2]).dot(axis);
    let count = part.len();
    let mean = part.iter().map(along).sum::<f64>() / count as f64;
    part.sort_unstable_by(|s, t| along(s).total_cmp(&along(t)));
    let below = part.partition_point(|t| along(t) < mean);
    let few = greater(1.0, LEAST_SHARE * count as f64) as usize;
    let below = if (few..=count - few).contains(&below) {
        below
    } else {
        count / 2
    };
    range.start + below
}

/// Fits a rectangle across the direction in which the triangles are thinnest, and returns it with the required radius
/// \[PQP99 §3\].
fn fit(triangles: &[Triangle]) -> (Placement, DVec2, f64) {
    let (_, axes) = principal_axes(triangles.iter().flatten().copied());
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
        middle,
        radius,
    };
    points().for_each(|p| shape.reach_sides(p));
    shape.repair_crossed_sides();
    points().for_each(|p| shape.reach_corner(p));
    let farthest = points().map(|p| shape.distance(p)).fold(radius, greater);
    let extent = triangles
        .iter()
        .flatten()
        .fold(0.0, |most, p| greater(most, p.abs().max_element()));
    let frame = Placement {
        rotation: axes,
        translation: axes * shape.low.extend(middle),
    };
    (frame, shape.high - shape.low, farthest + ROUNDING * extent)
}

/// A rectangle in the plane z = `middle` that grows until all points are within the radius of it.
struct GrowingRectangle {
    low: DVec2,
    high: DVec2,
    middle: f64,
    radius: f64,
}

impl GrowingRectangle {
    /// Returns how far from a point's foot in the plane the rectangle may end with the point still within the radius.
    fn foot_radius(&self, point: DVec3) -> f64 {
        let up = point.z - self.middle;
        greater(0.0, self.radius * self.radius - up * up).sqrt()
    }

    /// Moves each side outwards until a point is within the radius of the line along that side.
    fn reach_sides(&mut self, point: DVec3) {
        let reach = self.foot_radius(point);
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
    fn reach_corner(&mut self, point: DVec3) {
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
            let reach = self.foot_radius(point);
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
        point.distance(nearest.extend(self.middle))
    }
}
