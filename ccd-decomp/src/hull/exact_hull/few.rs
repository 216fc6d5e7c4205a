//! The hull of few points: each is held against all facets, without lists of who sees what.

use super::plane::{Places, Plane};
use ccd_core::glam::DVec3;

/// The facets of the hull of points that span a volume, from a triangle and a point behind it on.
///
/// O(n²), with next to no memory: for few points faster than anything else.
pub(super) fn facets(points: &[DVec3], simplex: [u32; 4]) -> Vec<[u32; 3]> {
    let hull = Growing::all(points, simplex);
    hull.facets.into_iter().map(|facet| facet.corners).collect()
}

struct Growing<'a> {
    places: Places<'a>,
    facets: Vec<Facet>,
}

struct Facet {
    corners: [u32; 3],
    plane: Plane,
}

impl<'a> Growing<'a> {
    fn all(points: &'a [DVec3], simplex: [u32; 4]) -> Self {
        let [a, b, c, d] = simplex;
        let mut hull = Growing {
            places: Places::new(points),
            facets: Vec::with_capacity(2 * points.len()),
        };
        for corners in [[a, b, c], [b, a, d], [c, b, d], [a, c, d]] {
            hull.push(corners);
        }
        let mut edges = Vec::with_capacity(4 * points.len());
        for v in (0..points.len() as u32).filter(|v| !simplex.contains(v)) {
            hull.insert(v, &mut edges);
        }
        hull
    }

    fn push(&mut self, corners: [u32; 3]) {
        let plane = self.places.plane(corners);
        self.facets.push(Facet { corners, plane });
    }

    /// Replaces what a point sees by a fan from its rim; `edges` is there to be used again.
    fn insert(&mut self, v: u32, edges: &mut Vec<(u32, u32)>) {
        edges.clear();
        let places = &self.places;
        self.facets.retain(|&Facet { corners, ref plane }| {
            let seen = places.is_in_front(plane, corners, v);
            if seen {
                let [a, b, c] = corners;
                edges.extend([(a, b), (b, c), (c, a)]);
            }
            !seen
        });
        for &(a, b) in edges.iter() {
            if !edges.contains(&(b, a)) {
                self.push([a, b, v]);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hull::exact_hull::{ExactHull, conflicts};
    use crate::hull::polygons::polygons;
    use proptest::prelude::*;

    proptest! {
        /// Few points have the polygons that many have, on grids and slightly off them.
        #[test]
        fn few_points_have_the_hull_of_many(
            points in prop::collection::vec(prop::array::uniform3(-2_i8..=2), 4..24),
            off in prop::collection::vec(prop::array::uniform3(-1.0..1.0), 24),
            size in prop::sample::select(vec![0.0, 1e-16, 1e-12, 0.5]),
        ) {
            let shaken = |(p, off): (&[i8; 3], &[f64; 3])| {
                DVec3::from_array(p.map(f64::from)) + size * DVec3::from_array(*off)
            };
            let points: Vec<DVec3> = points.iter().zip(&off).map(shaken).collect();
            let Some(simplex) = ExactHull::simplex(&points) else { return Ok(()) };
            let sorted = |triangles: Vec<[u32; 3]>| {
                let mut loops: Vec<Vec<[u64; 3]>> = Vec::new();
                for polygon in polygons(&points, &triangles) {
                    // Of points at one place either hull takes any.
                    let place = |&v: &u32| points[v as usize].to_array().map(|x| (x + 0.0).to_bits());
                    let mut corners: Vec<[u64; 3]> = polygon.corners.iter().map(place).collect();
                    let least = (0..corners.len()).min_by_key(|&k| corners[k]).unwrap();
                    corners.rotate_left(least);
                    loops.push(corners);
                }
                loops.sort();
                loops
            };
            let few = sorted(facets(&points, simplex));
            prop_assert_eq!(few, sorted(conflicts::facets(&points, simplex)));
        }
    }
}
