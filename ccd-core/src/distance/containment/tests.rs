//! Tests which points and bodies count as inside a solid, outside of it, or on its surface, also for nested shells.

use super::containment_at_start;
use crate::answer::{Limit, Outcome, Overlap};
use crate::body::polytope::{Facet, FacetOrigin, Polytope};
use crate::body::{Body, Solidity};
use crate::motion::Motion;
use crate::motion::pose::Pose;
use crate::problem::Problem;
use crate::query::MovingBody;
use crate::settings::Settings;
use crate::tests::meshes::{cube, reversed_triangles, translated_triangles};
use crate::tests::nearest::Triangle;
use crate::tests::scene::{
    RngExt, pieces, random_point_in_ball, random_power_of_ten, random_rotation, rng,
};
use glam::DVec3;

fn solid(triangles: &[Triangle]) -> Body {
    Body::new(&pieces(triangles), Solidity::Solid).unwrap()
}

fn containment_overlap(a: &Body, b: &Body) -> Option<Overlap> {
    match containment_of(a, b, &[]) {
        Some(Outcome::Overlapping { overlap, .. }) => Some(overlap),
        None => None,
        found => panic!("too near to tell: {found:?}"),
    }
}

fn containment_of(a: &Body, b: &Body, touching: &[[u32; 2]]) -> Option<Outcome> {
    let moving = |body| MovingBody::from((body, Motion::still(Pose::IDENTITY)));
    let problem = Problem::of_moving_bodies(moving(a), moving(b), 1.0, &Settings::DEFAULT).unwrap();
    containment_at_start(&problem, touching, &mut Vec::new())
}

fn contains(body: &Body, point: DVec3) -> Option<bool> {
    super::contains(body, point, 1e-13)
}

#[test]
fn points_are_inside_or_outside_of_a_cube() {
    let mut rng = rng(1);
    let (mut inside, mut outside) = (0, 0);
    for n in [1, 3, 20] {
        let body = solid(&cube(1.0, n));
        for _ in 0..2_000 {
            let point = random_point_in_ball(&mut rng, 2.0);
            let exact = point.abs().max_element() < 1.0;
            assert_eq!(contains(&body, point), Some(exact), "{point} {n}");
            inside += usize::from(exact);
            outside += usize::from(!exact);
        }
    }
    assert!(inside > 1_000 && outside > 1_000);
}

#[test]
fn a_point_on_the_surface_is_not_inside() {
    for n in [1, 4] {
        let body = solid(&cube(1.0, n));
        let on = [
            DVec3::new(1.0, 0.3, 0.2),
            DVec3::new(0.1, -1.0, 0.77),
            DVec3::new(1.0, 1.0, 0.3),
            DVec3::ONE,
            -DVec3::ONE,
            DVec3::new(0.0, 0.0, 1.0),
        ];
        for point in on {
            assert_ne!(contains(&body, point), Some(true), "{point} {n}");
        }
    }
}

/// Tests that points are inside or outside a cube as expected, although rays from them pass exactly through corners and
/// edges.
#[test]
fn regular_points_in_line_with_edges_are_decided() {
    let body = solid(&cube(1.0, 8));
    for i in -7..=7 {
        for j in -7..=7 {
            for k in -7..=7 {
                let point = DVec3::new(f64::from(i), f64::from(j), f64::from(k)) / 8.0;
                assert_eq!(contains(&body, point), Some(true), "{point}");
                assert_eq!(
                    contains(&body, point + 2.0 * DVec3::X),
                    Some(false),
                    "{point}"
                );
            }
        }
    }
}

#[test]
fn a_cavity_is_outside_and_a_solid_in_it_inside() {
    let mut shells = cube(3.0, 2);
    shells.extend(reversed_triangles(&cube(2.0, 2)));
    shells.extend(cube(1.0, 2));
    let body = solid(&shells);
    for (x, inside) in [(0.0, true), (1.5, false), (2.5, true), (3.5, false)] {
        let point = DVec3::new(x, 0.1 * x, 0.03 * x);
        assert_eq!(contains(&body, point), Some(inside), "{x}");
    }
    // A body in the cavity is no overlap. A body in the core or the wall is one.
    let part = |x: f64| solid(&translated_triangles(&cube(0.1, 1), x * DVec3::X));
    for (x, inside) in [(0.0, true), (1.5, false), (2.5, true), (3.5, false)] {
        let overlap = containment_overlap(&part(x), &body);
        assert_eq!(matches!(overlap, Some(Overlap::AInsideB(_))), inside, "{x}");
        let overlap = containment_overlap(&body, &part(x));
        assert_eq!(matches!(overlap, Some(Overlap::BInsideA(_))), inside, "{x}");
    }
}

#[test]
fn an_inside_out_mesh_contains_the_space_that_it_surrounds() {
    let body = solid(&reversed_triangles(&cube(1.0, 3)));
    assert_eq!(contains(&body, DVec3::new(0.1, 0.2, 0.3)), Some(true));
    assert_eq!(contains(&body, DVec3::new(1.1, 0.2, 0.3)), Some(false));
}

#[test]
fn only_one_of_many_parts_need_be_inside() {
    let outer = solid(&cube(1.0, 2));
    let mut parts = translated_triangles(&cube(0.1, 1), 5.0 * DVec3::X);
    parts.extend(translated_triangles(&cube(0.1, 1), -5.0 * DVec3::X));
    assert_eq!(containment_overlap(&solid(&parts), &outer), None);
    parts.extend(cube(0.1, 1));
    let Some(Overlap::AInsideB(point)) = containment_overlap(&solid(&parts), &outer) else {
        panic!("a part is inside");
    };
    assert!(point.abs().max_element() <= 0.1);
}

#[test]
fn a_surface_contains_nothing() {
    let surface = Body::new(&pieces(&cube(1.0, 2)), Solidity::Surface).unwrap();
    let small = solid(&cube(0.1, 1));
    assert_eq!(containment_overlap(&small, &surface), None);
    // A surface, however, may be inside a solid.
    let inner = Body::new(&pieces(&cube(0.1, 2)), Solidity::Surface).unwrap();
    let overlap = containment_overlap(&solid(&cube(1.0, 1)), &inner);
    assert!(matches!(overlap, Some(Overlap::BInsideA(_))));
}

/// Tests that a triangle on the surface of a cube is not inside it if the touching pieces are given, and undecided
/// otherwise.
#[test]
fn a_part_on_the_surface_is_left_to_its_pieces() {
    let on_top = [[0.5, 0.0, 1.0], [0.75, 0.25, 1.0], [0.5, 0.25, 1.0]].map(DVec3::from);
    let triangle = Body::new(&pieces(&[on_top]), Solidity::Surface).unwrap();
    let cube = solid(&cube(1.0, 1));
    let all: Vec<[u32; 2]> = (0..cube.pieces().len() as u32).map(|k| [0, k]).collect();
    let found = containment_of(&triangle, &cube, &all);
    assert_eq!(found, None);
    let found = containment_of(&triangle, &cube, &[]);
    assert_eq!(
        found,
        Some(Outcome::unresolved(0.0, Limit::OverlapUndecided))
    );
}

#[test]
fn placement_and_size_do_not_matter() {
    let mut rng = rng(2);
    for _ in 0..200 {
        let scale = random_power_of_ten(&mut rng, -6.0, 6.0);
        let turn = random_rotation(&mut rng);
        let far = random_point_in_ball(&mut rng, 1e3 * scale);
        let place = |triangles: Vec<Triangle>, at: DVec3| -> Vec<Triangle> {
            let put = |p: DVec3| turn * (p + at) * scale + far;
            triangles.iter().map(|t| t.map(put)).collect()
        };
        let at = random_point_in_ball(&mut rng, 2.0);
        let inside = at.abs().max_element() < 0.9;
        if (0.9..1.1).contains(&at.abs().max_element()) {
            continue;
        }
        let n = rng.random_range(1..4);
        let (outer, inner) = (
            solid(&place(cube(1.0, n), DVec3::ZERO)),
            solid(&place(cube(0.05, 1), at)),
        );
        let overlap = containment_overlap(&inner, &outer);
        assert_eq!(
            matches!(overlap, Some(Overlap::AInsideB(_))),
            inside,
            "{at} {scale:e}"
        );
    }
}

/// Tests that a triangle in the common square of two pyramids is inside their union, although no face passes through
/// it.
#[test]
fn a_triangle_through_the_waist_of_an_octahedron_is_inside() {
    let tip = |k: usize| match k % 2 {
        0 => DVec3::AXES[k / 2],
        _ => -DVec3::AXES[k / 2],
    };
    let faces = [
        [0, 2, 4],
        [2, 1, 4],
        [1, 3, 4],
        [3, 0, 4],
        [2, 0, 5],
        [1, 2, 5],
        [3, 1, 5],
        [0, 3, 5],
    ];
    let octahedron: Vec<Triangle> = faces.iter().map(|face| face.map(tip)).collect();
    let plate = [
        DVec3::new(-4.0, -4.0, 0.0),
        DVec3::new(40.0, -4.0, 0.0),
        DVec3::new(-4.0, 40.0, 0.0),
    ];
    let sheet = Body::new(&pieces(&[plate]), Solidity::Surface).unwrap();
    let solid = solid(&octahedron);
    let touching: Vec<[u32; 2]> = (0..8).map(|k| [k, 0]).collect();
    let found = |sheet: &Body| containment_of(&solid, sheet, &touching);
    assert!(matches!(
        found(&sheet),
        Some(Outcome::Overlapping {
            overlap: Overlap::BInsideA(_),
            ..
        })
    ));
    // A triangle that rests on a tip is not inside.
    let above = Body::new(
        &pieces(&translated_triangles(&[plate], DVec3::Z)),
        Solidity::Surface,
    )
    .unwrap();
    assert_eq!(found(&above), None);
}

/// Tests that a needle that enters a cube through the common edge of two faces is found to end inside. The fuzz target
/// `query` found this case.
#[test]
fn a_lone_needle_through_an_edge_is_inside() {
    let needle = [-4.0 * DVec3::Z, DVec3::ZERO, DVec3::ZERO];
    let needle = Body::new(&pieces(&[needle]), Solidity::Surface).unwrap();
    let cube = cube(1.0, 1);
    // These are the faces whose diagonal the needle passes through.
    let below = |face: &Triangle| face.iter().all(|corner| corner.z < 0.0);
    let touching: Vec<[u32; 2]> = (0..12)
        .filter(|&k| below(&cube[k as usize]))
        .map(|k| [k, 0])
        .collect();
    assert_eq!(touching.len(), 2);
    assert!(matches!(
        containment_of(&solid(&cube), &needle, &touching),
        Some(Outcome::Overlapping {
            overlap: Overlap::BInsideA(_),
            ..
        })
    ));
}

/// Tests that points near a face of length 4e10 are decided, although rounding errors of volumes exceed their distance
/// from it. The fuzz target `query` found this case.
#[test]
fn points_near_very_long_faces_are_decided() {
    let long = cube(1.0, 1).into_iter().map(|face| {
        let stretched = |p: DVec3| p * DVec3::new(4.0, 4.0e10, 0.125) + DVec3::Y;
        face.map(stretched)
    });
    let beam = solid(&long.collect::<Vec<Triangle>>());
    assert_eq!(contains(&beam, DVec3::Z * 1.875), Some(false));
    assert_eq!(contains(&beam, DVec3::Z * 0.0625), Some(true));
    assert_eq!(contains(&beam, DVec3::X * 3.75), Some(true));
}

/// Returns the outcome for a plate in a cube, perpendicular to y, and so thin that no face proves an intersection; `x`
/// and `z` are its half extents.
fn outcome_of_plate_in_cube(n: usize, at: DVec3, [x, z]: [f64; 2]) -> Option<Outcome> {
    let cube = solid(&cube(1.0, n));
    let plate = Body::cuboid([x, 1e-33, z]).unwrap();
    let problem = Problem::of_moving_bodies(
        (&plate, Motion::still(Pose::at(at).unwrap())),
        (&cube, Motion::STILL),
        1.0,
        &Settings::DEFAULT,
    )
    .unwrap();
    let touching: Vec<[u32; 2]> = (0..cube.pieces().len() as u32).map(|k| [0, k]).collect();
    containment_at_start(&problem, &touching, &mut Vec::new())
}

#[test]
fn a_thin_piece_is_examined_at_its_corners() {
    // The middle of the plate is outside, and half of its corners are inside.
    let found = outcome_of_plate_in_cube(1, 1.5 * DVec3::X, [1.5, 0.25]);
    assert!(
        matches!(found, Some(Outcome::Overlapping { overlap: Overlap::AInsideB(p), .. }) if p.x == 0.0),
        "{found:?}"
    );
    let beside = outcome_of_plate_in_cube(1, 3.0 * DVec3::X, [1.5, 0.25]);
    assert_eq!(beside, None);
}

#[test]
fn a_thin_piece_is_examined_beside_edges_on_it() {
    // All corners of the plate are outside, and so is its middle: two faces of the cube meet on it.
    let found = outcome_of_plate_in_cube(2, 2.0 * DVec3::X, [2.5, 3.0]);
    assert!(
        matches!(found, Some(Outcome::Overlapping { overlap: Overlap::AInsideB(p), .. }) if p.abs().max_element() < 1.0),
        "{found:?}"
    );
    let beside = outcome_of_plate_in_cube(2, 4.0 * DVec3::X, [2.5, 3.0]);
    assert_eq!(beside, None);
}

/// Tests that no points beside edges are tested for thick pieces, or for pieces without a known outline. A piece
/// without known sides is not examined either.
#[test]
fn only_thin_pieces_are_examined_beside_edges() {
    let cube = solid(&cube(1.0, 1));
    let examined = |piece: Body| {
        let motion = Motion::still(Pose::at(4.0 * DVec3::X).unwrap());
        let (a, b) = ((&cube, Motion::STILL), (&piece, motion));
        let problem = Problem::of_moving_bodies(a, b, 1.0, &Settings::DEFAULT).unwrap();
        let mut pieces = Vec::new();
        assert_eq!(containment_at_start(&problem, &[[0, 0]], &mut pieces), None);
        pieces
    };
    // The prism is aside of the origin, and no corner of a facet is opposite to another one.
    let prism = |height: f64| {
        let corners = [[5.0, 5.0], [8.0, 5.0], [5.0, 7.0]];
        let at = |y: f64| corners.map(|[x, z]| DVec3::new(x, y, z));
        let facets: [&[u32]; 5] = [
            &[0, 1, 2],
            &[3, 5, 4],
            &[0, 3, 4, 1],
            &[1, 4, 5, 2],
            &[2, 5, 3, 0],
        ];
        let facet = |corners: &[u32]| Facet {
            origin: FacetOrigin::Virtual,
            corners: corners.to_vec(),
        };
        let prism = Polytope {
            points: [at(5.0), at(5.0 + height)].concat(),
            facets: facets.map(facet).to_vec(),
            ..Polytope::default()
        };
        Body::polytope(prism).unwrap()
    };
    assert_eq!(examined(prism(1e-15)), [0]);
    assert_eq!(examined(prism(0.5)), []);
    let corners = Polytope {
        points: vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z],
        ..Polytope::default()
    };
    assert_eq!(examined(Body::polytope(corners).unwrap()), []);
}
