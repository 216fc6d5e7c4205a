//! Merges bodies of a cell that are static relative to each other into one body of a proof.

use crate::body::{Body, triangles_of};
use crate::error::NoMesh;
use crate::stop::Stop;
use crate::tolerances::POSE_ERROR;
use ccd_core::Pose;
use ccd_core::glam::{DVec3, DVec4};
use rigid_ccd::trajectory::JointKind;
use rigid_ccd_robot::{AttachedBody, Cell, Robot};
use std::collections::BTreeMap;

/// One body of a cell, or several bodies that are static relative to each other and are compared with the same other bodies.
#[derive(Debug)]
pub(crate) struct RigidGroup {
    /// The indices of the cell's bodies.
    pub(crate) members: Vec<usize>,
    /// The index of the robot's link to which the group is attached.
    pub(crate) link: usize,
    /// The pose on the link. It is the identity for several bodies, because their merged vertices are in the frame of the link.
    pub(crate) pose: Pose,
    /// The merged mesh.
    pub(crate) body: Body,
}

/// The key of a group: the static root of its bodies, and the pairs of each body. A pair is given by the index of the other body, and by
/// the bits of the required distances for the margins 0 and 1.
type GroupKey = (usize, Vec<[u64; 3]>);

/// Returns the groups of all bodies of a cell that are in a pair. Two bodies of one group are never compared with each other: as no
/// body is compared with itself, their keys would differ.
///
/// # Errors
/// [`NoMesh`].
pub(crate) fn rigid_groups<S: Stop>(
    cell: &Cell,
    stop: S,
) -> Result<Result<Vec<RigidGroup>, NoMesh>, S::Stopped> {
    let roots = static_roots(cell.robot());
    let mut partners = vec![Vec::new(); cell.carried_bodies().len()];
    // A padding is added to the margin, and a clearance replaces it. The distances for two margins distinguish both.
    for (([a, b], distance_at_0), (_, distance_at_1)) in
        cell.compared_pairs(0.0).zip(cell.compared_pairs(1.0))
    {
        for (body, partner) in [(a, b), (b, a)] {
            partners[body].push([
                partner as u64,
                distance_at_0.to_bits(),
                distance_at_1.to_bits(),
            ]);
        }
    }
    let mut members: BTreeMap<GroupKey, Vec<Member<'_>>> = BTreeMap::new();
    for ((index, carried), partners) in cell.carried_bodies().enumerate().zip(partners) {
        if partners.is_empty() {
            continue;
        }
        stop.check()?;
        let Some(triangles) = triangles_of(carried.body) else {
            let body = carried.item.name().into();
            return Ok(Err(NoMesh { body }));
        };
        let root = roots[carried.link].link;
        let member = Member {
            index,
            carried,
            triangles,
        };
        members.entry((root, partners)).or_default().push(member);
    }
    let mut groups: Vec<RigidGroup> = members
        .into_iter()
        .map(|((root, _), members)| merge(root, members, &roots, stop))
        .collect::<Result<_, _>>()?;
    groups.sort_by_key(|group| group.members[0]);
    Ok(Ok(groups))
}

/// A body of a cell, and the triangles of its mesh.
struct Member<'c> {
    index: usize,
    carried: AttachedBody<'c>,
    triangles: Vec<[DVec4; 3]>,
}

/// The static root of a link: the link itself, or its nearest ancestor, whose joint is not fixed.
#[derive(Clone)]
struct StaticRoot {
    link: usize,
    /// The poses from the link to the root, in the order in which they are applied.
    poses: Vec<Pose>,
}

/// Returns the static root of each link.
fn static_roots(robot: &Robot) -> Vec<StaticRoot> {
    let mut roots: Vec<StaticRoot> = (0..robot.links().len())
        .map(|link| StaticRoot {
            link,
            poses: Vec::new(),
        })
        .collect();
    for (link, parent, joint_index) in robot.joints_parents_first() {
        let joint = &robot.joints()[joint_index].geometry;
        if matches!(joint.kind(), JointKind::Fixed) {
            let mut root = roots[parent].clone();
            root.poses.insert(0, *joint.origin());
            roots[link] = root;
        }
    }
    roots
}

/// Merges the members of a group into one body.
fn merge<S: Stop>(
    root: usize,
    mut members: Vec<Member<'_>>,
    roots: &[StaticRoot],
    stop: S,
) -> Result<RigidGroup, S::Stopped> {
    let indices = members.iter().map(|member| member.index).collect();
    if members.len() == 1 {
        let Member {
            carried, triangles, ..
        } = members.remove(0);
        return Ok(RigidGroup {
            members: indices,
            link: carried.link,
            pose: carried.pose,
            body: Body::of_triangles(&triangles, stop)?,
        });
    }
    let mut merged = Vec::new();
    for Member {
        carried, triangles, ..
    } in members
    {
        let poses = || {
            [&carried.pose]
                .into_iter()
                .chain(&roots[carried.link].poses)
        };
        let to_root = |corner| poses().fold(corner, transform_ball);
        merged.extend(triangles.into_iter().map(|corners| corners.map(to_root)));
    }
    Ok(RigidGroup {
        members: indices,
        link: root,
        pose: Pose::IDENTITY,
        body: Body::of_triangles(&merged, stop)?,
    })
}

/// Transforms a ball by a pose. Enlarges its radius by the error bound of the center.
fn transform_ball(ball: DVec4, pose: &Pose) -> DVec4 {
    if *pose == Pose::IDENTITY {
        return ball;
    }
    let (center, translation): (DVec3, _) = (ball.truncate(), pose.translation());
    // The sum of the absolute coordinates bounds a length, and does not underflow as squares do.
    let lengths = center.abs().element_sum() + translation.abs().element_sum();
    let error = POSE_ERROR * lengths + f64::MIN_POSITIVE;
    let transformed = pose.transform_point(center);
    transformed.extend((ball.w + error).next_up())
}

#[cfg(test)]
mod tests;
