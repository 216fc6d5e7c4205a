//! Tests that invalid pieces are refused, and that points of pieces have the right mesh features.

use super::*;
use crate::body::Body;
use crate::body::polytope::{Facet, MeshFace, Polytope};
use crate::tests::scene::rng;
use proptest::prelude::*;

const TETRAHEDRON_CORNERS: [DVec3; 4] = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];

fn ball(radius: f64) -> Polytope {
    Polytope {
        points: vec![DVec3::ZERO],
        radius,
        ..Polytope::default()
    }
}

#[test]
fn invalid_triangles_are_refused() {
    let made = |faces: &[[u32; 3]]| {
        let ids: Vec<u32> = (0..faces.len() as u32).collect();
        Pieces::from_triangles(&TETRAHEDRON_CORNERS, faces, &ids).map(|pieces| pieces.len())
    };
    assert_eq!(made(&[[0, 1, 2], [1, 2, 3]]), Ok(2));
    assert_eq!(made(&[]), Err(InputError::NoPieces));
    let missing = InputError::VertexOutOfRange {
        face: 1,
        vertex: 4,
        vertices: 4,
    };
    assert_eq!(made(&[[0, 1, 2], [0, 4, 1]]), Err(missing));
    // A triangle of zero area is accepted.
    assert_eq!(made(&[[1, 1, 1], [0, 1, 1]]), Ok(2));
}

#[test]
fn invalid_points_are_refused_by_piece_and_point() {
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1.1e12, -1.1e12] {
        for axis in 0..3 {
            let mut points = TETRAHEDRON_CORNERS;
            points[3][axis] = bad;
            let made = Pieces::from_triangles(&points, &[[0, 1, 2], [2, 3, 0]], &[0, 1]);
            let expected = InputError::BadPoint { piece: 1, point: 1 };
            assert_eq!(made.err(), Some(expected.clone()), "{bad}");
            let made = Pieces::from_polytopes(&[
                ball(0.0),
                Polytope {
                    points: points[2..].to_vec(),
                    ..Polytope::default()
                },
            ]);
            assert_eq!(made.err(), Some(expected), "{bad}");
        }
    }
    // A vertex that no face uses may have any coordinates.
    let mut points = TETRAHEDRON_CORNERS;
    points[3].x = f64::NAN;
    assert!(Pieces::from_triangles(&points, &[[0, 1, 2]], &[0]).is_ok());
}

#[test]
fn invalid_polytopes_are_refused() {
    let refused = |polytope: Polytope| Pieces::from_polytopes(&[ball(1.0), polytope]).err();
    for bad in [-1.0, -f64::MIN_POSITIVE, f64::NAN, f64::INFINITY, 1.1e12] {
        let radius = match refused(ball(bad)) {
            Some(InputError::BadRadius { piece: 1, radius }) => radius,
            other => panic!("{other:?}"),
        };
        assert_eq!(radius.to_bits(), bad.to_bits());
    }
    let empty = InputError::EmptyPiece { piece: 1 };
    assert_eq!(refused(Polytope::default()), Some(empty));
    assert_eq!(
        Pieces::from_polytopes(&[]).err(),
        Some(InputError::NoPieces)
    );
    for corners in [vec![0, 1], vec![0, 1, 4], vec![]] {
        let facet = |corners: Vec<u32>| Facet {
            origin: FacetOrigin::Face(0),
            corners,
        };
        let polytope = Polytope {
            points: TETRAHEDRON_CORNERS.to_vec(),
            facets: vec![facet(vec![0, 1, 2]), facet(corners)],
            ..Polytope::default()
        };
        let expected = InputError::FacetOutOfRange { piece: 1, facet: 1 };
        assert_eq!(refused(polytope), Some(expected));
    }
    let face = |x: f64| MeshFace {
        id: 0,
        vertices: [0, 1, 2],
        corners: [
            TETRAHEDRON_CORNERS[0],
            TETRAHEDRON_CORNERS[1],
            DVec3::splat(x),
        ],
    };
    let polytope = Polytope {
        points: TETRAHEDRON_CORNERS.to_vec(),
        faces: vec![face(1.0), face(f64::NAN)],
        ..Polytope::default()
    };
    let expected = InputError::BadFace { piece: 1, face: 1 };
    assert_eq!(refused(polytope), Some(expected));
}

#[test]
fn triangles_name_vertices_edges_and_faces_of_the_mesh() {
    let pieces =
        Pieces::from_triangles(&TETRAHEDRON_CORNERS, &[[0, 1, 2], [3, 2, 1]], &[10, 20]).unwrap();
    assert_eq!(pieces.feature(0, &mean(&[2])), Feature::Vertex(2));
    assert_eq!(pieces.feature(1, &mean(&[0])), Feature::Vertex(3));
    assert_eq!(pieces.feature(1, &mean(&[2, 0])), Feature::Edge(1, 3));
    assert_eq!(pieces.feature(1, &mean(&[0, 2, 1])), Feature::Face(20));
    assert_eq!(pieces.feature(1, &mean(&[])), Feature::Piece(1));
}

#[test]
fn boxes_name_corners_edges_and_facets() {
    let body = Body::cuboid(DVec3::ONE).unwrap();
    let pieces = body.pieces();
    assert_eq!(pieces.feature(0, &mean(&[5])), Feature::Vertex(5));
    // Corners 0 and 1 differ in x alone: they span an edge.
    assert_eq!(pieces.feature(0, &mean(&[1, 0])), Feature::Edge(0, 1));
    // Corners 0 and 3 are opposite in the face towards −z; corners 0 and 7 in the box.
    assert_eq!(pieces.feature(0, &mean(&[0, 3])), Feature::Face(4));
    assert_eq!(pieces.feature(0, &mean(&[0, 7])), Feature::Piece(0));
    assert_eq!(pieces.feature(0, &mean(&[1, 3, 7])), Feature::Face(1));
    assert_eq!(pieces.feature(0, &mean(&[0, 3, 5])), Feature::Piece(0));
    // The faces are counterclockwise seen from outside, as documented.
    let piece = pieces.get(0);
    for (face, corners) in piece.facets.iter().enumerate() {
        let at = |k: usize| piece.points[corners[k] as usize];
        let normal = (at(1) - at(0)).cross(at(2) - at(0)).normalize();
        let sign = if face % 2 == 0 { -1.0 } else { 1.0 };
        assert_eq!(normal[face / 2], sign, "face {face}");
    }
}

#[test]
fn balls_and_capsules_name_their_points() {
    let capsule = Body::capsule(0.5, 1.0).unwrap();
    assert_eq!(capsule.pieces().feature(0, &mean(&[1])), Feature::Vertex(1));
    assert_eq!(
        capsule.pieces().feature(0, &mean(&[0, 1])),
        Feature::Edge(0, 1)
    );
    assert_eq!(capsule.pieces().get(0).radius, 0.5);
}

proptest! {
    /// Tests that reordering pieces keeps each piece's points, radius, facets and mesh numbers.
    #[test]
    fn order_changes_nothing_but_the_order(seed in any::<u64>(), count in 1usize..12) {
        use rand::seq::SliceRandom;
        let polytopes: Vec<Polytope> = (0..count)
            .map(|k| Polytope {
                points: (0..=k).map(|p| DVec3::splat((10 * k + p) as f64)).collect(),
                vertex_ids: (0..=k as u32).map(|p| 100 * k as u32 + p).collect(),
                facets: (2..k as u32)
                    .map(|c| Facet { origin: FacetOrigin::Face(1000 * k as u32 + c), corners: vec![0, c - 1, c] })
                    .collect(),
                faces: Vec::new(),
                radius: k as f64,
            })
            .collect();
        let pieces = Pieces::from_polytopes(&polytopes).unwrap();
        let mut order: Vec<u32> = (0..count as u32).collect();
        order.shuffle(&mut rng(seed));
        let other = pieces.with_piece_order(&order);
        for (k, &from) in order.iter().enumerate() {
            let (piece, same) = (other.get(k), pieces.get(from as usize));
            prop_assert_eq!(piece.points, same.points);
            prop_assert_eq!(piece.radius, same.radius);
            let loops = |piece: Piece<'_>| piece.facets.iter().map(<[u32]>::to_vec).collect::<Vec<_>>();
            prop_assert_eq!(loops(piece), loops(same));
            prop_assert_eq!(other.feature(k, &mean(&[0])), Feature::Vertex(100 * from));
            if from > 2 {
                prop_assert_eq!(other.feature(k, &mean(&[0, 1, 2])), Feature::Face(1000 * from + 2));
            }
        }
    }
}

/// Returns the combination of some corners with equal weights.
fn mean(corners: &[u32]) -> ConvexCombination {
    let mut mean = ConvexCombination::EMPTY;
    corners
        .iter()
        .for_each(|&corner| mean.add_weighted_point(corner, 1.0));
    mean
}

#[test]
fn points_on_virtual_facets_within_a_face_are_named_by_it() {
    // The bottom of a box is two triangles of the mesh; its other facets are virtual.
    let sign = |k: u32, bit: u32| if k >> bit & 1 == 1 { 1.0 } else { -1.0 };
    let corner = |k| DVec3::new(sign(k, 0), sign(k, 1), sign(k, 2));
    let facet = |origin, corners: &[u32]| Facet {
        origin,
        corners: corners.to_vec(),
    };
    let polytope = Polytope {
        points: (0..8).map(corner).collect(),
        facets: vec![
            facet(FacetOrigin::Faces, &[0, 2, 3, 1]),
            facet(FacetOrigin::Virtual, &[4, 5, 7, 6]),
        ],
        faces: vec![
            MeshFace {
                id: 10,
                vertices: [0, 2, 3],
                corners: [corner(0), corner(2), corner(3)],
            },
            MeshFace {
                id: 11,
                vertices: [0, 3, 1],
                corners: [corner(0), corner(3), corner(1)],
            },
        ],
        ..Polytope::default()
    };
    let pieces = Pieces::from_polytopes(&[polytope]).unwrap();
    let weighted = |terms: &[(u32, f64)]| {
        let mut point = ConvexCombination::EMPTY;
        terms
            .iter()
            .for_each(|&(corner, weight)| point.add_weighted_point(corner, weight));
        pieces.feature(0, &point)
    };
    assert_eq!(weighted(&[(1, 0.5), (2, 0.4)]), Feature::Face(11));
    assert_eq!(weighted(&[(1, 0.4), (2, 0.5)]), Feature::Face(10));
    assert_eq!(weighted(&[(0, 0.5), (1, 0.5)]), Feature::Face(11));
    assert_eq!(weighted(&[(4, 0.5), (5, 0.5)]), Feature::Piece(0));
    assert_eq!(weighted(&[(4, 0.5), (7, 0.5)]), Feature::Piece(0));
    assert_eq!(weighted(&[(0, 0.5), (7, 0.5)]), Feature::Piece(0));
}

/// Tests that points of a polytope with only virtual facets have no mesh feature, but the piece as a whole.
#[test]
fn a_polytope_of_virtual_facets_has_no_names() {
    let loops = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
    let facets = loops.map(|corners| Facet {
        origin: FacetOrigin::Virtual,
        corners: corners.to_vec(),
    });
    let hull = Polytope {
        points: TETRAHEDRON_CORNERS.to_vec(),
        facets: facets.to_vec(),
        ..Polytope::default()
    };
    let pieces = Pieces::from_polytopes(&[ball(1.0), hull]).unwrap();
    for corners in [&[2][..], &[0, 1], &[0, 1, 2]] {
        assert_eq!(pieces.feature(1, &mean(corners)), Feature::Piece(1));
    }
    assert_eq!(pieces.feature(0, &mean(&[0])), Feature::Vertex(0));
}
