//! Decides whether one body is inside the other's solid at the start, if no two pieces intersect.

mod beside;

use crate::answer::{Limit, Outcome, Overlap};
use crate::body::Body;
use crate::body::shell::ExtremePoints;
use crate::body::tree::point_query::is_far_from_surface;
use crate::body::tree::ray::sum_signed_crossings;
use crate::math::vector::{unit_or_any, vector_perpendicular_to_both};
use crate::motion::pose::Frame;
use crate::problem::Problem;
use crate::rounding::CERTAIN_SIDE_DISTANCE_PER_ROUNDING;
use beside::points_beside_edges;
use glam::DVec3;

/// Returns the outcome if a point of one body is inside the other body's solid at the start, or if that is undecided.
/// `touching` are the pairs of pieces without a separating axis; no pair intersects. The list `pieces` is scratch
/// memory.
///
/// # Guarantee
/// A point that is found is inside, by more than rounding. If none is found, the following parts
/// are not inside:
/// - any connected part of a body that touches the other nowhere: one point decides for all of it;
/// - the rest of the other parts, without the pieces that touch: it consists of pieces that each
///   share a corner with one that touches, and all corners of those are examined;
/// - thick pieces that touch: the middle decides, as no face passes through;
/// - thin and flat pieces that touch: examined at their corners, at the middle or a point on the side of
///   their own solid, and next to every edge of the other body that is on them, where a surface can pass
///   through a piece without a face that intersects it.
///
/// A part that is inside by less than rounding is not distinguished from one that touches. The same
/// holds for a part within a thousandth of an edge's length from that edge.
///
/// O((parts + pairs that touch) · log n) where rays meet few triangles.
pub(crate) fn containment_at_start(
    problem: &Problem<'_>,
    touching: &[[u32; 2]],
    pieces: &mut Vec<u32>,
) -> Option<Outcome> {
    if !(problem.a.body.may_be_hollow() || problem.b.body.may_be_hollow()) {
        return None;
    }
    let [a, b] = [&problem.a, &problem.b].map(|side| PlacedBody {
        body: side.body,
        frame: side.path.frame(0.0),
    });
    let reach = CERTAIN_SIDE_DISTANCE_PER_ROUNDING * problem.rounding;
    let mut look = |outer: &PlacedBody<'_>, inner: &PlacedBody<'_>, side: usize| {
        let search = Search {
            outer_body: outer,
            inner_body: inner,
            undecided_distance: reach,
        };
        if outer.body.may_be_hollow() {
            let pairs = touching.iter().map(|pair| [pair[side], pair[1 - side]]);
            search.find_part_inside(pairs, pieces)
        } else {
            ContainmentResult::NotInside
        }
    };
    let result = [look(&b, &a, 0), look(&a, &b, 1)];
    let inside = |overlap| Some(Outcome::from_overlap(overlap));
    match result {
        [ContainmentResult::Inside(p), _] => inside(Overlap::AInsideB(problem.to_world_point(p))),
        [_, ContainmentResult::Inside(p)] => inside(Overlap::BInsideA(problem.to_world_point(p))),
        [ContainmentResult::NotInside, ContainmentResult::NotInside] => None,
        _ => Some(Outcome::unresolved(0.0, Limit::OverlapUndecided)),
    }
}

/// A body, with its frame at the start of the query.
struct PlacedBody<'a> {
    body: &'a Body,
    frame: Frame,
}

/// A search for a point of one body, the inner one, inside the solid of the other, the outer one.
struct Search<'a> {
    outer_body: &'a PlacedBody<'a>,
    inner_body: &'a PlacedBody<'a>,
    /// The distance from the outer surface below which a point counts as neither inside nor outside.
    undecided_distance: f64,
}

/// Whether a test found a point inside the outer body; the point is in the problem's coordinates.
#[derive(Clone, Copy)]
enum ContainmentResult {
    Inside(DVec3),
    NotInside,
    Undecided,
}

impl ContainmentResult {
    fn is_inside(&self) -> bool {
        matches!(self, ContainmentResult::Inside(_))
    }
}

impl Search<'_> {
    /// Tests whether a part or a piece of the inner body is inside the outer body; `touching` has the pairs of an inner
    /// and an outer piece that touch.
    fn find_part_inside(
        &self,
        touching: impl Iterator<Item = [u32; 2]> + Clone,
        pieces: &mut Vec<u32>,
    ) -> ContainmentResult {
        pieces.clear();
        pieces.extend(touching.clone().map(|[inner, _]| inner));
        pieces.sort_unstable();
        pieces.dedup();
        let mut result = ContainmentResult::NotInside;
        let parts = self.inner_body.body.part_extreme_points().iter();
        let of_parts = parts.map(|shell| self.classify_part(shell, pieces));
        let of_pieces = pieces.iter().map(|&piece| self.classify_piece(piece));
        for one in of_parts.chain(of_pieces) {
            match one {
                ContainmentResult::Inside(_) => return one,
                ContainmentResult::Undecided => result = one,
                ContainmentResult::NotInside => {}
            }
        }
        // Each piece is tested once: a hull of many facets may touch many pieces.
        pieces.retain(|&piece| self.has_known_outline(piece) && !self.is_thick(piece));
        let thin = touching.filter(|[inner, _]| pieces.binary_search(inner).is_ok());
        let inside = thin
            .map(|pair| self.classify_points_beside_edges(pair))
            .find(ContainmentResult::is_inside);
        inside.unwrap_or(result)
    }

    /// Tests whether a point, given in the inner body's frame, is inside the outer body.
    fn classify_point(&self, point: DVec3) -> ContainmentResult {
        let placed = self.inner_body.frame.transform_point(point);
        let there = self.outer_body.frame.inverse_transform_point(placed);
        match contains(self.outer_body.body, there, self.undecided_distance) {
            Some(true) => ContainmentResult::Inside(placed),
            Some(false) => ContainmentResult::NotInside,
            None => ContainmentResult::Undecided,
        }
    }

    /// Tests points one by one, until one is certainly inside or certainly outside.
    fn classify_first_decided_point(
        &self,
        points: impl IntoIterator<Item = DVec3>,
    ) -> ContainmentResult {
        let mut answers = points.into_iter().map(|p| self.classify_point(p));
        let told = answers.find(|result| !matches!(result, ContainmentResult::Undecided));
        told.unwrap_or(ContainmentResult::Undecided)
    }

    /// Tests whether an extreme point of a connected part of the inner body is inside the outer body. If all of them
    /// are on the outer surface, the touching pieces decide about the part.
    fn classify_part(&self, shell: &ExtremePoints, touching: &[u32]) -> ContainmentResult {
        let result = self.classify_first_decided_point(*shell);
        let pieces = self.inner_body.body.pieces();
        let touches = |&piece: &u32| pieces.get(piece as usize).points.contains(&shell[0]);
        match result {
            ContainmentResult::Undecided if touching.iter().any(touches) => {
                ContainmentResult::NotInside
            }
            _ => result,
        }
    }

    /// Tests whether a piece that touches the other body has a point inside that body. The tested points are the
    /// piece's corners, which pieces that do not touch share, and a point of the solid behind or in the piece.
    fn classify_piece(&self, piece: u32) -> ContainmentResult {
        let body = self.inner_body.body;
        let corners = match body.pieces().get(piece as usize) {
            // A single piece shares no corner: the middle decides if it is thick.
            _ if body.pieces().len() == 1 && self.is_thick(piece) => &[],
            piece => piece.points,
        };
        let mut inside = corners.iter().map(|&p| self.classify_point(p));
        if let Some(result) = inside.find(ContainmentResult::is_inside) {
            return result;
        }
        match body.interior_point(piece) {
            Some(point) => self.classify_first_decided_point([point]),
            // A point of a surface that is on the other's surface is not inside.
            None => match self.classify_point(body.mean_of_points(piece)) {
                ContainmentResult::Undecided => ContainmentResult::NotInside,
                result => result,
            },
        }
    }

    /// Returns whether the outline of a piece or of one of its facets is known.
    fn has_known_outline(&self, piece: u32) -> bool {
        let piece = self.inner_body.body.pieces().get(piece as usize);
        piece.is_flat() || !piece.facets.is_empty()
    }

    /// Returns whether the middle of a piece is inside the piece by more than rounding. A face through the middle would
    /// intersect the piece by more than that.
    fn is_thick(&self, piece: u32) -> bool {
        let middle = self.inner_body.body.mean_of_points(piece);
        let piece = self.inner_body.body.pieces().get(piece as usize);
        let is_above = |corners: &[u32]| {
            let [a, b, c] = [0, 1, 2].map(|k| piece.points[corners[k] as usize]);
            unit_or_any(vector_perpendicular_to_both(b - a, c - a))
                .dot(a - middle)
                .abs()
                > self.undecided_distance
        };
        piece.facets.len() > 2 && piece.facets.iter().all(is_above)
    }

    /// Tests whether a thin piece is inside the outer body next to an edge of `outer` that lies on the piece. Some of
    /// the tested points are next to faces.
    fn classify_points_beside_edges(&self, [inner, outer]: [u32; 2]) -> ContainmentResult {
        let piece = self.inner_body.body.pieces().get(inner as usize);
        let other = self.outer_body.body.pieces().get(outer as usize);
        let place = |p: DVec3| {
            self.inner_body
                .frame
                .inverse_transform_point(self.outer_body.frame.transform_point(p))
        };
        let points = points_beside_edges(&piece, &other, place, self.undecided_distance);
        let mut result = points.map(|p| self.classify_point(p));
        result
            .find(ContainmentResult::is_inside)
            .unwrap_or(ContainmentResult::NotInside)
    }
}

/// Returns whether the faces of a body have a nonzero winding number about a point in the body's frame; `None` if the
/// point is not certainly farther than `reach` from them.
fn contains(body: &Body, point: DVec3, reach: f64) -> Option<bool> {
    if !body.tree().may_contain(point) {
        return Some(false);
    }
    if !is_far_from_surface(body.tree(), body.pieces(), point, reach) {
        return None;
    }
    let result = sum_signed_crossings(body.tree(), body.pieces(), point, 0.0)?;
    (result.triangle_count_at_start == 0).then_some(result.sum_ahead != 0)
}

#[cfg(test)]
mod tests;
