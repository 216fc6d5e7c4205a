//! Oracles for tests: a slow one for pieces of up to three points, and one that returns false claims.

use super::nearest::{Triangle, nearest_points, point};
use crate::body::piece::ConvexCombination;
use crate::distance::oracle::{Claim, DistanceOracle, GiveUpReason, PiecePair};
use crate::distance::separation::support_gap;
use glam::DVec3;

/// A slow oracle for pieces of up to three points, which compares all pairs of their vertices, edges and faces. Balls
/// and capsules are represented by their cores.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct ExhaustiveOracle;

impl DistanceOracle for ExhaustiveOracle {
    type Cache = ();

    fn separation(&mut self, pair: &PiecePair<'_>, _: &mut ()) -> Result<Claim, GiveUpReason> {
        let (Some(a), Some(b)) = (to_triangle(pair.a.points), to_triangle(pair.b.points)) else {
            return Err(GiveUpReason::TooManyPoints);
        };
        let b_in_a = b.map(|p| pair.b_to_a.transform_point(p));
        let found = nearest_points(&a, &b_in_a);
        let way = point(&b_in_a, found.b) - point(&a, found.a);
        Ok(Claim {
            axis: widest_gap_axis(pair, way, &a, &b_in_a),
            a: convex_combination(found.a, pair.a.points.len()),
            b: convex_combination(found.b, pair.b.points.len()),
        })
    }
}

/// Returns the axis along which two triangles have the widest gap, among a list of candidates. These are the vector
/// between the nearest points, its components perpendicular to an edge, the normals, and the cross products of edges.
fn widest_gap_axis(pair: &PiecePair<'_>, way: DVec3, a: &Triangle, b: &Triangle) -> DVec3 {
    let edges = |t: &Triangle| [t[1] - t[0], t[2] - t[1], t[0] - t[2]];
    let normal = |t: &Triangle| (t[1] - t[0]).cross(t[2] - t[0]);
    let mut axes = vec![way, normal(a), normal(b)];
    for e in edges(a) {
        axes.extend(edges(b).map(|f| e.cross(f)));
    }
    // The vector between corners that are very near is rounded: tilted towards a long edge it has no gap.
    axes.extend(
        [edges(a), edges(b)]
            .as_flattened()
            .iter()
            .map(|e| e.cross(way).cross(*e)),
    );
    let gap = |n: DVec3| support_gap(pair, n, a[0]);
    let candidates = axes.iter().filter_map(|n| n.try_normalize());
    candidates
        .flat_map(|n| [n, -n])
        .max_by(|m, n| gap(*m).total_cmp(&gap(*n)))
        .unwrap_or(DVec3::X)
}

/// Converts up to three points to a triangle, with the last point repeated.
fn to_triangle(points: &[DVec3]) -> Option<Triangle> {
    let last = points.len().checked_sub(1)?;
    (points.len() <= 3).then(|| std::array::from_fn(|k| points[k.min(last)]))
}

fn convex_combination(weights: [f64; 3], points: usize) -> ConvexCombination {
    let mut out = ConvexCombination::EMPTY;
    for (k, weight) in weights.into_iter().enumerate() {
        out.add_weighted_point(k.min(points - 1) as u32, weight);
    }
    out
}

/// An oracle that always returns the same claim.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ConstantOracle(pub(crate) Result<Claim, GiveUpReason>);

impl DistanceOracle for ConstantOracle {
    type Cache = ();

    fn separation(&mut self, _: &PiecePair<'_>, _: &mut ()) -> Result<Claim, GiveUpReason> {
        self.0
    }
}
