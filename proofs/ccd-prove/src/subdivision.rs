//! Builds the steps of a proof: splits tree nodes and intervals of time until a cheap leaf proves each pair of nodes apart.

use crate::error::NotProven;
use crate::interval::{LinkState, PairInterval, link_states};
use crate::link_motion::LinkMotion;
use crate::scene::Scene;
use crate::separating_plane::PlaneSearch;
use crate::step::Step;
use crate::stop::{Stop, Stopped};
use crate::tree::{NodeIndex, Tree};
use ccd_core::glam::DVec3;
use ccd_distance_gjk::{TerminationBounds, Vertex, bound_distance};
use std::collections::HashMap;
use std::rc::Rc;
use std::sync::atomic::AtomicBool;

/// The maximum number of bytes of the steps.
const MAX_BYTES: usize = 1 << 26;

/// The maximum number of splits between a pair's root and any leaf.
const MAX_DEPTH: u32 = 200;

/// The shortest interval that is split, as a fraction of the whole time. The checker's times are multiples of 2⁻⁶⁰.
const MIN_INTERVAL: f64 = 1e-15;

/// The interval is not split if the relative displacement of both nodes is below this fraction of the larger node's radius.
const MIN_DISPLACEMENT: f64 = 0.1;

/// The cost of checking a leaf with a ball, without its visits to boxes. The unit of all costs is a visit to one box.
const BALL_COST: usize = 15;

/// The cost of checking a leaf with a plane, without its visits to boxes.
const PLANE_COST: usize = 35;

/// The cost of computing the state of one link for one interval.
const LINK_COST: usize = 40;

/// A task with a leaf of at most this cost is not split in search of cheaper leaves.
const CHEAP_LEAF_COST: usize = 30;

/// The estimated cost of checking a task that no leaf proves yet.
const UNPROVEN_COST: usize = 800;

/// The maximum number of link states in the cache, which take about 100 MB. The cached pair intervals take up to 150 MB more. The
/// checker's cache has the same maximum.
pub(crate) const MAX_CACHED_STATES: usize = 1 << 19;

/// Writes the steps of a proof. The leaves cover all pairs of triangles at all times.
pub(crate) struct Subdivision<'a> {
    scene: &'a Scene<'a>,
    link_motions: &'a [LinkMotion],
    limits: SubdivisionLimits<'a>,
    /// The unit of length of the certificate.
    length_unit: f64,
    /// The index of the current pair.
    pair: usize,
    /// The required distance of either node of the current pair from a separating plane: half of the margin plus a rounding error bound.
    required_gap: f64,
    /// The motion of the current pair in each interval. The key is the bits of the interval's start and end.
    pair_intervals: HashMap<[u64; 2], Rc<PairInterval<'a>>>,
    /// The states of all links in each interval. All pairs use them.
    link_states: HashMap<[u64; 2], Vec<LinkState>>,
    pub(crate) steps: Vec<u8>,
    pub(crate) leaf_count: usize,
}

/// The end time of a proof, and the limits of the work on it.
#[derive(Clone, Copy)]
pub(crate) struct SubdivisionLimits<'a> {
    /// The time until which the pairs are proven apart.
    pub(crate) until: f64,
    /// The flag with which another thread stops the work.
    pub(crate) stop: Option<&'a AtomicBool>,
    /// The number of link states above which the cache is emptied.
    pub(crate) max_cached_states: usize,
}

/// Two tree nodes to prove apart over an interval of time.
#[derive(Clone)]
struct Task<'a> {
    nodes: [NodeIndex; 2],
    interval: Rc<PairInterval<'a>>,
    /// The best separating axis known for these nodes. A new task starts with the axis of the task that it was split from.
    axis: DVec3,
    /// The number of splits above this task.
    depth: u32,
    /// The result of the search for a leaf, or `None` before the search. The result is `None` if no leaf proves the task.
    leaf_search: Option<Option<Leaf>>,
}

/// A leaf that proves a task, and its checking cost.
#[derive(Clone, Copy)]
struct Leaf {
    cost: usize,
    kind: LeafKind,
}

#[derive(Clone, Copy)]
enum LeafKind {
    /// The bounding ball of the node of a body: 0 is A, 1 is B.
    Ball(usize),
    /// A plane perpendicular to the axis of the task.
    Plane,
}

/// A split of a task, and the tasks that replace it.
struct Split<'a> {
    step: Step,
    /// The cost of checking the split itself.
    cost: usize,
    tasks: Vec<Task<'a>>,
}

impl<'a> Subdivision<'a> {
    pub(crate) fn new(
        (scene, link_motions): (&'a Scene<'a>, &'a [LinkMotion]),
        limits: SubdivisionLimits<'a>,
        length_unit: f64,
    ) -> Self {
        Subdivision {
            scene,
            link_motions,
            limits,
            length_unit,
            pair: 0,
            required_gap: 0.0,
            pair_intervals: HashMap::new(),
            link_states: HashMap::new(),
            steps: Vec::new(),
            leaf_count: 0,
        }
    }

    /// Writes the steps that prove a pair farther apart than twice `required_gap`.
    pub(crate) fn write_pair(&mut self, pair: usize, required_gap: f64) -> Result<(), NotProven> {
        (self.pair, self.required_gap) = (pair, required_gap);
        self.pair_intervals.clear();
        let interval = self.pair_interval([0.0, self.limits.until]);
        let axis = interval.center_offset;
        self.prove_task(Task {
            nodes: [Tree::ROOT; 2],
            interval,
            axis,
            depth: 0,
            leaf_search: None,
        })
    }

    /// Returns the motion of the current pair over an interval of time. Uses the cache if possible.
    fn pair_interval(&mut self, times: [f64; 2]) -> Rc<PairInterval<'a>> {
        let key = times.map(f64::to_bits);
        if let Some(interval) = self.pair_intervals.get(&key) {
            return Rc::clone(interval);
        }
        if self.cached_states() > self.limits.max_cached_states {
            self.link_states.clear();
            self.pair_intervals.clear();
        }
        let ([start, end], motions) = (times, self.link_motions);
        let states = self
            .link_states
            .entry(key)
            .or_insert_with(|| link_states(motions, 0.5 * (start + end), 0.5 * (end - start)));
        let interval = PairInterval::new((self.scene, motions), self.pair, (times, states));
        let interval = Rc::new(interval);
        self.pair_intervals.insert(key, Rc::clone(&interval));
        interval
    }

    /// Returns the number of link states in the cache.
    pub(crate) fn cached_states(&self) -> usize {
        self.link_states.len() * self.link_motions.len()
    }

    /// Writes the steps that prove a task: a leaf, or a split and the steps of its tasks.
    fn prove_task(&mut self, mut task: Task<'a>) -> Result<(), NotProven> {
        let at = task.interval.start;
        if task.depth > MAX_DEPTH || self.steps.len() > MAX_BYTES {
            let bytes = self.steps.len();
            return Err(NotProven::TooLong { at, bytes });
        }
        if let Some(flag) = self.limits.stop {
            flag.check().map_err(|Stopped| NotProven::Stopped { at })?;
        }
        let leaf = self.find_leaf(&mut task);
        let leaf_cost = leaf.map_or(usize::MAX, |leaf| leaf.cost);
        let mut best: (usize, Option<Split<'a>>) = (leaf_cost, None);
        if leaf_cost > CHEAP_LEAF_COST {
            // If a leaf proves the task, a split with an unproven task is no alternative.
            let unproven_cost = if leaf.is_some() {
                usize::MAX
            } else {
                UNPROVEN_COST
            };
            for mut split in self.splits(&task) {
                let cost = self.cost_of_split(&mut split, unproven_cost);
                if cost < best.0 {
                    best = (cost, Some(split));
                }
            }
        }
        let Some(split) = best.1 else {
            let leaf = leaf.ok_or(NotProven::Touching { at })?;
            return self.write_leaf(&task, leaf.kind);
        };
        self.steps.push(split.step.opcode());
        split
            .tasks
            .into_iter()
            .try_for_each(|task| self.prove_task(task))
    }

    fn write_leaf(&mut self, task: &Task<'a>, kind: LeafKind) -> Result<(), NotProven> {
        match kind {
            LeafKind::Ball(k) => self.steps.push(Step::Ball(k).opcode()),
            LeafKind::Plane => {
                let (axis, _) = separating_axis_at_middle(task);
                let plane = self.plane_search(task).cheapest_plane([task.axis, axis]);
                let at = task.interval.start;
                let plane = plane.ok_or(NotProven::Touching { at })?;
                plane.write(&mut self.steps);
            }
        }
        self.leaf_count += 1;
        Ok(())
    }

    /// Returns the cost of checking a split and its tasks. A task without a leaf costs `unproven_cost`.
    fn cost_of_split(&self, split: &mut Split<'a>, unproven_cost: usize) -> usize {
        let tasks = split.tasks.iter_mut();
        let costs = tasks.map(|task| self.find_leaf(task).map_or(unproven_cost, |leaf| leaf.cost));
        costs.fold(split.cost, usize::saturating_add)
    }

    /// Returns the possible splits of a task. The most promising split comes first.
    fn splits(&mut self, task: &Task<'a>) -> Vec<Split<'a>> {
        let (interval, nodes) = (&task.interval, task.nodes);
        let radii = [0, 1].map(|k| interval.trees[k].radius(nodes[k]));
        let larger = usize::from(radii[1] > radii[0]);
        let displacement = interval.relative_displacement(nodes);
        let is_within_max_angle = interval.is_within_max_angle();
        let time = (displacement > MIN_DISPLACEMENT * radii[larger] || !is_within_max_angle)
            .then(|| self.split_time(task))
            .flatten();
        if !is_within_max_angle {
            return time.into_iter().collect();
        }
        let node_splits = [larger, 1 - larger]
            .into_iter()
            .filter_map(|body| split_node(task, body));
        if displacement > radii[larger] {
            time.into_iter().chain(node_splits).collect()
        } else {
            node_splits.chain(time).collect()
        }
    }

    /// Splits a task at the middle of its interval. Returns `None` if the interval is too short.
    fn split_time(&mut self, task: &Task<'a>) -> Option<Split<'a>> {
        let PairInterval { start, end, .. } = *task.interval;
        let middle = 0.5 * (start + end);
        if end - start <= MIN_INTERVAL * self.limits.until {
            return None;
        }
        let halves = [[start, middle], [middle, end]];
        let needs_link_states = !self.link_states.contains_key(&halves[0].map(f64::to_bits));
        let tasks = halves.map(|times| Task {
            interval: self.pair_interval(times),
            ..task.child()
        });
        Some(Split {
            step: Step::SplitTime,
            cost: if needs_link_states {
                2 * LINK_COST * self.link_motions.len()
            } else {
                0
            },
            tasks: tasks.into(),
        })
    }

    fn plane_search<'t>(&self, task: &'t Task<'a>) -> PlaneSearch<'t> {
        PlaneSearch {
            nodes: task.nodes,
            interval: &task.interval,
            required_gap: self.required_gap,
            length_unit: self.length_unit,
        }
    }

    /// Finds the cheapest leaf that proves a task: a leaf with a ball, or a leaf with a plane perpendicular to the task's axis. If
    /// that plane does not separate the nodes, the task gets the best separating axis at the middle of the interval.
    fn find_leaf(&self, task: &mut Task<'a>) -> Option<Leaf> {
        if let Some(leaf) = task.leaf_search {
            return leaf;
        }
        let gap = 2.0 * self.required_gap;
        let ball = [0, 1].into_iter().filter_map(|k| {
            let cost = BALL_COST + task.interval.ball_visits(task.nodes, k, gap)?;
            let kind = LeafKind::Ball(k);
            Some(Leaf { cost, kind })
        });
        let mut leaf = ball.min_by_key(|leaf| leaf.cost);
        if leaf.is_none_or(|leaf| leaf.cost > PLANE_COST) {
            let mut visits = self.plane_search(task).visits_along(task.axis);
            if visits.is_none() {
                let (axis, distance) = separating_axis_at_middle(task);
                if axis != task.axis && distance > gap {
                    visits = self.plane_search(task).visits_along(axis);
                }
                task.axis = axis;
            }
            let cost = visits.map(|visits| PLANE_COST + visits);
            let is_cheaper = |cost: &usize| leaf.is_none_or(|leaf| *cost < leaf.cost);
            if let Some(cost) = cost.filter(is_cheaper) {
                let kind = LeafKind::Plane;
                leaf = Some(Leaf { cost, kind });
            }
        }
        task.leaf_search = Some(leaf);
        leaf
    }
}

impl Task<'_> {
    /// Returns a copy with a depth greater by 1. The caller replaces its nodes or its interval.
    fn child(&self) -> Self {
        Task {
            depth: self.depth + 1,
            leaf_search: None,
            ..self.clone()
        }
    }
}

/// Splits the node of a body. Returns `None` if the node is a single triangle.
fn split_node<'a>(task: &Task<'a>, body: usize) -> Option<Split<'a>> {
    let tasks = task.interval.trees[body]
        .children(task.nodes[body])?
        .map(|child| {
            let mut nodes = task.nodes;
            nodes[body] = child;
            Task {
                nodes,
                ..task.child()
            }
        });
    Some(Split {
        step: Step::SplitNode(body),
        cost: 0,
        tasks: tasks.into(),
    })
}

/// Returns the axis along which the gap between the nodes is largest at the middle of the interval, and a lower bound of that gap.
fn separating_axis_at_middle(task: &Task<'_>) -> (DVec3, f64) {
    let ([a, b], interval) = (task.nodes, &task.interval);
    let support = |direction: DVec3| {
        let (a, point_a) = interval.support_vertex(0, a, -direction);
        let (b, point_b) = interval.support_vertex(1, b, direction);
        Vertex {
            point: point_b - point_a,
            a,
            b,
        }
    };
    let bounds = TerminationBounds {
        sufficient_lower_bound: f64::INFINITY,
        sufficient_upper_bound: 0.0,
    };
    let initial_axis = if task.axis == DVec3::ZERO {
        DVec3::X
    } else {
        task.axis
    };
    let closest = bound_distance(support, initial_axis, |found| bounds.are_met_by(found));
    (closest.axis.normalize_or_zero(), closest.lower)
}
