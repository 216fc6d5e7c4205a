//! Bodies of a cell that rest against each other, as one body of a proof.

use crate::body::{Body, triangles_of};
use crate::error::NoMesh;
use crate::stop::Stop;
use crate::tolerances::PLACING;
use ccd_core::Pose;
use ccd_core::glam::{DVec3, DVec4};
use rigid_ccd::trajectory::JointKind;
use rigid_ccd_robot::{CarriedBody, Cell, Robot};
use std::collections::BTreeMap;

/// One body of a cell, or several that rest against each other.
#[derive(Debug)]
pub(crate) struct Resting {
    /// The numbers of the cell's bodies.
    pub(crate) members: Vec<usize>,
    /// The robot's link that carries it.
    pub(crate) link: usize,
    /// The pose on the link; none for several bodies, whose corners are in the frame of the link.
    pub(crate) pose: Pose,
    pub(crate) body: Body,
}

/// What bodies have in common that are one: the link they rest on, the others that they are compared with, and how far they have
/// to be from these.
type Kind = (usize, Vec<[u64; 3]>);

/// Returns the bodies of a cell that are compared with others, those of one kind as one. None of these is compared with another
/// one of its kind, as none is compared with itself.
///
/// # Errors
/// [`NoMesh`].
pub(crate) fn resting_bodies<S: Stop>(
    cell: &Cell,
    stop: S,
) -> Result<Result<Vec<Resting>, NoMesh>, S::Stopped> {
    let ways = ways_to_roots(cell.robot());
    let mut partners = vec![Vec::new(); cell.carried_bodies().len()];
    // Two margins tell a distance that is added to the margin from one that replaces it.
    for (([a, b], least), (_, more)) in cell.compared_pairs(0.0).zip(cell.compared_pairs(1.0)) {
        for (body, partner) in [(a, b), (b, a)] {
            partners[body].push([partner as u64, least.to_bits(), more.to_bits()]);
        }
    }
    let mut kinds: BTreeMap<Kind, Vec<Member<'_>>> = BTreeMap::new();
    for ((number, carried), partners) in cell.carried_bodies().enumerate().zip(partners) {
        if partners.is_empty() {
            continue;
        }
        stop.check()?;
        let Some(triangles) = triangles_of(carried.body) else {
            let body = carried.item.name().into();
            return Ok(Err(NoMesh { body }));
        };
        let root = ways[carried.link].0;
        let member = Member {
            number,
            carried,
            triangles,
        };
        let kind = (root, partners);
        kinds.entry(kind).or_default().push(member);
    }
    let kinds = kinds.into_iter();
    let mut bodies: Vec<Resting> = kinds
        .map(|((root, _), members)| union(root, members, &ways, stop))
        .collect::<Result<_, _>>()?;
    bodies.sort_by_key(|resting| resting.members[0]);
    Ok(Ok(bodies))
}

/// A body of a cell, and the triangles of its mesh.
struct Member<'c> {
    number: usize,
    carried: CarriedBody<'c>,
    triangles: Vec<[DVec4; 3]>,
}

/// For a link the one on which it rests that rests on no other, and the poses from it to that one.
type WayToRoot = (usize, Vec<Pose>);

fn ways_to_roots(robot: &Robot) -> Vec<WayToRoot> {
    let mut ways: Vec<WayToRoot> = (0..robot.links().len())
        .map(|link| (link, Vec::new()))
        .collect();
    for (link, parent, number) in robot.joints_parents_first() {
        let joint = &robot.joints()[number].geometry;
        if matches!(joint.kind(), JointKind::Fixed) {
            let (root, poses) = ways[parent].clone();
            ways[link] = (root, [vec![*joint.origin()], poses].concat());
        }
    }
    ways
}

/// Returns bodies of one kind as one.
fn union<S: Stop>(
    root: usize,
    mut members: Vec<Member<'_>>,
    ways: &[WayToRoot],
    stop: S,
) -> Result<Resting, S::Stopped> {
    let numbers = members.iter().map(|member| member.number).collect();
    if members.len() == 1 {
        let Member {
            carried, triangles, ..
        } = members.remove(0);
        return Ok(Resting {
            members: numbers,
            link: carried.link,
            pose: carried.pose,
            body: Body::of_triangles(&triangles, stop)?,
        });
    }
    let mut all = Vec::new();
    for Member {
        carried, triangles, ..
    } in members
    {
        let poses = || [&carried.pose].into_iter().chain(&ways[carried.link].1);
        let placed = |corner| poses().fold(corner, place);
        all.extend(triangles.into_iter().map(|corners| corners.map(placed)));
    }
    Ok(Resting {
        members: numbers,
        link: root,
        pose: Pose::IDENTITY,
        body: Body::of_triangles(&all, stop)?,
    })
}

/// Places a ball; its radius grows by what its centre may be off.
fn place(ball: DVec4, pose: &Pose) -> DVec4 {
    if *pose == Pose::IDENTITY {
        return ball;
    }
    let (centre, shift): (DVec3, _) = (ball.truncate(), pose.translation());
    // Lengths by their coordinates, which do not underflow as squares do.
    let lengths = centre.abs().element_sum() + shift.abs().element_sum();
    let off = PLACING * lengths + f64::MIN_POSITIVE;
    let placed = pose.transform_point(centre);
    placed.extend((ball.w + off).next_up())
}

#[cfg(test)]
mod tests {
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

    /// The pose of a point by the rotation of q / |q|, in fractions.
    fn exactly_placed(point: DVec3, pose: &Pose) -> [RBig; 3] {
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
    fn balls_that_are_placed_hold_those_that_are_placed_exactly() {
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
            let of_shift = if size < 1e-200 { size } else { 10.0 };
            let (point, shift, [x, y, z]) = (vector(size), vector(of_shift), vector(1.0));
            let pose = Pose::new(shift, [x, y, z, 0.3]).unwrap();
            let ball = DVec3::from_array(point).extend(0.25);
            let placed = place(ball, &pose);
            let expected = exactly_placed(ball.truncate(), &pose);
            let found = placed.truncate().to_array().map(exact);
            let [x, y, z] = [0, 1, 2].map(|k| {
                let off = &found[k] - &expected[k];
                &off * &off
            });
            let slack = exact(placed.w) - exact(ball.w);
            assert!(x + y + z <= &slack * &slack);
            // The slack is no more than it has to be.
            assert!(placed.w - ball.w < 1e-13 * (size + 20.0));
        }
    }

    /// An arm with a tool that is fixed to it, among four obstacles.
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

    /// Each pair that the cell compares is stated once, with its margin, and no other; and what is stated is proven.
    fn check(cell: &Cell, kinds: &[&[usize]]) {
        let Ok(bodies) = resting_bodies(cell, Never);
        let bodies = bodies.unwrap();
        let members: Vec<&[usize]> = bodies.iter().map(|body| &body.members[..]).collect();
        assert_eq!(members, kinds);
        let proven = ProvenCell::new(cell).unwrap();
        let scene = proven.edge(&[0.2], &[0.5], 0.01).unwrap();
        let mut stated = Vec::new();
        for pair in &scene.pairs {
            let [a, b] = pair.bodies.map(|body| kinds[body]);
            for &a in a {
                stated.extend(b.iter().map(|&b| ([a.min(b), a.max(b)], pair.margin)));
            }
        }
        let mut compared: Vec<_> = cell.compared_pairs(0.01).collect();
        let by_bodies = |a: &([usize; 2], f64), b: &([usize; 2], f64)| a.0.cmp(&b.0);
        stated.sort_by(by_bodies);
        compared.sort_by(by_bodies);
        assert_eq!(stated, compared);
        let proof = prove(&scene, 1.0, None).unwrap();
        let meshes = proven.meshes().map(|body| {
            ccd_check::Body::new(body.mesh(), body.certificate(), &proof.bytes).unwrap()
        });
        let meshes: Vec<_> = meshes.collect();
        assert_eq!(ccd_check::check(&meshes, &proof.bytes), Ok(()));
    }

    #[test]
    fn bodies_that_rest_on_each_other_are_one_if_they_have_the_same_pairs() {
        let mut cell = cell();
        check(&cell, &[&[0, 1], &[2, 3, 4, 5]]);
        // A padding is the tool's alone.
        cell.set_padding("tool", 0.05).unwrap();
        check(&cell, &[&[0], &[1], &[2, 3, 4, 5]]);
        cell.set_padding("arm", 0.05).unwrap();
        check(&cell, &[&[0, 1], &[2, 3, 4, 5]]);
        // This clearance is the padding, but does not grow with the margin.
        let pair = [Item::Link("arm"), Item::Obstacle("obstacle 3")];
        cell.set_clearance(pair, 0.05).unwrap();
        check(&cell, &[&[0], &[1], &[2, 3, 4], &[5]]);
        // So it is with a contact that is allowed, which no proof is about.
        cell.allow_contact([Item::Link("tool"), Item::Obstacle("obstacle 2")])
            .unwrap();
        check(&cell, &[&[0], &[1], &[2, 3], &[4], &[5]]);
    }

    #[test]
    fn what_is_compared_with_nothing_is_no_body_of_a_proof() {
        let mut cell = cell();
        for number in 0..4 {
            cell.remove_obstacle(&format!("obstacle {number}")).unwrap();
        }
        let Ok(bodies) = resting_bodies(&cell, Never);
        assert!(bodies.unwrap().is_empty());
        // A proof about nothing would hold whatever the path.
        let error = ProvenCell::new(&cell).unwrap_err();
        assert!(
            matches!(error, CellNotProvable::NothingCompared(_)),
            "{error}"
        );
    }
}
