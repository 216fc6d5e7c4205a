use super::write_obj_pieces;
use crate::{Format, TriangleMesh};
use ccd_core::glam::{DVec3, dvec3};
use ccd_core::{Body, Facet, FacetOrigin, Pieces, Polytope};

fn obj_text(pieces: &Pieces) -> String {
    let mut bytes = Vec::new();
    write_obj_pieces(pieces, &mut bytes).unwrap();
    String::from_utf8(bytes).unwrap()
}

#[test]
fn triangles_are_groups_of_one_face() {
    let vertices = [DVec3::ZERO, DVec3::X, DVec3::Y, dvec3(0.1, 0.2, -1e-300)];
    let pieces = Pieces::from_triangles(&vertices, &[[0, 1, 2], [0, 3, 1]], &[0, 1]).unwrap();
    let text = obj_text(&pieces);
    let groups: Vec<&str> = text.lines().filter(|line| line.starts_with('g')).collect();
    assert_eq!(groups, ["g piece_0", "g piece_1"]);
    let mesh = TriangleMesh::from_reader(Format::Obj, text.as_bytes()).unwrap();
    assert_eq!(mesh.faces(), [[0, 1, 2], [3, 4, 5]]);
    assert_eq!(mesh.vertices(), pieces.points());
}

#[test]
fn facets_are_polygons_that_name_their_own_group_s_vertices() {
    let half = DVec3::splat(0.5);
    let boxes = [
        Body::cuboid(half).unwrap(),
        Body::cuboid(2.0 * half).unwrap(),
    ];
    let polytopes: Vec<Polytope> = boxes
        .iter()
        .map(|body| {
            let piece = body.pieces().get(0);
            let facet = |corners: &[u32]| Facet {
                origin: FacetOrigin::Virtual,
                corners: corners.to_vec(),
            };
            Polytope {
                points: piece.points.to_vec(),
                facets: piece.facets.iter().map(facet).collect(),
                ..Polytope::default()
            }
        })
        .collect();
    let text = obj_text(&Pieces::from_polytopes(&polytopes).unwrap());
    let (first, second) = text.split_once("g piece_1\n").unwrap();
    let faces = |group: &str| group.lines().filter(|line| line.starts_with('f')).count();
    assert_eq!((faces(first), faces(second)), (6, 6));
    assert!(first.contains("f 1 5 7 3\n"), "{first}");
    assert!(second.contains("f 9 13 15 11\n"), "{second}");
    let mesh = TriangleMesh::from_reader(Format::Obj, text.as_bytes()).unwrap();
    assert_eq!(mesh.faces().len(), 2 * 12);
}

#[test]
fn pieces_without_facets_are_a_segment_or_points() {
    let segment = Polytope {
        points: vec![DVec3::ZERO, DVec3::X],
        ..Polytope::default()
    };
    let cloud = Polytope {
        points: vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z],
        ..Polytope::default()
    };
    let text = obj_text(&Pieces::from_polytopes(&[segment, cloud]).unwrap());
    assert!(text.contains("l 1 2\n"), "{text}");
    assert!(text.ends_with("p 3 4 5 6\n"), "{text}");
}
