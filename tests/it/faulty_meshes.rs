//! A mesh that bounds no solid gives a typed error that names the offending elements.

use ccd_core::glam::DVec3;
use ccd_decomp::{DecomposeError, Edge, Order, Topology, decompose};
use ccd_tests::models::{Mesh, cuboid, hollow, icosphere, torus};

fn error(mesh: &Mesh) -> DecomposeError {
    let Err(error) = decompose(&mesh.for_decomposition(), Order::default()) else {
        panic!("no fault found");
    };
    assert!(!error.to_string().is_empty());
    error
}

fn topology(mesh: &Mesh) -> Topology {
    match error(mesh) {
        DecomposeError::NotManifold { topology } => *topology,
        other => panic!("{other:?}"),
    }
}

/// Returns the pairs of faces that are reported to intersect.
fn crossings(mesh: &Mesh) -> Vec<[u32; 2]> {
    match error(mesh) {
        DecomposeError::SelfIntersecting { pairs } => {
            assert!(pairs.count() >= pairs.first().len());
            pairs.first().iter().map(|it| [it.face, it.other]).collect()
        }
        other => panic!("{other:?}"),
    }
}

fn cube() -> Mesh {
    cuboid(DVec3::ONE).mesh
}

#[test]
fn an_open_mesh_names_its_rim() {
    let mut mesh = cube();
    let [a, b, c] = mesh.faces.remove(5);
    let mut rim = [(a, b), (b, c), (c, a)].map(|(v, w)| Edge(v.min(w), v.max(w)));
    rim.sort_unstable();
    assert_eq!(topology(&mesh).boundary.first(), rim);
}

#[test]
fn a_flipped_face_names_its_edges() {
    let mut mesh = cube();
    mesh.faces[5].swap(0, 1);
    let [a, b, c] = mesh.faces[5];
    let mut edges = [(a, b), (b, c), (c, a)].map(|(v, w)| Edge(v.min(w), v.max(w)));
    edges.sort_unstable();
    assert_eq!(topology(&mesh).flipped.first(), edges);
}

#[test]
fn a_fin_names_its_edge() {
    let mut mesh = cube();
    let [a, b, _] = mesh.faces[5];
    mesh.vertices.push(3.0 * DVec3::ONE);
    mesh.faces.push([b, a, 8]);
    let topology = topology(&mesh);
    assert_eq!(topology.branching.first(), [Edge(a.min(b), a.max(b))]);
    assert_eq!(topology.boundary.count(), 2);
}

#[test]
fn solids_that_share_an_edge_name_it() {
    let mut mesh = cube();
    mesh.append(&cuboid(DVec3::ONE).moved(DVec3::new(2.0, 2.0, 0.0)).mesh);
    let shared = topology(&mesh).shared;
    // Corners 3 and 7 are those with positive x and y.
    assert_eq!(shared.first(), [Edge(3, 7)]);
}

#[test]
fn crossing_solids_name_pairs_that_cross() {
    let mut mesh = cube();
    mesh.append(&cuboid(DVec3::ONE).moved(DVec3::new(0.5, 0.6, 0.7)).mesh);
    let pairs = crossings(&mesh);
    assert!(!pairs.is_empty());
    for [face, other] in pairs {
        assert!(face < 12 && other >= 12, "{face}, {other}");
    }
}

#[test]
fn touching_solids_are_reported() {
    for offset in [
        // Flush, an edge on a face, a corner on a face, an edge across an edge.
        DVec3::new(2.0, 0.3, 0.4),
        DVec3::new(2.0, 2.0, 0.4),
    ] {
        let mut mesh = cube();
        mesh.append(&cuboid(DVec3::ONE).moved(offset).mesh);
        assert!(!crossings(&mesh).is_empty(), "{offset}");
    }
    let spike = Mesh {
        vertices: vec![
            DVec3::new(0.2, 0.3, 1.0),
            DVec3::new(0.0, 0.0, 2.0),
            DVec3::new(1.0, 0.0, 2.0),
            DVec3::new(0.0, 1.0, 2.0),
        ],
        faces: vec![[0, 2, 1], [0, 3, 2], [0, 1, 3], [1, 2, 3]],
    };
    let mut mesh = cube();
    mesh.append(&spike);
    assert!(!crossings(&mesh).is_empty());
}

/// A vertex is pulled through the far side.
#[test]
fn a_self_intersecting_surface_names_its_faces() {
    let mut mesh = icosphere(1.0, 1).mesh;
    mesh.vertices[0] *= -1.5;
    for [face, other] in crossings(&mesh) {
        let pulled = |f: u32| mesh.faces[f as usize].contains(&0);
        assert!(pulled(face) || pulled(other), "{face}, {other}");
    }
}

/// A tube thicker than its ring meets itself at the axis.
#[test]
fn a_ring_without_a_hole_names_its_faces() {
    assert!(!crossings(&torus(0.5, 0.8, 12, 8).mesh).is_empty());
}

#[test]
fn a_two_sided_sheet_is_named() {
    let sheet = Mesh {
        vertices: vec![DVec3::ZERO, DVec3::X, DVec3::Y],
        faces: vec![[0, 1, 2], [0, 2, 1]],
    };
    assert_eq!(crossings(&sheet), [[0, 1]]);
}

#[test]
fn a_face_without_area_is_named() {
    let mut mesh = cube();
    // The face with the edge (a, b) is cut in two at a new vertex in the middle of that edge. A
    // triangle of no area keeps it closed.
    let [a, b, c] = mesh.faces[4];
    let middle = 0.5 * (mesh.vertices[a as usize] + mesh.vertices[b as usize]);
    mesh.vertices.push(middle);
    mesh.faces[4] = [a, 8, c];
    mesh.faces.extend([[8, b, c], [a, b, 8]]);
    match error(&mesh) {
        DecomposeError::NoArea { faces } => assert_eq!(faces.first(), [13]),
        other => panic!("{other:?}"),
    }
}

/// A cavity's shell faces into the cavity. If it faces out, the solid is on both sides of it; if
/// the outer shell also faces inward, the solid is on neither side of that.
#[test]
fn an_inside_out_shell_is_named() {
    let (big, small) = (cuboid(DVec3::ONE), cuboid(DVec3::splat(0.5)));
    let apart = hollow(&big, &small.clone().moved(5.0 * DVec3::X)).mesh;
    match error(&apart) {
        DecomposeError::InsideOut { face } => assert!((12..24).contains(&face), "{face}"),
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_coordinate_too_fine_is_named() {
    let mut mesh = cube();
    mesh.vertices[3].y = 1e-200;
    assert_eq!(error(&mesh), DecomposeError::TooFine { vertex: 3 });
}
