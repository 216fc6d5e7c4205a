//! Pairs of bodies as the engine takes them: a body with the trajectory of its link, against another one at rest.

use super::Question;
use crate::cell::Cell;
use rigid_ccd::trajectory::{Chain, Joint};
use rigid_ccd::{Answer, Error, Motion, Pose, Solver};
use std::collections::HashMap;

/// The chains of joints by which one body moves as another one sees it. Each is made when it is needed first.
pub(crate) struct PairChains<'c> {
    cell: &'c Cell,
    chains: HashMap<[usize; 2], PairChain>,
    from: Vec<f64>,
    to: Vec<f64>,
}

struct PairChain {
    chain: Chain,
    /// For each joint of the chain, the number of the moving joint; `None` for a fixed one.
    moving_joint_numbers: Vec<Option<usize>>,
}

impl<'c> PairChains<'c> {
    pub(crate) fn new(cell: &'c Cell) -> Self {
        PairChains {
            cell,
            chains: HashMap::new(),
            from: Vec::new(),
            to: Vec::new(),
        }
    }

    /// Asks a question about two bodies while all moving joints go from their positions in `from` to those in `to`.
    pub(crate) fn ask(
        &mut self,
        solver: &mut Solver,
        question: Question,
        pair: [usize; 2],
        from: &[f64],
        to: &[f64],
    ) -> Result<Answer, Error> {
        let cell = self.cell;
        let [a, b] = pair;
        let is_obstacle = b >= cell.robot_body_count();
        // All obstacles see a body move by the same chain.
        let key = if is_obstacle { [a, usize::MAX] } else { pair };
        let PairChain {
            chain,
            moving_joint_numbers: moving,
        } = self
            .chains
            .entry(key)
            .or_insert_with(|| pair_chain(cell, a, (!is_obstacle).then_some(b)));
        for (all, own) in [(from, &mut self.from), (to, &mut self.to)] {
            own.clear();
            own.extend(
                moving
                    .iter()
                    .map(|joint| joint.map_or(0.0, |joint| all[joint])),
            );
        }
        let link = chain.link(moving.len(), &self.from, &self.to, 1.0)?;
        let bodies = cell.bodies();
        let rests = Motion::still(if is_obstacle {
            bodies[b].pose
        } else {
            Pose::IDENTITY
        });
        let (a, b) = ((&*bodies[a].body, &link), (&*bodies[b].body, rests));
        Ok(match question {
            Question::AnyContact => solver.any_contact(a, b, 1.0)?,
            Question::FirstContact => solver.first_contact(a, b, 1.0)?,
            Question::ClosestApproach => solver.closest_approach(a, b, 1.0)?,
        })
    }
}

/// Makes the chain from a body of another link, or from the base, to a body of a link.
fn pair_chain(cell: &Cell, a: usize, b: Option<usize>) -> PairChain {
    let (robot, kinematics) = (cell.robot(), cell.kinematics());
    let seen_from = b.map_or(robot.base(), |b| cell.link_of(b));
    let between = robot.chain_between(seen_from, cell.link_of(a));
    let mut joints = Vec::new();
    let mut moving = Vec::new();
    if let Some(b) = b {
        joints.push(Joint::fixed(cell.pose_in_link(b)).reversed());
        moving.push(None);
    }
    // Configurations are checked already; positions within an edge are rounded.
    let unlimited = |joint: &Joint| joint.clone().with_limits(f64::NEG_INFINITY..=f64::INFINITY);
    joints.extend(between.chain().joints().iter().map(unlimited));
    let numbers = between.joint_numbers().iter();
    moving.extend(numbers.map(|&joint| kinematics.moving_joint_index(joint)));
    joints.push(Joint::fixed(cell.pose_in_link(a)));
    moving.push(None);
    PairChain {
        chain: Chain::new(Pose::IDENTITY, joints),
        moving_joint_numbers: moving,
    }
}
