//! Proofs of answers about paths of a robot in a cell.

use crate::body::Body;
use crate::error::{CellNotProvable, NotProven, PathNotProven};
use crate::link_motion::link_motions;
use crate::positions::{ImpossiblePosition, check_positions};
use crate::rigid_groups::{RigidGroup, rigid_groups};
use crate::scene::{AxisKind, Joint, Link, Pair, Scene, SceneBody, Witness};
use crate::statement::Statement;
use crate::stop::{Never, Stop};
use crate::write::{Proof, nearest_mesh_points, prove_unless_stopped, statement_of};
use ccd_core::{Motion, Pose};
use rigid_ccd::Settings;
use rigid_ccd::trajectory::JointKind;
use rigid_ccd_robot::{Cell, Item, PathAnswer, PathContact, PathOutcome, RobotError};
use std::collections::HashMap;
use std::sync::atomic::AtomicBool;

/// A robot's cell whose bodies are prepared for proofs.
///
/// Bodies that are static relative to each other are merged into one body, for example all obstacles. A condition is that all of them
/// are compared with the same other bodies. The vertices of the merged mesh are in the frame of the common link, rounded to binary64.
/// The radius of each vertex grows by the rounding error, so a proof about the merged mesh holds for each of its bodies.
#[derive(Debug)]
pub struct ProvenCell<'c> {
    cell: &'c Cell,
    groups: Vec<RigidGroup>,
    /// The links whose motion moves a body, each with its parent and the index of its joint. Parents come first.
    links: Vec<(usize, usize, usize)>,
}

impl<'c> ProvenCell<'c> {
    /// Prepares the bodies of a cell.
    ///
    /// # Errors
    /// [`CellNotProvable`] if no pair is compared, or if a body has no mesh. The error then names the obstacle, the attached body or
    /// the link.
    pub fn new(cell: &'c Cell) -> Result<Self, CellNotProvable> {
        let Ok(proven) = ProvenCell::prepare(cell, Never);
        proven
    }

    /// Prepares the bodies of a cell as [`new`](Self::new) does. Returns `None` soon after another thread sets the flag `stop`.
    pub fn unless_stopped(
        cell: &'c Cell,
        stop: &AtomicBool,
    ) -> Option<Result<Self, CellNotProvable>> {
        ProvenCell::prepare(cell, stop).ok()
    }

    fn prepare<S: Stop>(
        cell: &'c Cell,
        stop: S,
    ) -> Result<Result<Self, CellNotProvable>, S::Stopped> {
        if let Err(error) = cell.check_any_compared() {
            return Ok(Err(error.into()));
        }
        let groups = rigid_groups(cell, stop)?;
        Ok(groups.map_or_else(
            |error| Err(error.into()),
            |groups| Ok(ProvenCell::from_groups(cell, groups)),
        ))
    }

    fn from_groups(cell: &'c Cell, groups: Vec<RigidGroup>) -> Self {
        let mut links = cell.robot().joints_parents_first();
        let mut moves_body = vec![false; cell.robot().links().len()];
        for group in &groups {
            moves_body[group.link] = true;
        }
        for (link, parent, _) in links.iter().rev() {
            moves_body[*parent] |= moves_body[*link];
        }
        links.retain(|(link, ..)| moves_body[*link]);
        ProvenCell {
            cell,
            groups,
            links,
        }
    }

    /// Returns the cell.
    pub fn cell(&self) -> &'c Cell {
        self.cell
    }

    /// Returns the meshes of a proof. Each is the mesh of one body, or the merged mesh of several bodies.
    pub fn meshes(&self) -> impl Iterator<Item = &Body> {
        self.groups.iter().map(|group| &group.body)
    }

    /// Returns the scene of an edge. All joints move at constant rates, from the first configuration at time 0 to the second one at
    /// time 1.
    ///
    /// # Errors
    /// [`RobotError::WrongPositionCount`].
    pub fn edge(&self, from: &[f64], to: &[f64], margin: f64) -> Result<Scene<'_>, RobotError> {
        let robot = self.cell.robot();
        let [from, to] = [robot.joint_positions(from)?, robot.joint_positions(to)?];
        let mut scene = Scene::default();
        // For each link of the robot its index in the scene. The base is the world.
        let mut scene_links = vec![0; robot.links().len()];
        for &(link, parent, joint_index) in &self.links {
            let joint = &robot.joints()[joint_index].geometry;
            let positions = [from[joint_index], to[joint_index]];
            scene.links.push(Link {
                parent: scene_links[parent],
                joint: scene_joint(joint.kind(), *joint.origin(), positions),
            });
            scene_links[link] = scene.links.len();
        }
        for RigidGroup {
            link, pose, body, ..
        } in &self.groups
        {
            let mut link = scene_links[*link];
            if *pose != Pose::IDENTITY {
                let joint = fixed_joint(*pose);
                scene.links.push(Link {
                    parent: link,
                    joint,
                });
                link = scene.links.len();
            }
            scene.bodies.push(SceneBody { body, link });
        }
        scene.pairs = self.pairs(margin);
        Ok(scene)
    }

    /// Returns the names of the joints in a statement, and their positions at times 0 and 1. Returns `None` if the statement is not
    /// about all pairs of this cell with this margin.
    pub fn joints_of(&self, statement: &Statement, margin: f64) -> Option<Vec<(&str, [f64; 2])>> {
        let robot = self.cell.robot();
        let zeros = vec![0.0; robot.independent_joint_names().len()];
        let cell_statement = statement_of(&self.edge(&zeros, &zeros, margin).ok()?, 0.0)?;
        let scales = cell_statement.scales(statement)?;
        let links = statement.links.iter().zip(scales).zip(&self.links);
        let joints = links.filter(|((link, _), _)| link.axes > 0);
        let positions = joints.map(|((link, scale), (.., joint_index))| {
            let positions = [link.start, link.start + link.rate].map(|s| s * scale);
            (&*robot.joints()[*joint_index].name, positions)
        });
        Some(positions.collect())
    }

    /// Checks that the robot can have the joint positions that [`ProvenCell::joints_of`] returns. They have to be within the joint
    /// limits, and a mimic joint has to agree with its rule.
    ///
    /// # Errors
    /// [`ImpossiblePosition`] with the first joint whose position is impossible.
    pub fn check_positions(&self, joints: &[(&str, [f64; 2])]) -> Result<(), ImpossiblePosition> {
        check_positions(self.cell.robot(), joints)
    }

    /// Returns the statement that all pairs stay apart on a whole edge. Returns `None` if a number is too small for a certificate.
    ///
    /// # Errors
    /// [`RobotError::WrongPositionCount`].
    pub fn statement(
        &self,
        [from, to]: [&[f64]; 2],
        margin: f64,
    ) -> Result<Option<Statement>, RobotError> {
        Ok(statement_of(&self.edge(from, to, margin)?, 1.0))
    }

    /// Returns the compared pairs of groups. All members of a group have the same pairs, so only the first members are considered.
    fn pairs(&self, margin: f64) -> Vec<Pair> {
        let groups = self.groups.iter().enumerate();
        let by_first_member: HashMap<usize, usize> = groups
            .map(|(index, group)| (group.members[0], index))
            .collect();
        let pairs = self.cell.compared_pairs(margin);
        let group_of = |body| by_first_member.get(&body).copied();
        let group_pairs = pairs.filter_map(|([a, b], margin)| {
            let bodies = [group_of(a)?, group_of(b)?];
            Some(Pair { bodies, margin })
        });
        group_pairs.collect()
    }

    /// Proves the answer about the first contact on a path, with one proof for each segment up to the contact.
    ///
    /// The statement of a proof is that all pairs of the cell stay farther apart than the margin. The last proof also has the contact as
    /// a witness. A segment has no proof if bodies are in contact at its start, unless their surfaces can be proven apart there.
    ///
    /// # Errors
    /// [`PathNotProven`].
    pub fn prove_path<C: AsRef<[f64]>>(
        &self,
        path: &[C],
        answer: &PathAnswer<'_>,
        settings: &Settings,
    ) -> Result<Vec<Proof>, PathNotProven> {
        self.path_proofs(path, answer, settings).collect()
    }

    /// Returns an iterator over the proofs of [`prove_path`](Self::prove_path), which computes each proof when it is reached. The
    /// iterator ends after the first error.
    pub fn path_proofs<'p, C: AsRef<[f64]>>(
        &'p self,
        path: &'p [C],
        answer: &'p PathAnswer<'_>,
        settings: &'p Settings,
    ) -> impl Iterator<Item = Result<Proof, PathNotProven>> + 'p {
        let is_of_first_contact = answer.is_free_until_contact();
        let wrong_question = (!is_of_first_contact).then_some(Err(PathNotProven::NoFirstContact));
        let is_free = matches!(answer.outcome, PathOutcome::Free);
        let end = (!is_free).then_some(answer.free_until);
        let last = end.map_or(usize::MAX, |end| end.segment);
        let segments = path.windows(2).enumerate();
        let proofs = segments
            .take_while(move |(segment, _)| *segment <= last)
            .map_while(move |(segment, ends)| {
                let ends = [ends[0].as_ref(), ends[1].as_ref()];
                let fraction = end.filter(|end| end.segment == segment);
                let fraction = fraction.map_or(1.0, |end| end.fraction);
                self.prove_segment((segment, ends), fraction, answer, settings)
                    .transpose()
            });
        let mut has_failed = false;
        let proofs = wrong_question.into_iter().chain(proofs);
        proofs.take_while(move |proof| !std::mem::replace(&mut has_failed, proof.is_err()))
    }

    /// Proves a segment of a path from its start to a fraction of its length. Returns `None` if bodies are in contact at the start.
    fn prove_segment(
        &self,
        (segment, [from, to]): (usize, [&[f64]; 2]),
        fraction: f64,
        answer: &PathAnswer<'_>,
        settings: &Settings,
    ) -> Result<Option<Proof>, PathNotProven> {
        let scene = self.edge(from, to, settings.margin)?;
        let contact = match &answer.outcome {
            PathOutcome::Contact(contact) if contact.at.segment == segment => Some(contact),
            _ => None,
        };
        let witness = contact.and_then(|contact| self.witness(&scene, contact, settings.tolerance));
        match prove_unless_stopped(&scene, fraction, witness, settings.stop.as_deref()) {
            Ok(proof) => Ok(Some(proof)),
            Err(NotProven::Touching { .. } | NotProven::NoContact { .. }) if fraction == 0.0 => {
                Ok(None)
            }
            Err(reason) => Err(PathNotProven::Segment { segment, reason }),
        }
    }

    /// Returns the witness of a contact. Several pairs of the scene may consist of the contact's links or obstacles. The witness then
    /// belongs to the pair whose meshes are nearest to the contact's points. Returns `None` if there is no such pair, or if the contact
    /// has no points because of a deadline.
    fn witness(
        &self,
        scene: &Scene<'_>,
        contact: &PathContact<'_>,
        tolerance: f64,
    ) -> Option<Witness> {
        let items: Vec<Item<'_>> = self.cell.carried_bodies().map(|body| body.item).collect();
        let contains = |body: usize, item: Item<'_>| {
            let mut members = self.groups[body].members.iter();
            members.any(|&member| items[member] == item)
        };
        let links = link_motions(&scene.links, 0).ok()?;
        let ([a, b], [x, y]) = (contact.witnesses?, contact.items);
        let pairs = scene.pairs.iter().enumerate();
        let candidates = pairs.filter_map(|(pair, Pair { bodies: [k, l], .. })| {
            let points = if contains(*k, x) && contains(*l, y) {
                [a, b]
            } else if contains(*k, y) && contains(*l, x) {
                [b, a]
            } else {
                return None;
            };
            let witness = Witness {
                pair,
                time: contact.at.fraction,
                tolerance,
                points,
            };
            let [on_a, on_b] = nearest_mesh_points(scene, &links, witness);
            Some((on_a.distance + on_b.distance, witness))
        });
        let nearest = candidates.min_by(|a, b| a.0.total_cmp(&b.0));
        nearest.map(|(_, witness)| witness)
    }
}

/// Returns a joint of the robot as a joint of a scene. It moves from the position `start` to `end` in time 1.
fn scene_joint(kind: JointKind, pose: Pose, [start, end]: [f64; 2]) -> Joint {
    let (kind, axis) = match kind {
        JointKind::Fixed => return fixed_joint(pose),
        JointKind::Revolute(axis) => (AxisKind::Revolute, axis),
        JointKind::Prismatic(axis) => (AxisKind::Prismatic, axis),
    };
    Joint::Axis {
        kind,
        pose,
        axis,
        start,
        rate: end - start,
    }
}

fn fixed_joint(pose: Pose) -> Joint {
    Joint::Free(Motion::still(pose))
}
