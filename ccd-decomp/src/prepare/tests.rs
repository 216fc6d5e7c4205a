use crate::{Format, PieceChoice, TriangleMesh, body_from_mesh, prepare};
use ccd_core::ConvexCombination;
use ccd_core::glam::dvec3;

const TETRAHEDRON_OBJ: &str =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";

fn report(file: &str) -> String {
    let mesh = TriangleMesh::from_reader(Format::Obj, file.as_bytes()).unwrap();
    let prepared = body_from_mesh(&mesh, PieceChoice::Auto).unwrap();
    assert_eq!(prepared.body.pieces().len(), prepared.report.pieces);
    assert_eq!(prepared.body.solidity(), prepared.report.volume);
    prepared.report.to_string()
}

#[test]
fn a_closed_mesh_is_solid() {
    assert_eq!(report(TETRAHEDRON_OBJ), "1 convex hull, solid");
}

#[test]
fn a_closed_mesh_inside_out_is_solid_and_says_so() {
    let file = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 2 3 1\nf 4 2 1\nf 4 3 2\nf 4 1 3\n";
    assert_eq!(
        report(file),
        "1 convex hull, solid (closed, inside out: taken as turned outward)"
    );
}

#[test]
fn an_open_mesh_is_a_surface_and_says_why() {
    let file = TETRAHEDRON_OBJ.replace("f 3 1 4", "f 2 2 3");
    assert_eq!(
        report(&file),
        "3 triangles, surface only (open; edges with one face: 3 (e0-2, e0-3, e2-3); \
         collapsed faces dropped: 1 (3))"
    );
}

#[test]
fn features_carry_the_numbers_of_the_file() {
    let file = "v 9 9 9\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 2 2 3\nf 2 3 4\n";
    let mesh = TriangleMesh::from_reader(Format::Obj, file.as_bytes()).unwrap();
    let body = body_from_mesh(&mesh, PieceChoice::Triangles).unwrap().body;
    let feature = |support: &[u32]| {
        let mut point = ConvexCombination::EMPTY;
        support
            .iter()
            .for_each(|&corner| point.add_weighted_point(corner, 1.0));
        body.pieces().feature(0, &point).to_string()
    };
    assert_eq!(feature(&[0]), "v1");
    assert_eq!(feature(&[1, 2]), "e2-3");
    assert_eq!(feature(&[0, 1, 2]), "f1");
}

/// Tests that `ccd_core` accepts the hull tree of a rotated block, whose coplanar vertices are no longer exactly
/// coplanar.
#[test]
fn hull_trees_of_nearly_flat_meshes_are_proven() {
    use crate::test_meshes::{block_cells, cubes, scaled_and_moved};
    let step = cubes(&block_cells([4, 4, 2]));
    let vertices = scaled_and_moved(&step, 0.1, dvec3(0.3, 0.1, 0.7))
        .vertices()
        .to_vec();
    let tilt = ccd_core::glam::DQuat::from_axis_angle(dvec3(0.6, 0.0, 0.8), 0.4);
    let turned: Vec<_> = vertices.iter().map(|&p| tilt * p).collect();
    let turned = TriangleMesh::new(turned, step.faces()).unwrap();
    let model = prepare(&turned, PieceChoice::Triangles).unwrap();
    let tree = model.with_hull_tree().unwrap().hull_tree.unwrap();
    // The root has points in the middle of its sides, which rounding took outward.
    assert!(tree.hulls().get(0).points.len() > 8);
}
