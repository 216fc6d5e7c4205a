use super::{Assembly, Object, Part, PlacedObject};
use crate::MeshFault;
use crate::mesh::affine::AffineMap;
use crate::mesh::content::allowance::ExpansionBudget;
use crate::mesh::polygons::Polygons;
use ccd_core::Pose;
use ccd_core::glam::DVec3;

fn triangle() -> Polygons {
    Polygons {
        vertices: vec![DVec3::ZERO, DVec3::X, DVec3::Y],
        corners: vec![0, 1, 2],
        ends: vec![3],
        ..Polygons::default()
    }
}

fn shifted_object(object: usize, x: f64) -> PlacedObject {
    let map = AffineMap::from(Pose::at([x, 0.0, 0.0]).unwrap());
    PlacedObject { object, map }
}

fn part(object: usize) -> Part {
    Part {
        name: None,
        placed: shifted_object(object, 0.0),
    }
}

fn of(members: Vec<PlacedObject>) -> Object {
    Object {
        shape: Polygons::default(),
        members,
    }
}

fn leaf() -> Object {
    Object {
        shape: triangle(),
        members: Vec::new(),
    }
}

#[test]
fn members_are_placed_in_order() {
    let objects = vec![
        of(vec![shifted_object(2, 10.0), shifted_object(1, 20.0)]),
        of(vec![shifted_object(2, 1.0), shifted_object(2, 2.0)]),
        leaf(),
    ];
    let Ok(assembly) = Assembly::new(
        objects,
        vec![part(0), part(2)],
        ExpansionBudget::for_file(0),
    ) else {
        panic!("there is no circle");
    };
    let all = assembly.expand(0..2).unwrap();
    let firsts: Vec<f64> = all.vertices.iter().step_by(3).map(|v| v.x).collect();
    assert_eq!(firsts, [10.0, 21.0, 22.0, 0.0]);
    assert_eq!(all.corners, (0..12).collect::<Vec<i64>>());
}

#[test]
fn circles_are_found() {
    let circle = |objects: Vec<Object>| {
        let made = Assembly::new(objects, vec![part(0)], ExpansionBudget::for_file(0));
        made.err().map(|circle| circle.object)
    };
    assert_eq!(circle(vec![of(vec![shifted_object(0, 1.0)])]), Some(0));
    // The first object leads to the cycle, but is not on it.
    let lead = vec![
        of(vec![shifted_object(3, 0.0), shifted_object(1, 0.0)]),
        of(vec![shifted_object(2, 0.0)]),
        of(vec![shifted_object(1, 0.0)]),
        leaf(),
    ];
    assert!(matches!(circle(lead), Some(1 | 2)));
    assert_eq!(
        circle(vec![of(vec![shifted_object(1, 0.0); 3]), leaf()]),
        None
    );
}

#[test]
fn parts_without_faces_are_left_out() {
    let objects = vec![
        of(vec![shifted_object(1, 0.0)]),
        of(Vec::new()),
        of(vec![shifted_object(3, 0.0)]),
        leaf(),
    ];
    let parts = vec![part(0), part(2), part(1), part(3)];
    let Ok(assembly) = Assembly::new(objects, parts, ExpansionBudget::for_file(0)) else {
        panic!("there is no circle");
    };
    let kept: Vec<usize> = assembly
        .parts
        .iter()
        .map(|part| part.placed.object)
        .collect();
    assert_eq!(kept, [2, 3]);
}

/// Tests that a chain of a thousand objects, each twice its member, is refused before it is expanded.
#[test]
fn doubling_is_refused_before_it_is_done() {
    for bottom in [leaf(), of(Vec::new())] {
        let mut objects = vec![leaf(), bottom];
        objects.extend((1..1000).map(|k| {
            of(vec![
                shifted_object(k, 1.0),
                shifted_object(k, 2.0),
                shifted_object(0, 0.0),
            ])
        }));
        let Ok(assembly) = Assembly::new(
            objects,
            vec![part(1000)],
            ExpansionBudget::for_file(100_000),
        ) else {
            panic!("there is no circle");
        };
        let fault = assembly.expand(0..1).unwrap_err();
        assert!(matches!(fault, MeshFault::TooManyRepeats { .. }), "{fault}");
    }
}
