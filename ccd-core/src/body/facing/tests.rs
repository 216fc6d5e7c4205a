//! Tests that the outward side of every face is found, however the shells of the solid are wound.

use super::Facing;
use crate::body::{Body, Solidity};
use crate::tests::meshes::{cube, reversed_triangles, translated_triangles};
use crate::tests::nearest::Triangle;
use crate::tests::scene::pieces;
use glam::DVec3;

fn solid_body(triangles: &[Triangle]) -> Body {
    Body::new(&pieces(triangles), Solidity::Solid).unwrap()
}

/// Asserts that every face's outward normal agrees with the direction that `out_of` gives for the face's centroid.
fn assert_outward_normals(body: &Body, out_of: impl Fn(DVec3) -> DVec3) {
    for piece in 0..body.pieces().len() as u32 {
        let out = out_of(body.mean_of_points(piece));
        let Facing::OutwardNormal(normal) = body.facing(piece) else {
            panic!("{:?}", body.facing(piece));
        };
        assert!(normal.dot(out) > 0.1, "{normal} {out}");
        let inside = body.interior_point(piece).unwrap();
        assert!((inside - body.mean_of_points(piece)).dot(out) < 0.0);
    }
}

#[test]
fn shells_side_by_side_need_not_agree() {
    let middles = [DVec3::ZERO, 10.0 * DVec3::X];
    let mut shells = reversed_triangles(&cube(0.5, 2));
    shells.extend(translated_triangles(&cube(1.5, 2), middles[1]));
    assert_outward_normals(&solid_body(&shells), |p| {
        if p.x < 5.0 { p } else { p - middles[1] }
    });
}

#[test]
fn a_cavity_faces_inward_however_the_whole_is_wound() {
    let mut shells = cube(3.0, 2);
    shells.extend(reversed_triangles(&cube(2.0, 2)));
    for shells in [reversed_triangles(&shells), shells] {
        assert_outward_normals(&solid_body(&shells), |p| {
            if p.abs().max_element() > 2.5 { p } else { -p }
        });
    }
}

/// Tests that both faces of a plate have outward normals, at a thickness below 200 units in the last place of the
/// coordinates.
#[test]
fn a_thin_wall_has_two_sides() {
    let thin = |p: DVec3| DVec3::new(p.x, p.y, 1e-11 * p.z) + DVec3::splat(1e3);
    let plate: Vec<Triangle> = cube(1.0, 1).iter().map(|t| t.map(thin)).collect();
    let body = solid_body(&plate);
    let large = |piece: &u32| body.pieces().get(*piece as usize).points[0].z;
    let flat = (0..12).filter(|&piece| {
        let points = body.pieces().get(piece as usize).points;
        points.iter().all(|p| p.z == points[0].z)
    });
    for piece in flat {
        let Facing::OutwardNormal(normal) = body.facing(piece) else {
            panic!("{:?}", body.facing(piece));
        };
        assert_eq!(normal.z > 0.0, large(&piece) > 1e3, "{normal}");
    }
}

#[test]
fn faces_back_to_back_and_surfaces_face_neither_way() {
    let triangle = [DVec3::ZERO, DVec3::X, DVec3::Y];
    let sheet = solid_body(&[triangle, [triangle[0], triangle[2], triangle[1]]]);
    assert_eq!(sheet.facing(0), Facing::NoOutwardSide);
    assert_eq!(sheet.interior_point(0), None);
    let surface = Body::new(&pieces(&cube(1.0, 1)), Solidity::Surface).unwrap();
    assert_eq!(surface.facing(0), Facing::NoOutwardSide);
}

/// Tests that a face has no clear side if parts of it bound lobes of opposite winding, as in a figure of eight.
#[test]
fn a_face_on_which_the_sides_change_is_unclear() {
    let eight = [(-1.0, -1.0), (1.0, 1.0), (1.0, -1.0), (-1.0, 1.0)];
    let at = |k: usize, z: f64| DVec3::new(eight[k % 4].0, eight[k % 4].1, z);
    let mut shell = Vec::new();
    for k in 0..4 {
        let [a, b, c, d] = [at(k, 0.0), at(k + 1, 0.0), at(k + 1, 1.0), at(k, 1.0)];
        shell.extend([[a, b, c], [a, c, d]]);
    }
    for (z, turned) in [(0.0, true), (1.0, false)] {
        let cap = [[0, 1, 2], [0, 2, 3]].map(|t| t.map(|k| at(k, z)));
        shell.extend(cap.map(|[a, b, c]| if turned { [a, c, b] } else { [a, b, c] }));
    }
    let body = solid_body(&shell);
    let facings: Vec<Facing> = (0..shell.len() as u32).map(|k| body.facing(k)).collect();
    assert!(facings.contains(&Facing::Unclear), "{facings:?}");
    let known = facings
        .iter()
        .filter(|f| matches!(f, Facing::OutwardNormal(_)));
    assert!(known.count() > 0, "{facings:?}");
}
