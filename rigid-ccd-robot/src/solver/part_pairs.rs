//! The broad phase: candidate pairs of parts.

use super::boxes::ObstacleBoxes;
use super::displacement::DisplacementBounds;
use super::placement::Placement;
use crate::cell::Cell;
use crate::cell::part::HullPart;
use rigid_ccd::glam::DVec3;

/// A pair of parts that may touch in an interval, and results of earlier tests.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PartPair {
    pub(crate) a: u32,
    pub(crate) b: u32,
    /// The indices of both parts' displacement bounds, relative to their nearest common ancestor frame.
    pub(crate) displacement_indices: [Option<u32>; 2],
    /// The distance at which the pair counts as touching.
    pub(crate) margin: f64,
    /// The direction from A to B of the best separation so far; zero if there was none.
    pub(crate) axis: DVec3,
    /// The distance at the midpoint of the last interval, divided by the distance that the pair needed to be proven free.
    pub(crate) distance_to_proof_ratio: f64,
}

/// All checked pairs of a cell's parts, and the search for those that come near each other.
pub(crate) struct PartPairs<'c> {
    cell: &'c Cell,
    obstacle_boxes: ObstacleBoxes,
    /// For each part of the robot, the index of the bound of its displacement relative to the base.
    displacement_index_by_part: Vec<Option<u32>>,
    /// The pairs of the robot's own parts.
    self_pairs: Vec<PartPair>,
    /// The pairs of bodies that are left out of the current question.
    pub(crate) ignored: Vec<[usize; 2]>,
    /// The margin of pairs without a clearance.
    margin: f64,
    /// A distance that is added to the margins of all pairs.
    margin_increase: f64,
    /// The largest margin of a pair with an obstacle.
    largest_obstacle_margin: f64,
}

impl PartPair {
    /// Creates a pair of two of the robot's own parts. Displacements are relative to their nearest common ancestor
    /// frame.
    pub(crate) fn of_robot(
        cell: &Cell,
        displacements: &DisplacementBounds,
        parts: [usize; 2],
    ) -> Self {
        let kinematics = cell.kinematics();
        // A static part comes second, as an obstacle does.
        let [a, b] = parts;
        let is_static = |part: usize| cell.parts()[part].frame == 0;
        let parts = if is_static(a) { [b, a] } else { [a, b] };
        let frame = kinematics.common_frame(parts.map(|part| cell.parts()[part].frame));
        let indices =
            parts.map(|part| displacements.bound_index_seen_from(kinematics, part, frame));
        PartPair::new(parts, indices, 0.0)
    }

    fn new([a, b]: [usize; 2], indices: [Option<u32>; 2], margin: f64) -> Self {
        PartPair {
            a: a as u32,
            b: b as u32,
            displacement_indices: indices,
            margin,
            axis: DVec3::ZERO,
            distance_to_proof_ratio: 0.0,
        }
    }

    /// Returns an upper bound of the relative displacement of both parts from the interval's midpoint.
    #[inline(always)]
    pub(crate) fn displacement(&self, placement: &Placement) -> f64 {
        let [a, b] = self
            .displacement_indices
            .map(|index| placement.displacement_bounds.bound(index));
        a + b
    }

    /// Returns whether both parts are exactly their bodies.
    pub(crate) fn is_convex(&self, parts: &[HullPart]) -> bool {
        let mut both = [self.a, self.b].into_iter();
        both.all(|part| parts[part as usize].is_convex)
    }

    /// Returns the indices in the cell of the bodies that the parts belong to.
    pub(crate) fn body_indices(&self, parts: &[HullPart]) -> [usize; 2] {
        [self.a, self.b].map(|part| parts[part as usize].owner)
    }
}

impl<'c> PartPairs<'c> {
    pub(crate) fn new(cell: &'c Cell, displacements: &DisplacementBounds) -> Self {
        let own = cell
            .checked_robot_part_pairs()
            .map(|parts| PartPair::of_robot(cell, displacements, parts));
        let robot_parts = 0..cell.robot_part_count();
        let mut pairs = PartPairs {
            displacement_index_by_part: robot_parts
                .map(|part| displacements.bound_index_seen_from_base(part))
                .collect(),
            obstacle_boxes: ObstacleBoxes::new(&cell.parts()[cell.robot_part_count()..]),
            self_pairs: own.collect(),
            ignored: Vec::new(),
            cell,
            margin: 0.0,
            margin_increase: 0.0,
            largest_obstacle_margin: 0.0,
        };
        pairs.update_margins();
        pairs
    }

    /// Returns the checked pairs of the robot's own parts.
    pub(crate) fn self_pairs(&self) -> &[PartPair] {
        &self.self_pairs
    }

    /// Returns whether a pair of bodies is left out of the current question.
    #[inline(always)]
    pub(crate) fn is_ignored(&self, bodies: [usize; 2]) -> bool {
        !self.ignored.is_empty() && self.ignored.contains(&bodies)
    }

    /// Returns an upper bound of the margins of all pairs with an obstacle.
    pub(crate) fn largest_obstacle_margin(&self) -> f64 {
        self.largest_obstacle_margin
    }

    /// Returns the margin of a pair of a body of the robot and an obstacle.
    #[inline(always)]
    pub(crate) fn obstacle_margin(&self, bodies: [usize; 2]) -> f64 {
        self.cell.margin(bodies, self.margin) + self.margin_increase
    }

    /// Returns the pair of a moving part of the robot and a part of an obstacle, by their indices in the cell.
    pub(crate) fn pair_with_obstacle(&self, [a, b]: [usize; 2]) -> PartPair {
        let index = self.displacement_index_by_part[a];
        let bodies = [a, b].map(|part| self.cell.parts()[part].owner);
        PartPair::new([a, b], [index, None], self.obstacle_margin(bodies))
    }

    /// Returns the number of all pairs, checked or not.
    pub(crate) fn count(&self) -> usize {
        let robot_parts = self.cell.robot_part_count();
        self.self_pairs.len() + robot_parts * (self.cell.parts().len() - robot_parts)
    }

    /// Sets the margin of pairs without a clearance.
    pub(crate) fn set_margin(&mut self, margin: f64) {
        self.margin = margin;
        self.update_margins();
    }

    /// Sets the distance that is added to the margins of all pairs, replacing the previous one.
    pub(crate) fn set_margin_increase(&mut self, growth: f64) {
        self.margin_increase = growth;
        self.update_margins();
    }

    /// Returns the distance that is added to the margins of all pairs because of pose errors.
    pub(crate) fn margin_increase(&self) -> f64 {
        self.margin_increase
    }

    fn update_margins(&mut self) {
        let (cell, margin, growth) = (self.cell, self.margin, self.margin_increase);
        self.largest_obstacle_margin = cell.largest_obstacle_margin(margin) + growth;
        for pair in &mut self.self_pairs {
            pair.margin = cell.margin(pair.body_indices(cell.parts()), margin) + growth;
        }
    }

    /// Appends the pairs whose bounding boxes may come within margin + `allowance` in the current interval, and all
    /// pairs of the robot's own parts.
    #[inline(always)]
    pub(crate) fn append_candidates(
        &self,
        placement: &Placement,
        allowance: f64,
        pairs: &mut Vec<PartPair>,
    ) {
        let (cell, parts) = (self.cell, self.cell.parts());
        let robot_parts = cell.robot_part_count();
        for (a, part) in parts[..robot_parts].iter().enumerate() {
            if part.frame == 0 {
                continue;
            }
            let index = placement.displacement_bounds.bound_index_seen_from_base(a);
            let displacement = placement.displacement_bounds.bound(index);
            let frame = &placement.frames[part.frame];
            let growth = displacement + self.largest_obstacle_margin + allowance;
            let extents = part.box_half_extents(frame) + DVec3::splat(growth);
            let center = frame.transform_point(part.center);
            self.obstacle_boxes
                .for_each_meeting(center - extents, center + extents, |obstacle| {
                    let b = robot_parts + obstacle;
                    let bodies = [part.owner, parts[b].owner];
                    if cell.is_allowed(bodies) || self.is_ignored(bodies) {
                        return;
                    }
                    let margin = self.obstacle_margin(bodies);
                    pairs.push(PartPair::new([a, b], [index, None], margin));
                });
        }
        let own = self.self_pairs.iter().copied();
        pairs.extend(own.filter(|pair| !self.is_ignored(pair.body_indices(parts))));
    }

    /// Appends all pairs of parts of two bodies, with the given margin.
    pub(crate) fn append_pairs_of_bodies(
        &self,
        placement: &Placement,
        bodies: [usize; 2],
        margin: f64,
        pairs: &mut Vec<PartPair>,
    ) {
        let (cell, parts) = (self.cell, self.cell.parts());
        let of_robot = self.self_pairs.iter();
        let of_robot = of_robot.filter(|pair| pair.body_indices(parts) == bodies);
        pairs.extend(of_robot.map(|pair| PartPair { margin, ..*pair }));
        if bodies[1] < cell.robot_body_count() {
            return;
        }
        let parts_of = |body: usize| {
            let first = parts.partition_point(|part| part.owner < body);
            first..parts.partition_point(|part| part.owner <= body)
        };
        for a in parts_of(bodies[0]) {
            let index = placement.displacement_bounds.bound_index_seen_from_base(a);
            let with_obstacle = parts_of(bodies[1]);
            pairs.extend(with_obstacle.map(|b| PartPair::new([a, b], [index, None], margin)));
        }
    }
}

/// Sorts pairs by their distance ratios, the nearest first.
pub(crate) fn sort_by_proof_distance(pairs: &mut [PartPair]) {
    pairs.sort_unstable_by(|a, b| {
        a.distance_to_proof_ratio
            .total_cmp(&b.distance_to_proof_ratio)
    });
}
