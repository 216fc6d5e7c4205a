use super::*;
use ccd_core::order::greater;
use std::collections::HashSet;

/// Returns the volume that a closed mesh encloses.
fn enclosed_volume(mesh: &TriangleMesh) -> f64 {
    let v = mesh.vertices();
    let tetrahedron =
        |[a, b, c]: &[u32; 3]| v[*a as usize].dot(v[*b as usize].cross(v[*c as usize])) / 6.0;
    mesh.faces().iter().map(tetrahedron).sum()
}

/// Asserts that every directed edge of a mesh appears once, and so does the edge in the opposite direction.
fn assert_closed(mesh: &TriangleMesh, name: &str) {
    let mut edges = HashSet::new();
    for &[a, b, c] in mesh.faces() {
        for edge in [(a, b), (b, c), (c, a)] {
            assert!(edges.insert(edge), "{name}: edge {edge:?} twice");
        }
    }
    for &(v, w) in &edges {
        assert!(edges.contains(&(w, v)), "{name}: edge {v}-{w} is open");
    }
}

fn bounding_radius(mesh: &TriangleMesh) -> f64 {
    mesh.vertices()
        .iter()
        .map(|p| p.length())
        .fold(0.0, greater)
}

#[test]
fn triangle_counts_are_those_of_the_paper() {
    let expected = [
        (Model::Knot216, 216),
        (Model::Knot2880, 2_880),
        (Model::Knot11520, 11_520),
        (Model::Knot34560, 34_560),
        (Model::Ring, 10_000),
        (Model::Board, 12),
        (Model::Bunny70k, 69_664),
        (Model::Bunny26k, 26_000),
        (Model::Santa, 37_888),
    ];
    assert_eq!(expected.map(|(model, _)| model), Model::value_variants());
    for (model, triangles) in expected {
        let mesh = model.generate().unwrap();
        assert_eq!(mesh.faces().len(), triangles, "{}", model.name());
        assert!(
            mesh.repairs().is_empty(),
            "{}: {}",
            model.name(),
            mesh.repairs()
        );
    }
}

#[test]
fn models_are_closed_and_face_outwards() {
    for model in Model::value_variants() {
        let mesh = model.generate().unwrap();
        assert_closed(&mesh, &model.name());
        assert!(enclosed_volume(&mesh) > 0.0, "{}", model.name());
        let degenerate = mesh.faces().iter().find(|[a, b, c]| {
            let [a, b, c] = [a, b, c].map(|v| mesh.vertices()[*v as usize]);
            (b - a).cross(c - a).length() < 1e-9
        });
        assert_eq!(degenerate, None, "{}", model.name());
    }
}

#[test]
fn models_are_the_same_every_time() {
    for model in Model::value_variants() {
        let (first, second) = (model.generate().unwrap(), model.generate().unwrap());
        assert_eq!(first.vertices(), second.vertices());
        assert_eq!(first.faces(), second.faces());
    }
}

#[test]
fn volumes_approach_the_closed_forms() {
    use std::f64::consts::PI;
    let ring = enclosed_volume(&Model::Ring.generate().unwrap());
    let torus = 2.0 * PI * PI * 0.8 * 0.2 * 0.2;
    assert!(ring < torus && ring > 0.98 * torus, "{ring} of {torus}");
    let board = enclosed_volume(&Model::Board.generate().unwrap());
    assert!((board - 3.0 * 3.0 * 0.02).abs() < 1e-12);
}

#[test]
fn a_knot_is_a_tube_about_its_curve() {
    let mesh = Model::Knot2880.generate().unwrap();
    // The points of the curve are the means of opposite corners of each ring of twelve.
    for ring in mesh.vertices().chunks(12) {
        let center = 0.5 * (ring[0] + ring[6]);
        for corner in ring {
            assert!((corner.distance(center) - 0.16).abs() < 1e-12);
        }
        let from_axis = center.truncate().length();
        assert!((1.0 / 3.0 - 1e-12..1.0 + 1e-12).contains(&from_axis));
    }
}

/// Tests that all triangles of a blob face away from the origin. If the mesh is closed and connected, too, and winds
/// about the origin once, then every ray from the origin meets it exactly once, so that no two triangles intersect.
#[test]
fn blobs_are_star_shaped_and_so_free_of_self_intersection() {
    for model in [Model::Bunny70k, Model::Bunny26k, Model::Santa] {
        let mesh = model.generate().unwrap();
        let mut solid_angle = 0.0;
        for face in mesh.faces() {
            let [a, b, c] = face.map(|v| mesh.vertices()[v as usize].normalize());
            let triple = a.dot(b.cross(c));
            assert!(triple > 0.0, "{}: {face:?}", model.name());
            solid_angle += 2.0 * triple.atan2(1.0 + a.dot(b) + b.dot(c) + c.dot(a));
        }
        let turns = solid_angle / (4.0 * std::f64::consts::PI);
        assert!((turns - 1.0).abs() < 1e-9, "{}: {turns}", model.name());
    }
}

#[test]
fn blobs_are_not_convex_and_have_radius_1() {
    for model in [Model::Bunny70k, Model::Bunny26k, Model::Santa] {
        let mesh = model.generate().unwrap();
        assert!((bounding_radius(&mesh) - 1.0).abs() < 1e-12);
        let v = mesh.vertices();
        let inwards = mesh
            .faces()
            .iter()
            .filter(|[a, b, c]| {
                let [a, b, c] = [a, b, c].map(|k| v[*k as usize]);
                let normal = (b - a).cross(c - a);
                v.iter().step_by(97).any(|p| normal.dot(*p - a) > 1e-9)
            })
            .count();
        // A convex body has no vertex in front of a face.
        assert!(
            2 * inwards > mesh.faces().len(),
            "{}: {inwards}",
            model.name()
        );
    }
}

#[test]
fn files_take_precedence_over_models_made_by_code() {
    let directory = std::env::temp_dir().join(format!("ccd-models-{}", std::process::id()));
    std::fs::create_dir_all(&directory).unwrap();
    let file = directory.join("board.obj");
    std::fs::write(&file, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").unwrap();
    let board = Model::Board.load_or_generate(Some(&directory)).unwrap();
    assert_eq!(board.faces().len(), 1);
    let santa = Model::Santa.load_or_generate(Some(&directory)).unwrap();
    assert_eq!(santa.faces().len(), 37_888);
    std::fs::write(&file, "v 0 0 0\nf 1 2 3\n").unwrap();
    let error = Model::Board
        .load_or_generate(Some(&directory))
        .unwrap_err()
        .to_string();
    assert!(error.contains("board.obj"), "{error}");
    std::fs::remove_dir_all(&directory).unwrap();
}
