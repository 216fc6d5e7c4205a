//! Splits what is to be proven until leaves prove it that are cheap to check.

use crate::error::NotProven;
use crate::placed::{Moving, Placed, placed as placed_links};
use crate::plane::Gap;
use crate::scene::Scene;
use crate::stretch::Stretch;
use crate::tree::{Part, Tree};
use ccd_core::glam::DVec3;
use ccd_distance_gjk::{TerminationBounds, Vertex, bound_distance};
use std::collections::HashMap;
use std::rc::Rc;
use std::sync::atomic::{AtomicBool, Ordering};

/// The largest number of bytes of a proof.
const MAX_BYTES: usize = 1 << 26;

/// The largest number of splits on a path.
const MAX_DEPTH: u32 = 200;

/// The shortest stretch that is split, as a share of the whole: the checker has times in 2⁻⁶⁰.
const SHORTEST: f64 = 1e-15;

/// Parts that move by less than this share of their radius are not split in time.
const LEAST_WAY: f64 = 0.1;

/// What it takes to check a leaf with a ball or a plane besides the looks at boxes, and to place a link in the middle of a stretch
/// of time: as many looks as take as long, about.
const BALL: usize = 15;
const PLANE: usize = 35;
const LINK: usize = 40;

/// A leaf that takes less to check is not split to find cheaper ones.
const CHEAP: usize = 30;

/// What is expected to check what a split leaves unproven.
const EXPECTED: usize = 800;

/// A proof as it is written.
pub(crate) struct Cover<'a> {
    scene: (&'a Scene<'a>, &'a [Moving]),
    until: f64,
    /// What another thread sets to stop the work.
    stop: Option<&'a AtomicBool>,
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
    /// The cheapest leaf that is known to prove them apart, if that has been asked.
    leaf: Option<Option<Leaf>>,
}

/// What proves a task, and what it takes to check that.
#[derive(Clone, Copy)]
struct Leaf {
    price: usize,
    by: By,
}

#[derive(Clone, Copy)]
enum By {
    /// A ball around A or B.
    Ball(usize),
    /// A plane across the axis of the task.
    Plane,
}

/// What a task is split into.
struct Split<'a> {
    step: u8,
    /// What it takes to check the split itself.
    price: usize,
    tasks: Vec<Task<'a>>,
}

impl<'a> Cover<'a> {
    pub(crate) fn new(
        scene: (&'a Scene<'a>, &'a [Moving]),
        (until, stop): (f64, Option<&'a AtomicBool>),
        unit: f64,
    ) -> Self {
        Cover {
            scene,
            until,
            stop,
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
            parts: [Tree::WHOLE; 2],
            stretch,
            axis,
            depth: 0,
            leaf: None,
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
        if self.stop.is_some_and(|stop| stop.load(Ordering::Relaxed)) {
            return Err(NotProven::Stopped { at });
        }
        let leaf = self.leaf(&mut task);
        let price = leaf.map_or(usize::MAX, |leaf| leaf.price);
        let mut best: (usize, Option<Split<'a>>) = (price, None);
        if price > CHEAP {
            // What a leaf proves is not left to splits of which more is not known.
            let expected = if leaf.is_some() { usize::MAX } else { EXPECTED };
            for mut split in self.splits(&task) {
                let price = self.price(&mut split, expected);
                if price < best.0 {
                    best = (price, Some(split));
                }
            }
        }
        let Some(split) = best.1 else {
            let leaf = leaf.ok_or(NotProven::Touching { at })?;
            return self.write_leaf(&task, leaf.by);
        };
        self.steps.push(split.step);
        split
            .tasks
            .into_iter()
            .try_for_each(|task| self.cover(task))
    }

    fn write_leaf(&mut self, task: &Task<'a>, by: By) -> Result<(), NotProven> {
        match by {
            By::Ball(k) => self.steps.push(6 + k as u8),
            By::Plane => {
                let (axis, _) = axis_in_the_middle(task);
                let plane = self.gap(task).cheapest_plane([task.axis, axis]);
                let at = task.stretch.from;
                let plane = plane.ok_or(NotProven::Touching { at })?;
                plane.write(&mut self.steps);
            }
        }
        self.leaves += 1;
        Ok(())
    }

    /// Returns what it takes to check what a split leads to: what is expected for each task that no leaf proves.
    fn price(&self, split: &mut Split<'a>, expected: usize) -> usize {
        let tasks = split.tasks.iter_mut();
        let prices = tasks.map(|task| self.leaf(task).map_or(expected, |leaf| leaf.price));
        prices.fold(split.price, usize::saturating_add)
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
        let halves = [[from, middle], [middle, to]];
        let is_new = !self.placed.contains_key(&halves[0].map(f64::to_bits));
        let tasks = halves.map(|times| Task {
            stretch: self.stretch(times),
            ..task.below()
        });
        Some(Split {
            step: 2,
            price: if is_new {
                2 * LINK * self.scene.1.len()
            } else {
                0
            },
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

    /// Returns the cheapest leaf that is found to prove a task: with a ball, or with a plane across its axis, or across the axis along
    /// which its parts are farthest apart in the middle; that is its axis then.
    fn leaf(&self, task: &mut Task<'a>) -> Option<Leaf> {
        if let Some(known) = task.leaf {
            return known;
        }
        let ball = [0, 1].into_iter().filter_map(|k| {
            let looks = task
                .stretch
                .looks_beyond_ball(task.parts, k, 2.0 * self.least)?;
            let (price, by) = (BALL + looks, By::Ball(k));
            Some(Leaf { price, by })
        });
        let mut leaf = ball.min_by_key(|leaf| leaf.price);
        if leaf.is_none_or(|leaf| leaf.price > PLANE) {
            let mut looks = self.gap(task).looks(task.axis);
            if looks.is_none() {
                let (axis, distance) = axis_in_the_middle(task);
                if axis != task.axis && distance > 2.0 * self.least {
                    looks = self.gap(task).looks(axis);
                }
                task.axis = axis;
            }
            let price = looks.map(|looks| PLANE + looks);
            let is_cheaper = |price: &usize| leaf.is_none_or(|leaf| *price < leaf.price);
            if let Some(price) = price.filter(is_cheaper) {
                let by = By::Plane;
                leaf = Some(Leaf { price, by });
            }
        }
        task.leaf = Some(leaf);
        leaf
    }
}

impl Task<'_> {
    /// Returns what a split of the task leaves to be proven, as it is before it is told what of.
    fn below(&self) -> Self {
        Task {
            depth: self.depth + 1,
            leaf: None,
            ..self.clone()
        }
    }
}

/// Halves the part of a body of a task; `None` if it is a triangle.
fn split_part<'a>(task: &Task<'a>, side: usize) -> Option<Split<'a>> {
    let tasks = task.stretch.bodies[side]
        .halves(task.parts[side])?
        .map(|half| {
            let mut parts = task.parts;
            parts[side] = half;
            Task {
                parts,
                ..task.below()
            }
        });
    Some(Split {
        step: side as u8,
        price: 0,
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
