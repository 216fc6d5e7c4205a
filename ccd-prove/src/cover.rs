//! Splits what is to be proven until an axis proves it.

use crate::body::Part;
use crate::error::NotProven;
use crate::stretch::{Moving, Stretch};
use ccd_core::glam::DVec3;
use ccd_core::order::greater;
use ccd_distance_gjk::{TerminationBounds, Vertex, bound_distance};

/// Axes are multiples of 2⁻¹⁴, or fine ones of 2⁻³⁰.
const AXIS_UNITS: [f64; 2] = [16_384.0, 1_073_741_824.0];

/// The largest number of bytes of a proof.
const MAX_BYTES: usize = 1 << 26;

/// The largest number of splits on a path.
const MAX_DEPTH: u32 = 200;

/// A proof as it is written.
pub(crate) struct Cover<'a> {
    bodies: &'a [Moving<'a>; 2],
    /// What parts have to keep: the margin, and an allowance for the rounding here.
    least: f64,
    until: f64,
    pub(crate) steps: Vec<u8>,
    pub(crate) leaves: usize,
}

/// Parts over a stretch of time, the axis that kept a part above them apart best, and the number of splits so far.
#[derive(Clone, Copy)]
struct Task {
    parts: [Part; 2],
    axis: DVec3,
    depth: u32,
}

impl<'a> Cover<'a> {
    pub(crate) fn new(bodies: &'a [Moving<'a>; 2], least: f64, until: f64) -> Self {
        Cover {
            bodies,
            least,
            until,
            steps: Vec::new(),
            leaves: 0,
        }
    }

    pub(crate) fn write(&mut self) -> Result<(), NotProven> {
        let stretch = Stretch::new(self.bodies, 0.0, self.until);
        let axis = stretch.offset;
        let task = Task {
            parts: [Part::Node(0); 2],
            axis,
            depth: 0,
        };
        self.cover(task, &stretch)
    }

    fn cover(&mut self, task: Task, stretch: &Stretch) -> Result<(), NotProven> {
        if task.depth > MAX_DEPTH || self.steps.len() > MAX_BYTES {
            return Err(NotProven::TooLong {
                at: stretch.from,
                bytes: self.steps.len(),
            });
        }
        if self.write_leaf(task, task.axis, stretch) {
            return Ok(());
        }
        let (axis, distance) = self.axis_in_the_middle(task, stretch);
        if distance > self.least && axis != task.axis && self.write_leaf(task, axis, stretch) {
            return Ok(());
        }
        let task = Task {
            axis,
            depth: task.depth + 1,
            ..task
        };
        let [a, b] = [0, 1].map(|k| self.bodies[k].body.radius(task.parts[k]));
        let way = stretch.way(self.bodies, task.parts);
        if way > greater(a, b) && stretch.to > stretch.from {
            return self.split_time(task, stretch);
        }
        if greater(a, b) == 0.0 && !matches!(task.parts, [Part::Node(_), _] | [_, Part::Node(_)]) {
            return Err(NotProven::Touching { at: stretch.from });
        }
        let side = match task.parts {
            [Part::Triangle(_), _] => 1,
            [_, Part::Triangle(_)] => 0,
            _ => usize::from(b > a),
        };
        self.steps.push(side as u8);
        for child in self.bodies[side].body.children(task.parts[side]) {
            let mut parts = task.parts;
            parts[side] = child;
            self.cover(Task { parts, ..task }, stretch)?;
        }
        Ok(())
    }

    fn split_time(&mut self, task: Task, stretch: &Stretch) -> Result<(), NotProven> {
        let middle = 0.5 * (stretch.from + stretch.to);
        if middle <= stretch.from || middle >= stretch.to {
            return Err(NotProven::Touching { at: stretch.from });
        }
        self.steps.push(2);
        self.steps.extend((1u16 << 15).to_le_bytes());
        self.cover(task, &Stretch::new(self.bodies, stretch.from, middle))?;
        self.cover(task, &Stretch::new(self.bodies, middle, stretch.to))
    }

    /// Writes a leaf if the axis proves it, in one of the frames.
    fn write_leaf(&mut self, task: Task, axis: DVec3, stretch: &Stretch) -> bool {
        for (fine, unit) in AXIS_UNITS.into_iter().enumerate() {
            // Rounded towards zero it is no longer than 1.
            let stored = (axis.normalize_or_zero() * (unit - 1.0)).trunc();
            let axis = stored / unit;
            for (number, frame) in [None, Some(0), Some(1)].into_iter().enumerate() {
                if frame.is_some_and(|k: usize| self.bodies[k].motion.spin() == DVec3::ZERO) {
                    continue;
                }
                if stretch.least_gap(self.bodies, task.parts, (axis, frame)) > self.least {
                    self.steps.push((3 + 3 * fine + number) as u8);
                    for x in stored.to_array() {
                        if fine == 0 {
                            self.steps.extend((x as i16).to_le_bytes());
                        } else {
                            self.steps.extend((x as i32).to_le_bytes());
                        }
                    }
                    self.leaves += 1;
                    return true;
                }
            }
        }
        false
    }

    /// Returns the axis along which parts are farthest apart in the middle of a stretch, and how far.
    fn axis_in_the_middle(&self, task: Task, stretch: &Stretch) -> (DVec3, f64) {
        let support = |direction: DVec3| {
            let (a, of_a) = stretch.lowest(self.bodies, (0, task.parts[0]), -direction);
            let (b, of_b) = stretch.lowest(self.bodies, (1, task.parts[1]), direction);
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
}
