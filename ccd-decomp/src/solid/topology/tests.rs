use crate::test_meshes::CUBE_FACES;
use crate::{Edge, TopologyDefects, TriangleMesh};
use ccd_core::glam::{DVec3, dvec3};

const TETRAHEDRON_FACES: [[u32; 3]; 4] = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];

fn cube_points() -> Vec<DVec3> {
    let bit = |k: u32, b: u32| f64::from(k >> b & 1);
    (0..8)
        .map(|k| dvec3(bit(k, 0), bit(k, 1), bit(k, 2)) + 1e3)
        .collect()
}

fn topology(points: Vec<DVec3>, faces: &[[u32; 3]]) -> TopologyDefects {
    TopologyDefects::of(&TriangleMesh::new(points, faces).unwrap())
}

#[test]
fn a_cube_is_a_closed_manifold() {
    let cube = topology(cube_points(), &CUBE_FACES);
    assert!(cube.is_manifold(), "{cube}");
    assert!(!cube.is_inside_out());
    assert_eq!(cube.signed_volume, 1.0);
    assert_eq!(cube.to_string(), "closed");
}

#[test]
fn a_cube_inside_out_is_closed() {
    let cube = topology(cube_points(), &CUBE_FACES.map(|[a, b, c]| [a, c, b]));
    assert!(cube.is_manifold());
    assert!(cube.is_inside_out());
    assert_eq!(
        cube.to_string(),
        "closed, inside out: taken as turned outward"
    );
}

#[test]
fn a_soup_of_separate_triangles_is_closed_where_their_corners_meet() {
    let points = cube_points();
    let corners = CUBE_FACES
        .iter()
        .flatten()
        .map(|&v| points[v as usize])
        .collect();
    let faces: Vec<[u32; 3]> = (0..12).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]).collect();
    assert!(topology(corners, &faces).is_manifold());
}

#[test]
fn a_missing_face_leaves_its_rim() {
    let open = topology(cube_points(), &CUBE_FACES[1..]);
    assert!(!open.is_closed());
    assert_eq!(
        open.boundary_edges.first_elements(),
        [Edge(0, 4), Edge(0, 6), Edge(4, 6)]
    );
    assert_eq!(
        open.to_string(),
        "open; edges with one face: 3 (e0-4, e0-6, e4-6)"
    );
}

#[test]
fn a_flipped_face_is_found_at_its_edges() {
    let mut faces = CUBE_FACES;
    faces[0].swap(1, 2);
    let flipped = topology(cube_points(), &faces);
    assert!(!flipped.is_closed());
    assert_eq!(
        flipped.flipped_edges.first_elements(),
        [Edge(0, 4), Edge(0, 6), Edge(4, 6)]
    );
    assert!(flipped.boundary_edges.is_empty());
}

#[test]
fn two_shells_that_share_an_edge_are_closed_but_no_manifold() {
    let points = vec![
        DVec3::ZERO,
        DVec3::X,
        DVec3::Y,
        DVec3::Z,
        -DVec3::Y,
        -DVec3::Z,
    ];
    let other = TETRAHEDRON_FACES.map(|face| face.map(|v| [0, 1, 4, 5][v as usize]));
    let both = topology(points, &[TETRAHEDRON_FACES, other].concat());
    assert!(both.is_closed() && !both.is_manifold(), "{both}");
    assert_eq!(both.edges_shared_by_parts.first_elements(), [Edge(0, 1)]);
}

#[test]
fn a_fin_on_an_edge_opens_a_shell() {
    let points = vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z, -DVec3::Y];
    let fin = [TETRAHEDRON_FACES.as_slice(), &[[0, 1, 4]]].concat();
    let topology = topology(points, &fin);
    assert!(!topology.is_closed());
    assert_eq!(topology.branching_edges.first_elements(), [Edge(0, 1)]);
    assert_eq!(topology.boundary_edges.count(), 2);
}

#[test]
fn a_moebius_strip_cannot_be_oriented() {
    // Five points in a ring; every three in a row are a face.
    let points = (0..5).map(|k| dvec3(f64::from(k).cos(), f64::from(k).sin(), f64::from(k * k)));
    let faces: Vec<[u32; 3]> = (0..5).map(|k| [k, (k + 1) % 5, (k + 2) % 5]).collect();
    let strip = topology(points.collect(), &faces);
    assert_eq!(strip.boundary_edges.count(), 5);
    assert_eq!(strip.flipped_edges.count(), 5);
}

#[test]
fn a_klein_bottle_has_no_rim_and_is_not_closed() {
    // A 4 × 4 grid, mirrored around one direction.
    let number = |i: u32, j: u32| {
        if i == 4 {
            (4 - j % 4) % 4
        } else {
            4 * i + j % 4
        }
    };
    let mut faces = Vec::new();
    for (i, j) in (0..16).map(|k| (k / 4, k % 4)) {
        let quad = [
            number(i, j),
            number(i + 1, j),
            number(i + 1, j + 1),
            number(i, j + 1),
        ];
        faces.extend([[quad[0], quad[1], quad[2]], [quad[0], quad[2], quad[3]]]);
    }
    let points = (0..16).map(|k| dvec3(f64::from(k), f64::from(k * k), f64::from(k % 3)));
    let bottle = topology(points.collect(), &faces);
    assert!(
        bottle.boundary_edges.is_empty() && bottle.branching_edges.is_empty(),
        "{bottle}"
    );
    assert!(!bottle.flipped_edges.is_empty() && !bottle.is_closed());
}

#[test]
fn faces_without_area_close_the_mesh() {
    // The face 0 1 3 is split at a point of its side 0–1 (a T-junction); a degenerate triangle closes the seam.
    let points = vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z, 0.5 * DVec3::X];
    let seam = [
        [0, 2, 1],
        [0, 4, 3],
        [4, 1, 3],
        [0, 1, 4],
        [1, 2, 3],
        [2, 0, 3],
    ];
    assert!(topology(points.clone(), &seam).is_manifold());
    let collapsed = [TETRAHEDRON_FACES.as_slice(), &[[0, 0, 1], [2, 2, 2]]].concat();
    assert!(topology(points, &collapsed).is_manifold());
}

#[test]
fn two_faces_back_to_back_hold_nothing() {
    let sheet = topology(
        vec![DVec3::ZERO, DVec3::X, DVec3::Y],
        &[[0, 1, 2], [0, 2, 1]],
    );
    assert!(sheet.is_manifold());
    assert_eq!(sheet.signed_volume, 0.0);
}

/// A cylinder of 8 faces around, whose seam is computed at both angles 0 and 2π, as in many libraries.
fn cylinder_with_seam() -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let (mut points, mut faces) = (
        vec![dvec3(0.0, 0.0, -1.0), dvec3(0.0, 0.0, 1.0)],
        Vec::new(),
    );
    for k in 0..=8 {
        let (sin, cos) = (f64::from(k) / 8.0 * std::f64::consts::TAU).sin_cos();
        points.extend([dvec3(cos, sin, -1.0), dvec3(cos, sin, 1.0)]);
    }
    for k in (2..18).step_by(2) {
        let [low, high, next_low, next_high] = [k, k + 1, k + 2, k + 3];
        faces.extend([[low, next_low, high], [high, next_low, next_high]]);
        faces.extend([[0, next_low, low], [1, high, next_high]]);
    }
    (points, faces)
}

#[test]
fn a_seam_that_is_open_by_rounding_says_what_closes_it() {
    let (mut points, faces) = cylinder_with_seam();
    let open = topology(points.clone(), &faces);
    assert_eq!((open.is_closed(), open.boundary_edges.count()), (false, 6));
    let distance = open.joining_distance.unwrap();
    assert!((1e-17..1e-15).contains(&distance), "{distance}");
    let text = open.to_string();
    assert!(
        text.ends_with("; closed if vertices up to 2.4e-16 apart are joined"),
        "{text}"
    );
    // Farther apart is another shape, and so is one with a hole.
    let far = points
        .iter()
        .map(|p| *p + 1e-5 * f64::from(p.y.abs() < 1e-9 && p.y != 0.0));
    assert_eq!(topology(far.collect(), &faces).joining_distance, None);
    assert_eq!(topology(points.clone(), &faces[1..]).joining_distance, None);
    points.truncate(16);
    let closed: Vec<[u32; 3]> = (faces.iter())
        .map(|face| face.map(|v| if v < 18 { v } else { v - 16 }))
        .collect();
    points.extend(cylinder_with_seam().0.drain(16..18));
    assert_eq!(topology(points, &closed).to_string(), "closed");
}
