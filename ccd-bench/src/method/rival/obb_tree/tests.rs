use super::*;
use crate::method::rival::Placement;
use crate::method::rival::tests::samples::RandomSource;
use crate::method::rival::triangles_cross::triangles_cross;
use crate::scene::model::Model;

fn collect_triangle_indices(tree: &ObbTree, index: u32, into: &mut Vec<u32>) {
    match tree.node(index).content {
        NodeContent::Triangle(t) => into.push(t),
        NodeContent::Children(children) => children
            .iter()
            .for_each(|&child| collect_triangle_indices(tree, child, into)),
    }
}

#[test]
fn boxes_hold_their_triangles_and_leaves_all_of_them_once() {
    let mesh = Model::Knot216.generate().unwrap();
    let tree = ObbTree::new(&mesh);
    assert_eq!(tree.nodes.len(), 2 * mesh.faces().len() - 1);
    for (index, node) in tree.nodes.iter().enumerate() {
        let mut triangles = Vec::new();
        collect_triangle_indices(&tree, index as u32, &mut triangles);
        assert!(!triangles.is_empty());
        for corner in triangles.iter().flat_map(|&t| tree.triangle(t)) {
            let along = node
                .bounds
                .axes
                .transpose_mul_vec3(*corner - node.bounds.center);
            assert!((along.abs() - node.bounds.half_extents).max_element() < 1e-12);
            assert!(corner.length() <= tree.radius_about_origin);
        }
    }
    let mut leaves = Vec::new();
    collect_triangle_indices(&tree, 0, &mut leaves);
    leaves.sort_unstable();
    assert!(leaves.into_iter().eq(0..mesh.faces().len() as u32));
}

#[test]
fn boxes_are_fitted() {
    let tree = ObbTree::new(&crate::method::rival::tests::samples::cuboid(3.0, 2.0, 1.0));
    assert!((tree.node(0).bounds.half_extents - DVec3::new(3.0, 2.0, 1.0)).length() < 1.0);
    for index in 0..tree.nodes.len() as u32 {
        if let NodeContent::Triangle(_) = tree.node(index).content {
            assert!(tree.node(index).bounds.half_extents.min_element() < 1e-12);
        }
    }
}

#[test]
fn triangles_that_nothing_splits_are_split_by_number() {
    let fan = |k: u32| {
        let (sin, cos) = (f64::from(k) * 0.1).sin_cos();
        let (p, q) = (DVec3::new(cos, sin, 0.0), DVec3::new(-sin, cos, 0.0));
        [p - 0.5 * q, -2.0 * p, p + 0.5 * q]
    };
    let vertices: Vec<DVec3> = (0..9).flat_map(fan).collect();
    let faces: Vec<[u32; 3]> = (0..9).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]).collect();
    let mesh = TriangleMesh::new(vertices, &faces).unwrap();
    assert_eq!(ObbTree::new(&mesh).nodes.len(), 17);
}

#[test]
fn crossings_are_those_of_all_pairs_of_triangles() {
    let mesh = Model::Knot216.generate().unwrap();
    let tree = ObbTree::new(&mesh);
    let corners: Vec<[DVec3; 3]> = mesh
        .faces()
        .iter()
        .map(|face| face.map(|v| mesh.vertices()[v as usize]))
        .collect();
    let mut samples = RandomSource::new(4);
    let (mut stack, mut crossings) = (Vec::new(), 0);
    for _ in 0..60 {
        let placement = Placement {
            rotation: DMat3::from_quat(samples.rotation()),
            translation: samples.vector(1.6),
        };
        let moved = corners.iter().map(|t| t.map(|p| placement.apply(p)));
        let any = moved
            .clone()
            .any(|t| corners.iter().any(|u| triangles_cross(&t, u)));
        let found = trees_intersect(&tree, &tree, &placement, &mut stack);
        assert_eq!(found, any);
        crossings += usize::from(any);
    }
    assert!((15..55).contains(&crossings), "{crossings} of 60");
}
