use super::*;
use crate::solid::solid_surface;
use crate::test_meshes::{
    block_cells, cubes, merged_meshes, mesh, mesh_with_reversed_faces, scaled_and_moved,
    tetrahedron,
};

fn error_message(mesh: &TriangleMesh) -> String {
    solid_surface(mesh)
        .err()
        .map_or(String::new(), |e| e.to_string())
}

#[test]
fn twins_run_the_other_way() {
    let mesh = cubes(&block_cells([2, 2, 1]));
    let manifold = solid_surface(&mesh).unwrap();
    for h in 0..3 * manifold.faces().len() as u32 {
        let [v, w] = manifold.ends(h);
        assert_eq!(manifold.ends(manifold.twin(h)), [w, v]);
        assert_eq!(manifold.twin(manifold.twin(h)), h);
    }
}

#[test]
fn edges_of_a_step_bend_both_ways() {
    let mesh = cubes(&[[0, 0, 0], [1, 0, 0], [0, 0, 1]]);
    let manifold = solid_surface(&mesh).unwrap();
    let count = |bend| {
        let all = 0..3 * manifold.faces().len() as u32;
        all.filter(|&h| manifold.classify_dihedral(h) == bend)
            .count()
    };
    // One reflex edge of unit length; each edge has two halves.
    assert_eq!(count(Dihedral::Reflex), 2);
    // 14 squares have 14 diagonals and 28 edges between them; 6 of these are within a plane.
    assert_eq!(count(Dihedral::Coplanar), 2 * (14 + 6));
    assert_eq!(count(Dihedral::Convex), 2 * (28 - 1 - 6));
}

#[test]
fn a_mesh_that_is_inside_out_is_turned() {
    let mesh = mesh_with_reversed_faces(&tetrahedron());
    let manifold = solid_surface(&mesh).unwrap();
    assert!((0..12).all(|h| manifold.classify_dihedral(h) == Dihedral::Convex));
}

#[test]
fn faults_name_the_elements() {
    let solid = tetrahedron();
    let open = mesh(solid.vertices().to_vec(), &solid.faces()[1..]);
    assert!(
        error_message(&open).contains("edges with one face: 3 (e0-1"),
        "{}",
        error_message(&open)
    );

    let mut faces = solid.faces().to_vec();
    faces[3].swap(0, 1);
    let flipped = mesh(solid.vertices().to_vec(), &faces);
    assert!(
        error_message(&flipped).contains("look opposite ways: 3 (e0-2"),
        "{}",
        error_message(&flipped)
    );

    // Two tetrahedra along one edge.
    let other = mesh(
        vec![DVec3::ZERO, DVec3::X, -DVec3::Y, -DVec3::Z],
        solid.faces(),
    );
    let along_an_edge = merged_meshes(&[&solid, &other]);
    assert!(error_message(&along_an_edge).contains("shared by closed parts: 1 (e0-1)"));

    let pierced = merged_meshes(&[&solid, &scaled_and_moved(&solid, 1.0, DVec3::splat(0.2))]);
    assert!(
        error_message(&pierced).contains("faces that intersect: "),
        "{}",
        error_message(&pierced)
    );

    let tiny = scaled_and_moved(&solid, 1e-95, DVec3::ZERO);
    assert!(
        error_message(&tiny).contains("vertex 1 has a coordinate nearer to 0"),
        "{}",
        error_message(&tiny)
    );

    // A corner on the middle of an edge: one face without area.
    let vertices = vec![DVec3::ZERO, 2.0 * DVec3::X, DVec3::Y, DVec3::Z, DVec3::X];
    let faces = [
        [0, 2, 1],
        [0, 1, 4],
        [0, 4, 3],
        [4, 1, 3],
        [1, 2, 3],
        [2, 0, 3],
    ];
    let needle = mesh(vertices, &faces);
    assert!(
        error_message(&needle).contains("faces without area: 1 (1)"),
        "{}",
        error_message(&needle)
    );
}
