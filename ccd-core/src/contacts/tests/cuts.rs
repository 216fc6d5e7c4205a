//! Tests that the contacts of a flat surface do not depend on its triangulation. Also tests pieces of many faces, or
//! with shared corners.

use super::*;
use crate::body::pieces::Pieces;

/// Creates a slab whose top and bottom have four triangles each, around a middle point without a mesh number.
fn slab_with_center_points(half: DVec3) -> Body {
    let mut points = Mesh::cuboid(half).points;
    points.extend([-half.z * DVec3::Z, half.z * DVec3::Z]);
    let side = |corners: &[u32]| Facet {
        origin: FacetOrigin::Virtual,
        corners: corners.to_vec(),
    };
    let walls = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3]];
    let fans = [([0, 2, 3, 1], 8), ([4, 5, 7, 6], 9)];
    let fan =
        |(rim, middle): ([u32; 4], u32)| (0..4).map(move |k| [rim[k], rim[(k + 1) % 4], middle]);
    let walls = walls.iter().map(|wall| side(wall));
    let facets = walls.chain(fans.into_iter().flat_map(fan).map(|corners| side(&corners)));
    Body::polytope(Polytope {
        points,
        facets: facets.collect(),
        ..Polytope::default()
    })
    .unwrap()
}

/// Tests that the contact of a point with the inside of a flat side is the point's projection, for any triangulation.
#[test]
fn only_the_foot_on_a_side_is_reported() {
    let rng = &mut rng(74);
    let half = DVec3::new(1.0, 0.8, 0.3);
    let [cut, whole] = cuboid_as_triangles_and_as_piece(half);
    let point = Body::sphere(0.0).unwrap();
    for slab in [cut, whole, slab_with_center_points(half)] {
        let (mut feet, mut beside) = (0, 0);
        for _ in 0..200 {
            let place = 2.5 * random_point_in_ball(rng, 1.0);
            let pairs = contacts(&point, &slab, pose_at(place.x, place.y, place.z), 10.0);
            assert!(!pairs.is_empty());
            for pair in &pairs {
                let (witness, upper) = (pair.separation.witness_b, pair.separation.upper);
                assert!(upper - pair.separation.lower < 1e-12, "{place} {pair:?}");
                let bound = (half - witness.abs()).to_array();
                let across = [0, 1, 2].map(|k| bound[k].abs() < 1e-12);
                let inside = across.iter().filter(|&&it| it).count() == 1;
                let axis = across.iter().position(|&it| it).unwrap();
                let mut way = (witness - place).to_array();
                way[axis] = 0.0;
                let foot = DVec3::from_array(way).length() < 1e-12;
                assert!(foot || !inside, "{place}: {witness} {pair:?}");
                *(if inside { &mut feet } else { &mut beside }) += 1;
            }
        }
        assert!(feet > 100 && beside > 100, "{feet} {beside}");
    }
}

/// Creates a triangulated unit sphere of rings and sectors, with its poles on the z axis.
fn uv_sphere(rings: u32, sectors: u32) -> Mesh {
    let angle = |k: u32, of: u32| std::f64::consts::PI * f64::from(k) / f64::from(of);
    let point = |(i, j): (u32, u32)| {
        let (down, round) = (angle(i, rings).sin_cos(), angle(2 * j, sectors).sin_cos());
        DVec3::new(down.0 * round.1, down.0 * round.0, down.1)
    };
    let grid = (1..rings).flat_map(|i| (0..sectors).map(move |j| (i, j)));
    let mut points: Vec<DVec3> = grid.map(point).collect();
    let [north, south] = [points.len() as u32, points.len() as u32 + 1];
    points.extend([DVec3::Z, -DVec3::Z]);
    let vertex = |i: u32, j: u32| match i {
        0 => north,
        _ if i == rings => south,
        _ => (i - 1) * sectors + j % sectors,
    };
    let cell = |(i, j): (u32, u32)| {
        let [a, b] = [vertex(i, j), vertex(i, j + 1)];
        let [c, d] = [vertex(i + 1, j + 1), vertex(i + 1, j)];
        [[a, d, c], [a, c, b]]
    };
    let cells = (0..rings).flat_map(|i| (0..sectors).map(move |j| (i, j)));
    let proper = |face: &[u32; 3]| face[0] != face[1] && face[1] != face[2] && face[2] != face[0];
    Mesh {
        points,
        faces: cells.flat_map(cell).filter(proper).collect(),
    }
}

/// Tests that the work for a piece of many faces grows with the near pairs of faces, not with all pairs.
#[test]
fn a_piece_of_many_faces_is_sorted_once() {
    let ball = uv_sphere(32, 34);
    let count = ball.faces.len() as u64;
    let facet = |(k, corners): (u32, &[u32; 3])| Facet {
        origin: FacetOrigin::Face(k),
        corners: corners.to_vec(),
    };
    let hull = Body::polytope(Polytope {
        points: ball.points.clone(),
        facets: (0..).zip(&ball.faces).map(facet).collect(),
        ..Polytope::default()
    })
    .unwrap();
    let socket = Mesh {
        points: ball.points.iter().map(|&p| 1.01 * p).collect(),
        faces: ball.faces.iter().map(|&[a, b, c]| [a, c, b]).collect(),
    };
    let socket = socket.body(Solidity::Surface);
    let triangles = ball.body(Solidity::Solid);
    let config = Settings {
        budget: 50 * count,
        ..Settings::DEFAULT
    };
    let shifted = pose_at(0.0, 0.0, 0.0099);
    let gaps = |a: &Body, b: &Body, pose: Pose| -> Vec<f64> {
        let pairs = problem_of_still_bodies(a, b, pose, &config)
            .contacts_at(0.0)
            .unwrap();
        pairs.iter().map(|pair| pair.separation.upper).collect()
    };
    let (of_hull, of_triangles) = (
        gaps(&hull, &socket, shifted),
        gaps(&triangles, &socket, shifted),
    );
    assert!(of_hull.len() > 30, "{}", of_hull.len());
    assert_eq!(of_hull.len(), of_triangles.len());
    let same = |(one, other): (&f64, &f64)| (one - other).abs() < 1e-12;
    assert!(of_hull.iter().zip(&of_triangles).all(same));
    let back = gaps(&socket, &hull, pose_at(0.0, 0.0, -0.0099));
    assert_eq!(of_hull.len(), back.len());
    // Visits are counted.
    let config = Settings {
        budget: 2 * count,
        ..config
    };
    let refused = problem_of_still_bodies(&hull, &socket, shifted, &config).contacts_at(0.0);
    let budget = 2 * count;
    assert_eq!(refused, Err(ContactsError::TooManyPairs { budget }));
}

/// Tests that the contact at a corner that two pieces share is measured to the piece with the larger radius, which is
/// nearer.
#[test]
fn the_rounder_of_two_pieces_that_share_a_corner_is_reported() {
    let limb = |x: f64, id: u32, radius: f64| Polytope {
        points: vec![DVec3::ZERO, DVec3::new(x, 0.0, -1.0)],
        vertex_ids: vec![0, id],
        radius,
        ..Polytope::default()
    };
    let point = Body::sphere(0.0).unwrap();
    for radii in [[0.1, 0.5], [0.5, 0.1]] {
        let limbs = [limb(-1.0, 1, radii[0]), limb(1.0, 2, radii[1])];
        let pieces = Pieces::from_polytopes(&limbs).unwrap();
        let body = Body::new(&pieces, Solidity::Surface).unwrap();
        let pairs = contacts(&point, &body, pose_at(0.0, 0.0, 1.0), 0.6);
        assert_eq!(feature_names(&pairs), ["v0 v0"], "{radii:?}");
        check_separations(&pairs, 0.5, -DVec3::Z);
    }
}
