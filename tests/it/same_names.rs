//! Tests that contacts have the same feature names for every kind of pieces.

use ccd_core::glam::{DQuat, DVec2};
use ccd_core::order::{greater, lesser};
use ccd_core::{Feature, Motion, MovingBody, Pose, Settings};
use ccd_decomp::{PatchOrder, PieceChoice, PreparedBody, TriangleMesh, body_from_mesh};
use ccd_tests::models::{Mesh, divided_cube, divided_l_prism};

/// Returns a mesh in which no two faces share a vertex, as in an STL file.
fn without_shared_vertices(mesh: &Mesh) -> Mesh {
    let corners = mesh.faces.iter().flatten();
    Mesh {
        vertices: corners.map(|&v| mesh.vertices[v as usize]).collect(),
        faces: (0..mesh.faces.len() as u32)
            .map(|face| [0, 1, 2].map(|k| 3 * face + k))
            .collect(),
    }
}

/// A mesh, and the same body made of its triangles and of patches.
struct Body {
    mesh: Mesh,
    prepared_bodies: [PreparedBody; 2],
}

impl Body {
    fn new(mesh: Mesh) -> Self {
        let good = TriangleMesh::new(mesh.vertices.clone(), &mesh.faces).expect("a mesh");
        let made = [
            PieceChoice::Triangles,
            PieceChoice::Patches(PatchOrder::default()),
        ]
        .map(|choice| body_from_mesh(&good, choice).expect("a solid"));
        Body {
            mesh,
            prepared_bodies: made,
        }
    }

    fn vertex_heights(&self) -> impl Iterator<Item = f64> {
        self.mesh.vertices.iter().map(|p| p.z)
    }

    /// Returns a pose of the body on top of another one, at a small gap, shifted in x and y, and rotated about z.
    fn pose_resting_on(&self, other: &Body, shift: DVec2, turn: f64) -> Pose {
        let top = other.vertex_heights().fold(f64::NEG_INFINITY, greater);
        let bottom = self.vertex_heights().fold(f64::INFINITY, lesser);
        let up = top - bottom + 5e-4;
        Pose::new(shift.extend(up), DQuat::from_rotation_z(turn)).expect("finite")
    }
}

/// Returns the pairs of feature names in contact, sorted.
fn contact_names([a, b]: [&PreparedBody; 2], pose: Pose) -> Vec<[Feature; 2]> {
    let still = |made, pose| MovingBody::from((made, Motion::still(pose)));
    let (a, b) = (still(&a.body, pose), still(&b.body, Pose::IDENTITY));
    let problem = ccd_core::Query::new(a, b, 1.0, &Settings::DEFAULT).expect("good input");
    let pairs = problem.contacts_at(0.0).expect("contacts");
    let mut names: Vec<_> = pairs.iter().map(|p| [p.feature_a, p.feature_b]).collect();
    names.sort();
    names
}

/// Tests that triangles and patches give the same feature names, also for vertices inside an edge or a side of a patch,
/// and for vertices at equal positions.
#[test]
fn triangles_and_patches_have_the_same_names() {
    let shapes = [divided_cube(1), divided_cube(3), divided_l_prism(2)];
    let meshes = shapes
        .iter()
        .flat_map(|s| [s.mesh.clone(), without_shared_vertices(&s.mesh)]);
    let all: Vec<Body> = meshes.map(Body::new).collect();
    let mut found = 0;
    for (a, b) in all.iter().flat_map(|a| all.iter().map(move |b| (a, b))) {
        for (x, y, turn) in [(0.13, 0.07, 0.0), (0.2, 0.1, 0.25), (0.4, -0.3, 2.0)] {
            let pose = a.pose_resting_on(b, DVec2::new(x, y), turn);
            let [of_triangles, of_patches] =
                [0, 1].map(|k| contact_names([&a.prepared_bodies[k], &b.prepared_bodies[k]], pose));
            assert_eq!(of_triangles, of_patches);
            assert_eq!(
                of_triangles,
                contact_names([&a.prepared_bodies[0], &b.prepared_bodies[1]], pose)
            );
            found += of_triangles.len();
        }
    }
    assert!(found > 1000, "{found}");
}
