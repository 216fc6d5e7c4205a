//! Exact hulls of coplanar points.

use crate::exact::predicates::{Projection, lexicographic};
use ccd_core::Loops;
use ccd_core::glam::DVec3;
use std::cmp::Ordering;

/// Computes the hull of points in the plane of one of their triangles, as a front and a back polygon (Andrew's monotone
/// chain).
pub(super) fn facets(points: &[DVec3], triangle: [usize; 3]) -> Loops {
    let at = |k: u32| points[k as usize];
    let Some(projection) = Projection::new(triangle.map(|k| points[k])) else {
        return Loops::default();
    };
    let mut order: Vec<u32> = (0..points.len() as u32).collect();
    order.sort_unstable_by(|&v, &w| lexicographic(at(v), at(w)));
    let chain = |order: &mut dyn Iterator<Item = u32>| {
        let mut chain: Vec<u32> = Vec::new();
        for next in order {
            while let [.., a, b] = chain[..]
                && projection.turn(at(a), at(b), at(next)) != Ordering::Greater
            {
                chain.pop();
            }
            chain.push(next);
        }
        // The last point starts the other chain.
        chain.pop();
        chain
    };
    let mut front = chain(&mut order.iter().copied());
    front.extend(chain(&mut order.iter().rev().copied()));
    let back = front.iter().rev().copied().collect();
    Loops::from_iter([front, back])
}
