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

/// One body of a cell, or several bodies that are static relative to each other and have the same pairs.
#[derive(Debug)]
pub(crate) struct RigidGroup {
    /// The indices of the cell's bodies.
    pub(crate) members: Vec<usize>,
    /// The index of the robot's link that carries the group.
    pub(crate) link: usize,
    /// The pose on the link. It is the identity for several bodies, whose vertices are in the frame of the link.
    pub(crate) pose: Pose,
    /// The merged mesh.
    pub(crate) body: Body,
}

/// The key of a group: the link that its bodies are static on, and the pairs of each body. A pair has the other body, and the bits of
/// the required distance at margins 0 and 1.
type GroupKey = (usize, Vec<[u64; 3]>);

/// Groups the bodies of a cell that are in at least one pair. Two bodies of one group are never compared with each other. Their
/// keys would differ, as no body is compared with itself.
///
/// # Errors
/// [`NoMesh`].
pub(crate) fn rigid_groups<S: Stop>(
    cell: &Cell,
    stop: S,
) -> Result<Result<Vec<RigidGroup>, NoMesh>, S::Stopped> {
    let roots = static_roots(cell.robot());
    let mut partners = vec![Vec::new(); cell.carried_bodies().len()];
    // The distances at two margins distinguish a padding, which is added to the margin, from a clearance, which replaces it.
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

/// The static root of a link: its nearest ancestor, or the link itself, that is not on a fixed joint.
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
    let mut all = Vec::new();
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
        all.extend(triangles.into_iter().map(|corners| corners.map(to_root)));
    }
    Ok(RigidGroup {
        members: indices,
        link: root,
        pose: Pose::IDENTITY,
        body: Body::of_triangles(&all, stop)?,
    })
}

/// Transforms a ball by a pose, and grows its radius by the error bound of the center.
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
