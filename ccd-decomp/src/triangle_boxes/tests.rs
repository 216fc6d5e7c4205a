use super::*;
use crate::test_meshes::star;

fn found(boxes: &TriangleBoxes, region: &Region) -> Vec<u32> {
    let mut found = Vec::new();
    boxes.all_meeting(region, |face| {
        found.push(face);
        true
    });
    found.sort_unstable();
    found
}

/// However large the fans, a triangle or hull among them is near a few others.
#[test]
fn slivers_are_near_few_others() {
    for corners in [64, 512, 4096] {
        let mesh = star(corners, 0.5);
        let boxes = TriangleBoxes::new(mesh.vertices(), mesh.faces());
        let triangle = |face: usize| mesh.faces()[face].map(|v| mesh.vertices()[v as usize]);
        let most = (0..mesh.faces().len()).step_by(37).map(|face| {
            let near = found(&boxes, &Region::triangle(triangle(face)));
            assert!(near.contains(&(face as u32)));
            near.len()
        });
        let most = most.max().unwrap();
        assert!(most <= 24, "{most} of {corners}");
    }
}

/// Whoever is left out has no point in common with a triangle: all pairs, exactly.
#[test]
fn nothing_that_meets_is_left_out() {
    let mesh = star(64, 0.5);
    // Turned and moved, so that slivers of the two pass through each other.
    let turn = ccd_core::glam::DQuat::from_rotation_x(0.7);
    let moved = |p: DVec3| turn * p + DVec3::new(0.3, 0.2, 0.1);
    let boxes = TriangleBoxes::new(mesh.vertices(), mesh.faces());
    let mut meeting = 0;
    for face in mesh.faces() {
        let one = face.map(|v| moved(mesh.vertices()[v as usize]));
        let near = found(&boxes, &Region::triangle(one));
        for (k, other) in (0..).zip(mesh.faces()) {
            let other = other.map(|v| mesh.vertices()[v as usize]);
            if crate::self_intersection::triangles_meet([one, other]) {
                meeting += 1;
                assert!(near.contains(&k));
            }
        }
    }
    assert!(meeting > 100, "{meeting}");
}

/// A tip that only touches, amid a triangle or on its edge, meets it with all that is about it.
#[test]
fn a_hub_that_touches_is_not_left_out() {
    let mesh = star(64, 0.5);
    let boxes = TriangleBoxes::new(mesh.vertices(), mesh.faces());
    let [a, b] = [DVec3::new(-1.0, -1.0, 1.0), DVec3::new(1.0, 1.0, 1.0)];
    let amid = [a, DVec3::new(1.0, -1.0, 1.0), DVec3::new(0.0, 2.0, 1.0)];
    for touching in [amid, [a, b, DVec3::new(3.0, -1.0, 1.0)]] {
        assert_eq!(found(&boxes, &Region::triangle(touching)).len(), 64);
    }
    // Beside the tip, in the plane that touches it.
    let beside = [a, b, DVec3::new(-1.0, 4.0, 1.0)].map(|p| p + DVec3::Y);
    assert!(found(&boxes, &Region::triangle(beside)).is_empty());
}
