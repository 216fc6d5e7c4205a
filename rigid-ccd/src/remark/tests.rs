//! Tests that typical mistakes give a remark, and that usual input gives none.

use super::*;
use std::f64::consts::PI;

#[test]
fn a_tolerance_as_large_as_a_part_is_remarked_upon() {
    let size = |body: Body| Remark::body_size(&body);
    let part = size(Body::cuboid([0.0005; 3]).unwrap());
    assert!((part - 0.001).abs() < 1e-15);
    assert_eq!(size(Body::capsule(0.5, 2.0).unwrap()), 5.0);
    let wall = size(Body::cuboid([1.0, 1.0, 0.00001]).unwrap());
    assert_eq!(wall, 2.0);
    for sizes in [[part, wall], [wall, part]] {
        let remark = Remark::remark_on_tolerance(0.001, sizes).unwrap();
        assert!(
            remark
                .to_string()
                .ends_with(": 0.001, and the body is 0.001 long"),
            "{remark}"
        );
        assert_eq!(Remark::remark_on_tolerance(0.00009, sizes), None);
    }
    // Thin walls are usual, and so are points.
    assert_eq!(Remark::remark_on_tolerance(0.001, [wall, wall]), None);
    assert_eq!(Remark::remark_on_tolerance(0.001, [0.0, wall]), None);
    assert_eq!(size(Body::sphere(0.0).unwrap()), 0.0);
}

#[test]
fn degrees_are_remarked_upon() {
    for (spin, duration) in [
        ([0.0, 0.0, 90.0], 1.0),
        ([0.0, -45.0, 0.0], 1.0),
        ([30.0, 45.0, -60.0], 1.0),
        ([0.0, 0.0, 360.0], 1.0),
        ([0.0, 0.0, 9.0], 10.0),
        ([0.0, 0.0, 90.0], 0.7),
    ] {
        let remark = Remark::remark_on_spin(spin, duration);
        assert!(
            matches!(remark, Some(Remark::AngularVelocityInDegrees { .. })),
            "{spin:?} {duration}"
        );
    }
    let remark = Remark::remark_on_spin([0.0, 0.0, 90.0], 1.0)
        .unwrap()
        .to_string();
    assert!(remark.contains("(0, 0, 90) makes 14.3 turns"), "{remark}");
    for position in [90.0, -45.0, 180.0, 360.0, -720.0] {
        assert!(Remark::remark_on_joint(position).is_some(), "{position}");
    }
}

/// Tests that usual input in radians gives no remark: rest, rotations of parts and robots, shafts at round or whole
/// numbers of turns.
#[test]
fn radians_are_not() {
    for rate in [
        0.0,
        1.0,
        3.0,
        5.0,
        10.0,
        15.0,
        20.0,
        25.0,
        50.0,
        100.0,
        200.0,
        500.0,
        1000.0,
        3000.0,
        PI,
        TAU,
        0.5 * PI,
        10.0 * TAU,
        100.0 * TAU,
        104.72,
        314.159,
        1e5,
    ] {
        for spin in [[0.0, 0.0, rate], [-rate, 0.0, 0.0]] {
            assert_eq!(Remark::remark_on_spin(spin, 1.0), None, "{rate}");
        }
        assert_eq!(Remark::remark_on_joint(rate), None, "{rate}");
    }
    assert_eq!(Remark::remark_on_spin([0.0, 0.0, 90.0], 0.1), None);
    assert_eq!(Remark::remark_on_spin([f64::NAN, 0.0, 90.0], 1.0), None);
}

#[test]
fn quaternions_of_another_length_are_remarked_upon() {
    for parts in [
        [1.0, 0.0, 0.0, 1.0],
        [0.0, 0.0, 0.0, 0.5],
        [0.0, 0.0, 1.0, 90.0],
        [0.0, 0.0, 0.0, 1e-200],
        [0.0, 1e300, 0.0, 0.0],
    ] {
        assert!(Remark::remark_on_quaternion(parts).is_some(), "{parts:?}");
    }
    for parts in [
        [1.0, 0.0, 0.0, 0.0],
        [0.71, 0.71, 0.0, 0.0],
        [-0.5, 0.5, -0.5, 0.5],
        [0.0, 0.0, 0.0, 1.05],
    ] {
        assert_eq!(Remark::remark_on_quaternion(parts), None, "{parts:?}");
    }
}

#[test]
// Files have rounded angles.
#[allow(clippy::approx_constant)]
fn fixed_angles_of_more_than_a_turn_are_remarked_upon() {
    for angles in [[0.0, 0.0, 90.0], [-45.0, 0.0, 0.0], [0.0, 180.0, 0.0]] {
        let remark = Remark::remark_on_roll_pitch_yaw(angles).unwrap();
        assert!(remark.to_string().contains("in radians: ("), "{remark}");
    }
    for angles in [[0.0; 3], [PI, -PI, TAU], [0.0, 6.2832, -1.5708]] {
        assert_eq!(Remark::remark_on_roll_pitch_yaw(angles), None, "{angles:?}");
    }
}

/// Tests that numbers are short, however small, and that a mesh which is only a surface, or in another unit, is remarked upon.
#[cfg(feature = "meshes")]
#[test]
fn meshes_are_remarked_upon() {
    use ccd_decomp::{PieceChoice, TriangleMesh, Unit, body_from_mesh};
    let corners = |x| {
        let [o, y, z] = [[x, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], y, z, o]
    };
    let remark = |corners, faces: &[[u32; 3]], asked| {
        let mesh = TriangleMesh::new(corners, faces).unwrap();
        let report = body_from_mesh(&mesh, asked).unwrap().report;
        Remark::remark_on_mesh(asked, &mesh, &report)
    };
    let closed = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
    let seam = [[4, 2, 1], closed[1], closed[2], closed[3]];
    let auto = PieceChoice::Auto;
    assert_eq!(remark(corners(0.0), &closed, auto), None);
    assert_eq!(remark(corners(0.0), &seam, auto), None);
    for (asked, is_remarked) in [
        (auto, true),
        (PieceChoice::Triangles, true),
        (PieceChoice::Surface, false),
        (PieceChoice::OuterHull, false),
    ] {
        let open = remark(corners(0.0), &closed[1..], asked);
        let expected = Remark::SurfaceOnly { open_edges: 3 };
        assert_eq!(open, is_remarked.then_some(expected), "{asked:?}");
        let joining_distance = 1e-9;
        let open = remark(corners(joining_distance), &seam, asked);
        let expected = Remark::OpenSeam { joining_distance };
        assert_eq!(open, is_remarked.then_some(expected), "{asked:?}");
    }
    // A tetrahedron in another one, both turned outward, and as a cavity.
    let both = |inner: [[u32; 3]; 4]| {
        let small = corners(0.0).into_iter().map(|at| at.map(|x| 0.1 + 0.1 * x));
        let points = corners(0.0).into_iter().chain(small).collect();
        let inner = inner.map(|face| face.map(|corner| corner + 5));
        remark(points, &[closed, inner].concat(), auto)
    };
    assert_eq!(
        both(closed),
        Some(Remark::TurnedShells { turned_shells: 1 })
    );
    assert_eq!(both(closed.map(|[a, b, c]| [a, c, b])), None);
    // What is flat has no inside.
    assert_eq!(remark(corners(0.0), &closed[..1], auto), None);
    let point = remark(vec![[1.0; 3]; 3], &[[0, 1, 2]], auto);
    assert_eq!(point, Some(Remark::PointMesh));
    assert_eq!(Remark::remark_on_unit(None), None);
    assert_eq!(Remark::remark_on_unit(Some(Unit::Metre)), None);
    let text = Remark::remark_on_unit(Some(Unit::Inch))
        .unwrap()
        .to_string();
    assert!(text.ends_with(": in"), "{text}");
    let text = Remark::remark_on_quaternion([1e-300, 0.0, 0.0, 0.0])
        .unwrap()
        .to_string();
    assert!(
        text.ends_with("(1e-300, 0, 0, 0) has the length 1e-300"),
        "{text}"
    );
}
