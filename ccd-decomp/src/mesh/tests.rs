use crate::{MeshFault, TriangleMesh};
use ccd_core::glam::{DVec3, dvec3};

/// Returns the corners of a unit square, its first corner once more, and a point on its first side.
fn points() -> Vec<DVec3> {
    vec![
        dvec3(0.0, 0.0, 0.0),
        dvec3(1.0, 0.0, 0.0),
        dvec3(1.0, 1.0, 0.0),
        dvec3(0.0, 1.0, 0.0),
        dvec3(-0.0, 0.0, 0.0),
        dvec3(0.5, 0.0, 0.0),
    ]
}

fn mesh(faces: &[[u32; 3]]) -> TriangleMesh {
    TriangleMesh::new(points(), faces).unwrap()
}

#[test]
fn duplicates_are_merged_in_any_rotation_and_whichever_vertex_names_a_point() {
    let mesh = mesh(&[[0, 1, 2], [0, 2, 3], [1, 2, 0], [2, 4, 1]]);
    assert_eq!(mesh.faces(), [[0, 1, 2], [0, 2, 3]]);
    assert_eq!(mesh.repairs().duplicate_faces.count(), 2);
    assert_eq!(mesh.repairs().duplicate_faces.first_elements(), [2, 3]);
}

#[test]
fn faces_back_to_back_are_both_kept() {
    let mesh = mesh(&[[0, 1, 2], [0, 2, 1]]);
    assert_eq!(mesh.faces().len(), 2);
    assert!(mesh.repairs().duplicate_faces.is_empty());
}

#[test]
fn a_collapsed_face_is_dropped_where_it_lies_on_an_edge() {
    // Collapsed faces: a side, a side by a duplicate of its corner, and a corner.
    let mesh = mesh(&[[0, 0, 1], [0, 1, 2], [4, 1, 1], [2, 2, 2]]);
    assert_eq!(mesh.faces(), [[0, 1, 2]]);
    assert_eq!(mesh.face_ids(), [1]);
    assert_eq!(mesh.repairs().collapsed_faces.first_elements(), [0, 2, 3]);
}

#[test]
fn a_collapsed_face_is_kept_where_nothing_else_holds_it() {
    // Collapsed faces: a diagonal off every edge, the same again, a point of it, and an isolated point.
    let kept = mesh(&[[3, 3, 3], [0, 1, 5], [1, 3, 3], [3, 1, 1], [2, 2, 2]]);
    assert_eq!(kept.face_ids(), [1, 2, 4]);
    assert_eq!(kept.repairs().collapsed_faces.first_elements(), [0, 3]);
    assert_eq!(kept.repairs().zero_area_faces.count(), 3);
    assert_eq!(mesh(&[[0, 4, 0]]).faces(), [[0, 4, 0]]);
}

#[test]
fn a_face_without_area_is_kept_and_reported() {
    let mesh = mesh(&[[0, 5, 1], [0, 1, 2]]);
    assert_eq!(mesh.faces().len(), 2);
    assert_eq!(mesh.repairs().zero_area_faces.first_elements(), [0]);
    assert_eq!(
        mesh.repairs().unreferenced_vertices.first_elements(),
        [3, 4]
    );
}

/// Tests that exactly the collinear triangles count as faces without area, even if products of their coordinates
/// underflow.
#[test]
fn the_finest_face_has_an_area() {
    for unit in [1e-170, 1e-300, f64::MIN_POSITIVE, f64::from_bits(1)] {
        let [x, y] = [DVec3::X, DVec3::Y].map(|axis| unit * axis);
        let vertices = vec![DVec3::ZERO, x, y, 2.0 * x, x + y, 2.0 * (x + y), DVec3::X];
        let faces = [
            [0, 1, 2],
            [0, 1, 3],
            [0, 4, 5],
            [1, 2, 4],
            [0, 6, 2],
            [0, 6, 1],
        ];
        let mesh = TriangleMesh::new(vertices, &faces).unwrap();
        assert_eq!(
            mesh.repairs().zero_area_faces.first_elements(),
            [1, 2, 5],
            "{unit:e}"
        );
    }
}

#[test]
fn a_concave_polygon_is_filled() {
    let file = "v 0 0 0\nv 4 0 0\nv 1 1 0\nv 0 4 0\nf 2 3 4 1\nf 3 4 1 2\n";
    let mesh = TriangleMesh::from_reader(crate::Format::Obj, file.as_bytes()).unwrap();
    // From corner 4,0 one triangle of the fan is reversed; from the notch none is.
    assert_eq!(mesh.faces()[..2], [[1, 2, 0], [2, 3, 0]]);
    assert_eq!(mesh.face_ids()[..2], [0, 0]);
    assert_eq!(
        mesh.repairs().triangulated_polygons.first_elements(),
        [0, 1]
    );
    assert!(mesh.repairs().overhanging_fans.is_empty());
}

/// Tests that a polygon whose first three corners are collinear is triangulated without degenerate triangles. Other
/// polygons keep their fan.
#[test]
fn a_polygon_with_straight_corners_is_filled() {
    let file = "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nf 1 2 3 4 5\nf 4 5 1 3\n";
    let mesh = TriangleMesh::from_reader(crate::Format::Obj, file.as_bytes()).unwrap();
    assert_eq!(mesh.faces().len(), 5);
    assert_eq!(mesh.faces()[3..], [[3, 4, 0], [3, 0, 2]]);
    assert!(mesh.repairs().zero_area_faces.is_empty());
}

#[test]
fn a_polygon_that_meets_itself_is_covered_and_reported() {
    let file = "v 0 0 0\nv 2 2 0\nv 2 0 0\nv 0 1 0\nf 1 2 3 4\n";
    let mesh = TriangleMesh::from_reader(crate::Format::Obj, file.as_bytes()).unwrap();
    assert_eq!(mesh.faces(), [[0, 1, 2], [0, 2, 3]]);
    assert_eq!(mesh.repairs().overhanging_fans.first_elements(), [0]);
}

#[test]
fn invalid_vertices_and_faces_are_refused() {
    let fault = |points: Vec<DVec3>, faces: &[[u32; 3]]| {
        TriangleMesh::new(points, faces).unwrap_err().fault
    };
    assert!(matches!(fault(vec![], &[]), MeshFault::NoVertices));
    assert!(matches!(fault(points(), &[]), MeshFault::NoFaces));
    let mut bad = points();
    bad[5].z = f64::NAN;
    let error = fault(bad.clone(), &[[0, 1, 2]]);
    assert!(
        matches!(
            error,
            MeshFault::NotFinite {
                vertex: 5,
                line: None
            }
        ),
        "{error}"
    );
    bad[5].z = -1.1e12;
    let error = fault(bad, &[[0, 1, 2]]);
    assert!(
        matches!(
            error,
            MeshFault::CoordinateTooLarge {
                vertex: 5,
                line: None
            }
        ),
        "{error}"
    );
    let error = fault(points(), &[[0, 1, 2], [0, 1, u32::MAX]]);
    let expected = "face 1 names vertex 4294967295, but there are 6, numbered from 0";
    assert_eq!(error.to_string(), expected);
}
