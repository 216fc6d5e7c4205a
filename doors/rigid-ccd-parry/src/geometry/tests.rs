use super::*;

fn first_points_with_sub_shape_indices(geometry: &ShapeGeometry) -> Vec<(u32, DVec3)> {
    let (body, numbers) = geometry.body().expect("a body");
    let pieces = body.pieces().iter().map(|piece| piece.points[0]);
    let mut at: Vec<(u32, DVec3)> = numbers.into_iter().zip(pieces).collect();
    at.sort_by_key(|(number, _)| *number);
    at
}

#[test]
fn pieces_keep_their_numbers_in_any_order() {
    let mut parts = ShapeGeometry::EMPTY;
    for k in (0..50).rev() {
        let mut inner = ShapeGeometry::EMPTY;
        inner.push_box(DVec3::ZERO, DVec3::ONE, 0.0);
        let pose = Pose::at([f64::from(k * 7 % 50), 0.0, 0.0]).expect("a pose");
        parts.push_at_pose(&pose, &inner, k).expect("a part");
    }
    for (number, first) in first_points_with_sub_shape_indices(&parts) {
        assert_eq!(first.x, f64::from(number * 7 % 50));
    }
    let mut mesh = ShapeGeometry::EMPTY;
    for k in 0..50 {
        let x = f64::from(k * 7 % 50);
        let corners = [DVec3::ZERO, DVec3::Y, DVec3::Z].map(|v| DVec3::X * x + v);
        mesh.push_triangles(corners, &[[0, 1, 2]], [k]);
    }
    assert_eq!(first_points_with_sub_shape_indices(&mesh).len(), 50);
    for (number, first) in first_points_with_sub_shape_indices(&mesh) {
        assert_eq!(first.x, f64::from(number * 7 % 50));
    }
    // Triangles combined with other parts.
    mesh.push_hull_of_points([DVec3::X * 100.0, DVec3::Y], 0.0, 50);
    let at = first_points_with_sub_shape_indices(&mesh);
    assert_eq!((at.len(), at[50]), (51, (50, DVec3::X * 100.0)));
    assert!(
        at[..50]
            .iter()
            .all(|(number, first)| first.x == f64::from(number * 7 % 50))
    );
}

#[test]
fn a_mesh_that_names_a_missing_vertex_is_refused_by_its_face() {
    let mut geometry = ShapeGeometry::EMPTY;
    let corners = [DVec3::ZERO, DVec3::X, DVec3::Y];
    geometry.push_triangles(corners, &[[0, 1, 2], [0, 1, 3]], 0..);
    let error = geometry.body().expect_err("refused");
    assert!(
        matches!(
            error,
            ShapeError::Piece {
                element_index: 1,
                ..
            }
        ),
        "{error}"
    );
    let mut beside = ShapeGeometry::EMPTY;
    beside
        .push_at_pose(&Pose::IDENTITY, &geometry, 7)
        .expect("not looked at yet");
    beside.push_hull_of_points([DVec3::ZERO], 1.0, 0);
    let error = beside.body().expect_err("refused");
    assert!(
        matches!(
            error,
            ShapeError::Piece {
                element_index: 7,
                ..
            }
        ),
        "{error}"
    );
}

#[test]
fn points_that_are_placed_are_off_by_no_more_than_the_slack() {
    // A half turn about an axis without an exact representation, far from the origin.
    let axis = DVec3::new(1.0, 2.0, 3.0);
    let far = 1e6 * DVec3::new(1.0, -3.0, 2.0);
    let pose = Pose::new(far, [axis.x, axis.y, axis.z, 0.0]).expect("a pose");
    let mut inner = ShapeGeometry::EMPTY;
    inner.push_hull_of_points([axis, 5.0 * DVec3::X], 0.0, 0);
    let mut geometry = ShapeGeometry::EMPTY;
    geometry.push_at_pose(&pose, &inner, 0).expect("a part");
    let (body, _) = geometry.body().expect("a body");
    // Points on the axis are fixed, and others are reflected: `2 a (a·x)/(a·a) − x`.
    let fraction = 2.0 * 5.0 * axis.x / axis.length_squared();
    let exact = [far + axis, far + (fraction * axis - 5.0 * DVec3::X)];
    for (point, exact) in body.pieces().points().iter().zip(exact) {
        let off = length(*point - exact);
        assert!(off <= geometry.slack, "{off:e} of {:e}", geometry.slack);
    }
    assert!(geometry.slack < 1e-7 && geometry.slack > 0.0);
    let mut here = ShapeGeometry::EMPTY;
    here.push_at_pose(&Pose::IDENTITY, &inner, 0)
        .expect("a part");
    assert_eq!(here.slack, 0.0);
}

#[test]
fn a_ball_is_about_all_points() {
    let mut geometry = ShapeGeometry::EMPTY;
    geometry.push_box(DVec3::ONE, 3.0 * DVec3::ONE, 0.5);
    geometry.push_hull_of_points([DVec3::new(9.0, 2.0, 2.0)], 1.0, 0);
    let (middle, radius) = geometry.enclosing_ball();
    let far = [1.0, 3.0].map(|x| length(DVec3::new(x, 1.0, 1.0) - middle) + 0.5);
    assert!(far.iter().all(|far| radius >= *far) && radius >= 10.0 - middle.x);
    assert!(radius < 6.0);
}

#[test]
fn only_a_ball_is_a_point() {
    let mut ball = ShapeGeometry::EMPTY;
    ball.push_hull_of_points([DVec3::X], 2.0, 0);
    assert_eq!(ball.center_if_ball(), Some(DVec3::X));
    ball.push_hull_of_points([DVec3::X; 2], 0.0, 0);
    assert_eq!(ball.center_if_ball(), None);
}
