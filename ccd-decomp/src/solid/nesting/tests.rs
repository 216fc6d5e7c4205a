//! Tests which shells of nested, crossing and touching cubes are found to be wrongly oriented or unclear.

use super::center_and_points_beside;
use crate::rational::Exact3;
use crate::test_meshes::CUBE_FACES;
use crate::tolerance::FACE_CENTER_ROUNDING;
use crate::worst::{WorstCaseSearch, error_fraction};
use crate::{PieceChoice, TopologyDefects, TriangleMesh, body_from_mesh};
use ccd_core::Solidity;
use ccd_core::glam::{DVec3, dvec3};
use ccd_core::order::lesser;

/// Returns cubes as one mesh, each given by its center, half its side length, and whether it is inside out.
fn cubes(cubes: &[(DVec3, f64, bool)]) -> TriangleMesh {
    let (mut points, mut faces) = (Vec::new(), Vec::new());
    for &(middle, half, inward) in cubes {
        let first = points.len() as u32;
        let sign = |k: u32, bit: u32| if k >> bit & 1 == 1 { half } else { -half };
        points.extend((0..8).map(|k| middle + dvec3(sign(k, 0), sign(k, 1), sign(k, 2))));
        faces.extend(CUBE_FACES.map(|face| {
            let [a, b, c] = face.map(|v| first + v);
            if inward { [a, c, b] } else { [a, b, c] }
        }));
    }
    TriangleMesh::new(points, &faces).unwrap()
}

fn wrong_and_unclear_shell_counts(mesh: &TriangleMesh) -> [usize; 2] {
    let topology = TopologyDefects::of(mesh);
    [
        topology.wrong_shells.count(),
        topology.unclear_shells.count(),
    ]
}

#[test]
fn shells_side_by_side_are_each_turned_outward() {
    for (one, other, wrong) in [
        (true, false, 1),
        (false, true, 1),
        (false, false, 0),
        (true, true, 0),
    ] {
        let mesh = cubes(&[(DVec3::ZERO, 0.5, one), (10.0 * DVec3::X, 1.5, other)]);
        assert_eq!(wrong_and_unclear_shell_counts(&mesh), [wrong, 0]);
        let prepared = body_from_mesh(&mesh, PieceChoice::Triangles).unwrap();
        assert_eq!(prepared.body.solidity(), Solidity::Solid);
    }
    let mesh = cubes(&[(DVec3::ZERO, 0.5, true), (10.0 * DVec3::X, 1.5, false)]);
    let report = body_from_mesh(&mesh, PieceChoice::Auto).unwrap().report;
    let said = report.to_string();
    assert!(said.contains("turned, by a face: 1 (0)"), "{said}");
    let volume = TopologyDefects::of(&mesh).signed_volume;
    assert!((volume - 28.0).abs() < 1e-12, "{volume}");
}

/// Tests that nested shells of any orientation bound a solid and a cavity in turn.
#[test]
fn nested_shells_alternate() {
    for flips in 0..16u32 {
        let shells: Vec<(DVec3, f64, bool)> = (0..4)
            .map(|k| {
                (
                    0.01 * f64::from(k) * DVec3::ONE,
                    4.0 - f64::from(k),
                    flips >> k & 1 == 1,
                )
            })
            .collect();
        let mesh = cubes(&shells);
        let right = |inward: bool| {
            (0..4)
                .filter(|&k| shells[k].2 == (inward ^ (k % 2 == 1)))
                .count()
        };
        let wrong = match right(true) {
            4 => 0,
            _ => 4 - right(false),
        };
        assert_eq!(
            wrong_and_unclear_shell_counts(&mesh),
            [wrong, 0],
            "{flips:b}"
        );
        let volume = TopologyDefects::of(&mesh).signed_volume.abs();
        let cube = |half: f64| 8.0 * half * half * half;
        let exact = cube(4.0) - cube(3.0) + cube(2.0) - cube(1.0);
        assert!((volume - exact).abs() < 1e-9, "{flips:b} {volume} {exact}");
        for choice in [
            PieceChoice::Patches(crate::PatchOrder::default()),
            PieceChoice::Auto,
        ] {
            let prepared = body_from_mesh(&mesh, choice).unwrap();
            assert_eq!(prepared.body.solidity(), Solidity::Solid);
        }
    }
}

#[test]
fn shells_that_cross_are_one_solid_outside_and_unclear_within_another() {
    let pair = |inward: bool| [(DVec3::ZERO, 1.0, inward), (0.7 * DVec3::ONE, 1.0, false)];
    assert_eq!(wrong_and_unclear_shell_counts(&cubes(&pair(false))), [0, 0]);
    assert_eq!(wrong_and_unclear_shell_counts(&cubes(&pair(true))), [1, 0]);
    let around = |inward: bool| (0.1 * DVec3::ONE, 9.0, inward);
    // Crossing shells with the orientation of their surroundings are part of the solid.
    let part = [pair(false).as_slice(), &[around(false)]].concat();
    assert_eq!(wrong_and_unclear_shell_counts(&cubes(&part)), [0, 0]);
    // Two cavities that cross, or a solid that crosses a cavity.
    let cavities = [pair(false).as_slice(), &[around(true)]].concat();
    assert_eq!(wrong_and_unclear_shell_counts(&cubes(&cavities))[1], 2);
    let both = [pair(true).as_slice(), &[around(false)]].concat();
    let mesh = cubes(&both);
    assert_eq!(wrong_and_unclear_shell_counts(&mesh)[1], 1);
    let prepared = body_from_mesh(&mesh, PieceChoice::Auto).unwrap();
    assert_eq!(prepared.body.solidity(), Solidity::Surface);
    let said = prepared.report.to_string();
    assert!(
        said.contains("may bound a solid or a cavity, by a face: 1 (0)"),
        "{said}"
    );
}

/// Tests that of two cubes that share an edge, the cube that is inside out is the only wrong shell. Every edge has
/// equally many faces in both directions.
#[test]
fn shells_that_share_an_edge_are_distinguished() {
    for (one, other) in [(true, false), (false, true), (false, false)] {
        let mesh = cubes(&[(DVec3::ZERO, 0.5, one), (dvec3(1.0, 1.0, 0.0), 0.5, other)]);
        let topology = TopologyDefects::of(&mesh);
        assert_eq!(topology.edges_shared_by_parts.count(), 1);
        assert_eq!(
            wrong_and_unclear_shell_counts(&mesh),
            [usize::from(one != other), 0]
        );
        assert!((topology.signed_volume - 2.0).abs() < 1e-12);
    }
}

/// Tests that cubes of a lattice that share faces, edges and corners count as separate solids of the right orientation.
#[test]
fn shells_that_share_faces_are_distinguished() {
    let mut shared = 0;
    for seed in 1..120_u32 {
        let bits =
            seed.wrapping_mul(0x9e37_79b9) >> 3 & seed.wrapping_mul(0x85eb_ca6b).rotate_left(9);
        let place = |k: u32| 4.0 + dvec3((k % 3).into(), (k / 3 % 3).into(), (k / 9).into());
        let places = (0..27).filter(|k| bits >> k & 1 == 1).map(place);
        let of_lattice: Vec<_> = places.map(|place| (place, 0.5, seed % 2 == 0)).collect();
        if of_lattice.is_empty() {
            continue;
        }
        let mesh = cubes(&of_lattice);
        let topology = TopologyDefects::of(&mesh);
        assert_eq!(wrong_and_unclear_shell_counts(&mesh), [0, 0], "{seed}");
        let volume = topology.signed_volume.abs() - of_lattice.len() as f64;
        assert!(volume.abs() < 1e-9, "{seed}");
        let prepared = body_from_mesh(&mesh, PieceChoice::Auto).unwrap();
        assert_eq!(prepared.body.solidity(), Solidity::Solid);
        shared += usize::from(topology.edges_shared_by_parts.count() > 4);
    }
    assert!(shared > 40, "{shared}");
}

/// Tests that the two points beside a face's center are on opposite sides of the face in exact arithmetic. Faces are
/// needles of an aspect of up to a million, and far from the origin.
#[test]
fn worst_middle() {
    let found = WorstCaseSearch::new("FACE_ROUNDING", 10_000).search(|tape| {
        let (scale, far) = (tape.size(-60..=20), DVec3::from(tape.vector(-8..=20)));
        let [u, v] = [(); 2].map(|()| DVec3::from(tape.vector(-4..=0)));
        let narrow = tape.size(-20..=0);
        let face =
            [DVec3::ZERO, u, u * tape.next_fraction() + v * narrow].map(|p| (p + far) * scale);
        let [a, b, c] = face;
        let size = a.distance(b) + a.distance(c);
        let area = (b - a).cross(c - a).length();
        let (middle, across) =
            center_and_points_beside(face, size).filter(|_| area > 1e-6 * size * size)?;
        let [a, b, c] = face.map(Exact3::from_coordinates);
        let normal = b.minus(&a).cross(&c.minus(&a));
        // The rounding here is far below the tested error.
        let unit = normal.dot(&normal).to_f64().value().sqrt();
        let height = |p: DVec3| {
            Exact3::from_coordinates(p)
                .minus(&a)
                .dot(&normal)
                .to_f64()
                .value()
                / unit
        };
        let [behind, ahead] = across.map(height);
        let meant = FACE_CENTER_ROUNDING * (size + middle.abs().max_element());
        Some(error_fraction(meant - lesser(ahead, -behind), meant))
    });
    found.assert_tight_bound(1e4);
}
