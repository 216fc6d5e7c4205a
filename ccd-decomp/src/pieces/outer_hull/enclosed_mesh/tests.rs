//! Tests distances from a point to a triangle against exact fractions. A random search looks for the largest error.

use super::EnclosedMesh;
use crate::mesh::TriangleMesh;
use crate::rational::{Exact3, exact_fraction};
use crate::solid::topology::TopologyDefects;
use crate::work::WorkBudget;
use crate::worst::{RandomCase, WorstCaseSearch, error_fraction};
use ccd_core::glam::DVec3;
use ccd_core::order::{greater, lesser};
use dashu_ratio::Relaxed;

/// Returns the exact square of the distance from a point to a triangle.
fn squared_distance([a, b, c]: [DVec3; 3], point: DVec3) -> Relaxed {
    let [a, b, c] =
        [a, b, c].map(|v| Exact3::from_coordinates(v).minus(&Exact3::from_coordinates(point)));
    let edges = [(&a, &b), (&b, &c), (&c, &a)].map(|(p, q)| {
        let along = q.minus(p);
        let length = along.dot(&along);
        let toward = Relaxed::ZERO - p.dot(&along);
        if toward <= Relaxed::ZERO || length <= Relaxed::ZERO {
            p.dot(p)
        } else if toward >= length {
            q.dot(q)
        } else {
            p.dot(p) - &toward * &toward / length
        }
    });
    let normal = b.minus(&a).cross(&c.minus(&a));
    let inside =
        [(&a, &b), (&b, &c), (&c, &a)].map(|(p, q)| p.cross(q).dot(&normal) >= Relaxed::ZERO);
    let height = a.dot(&normal);
    let of_plane = match normal.dot(&normal) {
        size if size > Relaxed::ZERO && inside == [true; 3] => Some(&height * &height / size),
        _ => None,
    };
    let all = edges.into_iter().chain(of_plane);
    all.reduce(|x, y| if y < x { y } else { x })
        .expect("three edges")
}

/// Draws a triangle of any aspect ratio, and a point that may be near it.
fn random_triangle_and_point(tape: &mut RandomCase) -> ([DVec3; 3], DVec3) {
    let (scale, offset) = (tape.size(-60..=30), DVec3::from(tape.vector(-8..=10)));
    let [u, v] = [(); 2].map(|()| DVec3::from(tape.vector(-4..=0)));
    let (narrow, share) = (tape.size(-60..=0), tape.any_number(-3..=0));
    let corners = [DVec3::ZERO, u, u * share + v * narrow].map(|p| (p + offset) * scale);
    let [a, b, c] = corners;
    let [along, other] = [b - a, c - a];
    let near = tape.size(-40..=1);
    let at = a + along * tape.next_fraction() + other * tape.next_fraction();
    let point = at + DVec3::from(tape.vector(-8..=0)) * near * scale;
    (corners, point)
}

#[test]
fn worst_distance() {
    let found = WorstCaseSearch::new("NEAREST_SLACK", 6_000).search(|tape| {
        let (corners, point) = random_triangle_and_point(tape);
        let mesh = TriangleMesh::new(corners.to_vec(), &[[0, 1, 2]]).ok()?;
        let target = EnclosedMesh::new(&mesh, &TopologyDefects::of(&mesh));
        let (found, reached) = target.distance_bounds(point, &WorkBudget::unbounded());
        let scale = exact_fraction(2f64.powi(400));
        let truth = (squared_distance(corners, point) * &scale)
            .to_f64()
            .value()
            .sqrt()
            * 2f64.powi(-200);
        // Inside, the lesser of the two is the depth; outside, the second is the distance.
        let error = greater(lesser(found, reached) - truth, truth - reached);
        // Query points are in hulls of the mesh's points. A mesh of one point has no hull.
        let near = truth <= 2.0 * target.half_diagonal && target.half_diagonal > 0.0;
        near.then(|| error_fraction(error, target.distance_rounding))
    });
    // The search must find triangles that are barely not needles.
    found.assert_tight_bound(1e8);
}
