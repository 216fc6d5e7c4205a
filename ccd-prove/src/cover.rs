//! Splits what is to be proven until a plane proves it.

use crate::body::{Part, halves};
use crate::error::NotProven;
use crate::placed::{Moving, Placed, placed as placed_links};
use crate::plane::Gap;
use crate::scene::Scene;
use crate::stretch::Stretch;
use ccd_core::glam::DVec3;
use ccd_distance_gjk::{TerminationBounds, Vertex, bound_distance};
use std::collections::HashMap;
use std::rc::Rc;

/// The largest number of bytes of a proof.
const MAX_BYTES: usize = 1 << 26;

/// The largest number of splits on a path.
const MAX_DEPTH: u32 = 200;

/// The shortest stretch that is split, as a share of the whole: the checker has times in 2⁻⁶⁰.
const SHORTEST: f64 = 1e-15;

/// Parts that move by less than this share of their radius are not split in time.
const LEAST_WAY: f64 = 0.1;

/// How many leaves are expected of what a split leaves unproven.
const EXPECTED: u32 = 6;

/// A proof as it is written.
pub(crate) struct Cover<'a> {
    scene: (&'a Scene<'a>, &'a [Moving]),
    until: f64,
    /// The unit of length.
    unit: f64,
    /// The pair, and how far its parts have to be from a plane: half of the margin, and an allowance for the rounding here.
    pair: usize,
    least: f64,
    stretches: HashMap<[u64; 2], Rc<Stretch<'a>>>,
    /// All links in the middle of each stretch, which pairs share.
    placed: HashMap<[u64; 2], Vec<Placed>>,
    pub(crate) steps: Vec<u8>,
    pub(crate) leaves: usize,
}

/// Parts over a stretch of time.
#[derive(Clone)]
struct Task<'a> {
    parts: [Part; 2],
    stretch: Rc<Stretch<'a>>,
    /// The axis that kept them apart best, or a part above them.
    axis: DVec3,
    /// The number of splits so far.
    depth: u32,
    /// Whether a plane proves them apart, if that has been asked.
    proven: Option<bool>,
}

/// What a task is split into.
struct Split<'a> {
    step: u8,
    tasks: Vec<Task<'a>>,
}

impl<'a> Cover<'a> {
    pub(crate) fn new(scene: (&'a Scene<'a>, &'a [Moving]), until: f64, unit: f64) -> Self {
        Cover {
            scene,
            until,
            unit,
            pair: 0,
            least: 0.0,
            stretches: HashMap::new(),
            placed: HashMap::new(),
            steps: Vec::new(),
            leaves: 0,
        }
    }

    /// Writes the steps that prove a pair to be farther apart than twice `least`.
    pub(crate) fn write(&mut self, pair: usize, least: f64) -> Result<(), NotProven> {
        (self.pair, self.least) = (pair, least);
        self.stretches.clear();
        let stretch = self.stretch([0.0, self.until]);
        let axis = stretch.offset;
        self.cover(Task {
            parts: stretch.bodies.map(|body| body.whole()),
            stretch,
            axis,
            depth: 0,
            proven: None,
        })
    }

    fn stretch(&mut self, times: [f64; 2]) -> Rc<Stretch<'a>> {
        let (scene, pair, key) = (self.scene, self.pair, times.map(f64::to_bits));
        let placed = &mut self.placed;
        let stretch = self.stretches.entry(key).or_insert_with(|| {
            let [from, to] = times;
            let all = placed
                .entry(key)
                .or_insert_with(|| placed_links(scene.1, 0.5 * (from + to), 0.5 * (to - from)));
            Rc::new(Stretch::new(scene, pair, (times, all)))
        });
        Rc::clone(stretch)
    }

    fn cover(&mut self, mut task: Task<'a>) -> Result<(), NotProven> {
        let at = task.stretch.from;
        if task.depth > MAX_DEPTH || self.steps.len() > MAX_BYTES {
            let bytes = self.steps.len();
            return Err(NotProven::TooLong { at, bytes });
        }
        if self.is_proven(&mut task) {
            let (axis, _) = axis_in_the_middle(&task);
            let plane = self.gap(&task).cheapest_plane([task.axis, axis]);
            let plane = plane.ok_or(NotProven::Touching { at })?;
            plane.write(&mut self.steps);
            self.leaves += 1;
            return Ok(());
        }
        let mut best: Option<(u32, Split<'a>)> = None;
        for mut split in self.splits(&task) {
            let cost = self.cost(&mut split);
            if best.as_ref().is_none_or(|(least, _)| cost < *least) {
                best = Some((cost, split));
            }
        }
        let (_, split) = best.ok_or(NotProven::Touching { at })?;
        self.steps.push(split.step);
        if split.step == 2 {
            self.steps.extend((1u16 << 15).to_le_bytes());
        }
        split
            .tasks
            .into_iter()
            .try_for_each(|task| self.cover(task))
    }

    /// Returns the number of leaves that a split leads to, about.
    fn cost(&self, split: &mut Split<'a>) -> u32 {
        let tasks = split.tasks.iter_mut();
        let costs = tasks.map(|task| if self.is_proven(task) { 1 } else { EXPECTED });
        costs.sum()
    }

    /// Returns the ways to split a task, the one first that looks best.
    fn splits(&mut self, task: &Task<'a>) -> Vec<Split<'a>> {
        let (stretch, parts) = (&task.stretch, task.parts);
        let radii = [0, 1].map(|k| stretch.bodies[k].radius(parts[k]));
        let larger = usize::from(radii[1] > radii[0]);
        let way = stretch.way(parts);
        let time = (way > LEAST_WAY * radii[larger] || !stretch.is_short())
            .then(|| self.split_time(task))
            .flatten();
        if !stretch.is_short() {
            return time.into_iter().collect();
        }
        let halves = [larger, 1 - larger]
            .into_iter()
            .filter_map(|side| split_part(task, side));
        if way > radii[larger] {
            time.into_iter().chain(halves).collect()
        } else {
            halves.chain(time).collect()
        }
    }

    fn split_time(&mut self, task: &Task<'a>) -> Option<Split<'a>> {
        let Stretch { from, to, .. } = *task.stretch;
        let middle = 0.5 * (from + to);
        if to - from <= SHORTEST * self.until {
            return None;
        }
        let tasks = [[from, middle], [middle, to]].map(|times| Task {
            stretch: self.stretch(times),
            ..task.below()
        });
        Some(Split {
            step: 2,
            tasks: tasks.into(),
        })
    }

    fn gap<'t>(&self, task: &'t Task<'a>) -> Gap<'t> {
        Gap {
            parts: task.parts,
            stretch: &task.stretch,
            least: self.least,
            unit: self.unit,
        }
    }

    /// Returns whether a plane across its axis proves a task, or one across the axis along which its parts are farthest apart in
    /// the middle; that is its axis then.
    fn is_proven(&self, task: &mut Task<'a>) -> bool {
        let proven = task.proven.unwrap_or_else(|| {
            let inherited = self.gap(task).plane(task.axis).is_some();
            inherited || {
                let (axis, distance) = axis_in_the_middle(task);
                let is_new = axis != task.axis;
                task.axis = axis;
                is_new && distance > 2.0 * self.least && self.gap(task).plane(axis).is_some()
            }
        });
        task.proven = Some(proven);
        proven
    }
}

impl Task<'_> {
    /// Returns what a split of the task leaves to be proven, as it is before it is told what of.
    fn below(&self) -> Self {
        Task {
            depth: self.depth + 1,
            proven: None,
            ..self.clone()
        }
    }
}

/// Halves the part of a body of a task; `None` if it is a triangle.
fn split_part<'a>(task: &Task<'a>, side: usize) -> Option<Split<'a>> {
    let tasks = halves(task.parts[side])?.map(|half| {
        let mut parts = task.parts;
        parts[side] = half;
        Task {
            parts,
            ..task.below()
        }
    });
    Some(Split {
        step: side as u8,
        tasks: tasks.into(),
    })
}

/// Returns the axis along which parts are farthest apart in the middle of a stretch, and how far.
fn axis_in_the_middle(task: &Task<'_>) -> (DVec3, f64) {
    let ([a, b], stretch) = (task.parts, &task.stretch);
    let support = |direction: DVec3| {
        let (a, of_a) = stretch.lowest(0, a, -direction);
        let (b, of_b) = stretch.lowest(1, b, direction);
        Vertex {
            point: of_b - of_a,
            a,
            b,
        }
    };
    let bounds = TerminationBounds {
        sufficient_lower_bound: f64::INFINITY,
        sufficient_upper_bound: 0.0,
    };
    let first = if task.axis == DVec3::ZERO {
        DVec3::X
    } else {
        task.axis
    };
    let found = bound_distance(support, first, bounds);
    (found.axis.normalize_or_zero(), found.lower)
}
