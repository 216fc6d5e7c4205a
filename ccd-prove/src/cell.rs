//! The bodies of a robot's cell as proofs take them, and the scene of an edge.

use crate::body::Body;
use crate::placed::moving;
use crate::scene::{AxisKind, Carried, Joint, Link, Pair, Scene, Witness};
use crate::write::mesh_points;
use ccd_core::{Motion, Pose};
use rigid_ccd::trajectory::JointKind;
use rigid_ccd_robot::{Cell, Item, PathContact, RobotError};

/// A cell whose bodies are prepared for proofs.
#[derive(Debug)]
pub struct ProvenCell<'c> {
    cell: &'c Cell,
    /// For each body of the cell its mesh, and the radius around it.
    bodies: Vec<(Body, f64)>,
}

impl<'c> ProvenCell<'c> {
    /// Prepares the bodies of a cell.
    ///
    /// # Errors
    /// The number of a body that has no triangles of a mesh.
    pub fn new(cell: &'c Cell) -> Result<Self, usize> {
        let bodies = cell.carried_bodies().enumerate();
        let bodies = bodies.map(|(number, carried)| Body::of(carried.body).ok_or(number));
        Ok(ProvenCell {
            cell,
            bodies: bodies.collect::<Result<_, _>>()?,
        })
    }

    /// Returns the meshes of the cell's bodies.
    pub fn meshes(&self) -> impl Iterator<Item = &Body> {
        self.bodies.iter().map(|(body, _)| body)
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
        for (link, parent, number) in robot.joints_parents_first() {
            let joint = &robot.joints()[number].axis_and_limits;
            let positions = [from[number], to[number]];
            scene.links.push(Link {
                parent: numbers[parent],
                joint: scene_joint(joint.kind(), *joint.origin(), positions),
            });
            numbers[link] = scene.links.len();
        }
        for (carried, (body, radius)) in self.cell.carried_bodies().zip(&self.bodies) {
            let mut link = numbers[carried.link];
            if carried.pose != Pose::IDENTITY {
                let joint = fixed(carried.pose);
                scene.links.push(Link {
                    parent: link,
                    joint,
                });
                link = scene.links.len();
            }
            scene.bodies.push(Carried {
                body,
                link,
                radius: *radius,
            });
        }
        let pairs = self.cell.compared_pairs(margin);
        scene.pairs = pairs
            .map(|(bodies, margin)| Pair { bodies, margin })
            .collect();
        Ok(scene)
    }

    /// Returns a contact of an edge as a witness in its scene: of the pairs of bodies that the contact may be of, the one whose
    /// meshes are nearest to its points. `None` if there is no such pair.
    pub fn witness(
        &self,
        scene: &Scene<'_>,
        contact: &PathContact<'_>,
        tolerance: f64,
    ) -> Option<Witness> {
        let items: Vec<Item<'_>> = self.cell.carried_bodies().map(|body| body.item).collect();
        let links = moving(&scene.links);
        let [a, b] = contact.witnesses;
        let all = scene.pairs.iter().enumerate();
        let candidates = all.filter_map(|(pair, Pair { bodies, .. })| {
            let points = match bodies.map(|body| items[body]) {
                of_pair if of_pair == contact.items => [a, b],
                [y, x] if [x, y] == contact.items => [b, a],
                _ => return None,
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
