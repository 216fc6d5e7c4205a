//! Splits the triangles of a node of a bounding box tree.

use crate::bounds::Bounds;
use crate::stop::{Stop, sort};

/// The depth from which on each split halves the number of triangles. This bounds the depth of the tree. The checker's limit is 100.
const MAX_UNEVEN_DEPTH: usize = 60;

/// Splits the triangles of a node, at least two, between its children. Orders the triangles, and returns the number of triangles of the
/// first child.
///
/// The candidates are all splits along a coordinate axis. The function chooses the split with the least cost by the surface area
/// heuristic: the sum over both children of the box's area times the number of triangles.
pub(crate) fn split<S: Stop>(
    boxes: &[Bounds],
    triangles: &mut [u32],
    depth: usize,
    stop: S,
) -> Result<usize, S::Stopped> {
    let half = triangles.len() / 2;
    let mut best = (f64::INFINITY, 0, half);
    for axis in 0..3 {
        sort_along(boxes, triangles, axis, stop)?;
        let first = costs(boxes, triangles.iter());
        let second = costs(boxes, triangles.iter().rev());
        // `first[k]` is the cost of the first k + 1 triangles, and `second[k]` is the cost of the last k + 1 triangles.
        let sums = first
            .iter()
            .zip(second.iter().rev().skip(1))
            .map(|(a, b)| a + b);
        for (cost, count) in sums.zip(1..) {
            if cost < best.0 {
                best = (cost, axis, count);
            }
        }
    }
    let (_, axis, count) = best;
    sort_along(boxes, triangles, axis, stop)?;
    Ok(if depth < MAX_UNEVEN_DEPTH {
        count
    } else {
        half
    })
}

/// Returns, for each k from 1 on, the cost of the first k triangles: k times the area of their box.
fn costs<'a>(boxes: &[Bounds], triangles: impl Iterator<Item = &'a u32>) -> Vec<f64> {
    let ordered = triangles.map(|&triangle| &boxes[triangle as usize]);
    let growing = ordered.scan(None, |union: &mut Option<Bounds>, bounds| {
        *union = Some(union.map_or(*bounds, |union| union.union(bounds)));
        *union
    });
    growing
        .zip(1u32..)
        .map(|(union, count)| union.area() * f64::from(count))
        .collect()
}

/// Sorts triangles by the centers of their boxes along a coordinate axis.
fn sort_along<S: Stop>(
    boxes: &[Bounds],
    triangles: &mut [u32],
    axis: usize,
    stop: S,
) -> Result<(), S::Stopped> {
    let center = |triangle: u32| boxes[triangle as usize].center()[axis];
    let compare = |a: &u32, b: &u32| center(*a).total_cmp(&center(*b)).then(a.cmp(b));
    sort(triangles, compare, stop)
}
