use crate::test_meshes::{cubes, mesh, tetrahedron};
use crate::{
    AffineMap, Format, MeshFault, PieceChoice, TopologyDefects, TriangleMesh, body_from_mesh,
};
use ccd_core::glam::{DAffine3, DMat3, DQuat, DVec3, dvec3};
use ccd_core::{Pose, Solidity};

fn scaling_map(x: f64, y: f64, z: f64) -> AffineMap {
    DAffine3::from_scale(dvec3(x, y, z)).into()
}

fn cube() -> TriangleMesh {
    cubes(&[[0, 0, 0]])
}

fn volume(mesh: &TriangleMesh) -> f64 {
    TopologyDefects::of(mesh).signed_volume
}

#[test]
fn a_mesh_is_moved_and_scaled() {
    let pose = Pose::new([1.0, 2.0, 3.0], DQuat::from_rotation_z(0.5)).unwrap();
    let moved = cube()
        .transformed(AffineMap::from_scale_and_pose(2.0, pose))
        .unwrap();
    for (image, &point) in moved.vertices().iter().zip(cube().vertices()) {
        assert!(image.distance(pose.transform_point(2.0 * point)) < 1e-15);
    }
    assert_eq!(moved.faces(), cube().faces());
    assert!((volume(&moved) - 8.0).abs() < 1e-13);
    let same = cube().transformed(AffineMap::IDENTITY).unwrap();
    assert_eq!(same.vertices(), cube().vertices());
}

/// Tests that a mirrored solid is still a solid with outward orientation.
#[test]
fn a_mirror_turns_the_faces_round() {
    for map in [scaling_map(-1.0, 1.0, 1.0), scaling_map(-1.0, -2.0, -0.5)] {
        let image = cube().transformed(map).unwrap();
        assert!(volume(&image) > 0.9, "{map:?}");
        let [a, b, c] = cube().faces()[5];
        assert_eq!(image.faces()[5], [a, c, b]);
    }
    assert_eq!(
        volume(&cube().transformed(scaling_map(-1.0, -1.0, 1.0)).unwrap()),
        1.0
    );
}

/// Tests that a cube flattened to a plane keeps triangles on both sides of the plane. The other faces collapse to edges
/// of these, and are dropped.
#[test]
fn a_flattened_mesh_is_repaired() {
    let flat = cube().transformed(scaling_map(1.0, 1.0, 0.0)).unwrap();
    assert_eq!(flat.repairs().collapsed_faces.count(), 8);
    assert_eq!(flat.faces().len(), 4);
    assert_eq!(volume(&flat), 0.0);
    assert!(body_from_mesh(&flat, PieceChoice::Auto).is_ok());
    // A single point is a valid mesh.
    let point = cube().transformed(scaling_map(0.0, 0.0, 0.0)).unwrap();
    assert_eq!(point.faces().len(), 1);
    assert_eq!(point.bounding_box(), [DVec3::ZERO; 2]);
    assert!(body_from_mesh(&point, PieceChoice::Auto).is_ok());
}

#[test]
fn images_out_of_range_are_refused() {
    let fault = |map: AffineMap| cube().transformed(map).unwrap_err().fault;
    let far = fault(AffineMap::from(Pose::at([2e12, 0.0, 0.0]).unwrap()));
    assert!(
        matches!(far, MeshFault::CoordinateTooLarge { vertex: 0, .. }),
        "{far}"
    );
    for bad in [f64::NAN, f64::INFINITY, 1e308] {
        let matrix = DMat3::from_cols(DVec3::splat(bad), DVec3::splat(-bad), DVec3::Z);
        let fault = fault(DAffine3::from_mat3(matrix).into());
        let named = matches!(
            fault,
            MeshFault::NotFinite { .. } | MeshFault::CoordinateTooLarge { .. }
        );
        assert!(named, "{bad}: {fault}");
    }
}

#[test]
fn numbers_go_on_in_merged_meshes() {
    // Triangles 0 and 1 are one polygon, face 2 is dropped, and face 3 is the next.
    let text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 9 9 9\nf 1 2 3 4\nf 1 1 2\nf 4 3 2\n";
    let one = TriangleMesh::from_reader(Format::Obj, text.as_bytes()).unwrap();
    assert_eq!(one.face_ids(), [0, 0, 2]);
    let other = one.transformed(Pose::at([0.0, 0.0, 1.0]).unwrap()).unwrap();
    let both = TriangleMesh::merge([&one, &other, &one]).unwrap();
    assert_eq!(both.vertices().len(), 15);
    // The last mesh equals the first: its faces are duplicates.
    assert_eq!(both.face_ids(), [0, 0, 2, 3, 3, 5]);
    assert_eq!(both.faces()[4], [5, 7, 8]);
    let repairs = both.repairs();
    assert_eq!(repairs.triangulated_polygons.first_elements(), [0, 3, 6]);
    assert_eq!(repairs.collapsed_faces.first_elements(), [1, 4, 7]);
    assert_eq!(repairs.unreferenced_vertices.first_elements(), [4, 9, 14]);
    assert_eq!(repairs.duplicate_faces.first_elements(), [6, 6, 8]);
    let error = TriangleMesh::merge([]).unwrap_err();
    assert!(matches!(error.fault, MeshFault::NoVertices), "{error}");
}

/// Tests that the merged halves of a cube form one solid without the squares between them, and two touching solids with
/// these squares.
#[test]
fn merged_solids_are_solid() {
    let moved = cube()
        .transformed(Pose::at([1.0, 0.0, 0.0]).unwrap())
        .unwrap();
    let both = TriangleMesh::merge([&cube(), &moved]).unwrap();
    assert_eq!(both.faces().len(), 24);
    assert_eq!(volume(&both), 2.0);
    let apart = cube()
        .transformed(Pose::at([3.0, 0.0, 0.0]).unwrap())
        .unwrap();
    let both = TriangleMesh::merge([&cube(), &apart]).unwrap();
    let body = body_from_mesh(&both, PieceChoice::Auto).unwrap().body;
    assert_eq!(body.solidity(), Solidity::Solid);
}

#[test]
fn the_box_is_about_the_faces() {
    assert_eq!(tetrahedron().bounding_box(), [DVec3::ZERO, DVec3::ONE]);
    let vertices = vec![DVec3::ZERO, DVec3::X, -DVec3::Y, 5.0 * DVec3::Z];
    let corners = mesh(vertices, &[[0, 1, 2]]).bounding_box();
    assert_eq!(corners, [-DVec3::Y, DVec3::X]);
}
