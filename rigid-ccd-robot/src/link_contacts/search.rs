//! The search for proofs about one pair of links after another.

use super::joint_box::JointBox;
use super::{AXIS_CONTACT_DISTANCE, LinkContactClass};
use crate::cell::Cell;
use crate::solver::measure::{DistanceVerdict, Thresholds, measure};
use crate::solver::part_pairs::PartPair;
use crate::solver::placement::Placement;
use crate::solver::violation::are_convex_parts_nearer;
use crate::tuning::JOINT_AXIS_INTERVALS;
use ccd_core::order::greater;
use rigid_ccd::{Body, Error, Outcome, Pose, Solver};
use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// Memory for searches about pairs of links.
pub(super) struct PairSearch<'c> {
    cell: &'c Cell,
    placement: Placement,
    solver: Solver,
}

/// What is known of a box after a look at its middle.
struct BoxExamination {
    /// Whether the links are apart over the whole box.
    is_free: bool,
    /// Whether they overlap over the whole box.
    overlaps: bool,
    /// Whether they touch in the middle; `None` if rounding hides it.
    touches_in_middle: Option<bool>,
}

/// A box that waits to be examined; the largest comes first.
struct WaitingBox(JointBox);

impl<'c> PairSearch<'c> {
    pub(super) fn new(cell: &'c Cell) -> Self {
        PairSearch {
            cell,
            placement: Placement::new(cell),
            solver: Solver::new(),
        }
    }

    /// Decides about a pair of links, with at most `max_boxes` looks.
    pub(super) fn decide(
        &mut self,
        links: [usize; 2],
        max_boxes: usize,
    ) -> Result<LinkContactClass, Error> {
        let (mut touching, mut apart, mut share) = (None, None, 0.0);
        let undecided = |share, touching, apart| LinkContactClass::Undecided {
            proven_apart_share: share,
            touching_configuration: touching,
            apart_configuration: apart,
        };
        let Some(all) = JointBox::of_joints_between(self.cell, links) else {
            return Ok(undecided(0.0, None, None));
        };
        if self.meet_on_hinge(links, &all)? {
            return Ok(LinkContactClass::Always);
        }
        let weights = self.weights();
        let is_rigid = self.cell.robot().are_rigidly_connected(links[0], links[1]);
        let mut waiting = BinaryHeap::from([WaitingBox(all)]);
        let mut pairs = self.part_pairs(links);
        for _ in 0..max_boxes {
            let Some(WaitingBox(joint_box)) = waiting.pop() else {
                break;
            };
            let look = self.examine_box(&joint_box, &mut pairs)?;
            match look.touches_in_middle {
                Some(true) if is_rigid => return Ok(LinkContactClass::Always),
                Some(true) => touching = touching.or_else(|| Some(joint_box.middle())),
                Some(false) => apart = apart.or_else(|| Some(joint_box.middle())),
                None => {}
            }
            if let (Some(touching), Some(apart)) = (&touching, &apart) {
                return Ok(LinkContactClass::Sometimes {
                    touching_configuration: Vec::clone(touching),
                    apart_configuration: Vec::clone(apart),
                });
            }
            if look.is_free {
                share += joint_box.volume_share;
            } else if look.overlaps {
                // Nothing is left to examine in the box.
            } else if let Some(halves) = joint_box.halves(&weights) {
                waiting.extend(halves.map(WaitingBox));
            } else {
                return Ok(undecided(share, touching, apart));
            }
        }
        // Of boxes that are all decided, none is free if one overlaps: both would have witnesses.
        Ok(match touching {
            None if waiting.is_empty() => LinkContactClass::Never,
            Some(_) if waiting.is_empty() => LinkContactClass::Always,
            touching => undecided(share, touching, apart),
        })
    }

    /// Returns whether one joint that turns is between two links, with a point on its axis that both links hold. That point
    /// rests in both frames.
    fn meet_on_hinge(&mut self, links: [usize; 2], all: &JointBox) -> Result<bool, Error> {
        let (cell, kinematics) = (self.cell, self.cell.kinematics());
        let between = cell.robot().chain_between(links[0], links[1]);
        let joints = between.joint_numbers().iter();
        let moving: Vec<usize> = joints
            .filter_map(|&joint| kinematics.moving_joint_index(joint))
            .collect();
        let &[number] = &*moving else {
            return Ok(false);
        };
        let joint = &kinematics.joints()[number];
        if joint.is_prismatic {
            return Ok(false);
        }
        self.placement.place_joint_box(cell, &all.middle(), |_| 0.0);
        let point = Body::sphere(AXIS_CONTACT_DISTANCE)?;
        let parts = cell.parts()[..cell.robot_part_count()].iter();
        let own = parts.filter(|part| links.contains(&cell.link_of(part.owner)));
        let reach = own
            .map(|part| part.centre.length() + part.ball_radius)
            .fold(0.0, greater);
        for k in 0..=JOINT_AXIS_INTERVALS {
            let along = reach * (2.0 * f64::from(k) / f64::from(JOINT_AXIS_INTERVALS) - 1.0);
            let parent = self.placement.frames[joint.parent];
            let at = Pose::at(parent.transform_point(joint.origin + along * joint.axis))?;
            if self.link_touches(links[0], (&point, at))?
                && self.link_touches(links[1], (&point, at))?
            {
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// Returns whether a body of a link touches another body.
    fn link_touches(&mut self, link: usize, other: (&Body, Pose)) -> Result<bool, Error> {
        for number in 0..self.cell.robot_body_count() {
            if self.cell.link_of(number) == link {
                let body = self.placed_body(number)?;
                // A proof is about the shapes.
                if self.solver.distance(body, other)?.outcome.upper() <= 0.0 {
                    return Ok(true);
                }
            }
        }
        Ok(false)
    }

    /// Measures both links in the middle of a box, against how far they move within it.
    fn examine_box(
        &mut self,
        joint_box: &JointBox,
        pairs: &mut [PartPair],
    ) -> Result<BoxExamination, Error> {
        let middle = joint_box.middle();
        let deviation = |source| joint_box.max_deviation(source);
        self.placement
            .place_joint_box(self.cell, &middle, deviation);
        let mut look = BoxExamination {
            is_free: true,
            overlaps: false,
            touches_in_middle: Some(false),
        };
        for pair in pairs {
            let thresholds = Thresholds {
                free_distance_threshold: 0.0,
                near_distance: 0.0,
            };
            let found = measure(self.cell, &self.placement, pair, thresholds, false);
            if matches!(found, DistanceVerdict::Free) {
                continue;
            }
            // The engine measures the bodies themselves; frames become poses with an error like their own.
            let rounding = 4.0 * self.placement.rounding;
            let [a, b] = pair.body_numbers(self.cell.parts());
            let (a, b) = (self.placed_body(a)?, self.placed_body(b)?);
            let outcome = self.solver.distance(a, b)?.outcome;
            if touch_as_they_are(&outcome, [a.0, b.0]) {
                look.touches_in_middle = Some(true);
            } else if !(outcome.lower() > rounding) && look.touches_in_middle == Some(false) {
                look.touches_in_middle = None;
            }
            // Written so that NaN is not free.
            if !(outcome.lower() > pair.displacement(&self.placement) + rounding) {
                look.is_free = false;
            }
            if look.touches_in_middle == Some(true) {
                look.is_free = false;
                let (cell, placement) = (self.cell, &self.placement);
                let depth = pair.displacement(placement) + rounding;
                look.overlaps = pair.is_convex(cell.parts())
                    && are_convex_parts_nearer(cell, placement, pair, -depth);
                break;
            }
        }
        Ok(look)
    }

    fn placed_body(&self, number: usize) -> Result<(&'c Body, Pose), Error> {
        self.placement.body(self.cell, number)
    }

    /// Returns all pairs of parts of two links.
    fn part_pairs(&self, [one, other]: [usize; 2]) -> Vec<PartPair> {
        let (cell, parts) = (self.cell, self.cell.parts());
        let parts_of = |link: usize| {
            let all = (0..cell.robot_part_count())
                .filter(move |&part| cell.link_of(parts[part].owner) == link);
            all.collect::<Vec<usize>>()
        };
        let mut pairs = Vec::new();
        for &a in &parts_of(one) {
            for &b in &parts_of(other) {
                let displacements = &self.placement.displacement_bounds;
                pairs.push(PartPair::of_robot(cell, displacements, [a, b]));
            }
        }
        pairs
    }

    /// Returns for each joint of a configuration about how far its unit of position moves things.
    fn weights(&self) -> Vec<f64> {
        let mut weights = vec![0.0; self.cell.robot().limits().len()];
        for joint in self.cell.kinematics().joints() {
            let effect = joint.source.factor().abs() * if joint.is_prismatic { 2.0 } else { 1.0 };
            let number = joint.source.position_index();
            weights[number] = greater(weights[number], effect);
        }
        weights
    }
}

impl PartialEq for WaitingBox {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for WaitingBox {}

impl PartialOrd for WaitingBox {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for WaitingBox {
    fn cmp(&self, other: &Self) -> Ordering {
        self.0.volume_share.total_cmp(&other.0.volume_share)
    }
}

/// Returns whether two bodies touch, up to rounding. The upper bound of a distance is of the shapes that they enclose: it includes
/// what they exceed these by.
fn touch_as_they_are(outcome: &Outcome, bodies: [&Body; 2]) -> bool {
    let excess: f64 = bodies.iter().map(|body| body.excess()).sum();
    outcome.upper() <= excess * (1.0 + 4.0 * f64::EPSILON)
}
