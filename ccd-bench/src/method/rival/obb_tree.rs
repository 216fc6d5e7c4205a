//! A tree of oriented boxes over the triangles of a mesh.

mod overlap;
#[cfg(test)]
mod tests;

use ccd_core::order::greater;
pub(super) use overlap::trees_intersect;

use super::principal_axes::mean_and_principal_axes;
use super::tree::{NodeContent, build_binary_tree};
use ccd_core::glam::{DMat3, DVec3};
use ccd_decomp::TriangleMesh;

/// A binary tree of oriented boxes over the triangles of a mesh. Each box is fitted to the spread of its triangles'
/// corners \[OBBTREE96 §4\] and split at their mean.
///
/// Corners and boxes are relative to [`ObbTree::origin`], the middle of the root's box, so that
/// rotation about it moves them little.
#[derive(Clone, Debug)]
pub(super) struct ObbTree {
    /// The origin of the boxes' coordinates, in the mesh's frame.
    pub(super) origin: DVec3,
    /// The largest distance of a triangle's corner from the origin.
    radius_about_origin: f64,
    /// The nodes of the tree, the root first.
    nodes: Vec<Node>,
    triangles: Vec<[DVec3; 3]>,
}

/// An oriented box, with the child nodes or the triangle in it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Node {
    pub(super) bounds: Obb,
    pub(super) content: NodeContent,
}

/// An oriented box: its center, axes and half extents.
#[derive(Clone, Copy, Debug)]
pub(super) struct Obb {
    /// The unit axes of the box, as columns. The longest is first if the box is fitted well.
    pub(super) axes: DMat3,
    pub(super) center: DVec3,
    pub(super) half_extents: DVec3,
}

impl ObbTree {
    /// Builds the tree of a mesh, with one leaf per triangle.
    pub(super) fn new(mesh: &TriangleMesh) -> Self {
        let corners = |face: &[u32; 3]| face.map(|v| mesh.vertices()[v as usize]);
        let mut triangles: Vec<[DVec3; 3]> = mesh.faces().iter().map(corners).collect();
        let origin = Obb::fit_mean_and_box(&triangles).1.center;
        for corner in triangles.iter_mut().flatten() {
            *corner -= origin;
        }
        let lengths = triangles.iter().flatten().map(|corner| corner.length());
        let radius = lengths.fold(0.0, greater);
        let nodes = build_binary_tree(
            &mut triangles,
            |triangles, _| Obb::fit_mean_and_box(triangles),
            |triangles, (mean, bounds)| partition_triangles(triangles, *mean, bounds.axes),
        );
        let node = |((_, bounds), content)| Node { bounds, content };
        ObbTree {
            origin,
            radius_about_origin: radius,
            nodes: nodes.into_iter().map(node).collect(),
            triangles,
        }
    }

    /// Returns the node with the given index.
    #[inline]
    pub(super) fn node(&self, index: u32) -> &Node {
        &self.nodes[index as usize]
    }

    /// Returns the corners of the triangle with the given index.
    #[inline]
    pub(super) fn triangle(&self, index: u32) -> &[DVec3; 3] {
        &self.triangles[index as usize]
    }

    /// Returns an upper bound of the distance of the mesh's points from a point in its frame.
    pub(super) fn radius_bound_about(&self, from: DVec3) -> f64 {
        self.origin.distance(from) + self.radius_about_origin
    }
}

impl Obb {
    /// Returns the mean of the triangles' corners, and the box around them along their principal axes.
    fn fit_mean_and_box(triangles: &[[DVec3; 3]]) -> (DVec3, Self) {
        let points = triangles.iter().flatten().copied();
        let (mean, axes) = mean_and_principal_axes(points.clone());
        let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        for point in points {
            let along = axes.transpose_mul_vec3(point - mean);
            low = low.min(along);
            high = high.max(along);
        }
        let bounds = Obb {
            axes,
            center: mean + axes * (0.5 * (low + high)),
            half_extents: 0.5 * (high - low),
        };
        (mean, bounds)
    }
}

/// Partitions triangles by the side of the mean on which their centers lie along the box's longest axis. If all lie on
/// one side, the next axis is used, and halves if no axis splits them. Returns the number of triangles in the first
/// part.
fn partition_triangles(triangles: &mut [[DVec3; 3]], mean: DVec3, axes: DMat3) -> usize {
    for axis in [axes.x_axis, axes.y_axis, axes.z_axis] {
        let before = |t: &[DVec3; 3]| (t[0] + t[1] + t[2] - 3.0 * mean).dot(axis) < 0.0;
        let mut count = 0;
        for k in 0..triangles.len() {
            if before(&triangles[k]) {
                triangles.swap(count, k);
                count += 1;
            }
        }
        if (1..triangles.len()).contains(&count) {
            return count;
        }
    }
    triangles.len() / 2
}
