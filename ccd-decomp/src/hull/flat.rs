//! Exact hulls of coplanar points.

use super::hull_from_facets;
use crate::exact::predicates::{Projection, compare_lexicographically, is_degenerate};
use ccd_core::glam::DVec3;
use ccd_core::{Hull, PolygonList};
use std::cmp::Ordering;

/// Computes the hull of distinct coplanar points: a polygon with two opposite facets or, for points on a line, the two
/// end points.
pub(super) fn hull(points: &[DVec3]) -> Hull {
    let by_order = |p: &DVec3, q: &DVec3| compare_lexicographically(*p, *q);
    let ends = [
        points.iter().copied().min_by(by_order),
        points.iter().copied().max_by(by_order),
    ];
    let mut ends: Vec<DVec3> = ends.into_iter().flatten().collect();
    ends.dedup();
    let plane = match ends[..] {
        [a, b] => projection_of_plane([a, b], points),
        _ => None,
    };
    match plane {
        Some(projection) => hull_from_facets(points, facets(points, projection)),
        None => Hull {
            points: ends,
            facets: PolygonList::default(),
        },
    }
}

/// Returns a projection of the plane that contains some points; `None` if all points are on a line. `a` and `b` are two
/// of the points.
fn projection_of_plane([a, b]: [DVec3; 2], points: &[DVec3]) -> Option<Projection> {
    let area = |p: &DVec3| (b - a).cross(*p - a).length_squared();
    let is_proper = |p: &DVec3| !is_degenerate([a, b, *p]);
    // A far point makes a large triangle; any will do.
    let points = points.iter().copied();
    let far = points
        .clone()
        .max_by(|p, q| area(p).total_cmp(&area(q)))
        .filter(is_proper);
    let corner = far.or_else(|| points.clone().find(is_proper))?;
    Projection::new([a, b, corner])
}

/// Computes the front and the back facet of a flat hull, by Andrew's monotone chain algorithm.
fn facets(points: &[DVec3], projection: Projection) -> PolygonList {
    let at = |k: u32| points[k as usize];
    let mut order: Vec<u32> = (0..points.len() as u32).collect();
    order.sort_unstable_by(|&v, &w| compare_lexicographically(at(v), at(w)));
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
    PolygonList::from_iter([front, back])
}
