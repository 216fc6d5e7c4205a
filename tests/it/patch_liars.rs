//! Tests that the checks of patches detect wrong patches: each kind of fault is found by the check made for it.

use ccd_core::glam::DVec3;
use ccd_core::order::greater;
use ccd_core::{Facet, FacetOrigin, Polytope};
use ccd_tests::exact::{SampleCounts, Solid};
use ccd_tests::models::{Mesh, cuboid, l_prism, torus};
use ccd_tests::patches::{Claim, check_hull_in_solid, check_partition, check_polytope};

/// Returns a cube, and its surface as a single, correct patch.
fn cube() -> (Mesh, Polytope) {
    let shape = cuboid(DVec3::ONE);
    let vertex_ids = (0..8).collect();
    let polytope = Polytope {
        vertex_ids,
        ..shape.parts[0].clone()
    };
    (shape.mesh, polytope)
}

const CUBE_FACE_INDICES: [u32; 12] = [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11];

fn assert_refused(lie: impl Fn(&mut Polytope), why: &str) {
    let (mesh, mut polytope) = cube();
    lie(&mut polytope);
    let claim = Claim {
        faces: &CUBE_FACE_INDICES,
        polytope: &polytope,
    };
    let law = check_polytope(&mesh, &claim);
    assert!(
        law.as_ref().is_err_and(|it| it.contains(why)),
        "{why}: {law:?}"
    );
}

#[test]
fn an_honest_patch_keeps_every_law() {
    let (mesh, polytope) = cube();
    let claim = Claim {
        faces: &CUBE_FACE_INDICES,
        polytope: &polytope,
    };
    assert_eq!(check_polytope(&mesh, &claim), Ok(()));
    let points = check_hull_in_solid(&Solid::new(&mesh), &claim, SampleCounts::THOROUGH, 0);
    assert!(points.is_ok_and(|count| count > 100));
    assert_eq!(check_partition(&mesh, &[claim]), Ok(()));
}

#[test]
fn lies_about_a_polytope_are_found() {
    assert_refused(
        |it| it.points[3].x = it.points[3].x.next_up(),
        "is not vertex 3",
    );
    assert_refused(|it| it.vertex_ids.swap(1, 2), "is not vertex");
    assert_refused(|it| it.radius = 0.1, "a radius");
    assert_refused(|it| it.facets.truncate(5), "open at");
    assert_refused(|it| it.facets[2].corners.reverse(), "in front of");
    assert_refused(|it| it.facets[2].corners.swap(1, 2), "is not convex");
    assert_refused(|it| it.facets[2].corners[0] = 7, "is in front of");
    assert_refused(|it| it.faces[4].id = 5, "is not face 5");
    assert_refused(|it| it.faces[4].corners.swap(0, 1), "is not face 4");
    assert_refused(|it| it.faces.push(it.faces[0]), "but named are");
    assert_refused(|it| it.faces[3].id = 12, "no face 12");
    let hide = |it: &mut Polytope| {
        it.facets[0].origin = FacetOrigin::Virtual;
        it.faces.drain(..2);
    };
    assert_refused(hide, "but named are");
    assert_refused(
        |it| it.facets[0].origin = FacetOrigin::Face(1),
        "is not face 1",
    );
    assert_refused(|it| it.faces.truncate(11), "is on no face");
    assert_refused(|it| it.facets.clear(), "too few");
}

#[test]
fn an_invalid_cover_is_found() {
    let (mesh, polytope) = cube();
    let claim = |faces| Claim {
        faces,
        polytope: &polytope,
    };
    for (faces, why) in [
        (&[&CUBE_FACE_INDICES[..11]][..], "face 11 is of 0"),
        (
            &[&CUBE_FACE_INDICES[..], &CUBE_FACE_INDICES[3..4]],
            "face 3 is of 2",
        ),
        (&[&CUBE_FACE_INDICES[..], &[12]], "no face 12"),
    ] {
        let claims: Vec<Claim<'_>> = faces.iter().map(|faces| claim(*faces)).collect();
        let law = check_partition(&mesh, &claims);
        assert!(law.as_ref().is_err_and(|it| it.contains(why)), "{law:?}");
    }
}

/// Returns a patch of two faces: the convex hull of their corners.
fn face_pair_as_patch(mesh: &Mesh, faces: [u32; 2]) -> Polytope {
    let mut vertex_ids: Vec<u32> = faces.iter().flat_map(|&f| mesh.faces[f as usize]).collect();
    vertex_ids.sort_unstable();
    vertex_ids.dedup();
    Polytope {
        points: vertex_ids
            .iter()
            .map(|&v| mesh.vertices[v as usize])
            .collect(),
        vertex_ids,
        ..Polytope::default()
    }
}

/// Counts the pairs of faces whose hull is found to leave the solid, and checks each finding against `leaves` where
/// that is known.
fn count_hulls_leaving_solid(mesh: &Mesh, leaves: impl Fn([u32; 2]) -> Option<bool>) -> usize {
    let solid = Solid::new(mesh);
    let mut found = 0;
    let count = mesh.faces.len() as u32;
    for faces in (0..count).flat_map(|f| (f + 1..count).map(move |g| [f, g])) {
        let polytope = face_pair_as_patch(mesh, faces);
        let claim = Claim {
            faces: &faces,
            polytope: &polytope,
        };
        let law = check_hull_in_solid(&solid, &claim, SampleCounts::THOROUGH, 0);
        if let Some(leaves) = leaves(faces) {
            assert_eq!(law.is_err(), leaves, "{faces:?} {law:?}");
        }
        found += usize::from(law.is_err());
    }
    found
}

/// Tests that hulls of two faces that cross the inner corner of an L-shaped solid are found to leave it.
#[test]
fn a_hull_across_the_inner_corner_of_an_l_is_found() {
    let mesh = l_prism().mesh;
    let found = count_hulls_leaving_solid(&mesh, |faces| {
        let corners = faces.map(|f| mesh.triangle(f as usize));
        let all = || corners.iter().flatten();
        let in_bar = |wide: fn(&DVec3) -> f64| all().all(|p| wide(p) <= 1.0);
        // The L has only two points on or beyond the line from (2, 1) to (1, 2): the ends of the line.
        let sum = |corner: &[DVec3; 3]| corner.iter().map(|p| p.x + p.y).fold(0.0, greater);
        if in_bar(|p| p.x) || in_bar(|p| p.y) {
            Some(false)
        } else {
            (sum(&corners[0]) >= 3.0 && sum(&corners[1]) >= 3.0).then_some(true)
        }
    });
    assert!(found >= 20, "{found}");
}

#[test]
fn a_hull_across_the_hole_of_a_torus_is_found() {
    let mesh = torus(1.0, 0.25, 8, 5).mesh;
    let found = count_hulls_leaving_solid(&mesh, |faces| {
        let [f, g] = faces.map(|f| {
            let corners = mesh.triangle(f as usize);
            (corners[0] + corners[1] + corners[2]) / 3.0
        });
        // The faces are on opposite sides of the hole.
        (f.truncate().dot(g.truncate()) < -0.5).then_some(true)
    });
    assert!(found > 500, "{found}");
}

/// Tests that a hull is found to leave the solid by one unit in the last place, below the bottom of a dent.
#[test]
fn a_hull_a_rounding_out_of_the_solid_is_found() {
    let mut mesh = cuboid(DVec3::ONE).mesh;
    mesh.faces.retain(|face| !face.iter().all(|&v| v & 4 != 0));
    let bottom = 1.0_f64.next_down();
    mesh.vertices.push(bottom * DVec3::Z);
    mesh.faces
        .extend([[4, 5, 8], [5, 7, 8], [7, 6, 8], [6, 4, 8]]);
    let lid = Polytope {
        points: [4, 5, 7, 6].map(|v: usize| mesh.vertices[v]).to_vec(),
        vertex_ids: vec![4, 5, 7, 6],
        facets: vec![Facet {
            origin: FacetOrigin::Virtual,
            corners: vec![0, 1, 2, 3],
        }],
        ..Polytope::default()
    };
    let claim = Claim {
        faces: &[],
        polytope: &lid,
    };
    let law = check_hull_in_solid(&Solid::new(&mesh), &claim, SampleCounts::QUICK, 0);
    assert!(law.is_err(), "{law:?}");
}
