//! Where a tree of boxes splits triangles.

use crate::bounds::Bounds;
use crate::stop::{Stop, sort};

/// A part that is so many splits deep is halved: until then splits may be as uneven as they like. The checker has a limit of 100.
const MOST_UNEVEN: usize = 60;

/// Orders triangles, of which there is more than one, and returns how many of them the first part has: such that the areas of the
/// boxes of both parts, times their numbers of triangles, have the least sum of all splits along an axis of the mesh.
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
        let first = prices(boxes, triangles.iter());
        let second = prices(boxes, triangles.iter().rev());
        // The first price is that of one triangle, the last one that of all.
        let sums = first
            .iter()
            .zip(second.iter().rev().skip(1))
            .map(|(a, b)| a + b);
        for (price, count) in sums.zip(1..) {
            if price < best.0 {
                best = (price, axis, count);
            }
        }
    }
    let (_, axis, count) = best;
    sort_along(boxes, triangles, axis, stop)?;
    Ok(if depth < MOST_UNEVEN { count } else { half })
}

/// Returns the areas of the boxes of the first triangle, the first two and so on, times their number.
fn prices<'a>(boxes: &[Bounds], triangles: impl Iterator<Item = &'a u32>) -> Vec<f64> {
    let ordered = triangles.map(|&number| &boxes[number as usize]);
    let growing = ordered.scan(None, |all: &mut Option<Bounds>, one| {
        *all = Some(all.map_or(*one, |all| all.with(one)));
        *all
    });
    growing
        .zip(1u32..)
        .map(|(all, count)| all.area() * f64::from(count))
        .collect()
}

fn sort_along<S: Stop>(
    boxes: &[Bounds],
    triangles: &mut [u32],
    axis: usize,
    stop: S,
) -> Result<(), S::Stopped> {
    let middle = |number: u32| boxes[number as usize].middle()[axis];
    let compare = |a: &u32, b: &u32| middle(*a).total_cmp(&middle(*b)).then(a.cmp(b));
    sort(triangles, compare, stop)
}
