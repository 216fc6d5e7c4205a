use super::*;
use crate::error::CellNotProvable;
use crate::stop::Never;
use crate::{ProvenCell, prove};
use dashu_ratio::RBig;
use rigid_ccd::trajectory;
use rigid_ccd_robot::{Item, Joint, Link, LinkPairs, PositionRule};

fn exact(x: f64) -> RBig {
    RBig::try_from(x).unwrap()
}

/// Transforms a point by a pose in exact fractions. The rotation is that of the normalized quaternion.
fn transform_exactly(point: DVec3, pose: &Pose) -> [RBig; 3] {
    let [x, y, z, w] = pose.rotation().to_array().map(exact);
    let [vx, vy, vz] = point.to_array().map(exact);
    let dot = |a: [&RBig; 3], b: [&RBig; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let (u, v) = ([&x, &y, &z], [&vx, &vy, &vz]);
    let [along, square] = [dot(u, v), dot(u, u)];
    let cross = [
        &y * &vz - &z * &vy,
        &z * &vx - &x * &vz,
        &x * &vy - &y * &vx,
    ];
    let length = &w * &w + &square;
    let shift = pose.translation().to_array().map(exact);
    [0, 1, 2].map(|k| {
        let twice = &along * u[k] + &w * &cross[k];
        ((&w * &w - &square) * v[k] + &twice + &twice) / &length + &shift[k]
    })
}

#[test]
fn transformed_balls_contain_the_exact_ones() {
    let mut state = 3u64;
    let mut random = || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        (state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    };
    for round in 0..1000 {
        let size = 10f64.powi([round % 13 - 6, -300 - round % 20][round as usize % 2]);
        let mut vector = |size: f64| [random() * size, random() * size, random() * size];
        let translation_size = if size < 1e-200 { size } else { 10.0 };
        let (point, translation, [x, y, z]) = (vector(size), vector(translation_size), vector(1.0));
        let pose = Pose::new(translation, [x, y, z, 0.3]).unwrap();
        let ball = DVec3::from_array(point).extend(0.25);
        let transformed = transform_ball(ball, &pose);
        let expected = transform_exactly(ball.truncate(), &pose);
        let center = transformed.truncate().to_array().map(exact);
        let [x, y, z] = [0, 1, 2].map(|k| {
            let error = &center[k] - &expected[k];
            &error * &error
        });
        let growth = exact(transformed.w) - exact(ball.w);
        assert!(x + y + z <= &growth * &growth);
        // The radius grows by little more than necessary.
        assert!(transformed.w - ball.w < 1e-13 * (size + 20.0));
    }
}

/// Returns a cell with an arm, a tool fixed to it, and four obstacles.
fn cell() -> Cell {
    let at = |x, y, z| Pose::new([x, y, z], [0.1, 0.2, x, 1.0]).unwrap();
    let rod = || rigid_ccd::Body::capsule(0.1, 0.4).unwrap();
    let block = || rigid_ccd::Body::cuboid([0.2, 0.3, 0.1]).unwrap();
    let links = vec![
        Link::named("base"),
        Link::named("arm").with_body(rod(), at(0.0, 0.0, 0.8)),
        Link::named("tool").with_body(block(), at(0.1, 0.0, 0.0)),
    ];
    let joint = |parent: &str, child: &str, geometry| Joint {
        name: format!("to {child}"),
        parent: parent.into(),
        child: child.into(),
        geometry,
        position_rule: PositionRule::Independent,
    };
    let hinge = trajectory::Joint::revolute(at(0.0, 0.0, 1.0), [0.0, 1.0, 0.0]).unwrap();
    let flange = trajectory::Joint::fixed(at(0.0, 0.1, 1.5));
    let joints = vec![joint("base", "arm", hinge), joint("arm", "tool", flange)];
    let robot = Robot::new(links, joints).unwrap();
    let pairs = LinkPairs::from_robot(&robot);
    let mut cell = Cell::new(robot, pairs);
    for (number, body) in [block(), rod(), block(), rod()].into_iter().enumerate() {
        let pose = at(5.0 + number as f64, -2.0, 1.0);
        cell.add_obstacle(format!("obstacle {number}"), body, pose)
            .unwrap();
    }
    cell
}

/// Checks the members of the groups. Checks that the scene has exactly the pairs of the cell with their margins, and that the proof holds.
fn assert_groups_and_proof(cell: &Cell, expected: &[&[usize]]) {
    let Ok(groups) = rigid_groups(cell, Never);
    let groups = groups.unwrap();
    let members: Vec<&[usize]> = groups.iter().map(|group| &group.members[..]).collect();
    assert_eq!(members, expected);
    let proven = ProvenCell::new(cell).unwrap();
    let scene = proven.edge(&[0.2], &[0.5], 0.01).unwrap();
    let mut scene_pairs = Vec::new();
    for pair in &scene.pairs {
        let [a, b] = pair.bodies.map(|body| expected[body]);
        for &a in a {
            scene_pairs.extend(b.iter().map(|&b| ([a.min(b), a.max(b)], pair.margin)));
        }
    }
    let mut compared: Vec<_> = cell.compared_pairs(0.01).collect();
    let by_bodies = |a: &([usize; 2], f64), b: &([usize; 2], f64)| a.0.cmp(&b.0);
    scene_pairs.sort_by(by_bodies);
    compared.sort_by(by_bodies);
    assert_eq!(scene_pairs, compared);
    let proof = prove(&scene, 1.0, None).unwrap();
    let meshes = proven
        .meshes()
        .map(|body| ccd_check::Body::new(body.mesh(), body.certificate(), &proof.bytes).unwrap());
    let meshes: Vec<_> = meshes.collect();
    assert_eq!(ccd_check::check(&meshes, &proof.bytes), Ok(()));
}

#[test]
fn static_bodies_are_merged_if_they_have_the_same_pairs() {
    let mut cell = cell();
    assert_groups_and_proof(&cell, &[&[0, 1], &[2, 3, 4, 5]]);
    // Only the tool has a padding, so its distances differ from those of the arm.
    cell.set_padding("tool", 0.05).unwrap();
    assert_groups_and_proof(&cell, &[&[0], &[1], &[2, 3, 4, 5]]);
    cell.set_padding("arm", 0.05).unwrap();
    assert_groups_and_proof(&cell, &[&[0, 1], &[2, 3, 4, 5]]);
    // This clearance equals the padding, but does not grow with the margin.
    let pair = [Item::Link("arm"), Item::Obstacle("obstacle 3")];
    cell.set_clearance(pair, 0.05).unwrap();
    assert_groups_and_proof(&cell, &[&[0], &[1], &[2, 3, 4], &[5]]);
    // A pair with an allowed contact is in no proof.
    cell.allow_contact([Item::Link("tool"), Item::Obstacle("obstacle 2")])
        .unwrap();
    assert_groups_and_proof(&cell, &[&[0], &[1], &[2, 3], &[4], &[5]]);
}

#[test]
fn a_body_without_pairs_is_not_in_a_proof() {
    let mut cell = cell();
    for number in 0..4 {
        cell.remove_obstacle(&format!("obstacle {number}")).unwrap();
    }
    let Ok(groups) = rigid_groups(&cell, Never);
    assert!(groups.unwrap().is_empty());
    // A proof without pairs would hold for any path.
    let error = ProvenCell::new(&cell).unwrap_err();
    assert!(
        matches!(error, CellNotProvable::NothingCompared(_)),
        "{error}"
    );
}
