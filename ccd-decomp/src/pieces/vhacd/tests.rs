use super::target::Location;
use super::*;
use crate::exact::predicates::side;
use crate::test_meshes::prism;
use crate::work::Work;
use ccd_core::Facet;
use ccd_core::glam::DVec3;
use ccd_core::order::{greater, lesser};
use rstest::rstest;
use std::cmp::Ordering;
use std::f64::consts::{PI, TAU};

fn mesh(vertices: &[DVec3], faces: &[[u32; 3]]) -> TriangleMesh {
    TriangleMesh::new(vertices.to_vec(), faces).expect("a mesh")
}

fn cube(lo: DVec3, hi: DVec3) -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let corner = |k: usize| DVec3::from_array([0, 1, 2].map(|a| [lo, hi][k >> a & 1][a]));
    let quads: [[u32; 4]; 6] = [
        [0, 2, 3, 1],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 4, 6, 2],
        [1, 3, 7, 5],
    ];
    let halves = |[a, b, c, d]: [u32; 4]| [[a, b, c], [a, c, d]];
    (
        (0..8).map(corner).collect(),
        quads.into_iter().flat_map(halves).collect(),
    )
}

fn box_mesh(boxes: &[[DVec3; 2]]) -> TriangleMesh {
    let (mut vertices, mut faces) = (Vec::new(), Vec::new());
    for &[lo, hi] in boxes {
        let base = vertices.len() as u32;
        // Swapped corners make a cube that is inside out.
        let (corners, triangles) = cube(lo, hi);
        vertices.extend(corners);
        faces.extend(triangles.into_iter().map(|t| t.map(|v| v + base)));
    }
    mesh(&vertices, &faces)
}

fn cube_bounds(half: f64) -> [DVec3; 2] {
    [DVec3::splat(-half), DVec3::splat(half)]
}

fn torus(around: u32, across: u32, thickness: f64) -> TriangleMesh {
    let at = |i: u32, j: u32| i % around * across + j % across;
    let point = |k: u32| {
        let (u, v) = (
            TAU * f64::from(k / across) / f64::from(around),
            TAU * f64::from(k % across) / f64::from(across),
        );
        let out = 1.0 + thickness * v.cos();
        DVec3::new(out * u.cos(), out * u.sin(), thickness * v.sin())
    };
    let quads = (0..around * across).map(|k| (k / across, k % across));
    let faces = quads.flat_map(|(i, j)| {
        let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
        [[a, b, c], [a, c, d]]
    });
    let points: Vec<DVec3> = (0..around * across).map(point).collect();
    mesh(&points, &faces.collect::<Vec<_>>())
}

/// Returns an L of size two by two and height 1, with legs of width 1.
fn l_shape() -> TriangleMesh {
    let outline = [(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)];
    prism(&outline.map(|(x, y)| DVec3::new(f64::from(x), f64::from(y), 0.0)))
}

fn sheet() -> TriangleMesh {
    let n = 12;
    let point = |k: u32| {
        let (x, y) = (f64::from(k % n) / 11.0, f64::from(k / n) / 11.0);
        DVec3::new(x, y, 0.3 * (3.0 * x).sin())
    };
    let quads = (0..n * n).filter(|k| k % n < n - 1 && k / n < n - 1);
    let faces = quads.flat_map(|k| [[k, k + 1, k + n + 1], [k, k + n + 1, k + n]]);
    mesh(
        &(0..n * n).map(point).collect::<Vec<_>>(),
        &faces.collect::<Vec<_>>(),
    )
}

/// Returns a generator of pseudo-random numbers in 0..1, by a linear congruence.
fn noise() -> impl FnMut() -> f64 {
    let mut state = 1_u64;
    move || {
        state = state
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        (state >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// Returns a random convex combination of some points.
fn random_combination(points: &[DVec3], mut next: impl FnMut() -> f64) -> DVec3 {
    let weights: Vec<f64> = points.iter().map(|_| -(1.0 - next()).ln()).collect();
    let sum: f64 = weights.iter().sum();
    points.iter().zip(weights).map(|(&p, w)| w / sum * p).sum()
}

fn triangles(mesh: &TriangleMesh) -> Vec<[DVec3; 3]> {
    mesh.faces()
        .iter()
        .map(|f| f.map(|v| mesh.vertices()[v as usize]))
        .collect()
}

/// Returns whether the winding number of a mesh about a point is not 0, by the solid angles of its triangles.
fn has_nonzero_winding_number(mesh: &TriangleMesh, point: DVec3) -> bool {
    let angle = |t: [DVec3; 3]| {
        let [a, b, c] = t.map(|p| p - point);
        let (la, lb, lc) = (a.length(), b.length(), c.length());
        let below = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
        2.0 * a.dot(b.cross(c)).atan2(below)
    };
    let sum: f64 = triangles(mesh).into_iter().map(angle).sum();
    (sum / (4.0 * PI)).round() != 0.0
}

fn distance(triangles: &[[DVec3; 3]], point: DVec3) -> f64 {
    let to_segment = |a: DVec3, b: DVec3| {
        let share = (point - a).dot(b - a) / (b - a).length_squared();
        point.distance(a + share.clamp(0.0, 1.0) * (b - a))
    };
    let to_triangle = |[a, b, c]: [DVec3; 3]| {
        let normal = (b - a).cross(c - a).normalize();
        let within = |a: DVec3, b: DVec3| (b - a).cross(point - a).dot(normal) >= 0.0;
        if within(a, b) && within(b, c) && within(c, a) {
            normal.dot(point - a).abs()
        } else {
            lesser(lesser(to_segment(a, b), to_segment(b, c)), to_segment(c, a))
        }
    };
    triangles
        .iter()
        .copied()
        .map(to_triangle)
        .fold(f64::INFINITY, lesser)
}

/// Returns whether a point is in a polytope, or at most the distance `way` from it.
fn is_within(polytope: &Polytope, point: DVec3, way: f64) -> bool {
    let at = |v: u32| polytope.points[v as usize];
    let fan = |f: &Facet| -> Vec<_> {
        f.corners[1..]
            .windows(2)
            .map(|e| [f.corners[0], e[0], e[1]].map(at))
            .collect()
    };
    let fans: Vec<_> = polytope.facets.iter().map(fan).collect();
    let inside = fans
        .iter()
        .all(|fan| side(fan[0], point) != Ordering::Greater);
    inside || distance(&fans.concat(), point) <= way
}

fn approximate_mesh(mesh: &TriangleMesh, hulls: u32) -> Result<Approximation, VhacdError> {
    approximate(mesh, &Topology::of(mesh), hulls)
}

#[rstest]
#[case::prism(l_shape(), 4)]
#[case::star(crate::test_meshes::star_bipyramid(300, 0.5), 16)]
#[case::comb(crate::test_meshes::comb(&[5.0; 40]), 8)]
#[case::torus(torus(24, 12, 0.3), 8)]
#[case::thin_torus(torus(48, 8, 0.05), 16)]
#[case::hollow(box_mesh(&[cube_bounds(1.0), [DVec3::splat(0.5), DVec3::splat(-0.5)]]), 12)]
#[case::two(box_mesh(&[cube_bounds(1.0), [DVec3::splat(1.5), DVec3::splat(2.0)]]), 4)]
#[case::sheet(sheet(), 8)]
#[case::far_off(distant_torus(), 8)]
fn excess_bounds_hold_for_samples(#[case] mesh: TriangleMesh, #[case] hulls: u32) {
    let found = approximate_mesh(&mesh, hulls).expect("an approximation");
    assert!((1..=hulls as usize).contains(&found.polytopes.len()));
    let size = mesh
        .vertices()
        .iter()
        .map(|p| p.abs().max_element())
        .fold(0.0, greater);
    assert!(found.uncovered_bound <= 1e-12 * size);
    let mut next = noise();
    let closed = crate::Topology::of(&mesh).is_closed();
    let [lo, hi] = Target::new(&mesh, &Topology::of(&mesh)).bounds();
    let mut samples: Vec<DVec3> = triangles(&mesh)
        .iter()
        .flat_map(|t| {
            [
                random_combination(t, &mut next),
                random_combination(t, &mut next),
            ]
        })
        .collect();
    let in_box = (0..2000).map(|_| lo + (hi - lo) * DVec3::new(next(), next(), next()));
    let in_box: Vec<DVec3> = in_box
        .filter(|&p| closed && has_nonzero_winding_number(&mesh, p))
        .collect();
    samples.extend(in_box);
    for point in samples {
        let covers = |p: &Polytope| is_within(p, point, found.uncovered_bound);
        assert!(found.polytopes.iter().any(covers), "{point} is outside");
    }
    let mut farthest = 0.0_f64;
    for polytope in &found.polytopes {
        let mixed: Vec<DVec3> = (0..60)
            .map(|_| random_combination(&polytope.points, &mut next))
            .collect();
        for &point in polytope.points.iter().chain(&mixed) {
            if !(closed && has_nonzero_winding_number(&mesh, point)) {
                farthest = greater(farthest, distance(&triangles(&mesh), point));
            }
        }
    }
    assert!(
        farthest <= found.excess_bound,
        "{farthest} > {}",
        found.excess_bound
    );
}

fn distant_torus() -> TriangleMesh {
    let torus = torus(24, 12, 0.3);
    let moved: Vec<DVec3> = torus
        .vertices()
        .iter()
        .map(|p| p + DVec3::splat(1e5))
        .collect();
    mesh(&moved, torus.faces())
}

/// Tests the reported excess of a single hull. It fills the hole of a torus, whose farthest points are at the two
/// mouths, or a cavity, whose farthest point is its centre.
#[rstest]
#[case::torus(torus(96, 48, 0.3), 1.09_f64.sqrt() - 0.3)]
#[case::cavity(box_mesh(&[cube_bounds(1.0), [DVec3::splat(0.5), DVec3::splat(-0.5)]]), 0.5)]
#[case::prism(l_shape(), 0.5)]
fn one_hull_has_the_expected_excess(#[case] mesh: TriangleMesh, #[case] expected: f64) {
    let found = approximate_mesh(&mesh, 1).expect("an approximation");
    assert_eq!(found.polytopes.len(), 1);
    let ratio = found.excess_bound / expected;
    assert!(
        (1.0 - 2e-3..1.02).contains(&ratio),
        "{} for {expected}",
        found.excess_bound
    );
}

#[rstest]
#[case(1)]
#[case(2)]
#[case(7)]
fn a_box_is_approximated_exactly(#[case] hulls: u32) {
    let found = approximate_mesh(&box_mesh(&[cube_bounds(1.0)]), hulls).expect("an approximation");
    assert!(found.excess_bound < 1e-6, "{}", found.excess_bound);
    if hulls == 1 {
        assert_eq!(found.polytopes[0].facets.len(), 6);
        assert_eq!(found.polytopes[0].points.len(), 8);
    }
}

#[test]
fn more_hulls_stick_out_less() {
    let mesh = torus(48, 16, 0.2);
    let errors =
        [1, 4, 16, 64].map(|hulls| approximate_mesh(&mesh, hulls).expect("hulls").excess_bound);
    assert!(errors.windows(2).all(|e| e[1] < 0.6 * e[0]), "{errors:?}");
}

#[test]
fn the_same_twice() {
    let mesh = torus(24, 12, 0.3);
    let [one, other] = [(); 2].map(|()| approximate_mesh(&mesh, 8).expect("hulls"));
    assert_eq!(one.polytopes, other.polytopes);
    assert_eq!(one.excess_bound, other.excess_bound);
}

#[test]
fn needles_and_points() {
    let needle = mesh(&[DVec3::ZERO, DVec3::X, 2.0 * DVec3::X], &[[0, 1, 2]]);
    let found = approximate_mesh(&needle, 1).expect("a segment");
    assert_eq!(found.polytopes[0].points, [DVec3::ZERO, 2.0 * DVec3::X]);
    assert!(found.polytopes[0].facets.is_empty());
    let many = approximate_mesh(&needle, u32::MAX).expect("segments");
    assert!(!many.polytopes.is_empty());
}

#[test]
fn refusals() {
    let cube = box_mesh(&[cube_bounds(1.0)]);
    assert_eq!(approximate_mesh(&cube, 0).err(), Some(VhacdError::NoHulls));
    let fine = mesh(&[DVec3::ZERO, DVec3::X, DVec3::splat(1e-95)], &[[0, 1, 2]]);
    assert_eq!(
        approximate_mesh(&fine, 4).err(),
        Some(VhacdError::CoordinateTooSmall { vertex: 2 })
    );
    let apart = box_mesh(&[cube_bounds(1.0), [DVec3::splat(9.0), DVec3::splat(10.0)]]);
    let error = approximate_mesh(&apart, 1).err();
    assert!(
        matches!(error, Some(VhacdError::TooCoarse { .. })),
        "{error:?}"
    );
}

/// Tests the locations of lattice points, which are in line with edges and corners of the meshes.
#[rstest]
#[case::prism(l_shape())]
#[case::torus(torus(8, 4, 0.5))]
#[case::hollow(box_mesh(&[cube_bounds(1.0), [DVec3::splat(0.5), DVec3::splat(-0.5)]]))]
#[case::inside_out(box_mesh(&[[DVec3::splat(0.5), DVec3::splat(-0.5)]]))]
fn lattice_points_are_located(#[case] mesh: TriangleMesh) {
    let (target, surface) = (Target::new(&mesh, &Topology::of(&mesh)), triangles(&mesh));
    for k in 0..21 * 21 * 21 {
        let point = DVec3::new((k % 21) as f64, (k / 21 % 21) as f64, (k / 441) as f64) / 4.0 - 2.5;
        let way = distance(&surface, point);
        if way < 1e-9 {
            continue;
        }
        assert_eq!(
            target.winds_about(point, &Work::unbounded()),
            has_nonzero_winding_number(&mesh, point),
            "{point}"
        );
        match target.locate(point, &Work::unbounded()) {
            Location::Inside { depth } => assert!(depth <= way && depth > way - 1e-6),
            Location::Outside { distance } => assert!(distance >= way && distance < way + 1e-6),
        }
    }
}

/// Tests that a convex solid becomes one hull, for any aspect of triangles and any number of hulls.
#[test]
fn a_convex_solid_is_one_hull() {
    let cones = crate::test_meshes::star_bipyramid(400, 1.0);
    let found = approximate_mesh(&cones, 32).expect("an approximation");
    assert_eq!(found.polytopes.len(), 1);
    assert_eq!(found.polytopes[0].points.len(), 402);
    assert!(found.excess_bound < 1e-6, "{}", found.excess_bound);
}
