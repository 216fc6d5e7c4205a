//! Computes test points on a thin piece, next to the edges of another piece that lie on it.

use crate::body::facets::edges_of;
use crate::body::piece::Piece;
use crate::math::order::{greater, lesser};
use crate::math::vector::{unit_or_any, vector_perpendicular_to_both};
use crate::rounding::EDGE_PROBE_DISTANCE_SHARE;
use glam::DVec3;

/// Returns points on a thin piece, next to the edges of `other` that lie on it: two for each edge, on either side of
/// the middle of the common part. An edge counts as on the piece if it leaves its plane by at most `reach`.
///
/// A surface that passes through a piece's inside, without any of its faces intersecting it, does
/// so along such edges. For a part that is entirely in the plane, the faces beyond its edges
/// decide.
pub(crate) fn points_beside_edges(
    piece: &Piece<'_>,
    other: &Piece<'_>,
    place: impl Fn(DVec3) -> DVec3 + Copy,
    reach: f64,
) -> impl Iterator<Item = DVec3> {
    let flat = FlatOutline::from_piece(piece);
    let placed = move |k: u32| place(other.points[k as usize]);
    let is_level = move |flat: &FlatOutline<'_>, at: DVec3| flat.height(at).abs() <= reach;
    // For a piece within the plane, the faces beyond the edges decide.
    let passes = move |flat: &FlatOutline<'_>| {
        let mut all = 0..other.points.len() as u32;
        !all.all(|k| is_level(flat, placed(k)))
    };
    flat.filter(passes).into_iter().flat_map(move |flat| {
        let ends = edges(other).map(move |edge| edge.map(placed));
        let level = ends.filter(move |ends| ends.iter().all(|&at| is_level(&flat, at)));
        level
            .filter_map(move |ends| flat.points_beside_edge(ends))
            .flatten()
            .filter(move |&point| flat.contains_point(point))
    })
}

/// The outline of a thin piece: its largest facet, or its points in order.
#[derive(Clone, Copy)]
struct FlatOutline<'a> {
    outline_points: &'a [DVec3],
    /// The indices of the outline's corners in `outline_points`; `None` if every point is a corner, in the given order.
    corners: Option<&'a [u32]>,
    normal: DVec3,
}

impl<'a> FlatOutline<'a> {
    /// Returns the outline of a piece; `None` for a piece with fewer than three corners.
    fn from_piece(piece: &Piece<'a>) -> Option<Self> {
        let spread = |corners: &[u32]| match *corners {
            [a, b, c, ..] => {
                let [a, b, c] = [a, b, c].map(|k| piece.points[k as usize]);
                (b - a).cross(c - a).length_squared()
            }
            _ => 0.0,
        };
        let larger = |one, other| {
            let is_larger = spread(other) > spread(one);
            if is_larger { other } else { one }
        };
        let mut flat = FlatOutline {
            outline_points: piece.points,
            corners: piece.facets.iter().reduce(larger),
            normal: DVec3::ZERO,
        };
        if flat.corner_count() < 3 {
            return None;
        }
        let [a, b, c] = [0, 1, 2].map(|k| flat.corner(k));
        flat.normal = unit_or_any(vector_perpendicular_to_both(b - a, c - a));
        Some(flat)
    }

    fn corner_count(&self) -> usize {
        self.corners.map_or(self.outline_points.len(), <[u32]>::len)
    }

    fn corner(&self, k: usize) -> DVec3 {
        let k = self.corners.map_or(k, |corners| corners[k] as usize);
        self.outline_points[k]
    }

    fn height(&self, point: DVec3) -> f64 {
        self.normal.dot(point - self.corner(0))
    }

    /// Returns for each edge of the outline its first corner, and a vector perpendicular to the edge that points
    /// inward.
    fn side_half_planes(&self) -> impl Iterator<Item = (DVec3, DVec3)> {
        let count = self.corner_count();
        (0..count).map(move |k| {
            let (from, to) = (self.corner(k), self.corner((k + 1) % count));
            (from, self.normal.cross(to - from))
        })
    }

    fn contains_point(&self, point: DVec3) -> bool {
        self.side_half_planes()
            .all(|(from, inward)| inward.dot(point - from) > 0.0)
    }

    /// Returns two points, one on either side of an edge, next to the middle of the edge's part inside the outline;
    /// `None` if no part is inside.
    fn points_beside_edge(&self, [from, to]: [DVec3; 2]) -> Option<[DVec3; 2]> {
        let way = to - from;
        let (mut enter, mut leave) = (0.0, 1.0);
        for (side, inward) in self.side_half_planes() {
            let (depth, speed) = (inward.dot(from - side), inward.dot(way));
            match () {
                () if speed > 0.0 => enter = greater(enter, -depth / speed),
                () if speed < 0.0 => leave = lesser(leave, -depth / speed),
                () if depth < 0.0 => leave = f64::NEG_INFINITY,
                () => {}
            }
        }
        (leave > enter).then(|| {
            let middle = from + way * (0.5 * (enter + leave));
            let beside = self.normal.cross(way) * (EDGE_PROBE_DISTANCE_SHARE * (leave - enter));
            [middle + beside, middle - beside]
        })
    }
}

/// Returns the edges of a piece as pairs of point indices; each edge occurs at least once.
fn edges<'a>(piece: &Piece<'a>) -> impl Iterator<Item = [u32; 2]> + use<'a> {
    // Without facets, the points are in their order.
    let points = if piece.facets.is_empty() {
        piece.points.len() as u32
    } else {
        0
    };
    let outline = (0..points).map(move |k| [k, (k + 1) % points]);
    let shared = piece.facets.iter().flat_map(edges_of);
    let shared = shared.filter(|(from, to)| from < to);
    outline.chain(shared.map(|(from, to)| [from, to]))
}

#[cfg(test)]
mod tests;
