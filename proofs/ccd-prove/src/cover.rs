//! Builds the steps of a proof: splits parts and intervals of time until a cheap leaf proves each pair of parts apart.

use crate::error::NotProven;
use crate::interval::{LinkState, PairInterval, link_states};
use crate::link_motion::LinkMotion;
use crate::scene::Scene;
use crate::separating_plane::PlaneSearch;
use crate::step::Step;
use crate::tree::{Part, Tree};
use ccd_core::glam::DVec3;
use ccd_distance_gjk::{TerminationBounds, Vertex, bound_distance};
use std::collections::HashMap;
use std::rc::Rc;
use std::sync::atomic::{AtomicBool, Ordering};

/// The maximum number of bytes of the steps.
const MAX_BYTES: usize = 1 << 26;

/// The maximum number of splits between a pair's root and any leaf.
const MAX_DEPTH: u32 = 200;

/// The shortest interval that is split, as a fraction of the whole time. The checker's times are multiples of 2⁻⁶⁰.
const MIN_INTERVAL: f64 = 1e-15;

/// Time is not split for parts whose displacement is below this fraction of their radius.
const MIN_DISPLACEMENT: f64 = 0.1;

/// The cost of checking a leaf with a ball, besides its visits to boxes. All costs are in visits to one box.
const BALL_COST: usize = 15;

/// The cost of checking a leaf with a plane, besides its visits to boxes.
const PLANE_COST: usize = 35;

/// The cost of computing the state of one link for one interval.
const LINK_COST: usize = 40;

/// A task with a leaf of at most this cost is not split in search of cheaper leaves.
const CHEAP_LEAF_COST: usize = 30;

/// Estimated checking cost of a task that no leaf proves yet.
const UNPROVEN_COST: usize = 800;

/// The maximum number of link states in the cache, which take about 100 MB; the intervals that are kept beside them take up to 150 MB. The checker's cache has the same maximum.
pub(crate) const MAX_CACHED_STATES: usize = 1 << 19;

/// The steps of a proof while they are written. Their leaves cover all pairs of triangles at all times.
pub(crate) struct Cover<'a> {
    scene: &'a Scene<'a>,
    link_motions: &'a [LinkMotion],
    limits: CoverLimits<'a>,
    /// The unit of length of the certificate.
    length_unit: f64,
    /// The index of the current pair.
    pair: usize,
    /// The required gap of the current pair on either side of a separating plane: half of the margin, and an allowance for rounding.
    required_gap: f64,
    /// The current pair in each interval, by the bits of the interval's start and end.
    pair_intervals: HashMap<[u64; 2], Rc<PairInterval<'a>>>,
    /// The states of all links in each interval, which all pairs share.
    link_states: HashMap<[u64; 2], Vec<LinkState>>,
    pub(crate) steps: Vec<u8>,
    pub(crate) leaf_count: usize,
}

/// The end of the time to cover, and the limits of the work.
#[derive(Clone, Copy)]
pub(crate) struct CoverLimits<'a> {
    /// The time until which the pairs are proven apart.
    pub(crate) until: f64,
    /// The flag that another thread sets to stop the work.
    pub(crate) stop: Option<&'a AtomicBool>,
    /// The number of link states above which the cache is emptied.
    pub(crate) max_cached_states: usize,
}

/// Two parts to prove apart over an interval of time.
#[derive(Clone)]
struct Task<'a> {
    parts: [Part; 2],
    interval: Rc<PairInterval<'a>>,
    /// The best separating axis so far of these parts, or of the parts that they were split from.
    axis: DVec3,
    /// The number of splits above this task.
    depth: u32,
    leaf: KnownLeaf,
}

/// The result of the search for a leaf that proves a task.
#[derive(Clone, Copy)]
enum KnownLeaf {
    NotSearched,
    NotFound,
    Found(Leaf),
}

/// A leaf that proves a task, and its checking cost.
#[derive(Clone, Copy)]
struct Leaf {
    cost: usize,
    kind: LeafKind,
}

#[derive(Clone, Copy)]
enum LeafKind {
    /// The bounding ball of the part of a body: 0 is A, 1 is B.
    Ball(usize),
    /// A plane perpendicular to the axis of the task.
    Plane,
}

/// A split of a task, and the tasks that remain.
struct Split<'a> {
    step: Step,
    /// The cost of checking the split itself.
    cost: usize,
    tasks: Vec<Task<'a>>,
}

impl<'a> Cover<'a> {
    pub(crate) fn new(
        (scene, link_motions): (&'a Scene<'a>, &'a [LinkMotion]),
        limits: CoverLimits<'a>,
        length_unit: f64,
    ) -> Self {
        Cover {
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
        let axis = interval.offset;
        self.prove_task(Task {
            parts: [Tree::WHOLE; 2],
            interval,
            axis,
            depth: 0,
            leaf: KnownLeaf::NotSearched,
        })
    }

    /// Returns the current pair over an interval of time, from the cache if it is there.
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

    /// Writes the steps that prove a task: its leaf, or a split and the steps of the tasks that remain.
    fn prove_task(&mut self, mut task: Task<'a>) -> Result<(), NotProven> {
        let at = task.interval.start;
        if task.depth > MAX_DEPTH || self.steps.len() > MAX_BYTES {
            let bytes = self.steps.len();
            return Err(NotProven::TooLong { at, bytes });
        }
        if self
            .limits
            .stop
            .is_some_and(|stop| stop.load(Ordering::Relaxed))
        {
            return Err(NotProven::Stopped { at });
        }
        let leaf = self.find_leaf(&mut task);
        let leaf_cost = leaf.map_or(usize::MAX, |leaf| leaf.cost);
        let mut best: (usize, Option<Split<'a>>) = (leaf_cost, None);
        if leaf_cost > CHEAP_LEAF_COST {
            // A split with an unproven task does not replace a leaf.
            let unproven_cost = if leaf.is_some() {
                usize::MAX
            } else {
                UNPROVEN_COST
            };
            for mut split in self.splits(&task) {
                let cost = self.split_cost(&mut split, unproven_cost);
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

    /// Returns the cost of checking a split and its tasks. A task that no leaf proves costs `unproven_cost`.
    fn split_cost(&self, split: &mut Split<'a>, unproven_cost: usize) -> usize {
        let tasks = split.tasks.iter_mut();
        let costs = tasks.map(|task| self.find_leaf(task).map_or(unproven_cost, |leaf| leaf.cost));
        costs.fold(split.cost, usize::saturating_add)
    }

    /// Returns the possible splits of a task, the most promising one first.
    fn splits(&mut self, task: &Task<'a>) -> Vec<Split<'a>> {
        let (interval, parts) = (&task.interval, task.parts);
        let radii = [0, 1].map(|k| interval.trees[k].radius(parts[k]));
        let larger = usize::from(radii[1] > radii[0]);
        let displacement = interval.relative_displacement(parts);
        let is_within_max_turn = interval.is_within_max_turn();
        let time = (displacement > MIN_DISPLACEMENT * radii[larger] || !is_within_max_turn)
            .then(|| self.split_time(task))
            .flatten();
        if !is_within_max_turn {
            return time.into_iter().collect();
        }
        let halves = [larger, 1 - larger]
            .into_iter()
            .filter_map(|body| split_part(task, body));
        if displacement > radii[larger] {
            time.into_iter().chain(halves).collect()
        } else {
            halves.chain(time).collect()
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
        let is_new = !self.link_states.contains_key(&halves[0].map(f64::to_bits));
        let tasks = halves.map(|times| Task {
            interval: self.pair_interval(times),
            ..task.child()
        });
        Some(Split {
            step: Step::SplitTime,
            cost: if is_new {
                2 * LINK_COST * self.link_motions.len()
            } else {
                0
            },
            tasks: tasks.into(),
        })
    }

    fn plane_search<'t>(&self, task: &'t Task<'a>) -> PlaneSearch<'t> {
        PlaneSearch {
            parts: task.parts,
            interval: &task.interval,
            required_gap: self.required_gap,
            length_unit: self.length_unit,
        }
    }

    /// Finds the cheapest leaf that proves a task: one with a ball, or one with a plane perpendicular to the task's axis. If that
    /// plane does not separate the parts, their best separating axis at the middle of the interval becomes the task's axis.
    fn find_leaf(&self, task: &mut Task<'a>) -> Option<Leaf> {
        match task.leaf {
            KnownLeaf::NotSearched => {}
            KnownLeaf::NotFound => return None,
            KnownLeaf::Found(leaf) => return Some(leaf),
        }
        let gap = 2.0 * self.required_gap;
        let ball = [0, 1].into_iter().filter_map(|k| {
            let cost = BALL_COST + task.interval.ball_visits(task.parts, k, gap)?;
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
        task.leaf = leaf.map_or(KnownLeaf::NotFound, KnownLeaf::Found);
        leaf
    }
}

impl Task<'_> {
    /// Returns a copy that is one split deeper, whose parts or interval the caller replaces.
    fn child(&self) -> Self {
        Task {
            depth: self.depth + 1,
            leaf: KnownLeaf::NotSearched,
            ..self.clone()
        }
    }
}

/// Splits the part of a body. Returns `None` if it is a single triangle.
fn split_part<'a>(task: &Task<'a>, body: usize) -> Option<Split<'a>> {
    let tasks = task.interval.trees[body]
        .halves(task.parts[body])?
        .map(|half| {
            let mut parts = task.parts;
            parts[body] = half;
            Task {
                parts,
                ..task.child()
            }
        });
    Some(Split {
        step: Step::SplitPart(body),
        cost: 0,
        tasks: tasks.into(),
    })
}

/// Returns the axis along which the gap between the parts is largest at the middle of the interval, and a lower bound of the gap.
fn separating_axis_at_middle(task: &Task<'_>) -> (DVec3, f64) {
    let ([a, b], interval) = (task.parts, &task.interval);
    let support = |direction: DVec3| {
        let (a, point_a) = interval.lowest_vertex(0, a, -direction);
        let (b, point_b) = interval.lowest_vertex(1, b, direction);
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
    let found = bound_distance(support, initial_axis, bounds);
    (found.axis.normalize_or_zero(), found.lower)
}
