use super::{Assembly, Part};
use crate::mesh::affine::AffineMap;
use crate::mesh::content::allowance::ExpansionBudget;
use crate::mesh::polygons::Polygons;
use crate::mesh::remark::Remarks;
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

fn shifted_part(x: f64) -> Part {
    let map = AffineMap::from(Pose::at([x, 0.0, 0.0]).unwrap());
    Part {
        shape: 0,
        placement: map,
    }
}

#[test]
fn parts_are_placed_in_order() {
    let parts = [10.0, 21.0, 0.0].map(shifted_part);
    let assembly = Assembly {
        shapes: vec![triangle()],
        parts: parts.into(),
        budget: ExpansionBudget::for_file(0),
        remarks: Remarks::default(),
    };
    let all = assembly.placed_triangles(0..3).unwrap();
    let firsts: Vec<f64> = all.vertices.iter().step_by(3).map(|v| v.x).collect();
    assert_eq!(firsts, [10.0, 21.0, 0.0]);
    assert_eq!(all.corners, (0..9).collect::<Vec<i64>>());
}
