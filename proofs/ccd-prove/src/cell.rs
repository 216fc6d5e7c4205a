//! The bodies of a robot's cell as proofs take them, and the scene of an edge.

use crate::body::Body;
use crate::error::{CellNotProvable, NotProven, PathNotProven};
use crate::placed::moving;
use crate::positions::{ImpossiblePosition, check_positions};
use crate::resting::{Resting, resting_bodies};
use crate::scene::{AxisKind, Carried, Joint, Link, Pair, Scene, Witness};
use crate::statement::Statement;
use crate::stop::{Never, Stop};
use crate::write::{Proof, mesh_points, prove_unless_stopped, statement_of};
use ccd_core::{Motion, Pose};
use rigid_ccd::Settings;
use rigid_ccd::trajectory::JointKind;
use rigid_ccd_robot::{Cell, Item, PathAnswer, PathContact, PathOutcome, RobotError};
use std::collections::HashMap;
use std::sync::atomic::AtomicBool;

/// A cell whose bodies are prepared for proofs.
///
/// Bodies that rest against each other, such as all obstacles, are one body of a proof if they are compared with the same others.
/// Its mesh has the corners of all of them in the frame of the link that carries them, rounded to binary64, each with a ball around
/// it that is larger by what the corner may be off. So a proof about it is one about each of them.
#[derive(Debug)]
pub struct ProvenCell<'c> {
    cell: &'c Cell,
    bodies: Vec<Resting>,
    /// The links that carry them, each with the one that carries it and the number of its joint; those that carry others first.
    links: Vec<(usize, usize, usize)>,
}

impl<'c> ProvenCell<'c> {
    /// Prepares the bodies of a cell.
    ///
    /// # Errors
    /// [`CellNotProvable`], with the name of an obstacle, a held body or a link, or if no pair is compared.
    pub fn new(cell: &'c Cell) -> Result<Self, CellNotProvable> {
        let Ok(proven) = ProvenCell::prepare(cell, Never);
        proven
    }

    /// Prepares the bodies of a cell as [`new`](Self::new) does; `None` soon after another thread sets a flag.
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
        if let Err(nothing) = cell.check_any_compared() {
            return Ok(Err(nothing.into()));
        }
        let bodies = resting_bodies(cell, stop)?;
        Ok(bodies.map_or_else(
            |error| Err(error.into()),
            |bodies| Ok(ProvenCell::of_bodies(cell, bodies)),
        ))
    }

    fn of_bodies(cell: &'c Cell, bodies: Vec<Resting>) -> Self {
        let mut links = cell.robot().joints_parents_first();
        let mut carries = vec![false; cell.robot().links().len()];
        for resting in &bodies {
            carries[resting.link] = true;
        }
        for (link, parent, _) in links.iter().rev() {
            carries[*parent] |= carries[*link];
        }
        links.retain(|(link, ..)| carries[*link]);
        ProvenCell {
            cell,
            bodies,
            links,
        }
    }

    /// Returns the cell.
    pub fn cell(&self) -> &'c Cell {
        self.cell
    }

    /// Returns the meshes of the cell's bodies.
    pub fn meshes(&self) -> impl Iterator<Item = &Body> {
        self.bodies.iter().map(|resting| &resting.body)
    }

    /// Returns the scene of an edge, whose joints move from one configuration to another at constant rates from time 0 to 1.
    ///
    /// # Errors
    /// [`RobotError::WrongPositionCount`].
    pub fn edge(&self, from: &[f64], to: &[f64], margin: f64) -> Result<Scene<'_>, RobotError> {
        let robot = self.cell.robot();
        let [from, to] = [robot.joint_positions(from)?, robot.joint_positions(to)?];
        let mut scene = Scene::default();
        // The number in the scene of each link of the robot; that of the base is the world.
        let mut numbers = vec![0; robot.links().len()];
        for &(link, parent, number) in &self.links {
            let joint = &robot.joints()[number].geometry;
            let positions = [from[number], to[number]];
            scene.links.push(Link {
                parent: numbers[parent],
                joint: scene_joint(joint.kind(), *joint.origin(), positions),
            });
            numbers[link] = scene.links.len();
        }
        for Resting {
            link, pose, body, ..
        } in &self.bodies
        {
            let mut link = numbers[*link];
            if *pose != Pose::IDENTITY {
                let joint = fixed(*pose);
                scene.links.push(Link {
                    parent: link,
                    joint,
                });
                link = scene.links.len();
            }
            scene.bodies.push(Carried { body, link });
        }
        scene.pairs = self.pairs(margin);
        Ok(scene)
    }

    /// Returns the positions at times 0 and 1 that a statement gives to the joints that move its bodies; `None` if the statement is not
    /// about all pairs of this cell with a margin.
    pub fn joints_of(&self, statement: &Statement, margin: f64) -> Option<Vec<(&str, [f64; 2])>> {
        let robot = self.cell.robot();
        let still = vec![0.0; robot.free_joint_names().len()];
        let own = statement_of(&self.edge(&still, &still, margin).ok()?, 0.0)?;
        let scales = own.scales(statement)?;
        let links = statement.links.iter().zip(scales).zip(&self.links);
        let joints = links.filter(|((stated, _), _)| stated.axes > 0);
        let positions = joints.map(|((stated, scale), (.., number))| {
            let positions = [stated.start, stated.start + stated.rate].map(|by| by * scale);
            (&*robot.joints()[*number].name, positions)
        });
        Some(positions.collect())
    }

    /// Says whether joints may be at positions that a statement gives them, as [`ProvenCell::joints_of`] returns them: within their
    /// limits, and as the rules of those that follow others say.
    ///
    /// # Errors
    /// [`ImpossiblePosition`], with the first joint that may not.
    pub fn check_positions(&self, joints: &[(&str, [f64; 2])]) -> Result<(), ImpossiblePosition> {
        check_positions(self.cell.robot(), joints)
    }

    /// Returns what a proof of an edge states, until its end; `None` if no certificate can state it, as its numbers are too small.
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

    /// Returns the pairs of bodies that are compared: those of the first ones of what rests stand for all.
    fn pairs(&self, margin: f64) -> Vec<Pair> {
        let firsts = self.bodies.iter().enumerate();
        let firsts: HashMap<usize, usize> = firsts
            .map(|(number, resting)| (resting.members[0], number))
            .collect();
        let pairs = self.cell.compared_pairs(margin);
        let number = |body| firsts.get(&body).copied();
        let of_firsts = pairs.filter_map(|([a, b], margin)| {
            let bodies = [number(a)?, number(b)?];
            Some(Pair { bodies, margin })
        });
        of_firsts.collect()
    }

    /// Proves what is known of a path: for each segment that all pairs of the cell are farther apart than the margin, up to the
    /// first contact, and two points that are near each other there. A segment at whose start bodies touch, or one is in another, is
    /// left out, unless their surfaces are apart there by less than the tolerance.
    ///
    /// `answer` is that about the first contact.
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

    /// Proves what is known of a path as [`prove_path`](Self::prove_path) does, one segment after another: each proof is made when
    /// it is asked for. The first error is the last item.
    pub fn path_proofs<'p, C: AsRef<[f64]>>(
        &'p self,
        path: &'p [C],
        answer: &'p PathAnswer<'_>,
        settings: &'p Settings,
    ) -> impl Iterator<Item = Result<Proof, PathNotProven>> + 'p {
        let is_of_first_contact = answer.is_free_until_contact();
        let refused = (!is_of_first_contact).then_some(Err(PathNotProven::NoFirstContact));
        let is_free = matches!(answer.outcome, PathOutcome::Free);
        let end = (!is_free).then_some(answer.free_until);
        let last = end.map_or(usize::MAX, |end| end.segment);
        let segments = path.windows(2).enumerate();
        let proofs = segments
            .take_while(move |(segment, _)| *segment <= last)
            .map_while(move |(segment, ends)| {
                let ends = [ends[0].as_ref(), ends[1].as_ref()];
                let share = end.filter(|end| end.segment == segment);
                let share = share.map_or(1.0, |end| end.share);
                self.prove_segment((segment, ends), share, answer, settings)
                    .transpose()
            });
        let mut has_failed = false;
        let proofs = refused.into_iter().chain(proofs);
        proofs.take_while(move |proof| !std::mem::replace(&mut has_failed, proof.is_err()))
    }

    /// Proves what is known of a segment up to a share of it; `None` if bodies touch at its start.
    fn prove_segment(
        &self,
        (segment, [from, to]): (usize, [&[f64]; 2]),
        share: f64,
        answer: &PathAnswer<'_>,
        settings: &Settings,
    ) -> Result<Option<Proof>, PathNotProven> {
        let scene = self.edge(from, to, settings.margin)?;
        let contact = match &answer.outcome {
            PathOutcome::Contact(contact) if contact.at.segment == segment => Some(contact),
            _ => None,
        };
        let witness = contact.and_then(|contact| self.witness(&scene, contact, settings.tolerance));
        match prove_unless_stopped(&scene, share, witness, settings.stop.as_deref()) {
            Ok(proof) => Ok(Some(proof)),
            Err(NotProven::Touching { .. } | NotProven::NoContact { .. }) if share == 0.0 => {
                Ok(None)
            }
            Err(reason) => Err(PathNotProven::Segment { segment, reason }),
        }
    }

    /// Returns a contact of an edge as a witness in its scene: of the pairs of bodies that the contact may be of, the one whose
    /// meshes are nearest to its points. `None` if there is no such pair, or if a deadline has left the contact without points.
    fn witness(
        &self,
        scene: &Scene<'_>,
        contact: &PathContact<'_>,
        tolerance: f64,
    ) -> Option<Witness> {
        let items: Vec<Item<'_>> = self.cell.carried_bodies().map(|body| body.item).collect();
        let has = |body: usize, item: Item<'_>| {
            let mut members = self.bodies[body].members.iter();
            members.any(|&member| items[member] == item)
        };
        let links = moving(&scene.links, 0).ok()?;
        let ([a, b], [x, y]) = (contact.witnesses?, contact.items);
        let all = scene.pairs.iter().enumerate();
        let candidates = all.filter_map(|(pair, Pair { bodies: [k, l], .. })| {
            let points = if has(*k, x) && has(*l, y) {
                [a, b]
            } else if has(*k, y) && has(*l, x) {
                [b, a]
            } else {
                return None;
            };
            let witness = Witness {
                pair,
                time: contact.at.share,
                tolerance,
                points,
            };
            let [on_a, on_b] = mesh_points(scene, &links, witness);
            Some((on_a.distance + on_b.distance, witness))
        });
        let nearest = candidates.min_by(|a, b| a.0.total_cmp(&b.0));
        nearest.map(|(_, witness)| witness)
    }
}

fn scene_joint(kind: JointKind, pose: Pose, [start, end]: [f64; 2]) -> Joint {
    let (kind, axis) = match kind {
        JointKind::Fixed => return fixed(pose),
        JointKind::Revolute(axis) => (AxisKind::Turns, axis),
        JointKind::Prismatic(axis) => (AxisKind::Slides, axis),
    };
    Joint::Axis {
        kind,
        pose,
        axis,
        start,
        rate: end - start,
    }
}

fn fixed(pose: Pose) -> Joint {
    Joint::Free(Motion::still(pose))
}
