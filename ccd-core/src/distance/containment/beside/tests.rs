//! Compares the points of `points_beside_edges` with points that are computed from dense samples of the edges.
//! Coordinates are whole numbers, so that edges run along sides, and end on them, exactly.

use super::points_beside_edges;
use crate::body::Body;
use crate::body::polytope::{Facet, FacetOrigin, Polytope};
use crate::rounding::EDGE_PROBE_DISTANCE_SHARE;
use crate::tests::scene::{Pcg64, RngExt, rng};
use glam::{DVec2, DVec3};

/// The number of samples of an edge.
const SAMPLES_PER_EDGE: usize = 1 << 14;

const MAX_EDGE_HEIGHT: f64 = 1e-9;

/// A permutation of the axes and a translation, both exact for whole numbers.
struct Placement {
    axes: usize,
    shift: DVec3,
}

impl Placement {
    fn new(rng: &mut Pcg64) -> Self {
        Placement {
            axes: rng.random_range(0..3),
            shift: random_whole_vector(rng, 9),
        }
    }

    fn place_point(&self, p: DVec3) -> DVec3 {
        let p = p.to_array();
        DVec3::from([0, 1, 2].map(|k| p[(k + self.axes) % 3])) + self.shift
    }

    /// Maps a point back to the plate's plane, and returns its height above the plane.
    fn to_plate_plane(&self, p: DVec3) -> (DVec2, f64) {
        let p = (p - self.shift).to_array();
        let [x, y, z] = [0, 1, 2].map(|k| p[(k + 3 - self.axes) % 3]);
        (DVec2::new(x, y), z)
    }
}

/// Draws a vector of whole numbers from −`most` to `most`.
fn random_whole_vector(rng: &mut Pcg64, most: i32) -> DVec3 {
    DVec3::from([0; 3].map(|_| f64::from(rng.random_range(-most..=most))))
}

fn random_plane_point(rng: &mut Pcg64) -> DVec2 {
    random_whole_vector(rng, 7).truncate()
}

/// Draws the corners of a plate, counterclockwise: a triangle, or a rectangle.
fn random_plate_outline(rng: &mut Pcg64) -> Vec<DVec2> {
    loop {
        let (a, b, c) = (
            random_plane_point(rng),
            random_plane_point(rng),
            random_plane_point(rng),
        );
        match rng.random_bool(0.5) {
            true if (b - a).perp_dot(c - a) > 3.0 => return vec![a, b, c],
            false if (b - a).min_element() > 0.0 => {
                return vec![a, DVec2::new(b.x, a.y), b, DVec2::new(a.x, b.y)];
            }
            _ => {}
        }
    }
}

/// Draws the ends of an edge in the plate's plane, sometimes along a side of the outline.
fn ends(rng: &mut Pcg64, outline: &[DVec2]) -> [DVec2; 2] {
    if rng.random_bool(0.2) {
        let k = rng.random_range(0..outline.len());
        let (from, to) = (outline[k], outline[(k + 1) % outline.len()]);
        let beyond = f64::from(rng.random_range(0..2));
        return [from, to + (to - from) * beyond];
    }
    loop {
        let ends = [random_plane_point(rng), random_plane_point(rng)];
        if ends[0] != ends[1] {
            return ends;
        }
    }
}

fn plate(outline: &[DVec2], placement: &Placement) -> Body {
    let corners = outline.iter().map(|p| placement.place_point(p.extend(0.0)));
    let facets: &[&[u32]] = match outline.len() {
        3 => &[&[0, 1, 2], &[2, 1, 0]],
        // Sides without an area come first.
        _ => &[
            &[0, 1, 5, 4],
            &[1, 2, 6, 5],
            &[4, 5, 6, 7],
            &[2, 3, 7, 6],
            &[3, 0, 4, 7],
            &[3, 2, 1, 0],
        ],
    };
    let doubled = if outline.len() == 3 { 1 } else { 2 };
    polytope(corners.collect::<Vec<_>>().repeat(doubled), facets)
}

fn polytope(points: Vec<DVec3>, facets: &[&[u32]]) -> Body {
    let facet = |corners: &&[u32]| Facet {
        origin: FacetOrigin::Virtual,
        corners: corners.to_vec(),
    };
    Body::polytope(Polytope {
        points,
        facets: facets.iter().map(facet).collect(),
        ..Polytope::default()
    })
    .unwrap()
}

/// Creates a triangle or a tetrahedron with a given level edge; its other corners are at other heights.
fn random_body_with_edge(rng: &mut Pcg64, [from, to]: [DVec3; 2], placement: &Placement) -> Body {
    let mut apex = |height: f64| random_plane_point(rng).extend(from.z + height);
    let (mut points, facets): (Vec<DVec3>, &[&[u32]]) = if apex(0.0).x > 0.0 {
        (vec![from, to, apex(3.0)], &[])
    } else {
        (
            vec![from, to, apex(2.0), apex(-1.0)],
            // The edge is the last one of its facets.
            &[&[1, 2, 0], &[0, 3, 1], &[2, 1, 3], &[0, 2, 3]],
        )
    };
    if facets.is_empty() {
        points.rotate_left(rng.random_range(0..3));
    }
    polytope(
        points
            .into_iter()
            .map(|p| placement.place_point(p))
            .collect(),
        facets,
    )
}

/// Returns the distance of a point inside the outline from the nearest side; negative for a point outside.
fn depth(outline: &[DVec2], p: DVec2) -> f64 {
    let side = |k: usize| {
        let (from, to) = (outline[k], outline[(k + 1) % outline.len()]);
        (to - from).normalize().perp_dot(p - from)
    };
    (0..outline.len())
        .map(side)
        .fold(f64::INFINITY, crate::math::order::lesser)
}

/// Computes from samples the points that `points_beside_edges` should return; `None` if samples cannot decide.
fn expected_points(outline: &[DVec2], [from, to]: [DVec2; 2]) -> Option<Vec<DVec2>> {
    let at = |k: usize| from + (to - from) * (k as f64 / SAMPLES_PER_EDGE as f64);
    let held: Vec<usize> = (0..=SAMPLES_PER_EDGE)
        .filter(|&k| depth(outline, at(k)) >= -1e-12)
        .collect();
    let (Some(first), Some(last)) = (held.first(), held.last()) else {
        return Some(Vec::new());
    };
    let share = (last - first) as f64 / SAMPLES_PER_EDGE as f64;
    if share < 0.01 {
        return (first == last).then(Vec::new);
    }
    let middle = 0.5 * (at(*first) + at(*last));
    let aside = (to - from).perp() * (EDGE_PROBE_DISTANCE_SHARE * share);
    let off = sample_spacing([from, to]);
    let both = [middle + aside, middle - aside];
    let told = both.iter().all(|&p| depth(outline, p).abs() > off);
    told.then(|| {
        both.into_iter()
            .filter(|&p| depth(outline, p) > 0.0)
            .collect()
    })
}

fn sample_spacing([from, to]: [DVec2; 2]) -> f64 {
    from.distance(to) / SAMPLES_PER_EDGE as f64
}

#[test]
fn points_are_beside_the_middle_of_what_the_piece_has_of_an_edge() {
    let (mut rng, mut counts) = (rng(1), [0; 3]);
    for _ in 0..1_500 {
        let placement = Placement::new(&mut rng);
        let outline = random_plate_outline(&mut rng);
        let ends = ends(&mut rng, &outline);
        // One edge in ten is above the plane.
        let height = if rng.random_bool(0.1) { 1.0 } else { 0.0 };
        let edge = ends.map(|p| p.extend(height));
        let plate = plate(&outline, &placement);
        // The other body has another placement.
        let elsewhere = Placement {
            shift: random_whole_vector(&mut rng, 9),
            ..placement
        };
        let other = random_body_with_edge(&mut rng, edge, &elsewhere);
        let back = placement.shift - elsewhere.shift;
        let (a, b) = (plate.pieces().get(0), other.pieces().get(0));
        let found: Vec<DVec3> =
            points_beside_edges(&a, &b, |p| p + back, MAX_EDGE_HEIGHT).collect();
        let expected = if height > 0.0 {
            Some(Vec::new())
        } else {
            expected_points(&outline, ends)
        };
        let Some(expected) = expected else { continue };
        assert_eq!(found.len(), expected.len(), "{outline:?} {ends:?}");
        for p in found {
            let (p, height) = placement.to_plate_plane(p);
            let near = |q: &DVec2| q.distance(p) <= 2.0 * sample_spacing(ends);
            assert!(
                height == 0.0 && expected.iter().any(near),
                "{outline:?} {ends:?} {p}"
            );
        }
        counts[expected.len()] += 1;
    }
    let [none, one, two] = counts;
    assert!(none > 300 && one > 100 && two > 300, "{counts:?}");
}

/// Tests that a triangle in the plane of a piece gives no points, and that a tilted triangle gives two.
#[test]
fn pieces_in_one_plane_have_no_points() {
    let [a, b] = [DVec3::ZERO, DVec3::ONE.with_z(0.0)].map(|p| {
        let corners = [p, p + 4.0 * DVec3::X, p + 4.0 * DVec3::Y];
        polytope(corners.to_vec(), &[&[0, 1, 2], &[2, 1, 0]])
    });
    let (a, b) = (a.pieces().get(0), b.pieces().get(0));
    assert_eq!(
        points_beside_edges(&a, &b, |p| p, MAX_EDGE_HEIGHT).count(),
        0
    );
    let tilted = |p: DVec3| p.with_z(1.0 - p.y);
    assert_eq!(
        points_beside_edges(&a, &b, tilted, MAX_EDGE_HEIGHT).count(),
        2
    );
}
