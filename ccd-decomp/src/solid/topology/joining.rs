//! Finds meshes whose open edges would close if vertices that nearly meet were joined, as at the seam of a round surface.

use crate::disjoint_sets::DisjointSets;
use crate::half_edges::{EdgeUse, SortedHalfEdges};
use crate::mesh::TriangleMesh;
use crate::tolerance::JOINING_DISTANCE_PER_SIZE;
use ccd_core::glam::{DVec3, dvec3};
use ccd_core::order::greater;
use ccd_core::vector::length;

/// A direction in which points on the planes, circles and seams of usual meshes have different heights.
const DIRECTION: DVec3 = dvec3(0.5377, 0.6123, 0.5796);

/// The number of vertices above one that are compared with it, which keeps the time linear in meshes of many vertices at
/// nearly one place.
const MAX_COMPARED_VERTICES: usize = 64;

/// Returns the largest distance between vertices on edges with a single face that have to be joined, so that every edge
/// has equally many faces in both directions; `None` if that takes more than [`JOINING_DISTANCE_PER_SIZE`].
pub(super) fn joining_distance(mesh: &TriangleMesh, edges: &SortedHalfEdges) -> Option<f64> {
    let single = edges.iter().filter(|(_, uses)| uses.len() == 1);
    let mut open: Vec<u32> = single.flat_map(|(ends, _)| ends).collect();
    open.sort_unstable();
    open.dedup();
    let point = |v: u32| mesh.vertices()[v as usize];
    let [low, high] = mesh.bounding_box();
    let limit = JOINING_DISTANCE_PER_SIZE * (high - low).max_element();
    let height = |v: u32| point(v).dot(DIRECTION);
    open.sort_unstable_by(|&v, &w| height(v).total_cmp(&height(w)));
    let mut joined = DisjointSets::new(mesh.vertices().len());
    let mut farthest: f64 = 0.0;
    for (k, &v) in open.iter().enumerate() {
        let above = open[k + 1..].iter().take(MAX_COMPARED_VERTICES);
        for &w in above.take_while(|&&w| height(w) - height(v) <= limit) {
            let distance = length(point(w) - point(v));
            if distance <= limit {
                joined.join(v, w);
                farthest = greater(farthest, distance);
            }
        }
    }
    let mut faces = mesh.welded_faces();
    for corner in faces.iter_mut().flatten() {
        *corner = joined.root(*corner);
    }
    let is_balanced = |(_, uses): ([u32; 2], &[EdgeUse])| {
        2 * uses.iter().filter(|of| of.is_backward).count() == uses.len()
    };
    (farthest > 0.0 && SortedHalfEdges::new(&faces).iter().all(is_balanced)).then_some(farthest)
}
