use super::*;
use crate::mesh::TriangleMesh;
use crate::solid::solid_surface;
use crate::test_meshes::{
    block_cells, cubes, merged_meshes, mesh_with_reversed_faces, scaled_and_moved, tetrahedron,
};
use ccd_core::FacetOrigin;
use ccd_core::glam::dvec3;

fn polytope(mesh: &TriangleMesh) -> Result<Polytope, DecomposeError> {
    convex_polytope(&solid_surface(mesh)?)
}

#[test]
fn a_block_has_eight_corners_and_six_sides() {
    let polytope = polytope(&cubes(&block_cells([3, 2, 4]))).unwrap();
    assert_eq!(polytope.points.len(), 8);
    assert_eq!(polytope.facets.len(), 6);
    assert!(
        polytope
            .facets
            .iter()
            .all(|f| f.origin == FacetOrigin::Faces)
    );
    assert_eq!(polytope.faces.len(), 2 * 2 * (6 + 8 + 12));
}

#[test]
fn faces_keep_their_numbers() {
    let mesh = mesh_with_reversed_faces(&tetrahedron());
    let polytope = polytope(&mesh).unwrap();
    let mut faces: Vec<FacetOrigin> = polytope.facets.iter().map(|f| f.origin).collect();
    faces.sort_by_key(|origin| format!("{origin:?}"));
    assert_eq!(faces, [0, 1, 2, 3].map(FacetOrigin::Face));
    assert_eq!(polytope.vertex_ids, [0, 1, 2, 3]);
}

#[test]
fn reflex_edges_are_named() {
    let step = cubes(&[[0, 0, 0], [1, 0, 0], [0, 0, 1]]);
    let Err(DecomposeError::NotConvex { edge }) = polytope(&step) else {
        panic!("a step is not convex");
    };
    // The reflex edge runs along y, where the two upper squares of the step meet.
    let ends = [edge.0, edge.1].map(|v| step.vertices()[v as usize]);
    assert!(ends.contains(&dvec3(1.0, 0.0, 1.0)) && ends.contains(&dvec3(1.0, 1.0, 1.0)));

    let one = tetrahedron();
    let two = merged_meshes(&[&one, &scaled_and_moved(&one, 1.0, dvec3(5.0, 0.0, 0.0))]);
    assert_eq!(
        polytope(&two),
        Err(DecomposeError::NotConnected { parts: 2 })
    );
}
