use super::enclosed_mesh::Location;
use super::*;
use crate::exact::predicates::side_of_plane;
use crate::test_meshes::prism;
use crate::work::WorkBudget;
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
fn noise_generator() -> impl FnMut() -> f64 {
    let mut state = 1_u64;
    move || {
        state = state
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        (state >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// Returns a random convex combination of some points.
fn random_convex_combination(points: &[DVec3], mut next: impl FnMut() -> f64) -> DVec3 {
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

/// Returns whether a point is on or behind the planes of all facets of a polytope, by exact predicates.
fn is_inside(polytope: &Polytope, point: DVec3) -> bool {
    let at = |v: u32| polytope.points[v as usize];
    let is_behind = |facet: &Facet| {
        let fan = facet.corners[1..].windows(2);
        let mut fan = fan.map(|edge| [facet.corners[0], edge[0], edge[1]].map(at));
        fan.all(|triangle| side_of_plane(triangle, point) != Ordering::Greater)
    };
    polytope.facets.iter().all(is_behind)
}

fn enclose(mesh: &TriangleMesh) -> OuterHull {
    outer_hull(mesh, &TopologyDefects::of(mesh)).expect("a hull")
}

#[rstest]
#[case::prism(l_shape())]
#[case::star(crate::test_meshes::star_bipyramid(300, 0.5))]
#[case::comb(crate::test_meshes::comb(&[5.0; 40]))]
#[case::torus(torus(24, 12, 0.3))]
#[case::thin_torus(torus(48, 8, 0.05))]
#[case::hollow(box_mesh(&[cube_bounds(1.0), [DVec3::splat(0.5), DVec3::splat(-0.5)]]))]
#[case::two(box_mesh(&[cube_bounds(1.0), [DVec3::splat(1.5), DVec3::splat(2.0)]]))]
#[case::sheet(sheet())]
#[case::rounded_sphere(with_rounded_coordinates(&sphere()))]
#[case::dented(dented_sphere())]
#[case::far_off(shifted_along_diagonal(&torus(24, 12, 0.3), 1e5))]
#[case::farther_off(shifted_along_diagonal(&torus(24, 12, 0.3), 1e8))]
fn excess_bounds_hold_for_samples(#[case] mesh: TriangleMesh) {
    let found = enclose(&mesh);
    for point in triangles(&mesh).into_iter().flatten() {
        assert!(is_inside(&found.polytope, point), "{point} is outside");
    }
    let mut next = noise_generator();
    let closed = TopologyDefects::of(&mesh).is_closed();
    let mut farthest = 0.0_f64;
    for _ in 0..600 {
        let point = random_convex_combination(&found.polytope.points, &mut next);
        if !(closed && has_nonzero_winding_number(&mesh, point)) {
            farthest = greater(farthest, distance(&triangles(&mesh), point));
        }
    }
    let bound = found.excess_bound;
    assert!(farthest <= bound, "{farthest} > {bound}");
}

/// Returns a sphere of 24 by 12 quadrilaterals.
fn sphere() -> TriangleMesh {
    let (around, rings) = (24_u32, 11_u32);
    let ring = |k: u32| {
        let latitude = PI * (f64::from(k + 1) / f64::from(rings + 1) - 0.5);
        (0..around).map(move |i| {
            let longitude = TAU * f64::from(i) / f64::from(around);
            DVec3::new(
                latitude.cos() * longitude.cos(),
                latitude.cos() * longitude.sin(),
                latitude.sin(),
            )
        })
    };
    let mut points: Vec<DVec3> = (0..rings).flat_map(ring).collect();
    points.extend([-DVec3::Z, DVec3::Z]);
    let (south, north) = (rings * around, rings * around + 1);
    let at = |k: u32, i: u32| k * around + i % around;
    let caps = (0..around).flat_map(|i| {
        [
            [south, at(0, i + 1), at(0, i)],
            [north, at(rings - 1, i), at(rings - 1, i + 1)],
        ]
    });
    let bands = (0..rings - 1).flat_map(|k| {
        (0..around).flat_map(move |i| {
            let [a, b, c, d] = [at(k, i), at(k, i + 1), at(k + 1, i + 1), at(k + 1, i)];
            [[a, b, c], [a, c, d]]
        })
    });
    mesh(&points, &caps.chain(bands).collect::<Vec<_>>())
}

/// Returns a mesh whose coordinates are rounded to single precision, as an STL file rounds them.
fn with_rounded_coordinates(exact: &TriangleMesh) -> TriangleMesh {
    let points = exact.vertices().iter().map(|p| p.as_vec3().as_dvec3());
    mesh(&points.collect::<Vec<_>>(), exact.faces())
}

/// Returns a sphere with one corner pushed a tenth of the radius inwards.
fn dented_sphere() -> TriangleMesh {
    let sphere = sphere();
    let mut points = sphere.vertices().to_vec();
    points[100] *= 0.9;
    mesh(&points, sphere.faces())
}

/// Tests that a sphere rounded to single precision, which has reflex edges, gets a hull with a small positive excess.
#[test]
fn a_convex_solid_in_single_precision_exceeds_itself_little() {
    let mesh = with_rounded_coordinates(&sphere());
    let manifold =
        Manifold::without_intersection_check(&mesh, &TopologyDefects::of(&mesh)).expect("closed");
    assert!(convex_polytope(&manifold).is_err());
    let found = enclose(&mesh);
    assert!(found.excess_bound > 0.0);
    assert!(found.excess_bound < 2e-6, "{}", found.excess_bound);
}

fn shifted_along_diagonal(mesh: &TriangleMesh, offset: f64) -> TriangleMesh {
    let points = mesh.vertices().iter().map(|p| p + DVec3::splat(offset));
    self::mesh(&points.collect::<Vec<_>>(), mesh.faces())
}

/// Tests that the excess bound of a hull is within 2 % of the known excess. The hull fills the hole of a torus, whose
/// farthest points are at the two mouths, or a cavity, whose farthest point is its center.
#[rstest]
#[case::torus(torus(96, 48, 0.3), 1.09_f64.sqrt() - 0.3)]
#[case::cavity(box_mesh(&[cube_bounds(1.0), [DVec3::splat(0.5), DVec3::splat(-0.5)]]), 0.5)]
#[case::prism(l_shape(), 0.5)]
fn one_hull_has_the_expected_excess(#[case] mesh: TriangleMesh, #[case] expected: f64) {
    let found = enclose(&mesh);
    let ratio = found.excess_bound / expected;
    assert!(
        (1.0 - 2e-3..1.02).contains(&ratio),
        "{} for {expected}",
        found.excess_bound
    );
}

#[test]
fn a_convex_solid_has_no_excess() {
    let found = enclose(&box_mesh(&[cube_bounds(1.0)]));
    assert_eq!(found.excess_bound, 0.0);
    assert_eq!(found.polytope.facets.len(), 6);
    assert_eq!(found.polytope.points.len(), 8);
    let cones = enclose(&crate::test_meshes::star_bipyramid(400, 1.0));
    assert_eq!(cones.excess_bound, 0.0);
    assert_eq!(cones.polytope.points.len(), 402);
}

#[test]
fn the_same_twice() {
    let mesh = torus(24, 12, 0.3);
    let [one, other] = [(); 2].map(|()| enclose(&mesh));
    assert_eq!(one.polytope, other.polytope);
    assert_eq!(one.excess_bound, other.excess_bound);
}

#[test]
fn needles_and_unused_vertices() {
    let needle = mesh(
        &[DVec3::ZERO, DVec3::X, 2.0 * DVec3::X, 9.0 * DVec3::Y],
        &[[0, 1, 2]],
    );
    let found = enclose(&needle);
    assert_eq!(found.polytope.points, [DVec3::ZERO, 2.0 * DVec3::X]);
    assert!(found.polytope.facets.is_empty());
}

#[test]
fn a_coordinate_too_near_to_0_is_refused() {
    let vertices = [DVec3::ZERO, DVec3::Y, DVec3::X, DVec3::splat(1e-95)];
    let fine = mesh(&vertices, &[[0, 2, 3]]);
    let error = outer_hull(&fine, &TopologyDefects::of(&fine)).err();
    assert_eq!(error, Some(HullError { point_index: 3 }));
}

/// Tests that lattice points, whose rays meet edges and corners of the meshes, are located inside or outside at the
/// right distance.
#[rstest]
#[case::prism(l_shape())]
#[case::torus(torus(8, 4, 0.5))]
#[case::hollow(box_mesh(&[cube_bounds(1.0), [DVec3::splat(0.5), DVec3::splat(-0.5)]]))]
#[case::inside_out(box_mesh(&[[DVec3::splat(0.5), DVec3::splat(-0.5)]]))]
fn lattice_points_are_located(#[case] mesh: TriangleMesh) {
    let (target, surface) = (
        EnclosedMesh::new(&mesh, &TopologyDefects::of(&mesh)),
        triangles(&mesh),
    );
    for k in 0..21 * 21 * 21 {
        let point = DVec3::new((k % 21) as f64, (k / 21 % 21) as f64, (k / 441) as f64) / 4.0 - 2.5;
        let distance_to_surface = distance(&surface, point);
        if distance_to_surface < 1e-9 {
            continue;
        }
        assert_eq!(
            target.has_nonzero_winding_number(point, &WorkBudget::unbounded()),
            has_nonzero_winding_number(&mesh, point),
            "{point}"
        );
        match target.locate(point, &WorkBudget::unbounded()) {
            Location::Inside { least_depth } => {
                assert!(
                    least_depth <= distance_to_surface && least_depth > distance_to_surface - 1e-6
                );
            }
            Location::Outside { distance_bound } => {
                assert!(
                    distance_bound >= distance_to_surface
                        && distance_bound < distance_to_surface + 1e-6
                );
            }
        }
    }
}
