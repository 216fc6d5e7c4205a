use super::{Assembly, Part};
use crate::mesh::affine::AffineMap;
use crate::mesh::content::allowance::ExpansionBudget;
use crate::mesh::polygons::Polygons;
use ccd_core::Pose;
use ccd_core::glam::DVec3;

fn triangle() -> Polygons {
    Polygons {
        vertices: vec![DVec3::ZERO, DVec3::X, DVec3::Y],
        corners: vec![0, 1, 2],
        corner_ends: vec![3],
        ..Polygons::default()
    }
}

fn shifted_part(shape: usize, x: f64) -> Part {
    let map = AffineMap::from(Pose::at([x, 0.0, 0.0]).unwrap());
    Part {
        name: None,
        shape,
        placement: map,
    }
}

#[test]
fn parts_are_placed_in_order() {
    let parts = [10.0, 21.0, 0.0].map(|x| shifted_part(0, x));
    let assembly = Assembly::new(vec![triangle()], parts.into(), ExpansionBudget::for_file(0));
    let all = assembly.placed_triangles(0..3).unwrap();
    let firsts: Vec<f64> = all.vertices.iter().step_by(3).map(|v| v.x).collect();
    assert_eq!(firsts, [10.0, 21.0, 0.0]);
    assert_eq!(all.corners, (0..9).collect::<Vec<i64>>());
}

#[test]
fn parts_without_faces_are_left_out() {
    let shapes = vec![Polygons::default(), triangle()];
    let parts = [0, 1, 0, 1].map(|shape| shifted_part(shape, 0.0));
    let assembly = Assembly::new(shapes, parts.into(), ExpansionBudget::for_file(0));
    let kept: Vec<usize> = assembly.parts.iter().map(|part| part.shape).collect();
    assert_eq!(kept, [1, 1]);
}
