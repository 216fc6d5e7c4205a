//! Implements CONTACT: continuous overlap tests of oriented boxes by interval arithmetic \[CONTACT02\].

mod boxes;
mod clock;
mod elementary;
mod leaf;
mod relative;
#[cfg(test)]
mod tests;

use super::RivalMotion;
use super::obb_tree::{ObbTree, trees_intersect};
use super::patience::WorkLimit;
use super::resolution::resolution;
use super::screw::to_screw_motions;
use super::tree::{OpenedPair, open_pair};
use crate::method::solver::{ContactClaim, Reply, Solver};
use boxes::motion_spread_unless_separated;
use ccd_core::order::{greater, lesser};
use ccd_decomp::TriangleMesh;
use ccd_tables::motions::Motions;
use clock::{HalvedInterval, MotionEncloser};
use elementary::{TrianglePair, TriangleWithNormals};
use leaf::{FirstTouch, first_touch};
use relative::RelativeMotion;

/// The ratio of the motion's spread to the larger box's half length above which an interval of time is halved. The
/// spread is the radius of the enclosure of a corner's position over the interval. Otherwise the boxes are opened.
///
/// Values from 0.1 to 2 were measured; this one is the fastest, on knots of 2,880 and 11,520
/// triangles and a bunny of 26,000.
const MAX_RELATIVE_MOTION_SPREAD: f64 = 0.2;

/// Finds the first contact of two triangle meshes that move by [screw motions](super::to_screw_motions()) between the
/// start and end poses of their given motions.
///
/// # Guarantee
/// Except for rounding, no contact of the screw motions is missed or reported late. At the reported
/// time the surfaces are within about the tolerance. Surfaces that cross at the start touch at time
/// 0. A surface inside another one that it does not touch is free.
///
/// # Source
/// \[CONTACT02\] on \[OBBTREE96\]. The paper leaves open, and here is chosen: time is halved while
/// the enclosure of the motion is wide against the larger box, and otherwise the larger box is
/// opened first. The frame is that of the body that turns less. The motions of both bodies are
/// enclosed separately and multiplied. The elementary tests of two triangles share the halving of
/// time. The roots of monotone contact functions are found by signs and false position. The method
/// assumes that surfaces do not cross at the start; a static test checks it.
#[derive(Clone, Debug)]
pub struct Contact {
    trees: [ObbTree; 2],
    work_limit: WorkLimit,
    pair_stack: Vec<NodePair>,
    intersection_stack: Vec<(u32, u32)>,
}

/// The limits on the work of one query, which let it run for some seconds. A step is a halving of time: surfaces that
/// slide past each other at a distance g are only separated over intervals in which they move by about g.
const WORK_LIMIT: WorkLimit = WorkLimit {
    max_steps: 1 << 22,
    max_pairs: 1 << 24,
};

/// A pair of nodes, one of each tree, over an interval of time.
#[derive(Clone, Copy, Debug)]
struct NodePair {
    nodes: [u32; 2],
    interval: HalvedInterval,
}

impl Contact {
    /// Builds the trees of both meshes.
    pub fn new(a: &TriangleMesh, b: &TriangleMesh) -> Self {
        Contact {
            trees: [a, b].map(ObbTree::new),
            work_limit: WORK_LIMIT,
            pair_stack: Vec::new(),
            intersection_stack: Vec::new(),
        }
    }

    /// Finds the first contact along exactly the given motions, which need not be screws.
    fn first_contact(&mut self, query: &Motions, tolerance: f64) -> Reply {
        let courses = [RivalMotion::new(&query.a), RivalMotion::new(&query.b)];
        let resolution = resolution(&courses, &self.trees, tolerance);
        let [a, b] = &self.trees;
        let start = courses[0].placement_relative_to(&courses[1], 0.0);
        if trees_intersect(a, b, &start, &mut self.intersection_stack) {
            let claim = ContactClaim::Contact { time: 0.0 };
            return Reply::new(claim, 0);
        }
        // A body that does not rotate encloses the other's motion in its frame without loss.
        let order = if courses[0].angular_speed < courses[1].angular_speed {
            [1, 0]
        } else {
            [0, 1]
        };
        let [first, second] = order.map(|k| (&courses[k], self.trees[k].origin));
        let relative = RelativeMotion::new(first, second);
        let mut search = ContactSearch {
            trees: order.map(|k| &self.trees[k]),
            motion_encloser: MotionEncloser::new(relative, resolution, self.work_limit.max_steps),
            max_pairs: self.work_limit.max_pairs,
            stack: &mut self.pair_stack,
            search_end: query.duration,
        };
        let claim = search.run();
        Reply::new(claim, search.motion_encloser.halving_count)
    }
}

impl Solver for Contact {
    /// Answers a query; the reply counts halvings of time as steps.
    fn answer(&mut self, query: &Motions, tolerance: f64) -> Reply {
        match to_screw_motions(query) {
            Ok(query) => self.first_contact(&query, tolerance),
            Err(_) => Reply::new(ContactClaim::Unresolved { safe_until: 0.0 }, 0),
        }
    }
}

/// A depth-first search of both trees and of the halves of time, for one query.
struct ContactSearch<'a> {
    trees: [&'a ObbTree; 2],
    motion_encloser: MotionEncloser,
    max_pairs: u64,
    stack: &'a mut Vec<NodePair>,
    /// The end of the time to search: the earliest contact found so far, or else the duration.
    search_end: f64,
}

impl ContactSearch<'_> {
    fn run(&mut self) -> ContactClaim {
        let mut found = None;
        let interval = HalvedInterval::whole_duration(self.search_end);
        let nodes = [0, 0];
        self.stack.clear();
        self.stack.push(NodePair { nodes, interval });
        for _ in 0..self.max_pairs {
            let Some(mut pair) = self.stack.pop() else {
                return found.map_or(ContactClaim::NoContact, |time| ContactClaim::Contact {
                    time,
                });
            };
            let ahead = pair.interval.span.start < self.search_end;
            if !ahead && found.is_some() {
                continue;
            }
            pair.interval.span.end = lesser(pair.interval.span.end, self.search_end);
            if self.motion_encloser.is_at_halving_limit() {
                self.stack.push(pair);
                break;
            }
            match self.settle_or_split_pair(pair) {
                FirstTouch::AtTime(time) => {
                    self.search_end = time;
                    found = Some(time);
                }
                FirstTouch::NotInInterval => {}
                FirstTouch::LimitReached => {
                    self.stack.push(pair);
                    break;
                }
            }
        }
        let starts = self.stack.iter().map(|pair| pair.interval.span.start);
        ContactClaim::Unresolved {
            safe_until: starts.fold(self.search_end, lesser),
        }
    }

    /// Examines a pair: drops it if its boxes stay apart, pushes halves or children onto the stack, or tests its two
    /// triangles.
    fn settle_or_split_pair(&mut self, pair: NodePair) -> FirstTouch {
        let NodePair { nodes, interval } = pair;
        let a = self.trees[0].node(nodes[0]);
        let b = self.trees[1].node(nodes[1]);
        let enclosure = self.motion_encloser.placement_enclosure(interval);
        let Some(spread) = motion_spread_unless_separated(&a.bounds, &b.bounds, enclosure) else {
            return FirstTouch::NotInInterval;
        };
        let size = [a, b].map(|node| node.bounds.half_extents.max_element());
        let wide = spread > MAX_RELATIVE_MOTION_SPREAD * greater(size[0], size[1]);
        if wide && !self.motion_encloser.is_too_short_to_halve(interval) {
            self.motion_encloser.halving_count += 1;
            let [early, late] = interval.halves();
            self.stack
                .extend([late, early].map(|interval| NodePair { nodes, interval }));
            return FirstTouch::NotInInterval;
        }
        let open = match open_pair([a.content, b.content], size) {
            OpenedPair::Triangles(leaves) => return self.first_touch_of_leaves(leaves, interval),
            OpenedPair::ChildrenOfA(children) => children.map(|child| [child, nodes[1]]),
            OpenedPair::ChildrenOfB(children) => children.map(|child| [nodes[0], child]),
        };
        self.stack
            .extend(open.map(|nodes| NodePair { nodes, interval }));
        FirstTouch::NotInInterval
    }

    fn first_touch_of_leaves(&mut self, [p, q]: [u32; 2], interval: HalvedInterval) -> FirstTouch {
        let triangles = TrianglePair {
            a: TriangleWithNormals::new(self.trees[0].triangle(p)),
            b: TriangleWithNormals::new(self.trees[1].triangle(q)),
        };
        first_touch(&triangles, interval, &mut self.motion_encloser)
    }
}
