use super::polytope::{Facet, FacetOrigin, Polytope};
use super::*;
use glam::DVec3;

/// Creates a body of two pieces: a box, and a square in the plane of the box's base that is twice as large.
fn box_on_a_square() -> Body {
    let sign = |k: u32, bit: u32| if k >> bit & 1 == 1 { 1.0 } else { -1.0 };
    let facet = |origin, corners: &[u32]| Facet {
        origin,
        corners: corners.to_vec(),
    };
    let box_of = [
        [0, 4, 6, 2],
        [1, 3, 7, 5],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 2, 3, 1],
        [4, 5, 7, 6],
    ];
    let boxed = Polytope {
        points: (0..8)
            .map(|k| DVec3::new(sign(k, 0), sign(k, 1), sign(k, 2) + 1.0))
            .collect(),
        facets: box_of
            .iter()
            .map(|f| facet(FacetOrigin::Virtual, f))
            .collect(),
        ..Polytope::default()
    };
    let square = Polytope {
        points: (0..4)
            .map(|k| 2.0 * DVec3::new(sign(k, 0), sign(k, 1), 0.0))
            .collect(),
        facets: vec![
            facet(FacetOrigin::Face(7), &[0, 2, 3, 1]),
            facet(FacetOrigin::Virtual, &[0, 1, 3, 2]),
        ],
        ..Polytope::default()
    };
    let pieces = Pieces::from_polytopes(&[boxed, square]).unwrap();
    Body::new(&pieces, Solidity::Surface).unwrap()
}

#[test]
fn a_virtual_facet_on_the_surface_takes_the_name_of_the_face_there() {
    let body = box_on_a_square();
    let boxed = (0..2)
        .find(|&k| body.pieces().get(k).points.len() == 8)
        .unwrap();
    let mean = |corners: &[u32]| {
        let mut mean = ConvexCombination::EMPTY;
        corners
            .iter()
            .for_each(|&corner| mean.add_weighted_point(corner, 1.0));
        mean
    };
    let name = |corners: &[u32]| body.feature(boxed as u32, &mean(corners));
    assert_eq!(name(&[0, 3]), Feature::Face(7));
    assert_eq!(name(&[0, 1]), Feature::Face(7));
    assert_eq!(name(&[4, 7]), Feature::Piece(boxed as u32));
    assert_eq!(name(&[0, 7]), Feature::Piece(boxed as u32));
}

/// Creates a tetrahedron twice: as a body of one piece, and as a body of four triangles.
fn tetrahedron_as_piece_and_as_triangles() -> [Body; 2] {
    let points = vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
    let faces = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
    let triangles = Pieces::from_triangles(&points, &faces, &[0, 1, 2, 3]).unwrap();
    let polytope = Polytope {
        facets: (0..)
            .zip(faces)
            .map(|(face, corners)| Facet {
                origin: FacetOrigin::Face(face),
                corners: corners.to_vec(),
            })
            .collect(),
        points,
        ..Polytope::default()
    };
    let one = Pieces::from_polytopes(&[polytope]).unwrap();
    [one, triangles].map(|pieces| Body::new(&pieces, Solidity::Solid).unwrap())
}

#[test]
fn a_surface_is_taken_against_many_triangles_only() {
    let [one, triangles] = tetrahedron_as_piece_and_as_triangles();
    let both = one
        .clone()
        .with_surface_triangles(triangles.clone())
        .unwrap();
    assert_eq!(both.body_for_query_against(&triangles).pieces().len(), 4);
    assert_eq!(both.body_for_query_against(&one).pieces().len(), 1);
    assert_eq!(both.body_for_query_against(&both).pieces().len(), 1);
    assert_eq!(
        both.body_for_query_against(&Body::sphere(1.0).unwrap())
            .pieces()
            .len(),
        1
    );
    assert_eq!(one.body_for_query_against(&triangles).pieces().len(), 1);
    assert_eq!(
        triangles.body_for_query_against(&triangles).pieces().len(),
        4
    );
    assert!(both.memory_usage() > one.memory_usage());
}

#[test]
fn invalid_surfaces_are_refused() {
    let [one, triangles] = tetrahedron_as_piece_and_as_triangles();
    let open = Body::new(triangles.pieces(), Solidity::Surface).unwrap();
    let refused = [
        one.clone().with_surface_triangles(open),
        one.clone().with_surface_triangles(one.clone()),
        triangles.clone().with_surface_triangles(triangles.clone()),
        Body::sphere(1.0).unwrap().with_surface_triangles(triangles),
    ];
    for body in refused {
        assert!(matches!(body, Err(InputError::BadSurface)));
    }
}
