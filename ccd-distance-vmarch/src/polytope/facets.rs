//! The facets of a piece, welded and connected along their sides, with their planes.

use crate::double_double::DoubleDoubleVector;
use ccd_core::glam::DVec3;
use ccd_core::order::greater;
use ccd_core::vector::{self, position_bits};

/// The polygons of a closed surface: every side occurs in reverse in another polygon.
#[derive(Debug)]
pub(crate) struct Facets {
    pub(crate) loops: Vec<Vec<u32>>,
    pub(crate) planes: Vec<Plane>,
    /// For each facet, the neighbouring facet across each of its sides, in the order of the sides.
    pub(crate) facets_across_sides: Vec<Vec<u32>>,
}

/// The plane and the width of a polygon.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Plane {
    /// The outward unit normal; zero for a polygon without area.
    pub(crate) normal: DVec3,
    pub(crate) area: f64,
    /// The area of the polygon over its longest side.
    pub(crate) area_per_longest_side: f64,
}

impl Facets {
    /// Welds equal points, drops facets with fewer than three remaining corners, and connects the rest; `None` if the
    /// surface is not closed.
    pub(crate) fn new<'a>(
        points: &[DVec3],
        loops: impl Iterator<Item = &'a [u32]>,
    ) -> Option<Self> {
        let welded = first_equal_point_indices(points);
        let mut kept: Vec<Vec<u32>> = Vec::new();
        for corners in loops {
            let corners = corners.iter().map(|&v| welded.get(v as usize).copied());
            let mut corners = corners.collect::<Option<Vec<u32>>>()?;
            corners.dedup();
            while corners.len() > 1 && corners.first() == corners.last() {
                corners.pop();
            }
            if corners.len() >= 3 {
                kept.push(corners);
            }
        }
        Self::from_loops(points, kept)
    }

    /// Connects polygons along their common edges; `None` unless they form a closed surface, on which each edge occurs
    /// once in each direction. No polygon may repeat a corner.
    pub(crate) fn from_loops(points: &[DVec3], loops: Vec<Vec<u32>>) -> Option<Self> {
        let mut sides: Vec<(u32, u32, u32)> = Vec::new();
        for (corners, facet) in loops.iter().zip(0..) {
            sides.extend(sides_of_loop(corners).map(|(v, w)| (v, w, facet)));
        }
        sides.sort_unstable();
        let twice = sides
            .windows(2)
            .any(|two| two[0].0 == two[1].0 && two[0].1 == two[1].1);
        if sides.is_empty() || twice {
            return None;
        }
        let holder = |v: u32, w: u32| {
            let found = sides.binary_search_by_key(&(v, w), |side| (side.0, side.1));
            found.ok().map(|at| sides[at].2)
        };
        let across =
            |corners: &Vec<u32>| sides_of_loop(corners).map(|(v, w)| holder(w, v)).collect();
        Some(Facets {
            facets_across_sides: loops.iter().map(across).collect::<Option<Vec<_>>>()?,
            planes: loops
                .iter()
                .map(|corners| Plane::new(points, corners))
                .collect(),
            loops,
        })
    }
}

impl Plane {
    /// Computes the plane from the area vector of a polygon, with exact differences of corners.
    pub(crate) fn new(points: &[DVec3], corners: &[u32]) -> Self {
        let at = |k: usize| points[corners[k] as usize];
        let mut sum = DoubleDoubleVector::default();
        for k in 1..corners.len() - 1 {
            let one = DoubleDoubleVector::difference(at(k), at(0));
            sum = sum + one.cross(DoubleDoubleVector::difference(at(k + 1), at(0)));
        }
        let area = sum.value();
        let normal = unit_or_zero(area);
        let sides =
            sides_of_loop(corners).map(|(v, w)| points[v as usize].distance(points[w as usize]));
        let (area, longest) = (0.5 * area.dot(normal), sides.fold(0.0, greater));
        Plane {
            normal,
            area,
            area_per_longest_side: if longest > 0.0 { area / longest } else { 0.0 },
        }
    }
}

/// Returns the sides of a polygon, as pairs of vertices.
pub(crate) fn sides_of_loop(corners: &[u32]) -> impl Iterator<Item = (u32, u32)> {
    let next = corners.iter().cycle().skip(1);
    corners.iter().copied().zip(next.copied())
}

/// Returns the unit vector along `v`, or zero if `v` has no direction.
pub(crate) fn unit_or_zero(v: DVec3) -> DVec3 {
    vector::unit(v).unwrap_or(DVec3::ZERO)
}

/// Returns the distance of a point from the line through two other points, or from the first of them if they are equal.
pub(crate) fn distance_from_line(p: DVec3, [start, end]: [DVec3; 2]) -> f64 {
    let along = DoubleDoubleVector::difference(end, start);
    let area = DoubleDoubleVector::difference(p, start)
        .cross(along)
        .value();
    let length = along.value().length();
    if length > 0.0 {
        area.length() / length
    } else {
        p.distance(start)
    }
}

/// Returns for every point the index of the first point at the same position.
fn first_equal_point_indices(points: &[DVec3]) -> Vec<u32> {
    let key = |v: u32| position_bits(points[v as usize]);
    let mut order: Vec<u32> = (0..points.len() as u32).collect();
    order.sort_unstable_by_key(|&v| (key(v), v));
    let mut welded: Vec<u32> = (0..points.len() as u32).collect();
    for two in order.windows(2) {
        if key(two[0]) == key(two[1]) {
            welded[two[1] as usize] = welded[two[0] as usize];
        }
    }
    welded
}
