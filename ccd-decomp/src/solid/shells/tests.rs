use crate::solid::error::DecomposeError;
use crate::solid::shells::shell_numbers;
use crate::solid::solid_surface;
use crate::test_meshes::{
    block_cells, cubes, merged_meshes, mesh_with_reversed_faces, scaled_and_moved, tetrahedron,
};
use ccd_core::glam::{DVec3, dvec3};

#[test]
fn parts_are_distinguished() {
    let one = cubes(&block_cells([2, 1, 1]));
    let two = merged_meshes(&[&one, &scaled_and_moved(&one, 1.0, dvec3(3.0, 0.0, 0.0))]);
    let shells = shell_numbers(&solid_surface(&two).unwrap());
    let faces = one.faces().len();
    assert!(shells[..faces].iter().all(|&s| s == 0));
    assert!(shells[faces..].iter().all(|&s| s == 1));
}

#[test]
fn a_cavity_looks_inward() {
    let outer = scaled_and_moved(&cubes(&block_cells([1, 1, 1])), 4.0, DVec3::ZERO);
    let inner = scaled_and_moved(&cubes(&block_cells([1, 1, 1])), 1.0, DVec3::ONE);
    let hollow = merged_meshes(&[&outer, &mesh_with_reversed_faces(&inner)]);
    assert!(solid_surface(&hollow).is_ok());
    // A solid within another is still solid.
    assert!(solid_surface(&merged_meshes(&[&outer, &inner])).is_ok());
    // A third solid in the cavity.
    let core = scaled_and_moved(&tetrahedron(), 0.5, dvec3(1.1, 1.1, 1.1));
    assert!(
        solid_surface(&merged_meshes(&[
            &outer,
            &mesh_with_reversed_faces(&inner),
            &core
        ]))
        .is_ok()
    );
}

#[test]
fn a_part_that_is_inside_out_is_named() {
    let large = scaled_and_moved(&tetrahedron(), 5.0, DVec3::ZERO);
    let small = scaled_and_moved(&tetrahedron(), 1.0, dvec3(9.0, 0.0, 0.0));
    let error = solid_surface(&merged_meshes(&[&large, &mesh_with_reversed_faces(&small)])).err();
    assert_eq!(error, Some(DecomposeError::InsideOut { face: 4 }));
}
