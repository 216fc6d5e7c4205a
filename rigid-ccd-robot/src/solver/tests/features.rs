//! Tests the mesh features of contacts.

use super::*;
use crate::path_answer::PathOutcome;
use rigid_ccd::answer::Feature;

/// Returns the distance of a point from a feature of a mesh.
fn distance_from_feature(
    point: DVec3,
    feature: Feature,
    corners: &[DVec3],
    faces: &[[u32; 3]],
) -> f64 {
    let at = |corner: u32| corners[corner as usize];
    match feature {
        Feature::Vertex(corner) => point.distance(at(corner)),
        Feature::Edge(p, q) => {
            let along = (at(q) - at(p)).normalize();
            (point - at(p)).cross(along).length()
        }
        Feature::Face(face) => {
            let [p, q, r] = faces[face as usize].map(at);
            (point - p).dot((q - p).cross(r - p).normalize()).abs()
        }
        Feature::Piece(_) => panic!("a mesh has features"),
    }
}

/// Returns a robot with one body on a vertical slide.
fn robot_on_slide(body: Body) -> Robot {
    let links = vec![
        Link::named("base"),
        Link::named("tool").with_body(body, Pose::IDENTITY),
    ];
    let joint = Joint {
        name: "slide".into(),
        parent: "base".into(),
        child: "tool".into(),
        geometry: trajectory::Joint::prismatic(Pose::IDENTITY, [0.0, 0.0, 1.0]).unwrap(),
        position_rule: PositionRule::Independent,
    };
    Robot::new(links, vec![joint]).unwrap()
}

/// Tests that the witness on a mesh is on the reported feature, and that a convex link has no feature.
#[test]
fn a_contact_names_the_feature_of_the_mesh() {
    let mut random = Pcg64::seed_from_u64(31);
    // A ridge of two rows of triangles. From below, its surface is not convex.
    let corners: Vec<DVec3> = (0..3)
        .flat_map(|row| {
            (0..5).map(move |column| {
                let height = if row == 1 { 0.1 } else { 0.0 };
                DVec3::new(f64::from(column) - 2.0, f64::from(row) - 1.0, height)
            })
        })
        .collect();
    let faces: Vec<[u32; 3]> = (0..2u32)
        .flat_map(|row| (0..4).map(move |column| 5 * row + column))
        .flat_map(|corner| {
            [
                [corner, corner + 1, corner + 5],
                [corner + 1, corner + 6, corner + 5],
            ]
        })
        .collect();
    let ids: Vec<u32> = (0..faces.len() as u32).collect();
    let pieces = Pieces::from_triangles(&corners, &faces, &ids).unwrap();
    let ridge = Body::new(&pieces, Solidity::Surface).unwrap();
    let (mut borders, mut inside) = (0, 0);
    for _ in 0..400 {
        let robot = robot_on_slide(random_body(&mut random));
        let pairs = LinkPairs::from_robot(&robot);
        let mut cell = Cell::new(robot, pairs);
        let below = Pose::at([0.0, 0.0, -1.5]).unwrap();
        let pose = below.compose(&random_pose(&mut random, 0.9));
        cell.add_obstacle("ridge", ridge.clone(), pose).unwrap();
        let PathOutcome::Contact(contact) = cell
            .solver()
            .first_contact(&[[0.0], [-4.0]])
            .unwrap()
            .outcome
        else {
            continue;
        };
        let [of_link, Some(feature)] = contact.features else {
            panic!("{contact:?}")
        };
        let is_mesh = cell.robot().links()[1].bodies[0].body.pieces().len() > 1;
        assert_eq!(of_link.is_some(), is_mesh);
        let on_ridge = pose
            .inverse()
            .transform_point(contact.witnesses.unwrap()[1]);
        let distance = distance_from_feature(on_ridge, feature, &corners, &faces);
        assert!(distance < 1e-9, "{distance} from {contact:?}");
        match feature {
            Feature::Vertex(_) | Feature::Edge(..) => borders += 1,
            _ => inside += 1,
        }
    }
    assert!(borders > 20 && inside > 20, "{borders} {inside}");
}
