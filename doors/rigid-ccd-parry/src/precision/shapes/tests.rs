use super::super::library::math::Vector;
use super::super::library::shape::{Ball, HeightFieldCellStatus, SharedShape, TriMesh};
use super::super::library::utils::Array2;
use super::*;
use crate::Excess;

fn prepared_body(shape: &dyn Shape) -> BodyOfShape {
    body(shape, &Options::default()).expect("served")
}

#[test]
fn holes_of_height_fields_are_holes() {
    let mut field = HeightField::new(Array2::repeat(4, 5, 0.5), Vector::new(2.0, 1.0, 3.0));
    let whole = prepared_body(&field);
    assert_eq!(whole.body().pieces().len(), 24);
    let removed = HeightFieldCellStatus::LEFT_TRIANGLE_REMOVED;
    field.set_cell_status(1, 2, removed);
    field.set_cell_status(
        2,
        3,
        removed | HeightFieldCellStatus::RIGHT_TRIANGLE_REMOVED,
    );
    field.set_cell_status(0, 0, HeightFieldCellStatus::ZIGZAG_SUBDIVISION);
    let holed = prepared_body(&field);
    assert_eq!(holed.body().pieces().len(), 21);
    // Piece number k is triangle k.
    for piece in 0..21 {
        let number = holed.sub_shape_index(piece);
        let theirs = field
            .triangle_at_id(number)
            .expect("a triangle that is there");
        let theirs = theirs.vertices().map(point_from_parry);
        let ours = holed.body().pieces().get(piece as usize);
        assert_eq!(ours.points, theirs, "{number}");
    }
}

#[test]
fn voxels_are_boxes_on_the_grid() {
    let cells = [[0, 0, 0], [1, 0, 0], [-9, 17, 3], [700, -5000, 8]];
    let keys: Vec<IVector> = cells
        .iter()
        .map(|[x, y, z]| IVector::new(*x, *y, *z))
        .collect();
    let made = prepared_body(&Voxels::new(Vector::new(0.1, 0.3, 0.7), &keys));
    assert_eq!(made.body().pieces().len(), 4);
    let size = point_from_parry(Vector::new(0.1, 0.3, 0.7));
    for [x, y, z] in cells {
        let low = DVec3::new(x as f64, y as f64, z as f64) * size;
        let pieces = made.body().pieces();
        let found = pieces
            .iter()
            .any(|piece| length(piece.points[0] - low) <= made.slack());
        assert!(found, "{x} {y} {z}");
    }
    let far = IVector::new(1 << 21, 0, 0);
    let refused = body(&Voxels::new(Vector::ONE, &[far]), &Options::default());
    assert!(
        matches!(refused, Err(ShapeError::UnresolvableVoxels)),
        "{refused:?}"
    );
}

#[test]
fn voxels_are_all_found_at_any_size() {
    // Rounded divisions by such sizes are wrong by one at the ends of chunks.
    for size in [0.1, 0.3, 1e-3, 7.77, 123.456] {
        let keys: Vec<IVector> = (-40..40).map(|x| IVector::new(x, 7 * x + 1, -x)).collect();
        let made = prepared_body(&Voxels::new(Vector::splat(size), &keys));
        assert_eq!(made.body().pieces().len(), keys.len(), "{size}");
    }
}

#[test]
fn parts_of_a_compound_have_their_numbers() {
    use super::super::library::math::Pose;
    let parts = (0..9).map(|k| {
        (
            Pose::translation(k as Real, 0.0, 0.0),
            SharedShape::ball(0.1),
        )
    });
    let made = prepared_body(&Compound::new(parts.collect()));
    for piece in 0..9 {
        let at = made.body().pieces().get(piece as usize).points[0];
        assert_eq!(at.x, f64::from(made.sub_shape_index(piece)));
    }
    assert_eq!(made.sub_shape_index(9), 0);
}

#[test]
fn refusals_name_the_reason() {
    let refused = |shape: &dyn Shape| body(shape, &Options::default()).expect_err("refused");
    let plane = SharedShape::halfspace(Vector::Y);
    assert_eq!(refused(&*plane), ShapeError::HalfSpace);
    assert!(matches!(
        refused(&Ball::new(-0.5)),
        ShapeError::InvalidSize {
            what: "radius",
            value: -0.5
        }
    ));
    let mut points = vec![Vector::ZERO, Vector::X, Vector::Y];
    points[2].z = Real::INFINITY;
    let mesh = TriMesh::new(points, vec![[0, 1, 2]]).expect("a mesh");
    assert!(matches!(
        refused(&mesh),
        ShapeError::Piece {
            element_index: 0,
            ..
        }
    ));
}

#[test]
fn cylinders_and_cones_are_along_y_with_the_reported_excess() {
    use super::super::library::shape::{Cone, Cylinder};
    let within = |excess| Options {
        excess,
        ..Options::default()
    };
    for excess in [Excess::DefaultRadiusFraction, Excess::Length(1e-3)] {
        let (cylinder, cone) = (Cylinder::new(0.5, 0.25), Cone::new(0.5, 0.25));
        for shape in [&cylinder as &dyn Shape, &cone] {
            let made = body(shape, &within(excess)).expect("served");
            assert!((1e-6..=1e-3).contains(&made.excess()));
            // Upper bounds of distances hold for the shape.
            assert_eq!(made.body().excess(), made.excess());
            let points = made.body().pieces().points();
            let [mut base, mut top] = [0.0, 0.0];
            for point in points {
                let aside = point.x.hypot(point.z);
                assert_eq!(point.y.abs(), 0.5);
                let widest = if point.y < 0.0 { &mut base } else { &mut top };
                *widest = greater(*widest, aside);
            }
            let rim = 0.25..=0.25 + made.excess();
            assert!(rim.contains(&base));
            // The apex is up, as in parry.
            assert!(rim.contains(&top) || (top == 0.0 && shape.as_cone().is_some()));
        }
    }
    let cylinder = Cylinder::new(1.0, 2.0);
    let refused = |excess| body(&cylinder, &within(excess)).expect_err("refused");
    let ShapeError::ExcessTooSmall {
        least_excess: least,
        ..
    } = refused(Excess::Length(1e-8))
    else {
        panic!("too fine");
    };
    assert!(least < 1e-7 && body(&cylinder, &within(Excess::Length(least))).is_ok());
    assert!(matches!(
        refused(Excess::Length(-1.0)),
        ShapeError::InvalidSize { what: "excess", .. }
    ));
    assert_eq!(
        refused(Excess::NotAllowed),
        ShapeError::SolidOfRevolutionRefused
    );
}
