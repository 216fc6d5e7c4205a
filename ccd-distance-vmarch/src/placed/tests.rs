use super::{PlacedPair, PlacedPolytope};
use crate::polytope::Polytope;
use crate::rational::{Exact3, exact_fraction};
use crate::tolerance::PLACEMENT_ERROR_BOUND;
use crate::worst::{RandomCase, WorstCaseSearch, error_fraction};
use ccd_core::glam::{DMat3, DQuat, DVec3};
use ccd_core::order::greater;
use ccd_core::{Frame, Piece};

/// Draws three random points around a common center, which may be far from the origin.
fn corners(tape: &mut RandomCase) -> [DVec3; 3] {
    let (middle, small) = (DVec3::from(tape.vector(-8..=4)), tape.size(-30..=0));
    [(); 3].map(|()| middle + DVec3::from(tape.vector(-8..=0)) * small)
}

/// Tests by exact fractions that the difference of two placed vertices has no rounding error above [`PLACEMENT_ERROR_BOUND`].
/// Errors of the rotation and translation are excluded: they move all vertices alike.
#[test]
fn worst_placing() {
    let found = WorstCaseSearch::new("PLACING", 6_000).search(|tape| {
        let points = [corners(tape), corners(tape)];
        let turn = DVec3::from(tape.vector(-8..=1));
        let frame = Frame {
            rotation: DMat3::from_quat(DQuat::from_scaled_axis(turn)),
            translation: DVec3::from(tape.vector(-8..=4)),
        };
        let pieces = points.each_ref().map(|points| Piece::from_points(points));
        let [a, b] = pieces.map(|piece| Polytope::new(&piece).ok());
        let (a, b) = (a?, b?);
        let placed = PlacedPair::new(&a, &b, &frame);
        // Corners keep the order of the points that have them.
        let (i, j) = (
            tape.index_below(a.vertices.len()),
            tape.index_below(b.vertices.len()),
        );
        let offset = placed.b.vertex(j as u32) - placed.a.vertex(i as u32);
        let given = |of: &Polytope, k: usize, all: &[DVec3; 3]| {
            let at = of.vertices[k].point + of.origin_in_piece;
            let nearer = |p: &&DVec3, q: &&DVec3| p.distance(at).total_cmp(&q.distance(at));
            *all.iter().min_by(nearer).expect("three points")
        };
        let [x, y] =
            [given(&a, i, &points[0]), given(&b, j, &points[1])].map(Exact3::from_coordinates);
        let columns = [0, 1, 2].map(|k| Exact3::from_coordinates(frame.rotation.col(k)));
        let to = Exact3::from_coordinates(placed.b.to_a.translation);
        let [x, y] = [
            x.minus(&Exact3::from_coordinates(a.origin_in_piece)),
            y.minus(&Exact3::from_coordinates(b.origin_in_piece)),
        ];
        let truth = [0, 1, 2].map(|k| {
            let row = Exact3([0, 1, 2].map(|l| columns[l].0[k].clone()));
            row.dot(&y) + &to.0[k] - &x.0[k]
        });
        let off = [0, 1, 2].map(|k| (exact_fraction(offset[k]) - &truth[k]).to_f64().value());
        let off = DVec3::from(off).length();
        // Points that coincide up to rounding may be swapped.
        let size = placed.scale.size;
        let apart = |p: [DVec3; 3]| [p[0] - p[1], p[1] - p[2], p[2] - p[0]].map(DVec3::length);
        let least = points.map(|p| {
            apart(p)
                .into_iter()
                .fold(f64::INFINITY, |a, b| -greater(-a, -b))
        });
        (least[0] > 1e-12 * size && least[1] > 1e-12 * size)
            .then(|| error_fraction(off, PLACEMENT_ERROR_BOUND * size))
    });
    found.assert_tight_bound(40.0);
}
