use super::*;
use crate::mesh::TriangleMesh;
use crate::solid::solid_surface;
use crate::solid::topology::TopologyDefects;
use crate::test_meshes::{
    block_cells, cubes, merged_meshes, mesh, mesh_with_reversed_faces, scaled_and_moved,
    star_bipyramid, tetrahedron,
};

fn is_star_shaped(mesh: &TriangleMesh) -> bool {
    star_center(&Manifold::without_intersection_check(mesh, &TopologyDefects::of(mesh)).unwrap())
        .is_some()
}

#[test]
fn convex_and_star_shaped_solids_are_recognised() {
    assert!(is_star_shaped(&tetrahedron()));
    assert!(
        is_star_shaped(&mesh_with_reversed_faces(&tetrahedron())),
        "turned by the manifold"
    );
    assert!(is_star_shaped(&cubes(&block_cells([3, 2, 1]))));
    assert!(is_star_shaped(&star_bipyramid(40, 0.5)));
}

#[test]
fn others_are_not() {
    let one = tetrahedron();
    let around = merged_meshes(&[&one, &scaled_and_moved(&one, 3.0, DVec3::splat(-0.3))]);
    assert!(
        !is_star_shaped(&around),
        "a surface seen through another one"
    );
    assert!(!is_star_shaped(&cubes(&[
        [0, 0, 0],
        [1, 0, 0],
        [0, 1, 0],
        [2, 1, 0],
        [2, 0, 0]
    ])));
    let corners = vec![DVec3::ZERO, DVec3::X, DVec3::Y];
    assert!(!is_star_shaped(&mesh(corners, &[[0, 1, 2], [0, 2, 1]])));
}

/// Tests that a double cone that winds twice around its axis is not star-shaped, although every face is outward and
/// every edge convex.
#[test]
fn a_surface_that_winds_twice_is_not_star_shaped() {
    let turns = 10;
    let mut vertices = vec![DVec3::Z, -DVec3::Z];
    for k in 0..turns {
        let angle = 2.0 * std::f64::consts::TAU * (f64::from(k) + 0.5) / f64::from(turns);
        // Two rims without a common vertex.
        let radius = if k < turns / 2 { 1.0 } else { 1.25 };
        vertices.push(DVec3::new(radius * angle.cos(), radius * angle.sin(), 0.0));
    }
    let rim = |k: i32| 2 + (k % turns) as u32;
    let faces: Vec<[u32; 3]> = (0..turns)
        .flat_map(|k| [[rim(k), rim(k + 1), 0], [rim(k + 1), rim(k), 1]])
        .collect();
    let twice = mesh(vertices, &faces);
    assert!(!is_star_shaped(&twice));
    assert!(solid_surface(&twice).is_err());
}
