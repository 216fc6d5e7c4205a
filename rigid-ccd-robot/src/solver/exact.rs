//! Queries of the engine about two bodies: the first body moves relative to the second one, which is static.

use super::Goal;
use super::curved_link::{CurvedLink, PathSection};
use super::pair_chain::{PairChain, pair_chain};
use crate::cell::Cell;
use rigid_ccd::trajectory::{MovingBody, Trajectory};
use rigid_ccd::{Answer, Body, Error, Motion, Pose, Solver};
use std::collections::HashMap;

/// The joint chains that move one body relative to another, cached by pair.
pub(crate) struct PairChains<'c> {
    cell: &'c Cell,
    chains: HashMap<[usize; 2], PairChain>,
    /// Scratch memory: the positions of all joints at one end of a section.
    positions: Vec<f64>,
    /// Scratch memory: the positions of a chain's joints at both ends of a section.
    ends: [Vec<f64>; 2],
}

impl<'c> PairChains<'c> {
    pub(crate) fn new(cell: &'c Cell) -> Self {
        PairChains {
            cell,
            chains: HashMap::new(),
            positions: Vec::new(),
            ends: Default::default(),
        }
    }

    /// Creates the chains of all checked pairs.
    pub(crate) fn prepare(&mut self) {
        for (pair, _) in self.cell.compared_pairs(0.0) {
            chain(&mut self.chains, self.cell, pair);
        }
    }

    /// Asks a question about two bodies over a section of a path, which takes one unit of time.
    pub(crate) fn query(
        &mut self,
        solver: &mut Solver,
        goal: Goal,
        pair: [usize; 2],
        section: &PathSection<'_>,
    ) -> Result<Answer, Error> {
        self.with_trajectory(solver, pair, section, |solver, link, a, b| {
            query_solver(solver, goal, (a, link), b)
        })
    }

    /// Calls a function with the first body and its trajectory over a section of a path, and with the static second
    /// body. The section takes one unit of time.
    pub(crate) fn with_trajectory<T>(
        &mut self,
        solver: &mut Solver,
        pair: [usize; 2],
        section: &PathSection<'_>,
        then: impl FnOnce(&mut Solver, &dyn Trajectory, &Body, (&Body, Motion)) -> Result<T, Error>,
    ) -> Result<T, Error> {
        let (a, b) = self.bodies(pair);
        let own = chain(&mut self.chains, self.cell, pair);
        if !section.path.has_constant_rates() {
            let link = CurvedLink {
                pair_chain: own,
                section: *section,
            };
            return then(solver, &link, a, b);
        }
        for (at, in_chain) in section.ends().into_iter().zip(&mut self.ends) {
            let path = section.path;
            path.interpolate_in_segment(section.segment, at, &mut self.positions);
            let joints = own.moving_joint_indices.iter();
            in_chain.clear();
            in_chain.extend(joints.map(|joint| joint.map_or(0.0, |joint| self.positions[joint])));
        }
        let [from, to] = &self.ends;
        let link = own.chain.link(from.len(), from, to, 1.0)?;
        then(solver, &link, a, b)
    }

    /// Returns the first body of a pair, and the second body at its static pose in the frame of the first one's chain.
    pub(crate) fn bodies(&self, [a, b]: [usize; 2]) -> (&'c Body, (&'c Body, Motion)) {
        let (cell, bodies) = (self.cell, self.cell.bodies());
        let static_pose = Motion::still(if b >= cell.robot_body_count() {
            bodies[b].pose
        } else {
            Pose::IDENTITY
        });
        (&bodies[a].body, (&bodies[b].body, static_pose))
    }
}

/// Returns the chain of a pair, creating it on first use.
fn chain<'m>(
    chains: &'m mut HashMap<[usize; 2], PairChain>,
    cell: &Cell,
    [a, b]: [usize; 2],
) -> &'m PairChain {
    let is_obstacle = b >= cell.robot_body_count();
    // A body has the same chain relative to all obstacles.
    let key = if is_obstacle { [a, usize::MAX] } else { [a, b] };
    let make = || pair_chain(cell, a, (!is_obstacle).then_some(b));
    chains.entry(key).or_insert_with(make)
}

fn query_solver<'b>(
    solver: &mut Solver,
    goal: Goal,
    a: impl Into<MovingBody<'b>> + Copy,
    b: (&'b Body, Motion),
) -> Result<Answer, Error> {
    Ok(match goal {
        Goal::AnyContact => solver.any_contact(a, b, 1.0)?,
        Goal::FirstContact => solver.first_contact(a, b, 1.0)?,
        Goal::LeastDistance => solver.closest_approach(a, b, 1.0)?,
    })
}
