//! How far do hulls stick out of a solid: an upper bound, by branch and bound.

mod body;
mod under;

use super::Part;
use super::solid::{Place, Solid};
use crate::tolerance::{EXCESS_CELLS, EXCESS_FLOOR, EXCESS_RATIO};
use body::{Body, Meets};
use ccd_core::glam::DVec3;
use ccd_core::order::{greater, lesser};
use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// A distance that no point of the parts is farther from the solid than.
///
/// The distance to the solid changes by no more than one moves, so that its value at the centre of a
/// box bounds it in the box; where the surface is nearly flat, [`under`] knows better. Boxes about the
/// parts are split, the one with the largest bound first, until that is hardly more than a distance
/// that was found, or the cells are spent.
pub(super) fn bound(solid: &Solid<'_>, parts: &[Part]) -> f64 {
    let floor = EXCESS_FLOOR * solid.reach();
    let bodies: Vec<Body<'_>> = parts.iter().map(|part| Body::of(part, solid)).collect();
    let mut search = Search {
        solid,
        bodies: &bodies,
        found: 0.0,
        heap: BinaryHeap::new(),
    };
    let mut settled = 0.0_f64;
    for (k, body) in bodies.iter().enumerate() {
        match body.excess_by_depth(solid) {
            Some(bound) if bound <= floor => settled = greater(settled, bound),
            _ => search.push(k, body.bounds),
        }
    }
    for body in &bodies {
        body.part.corners.iter().for_each(|&p| search.look_at(p));
    }
    for _ in 0..EXCESS_CELLS / 8 {
        let target = greater(EXCESS_RATIO * search.found, search.found + floor);
        match search.heap.peek() {
            Some(cell) if cell.bound > target => search.split(),
            _ => break,
        }
    }
    let open = search.heap.peek().map_or(0.0, |cell| cell.bound);
    greater(greater(open, search.found), settled)
}

struct Search<'a> {
    solid: &'a Solid<'a>,
    bodies: &'a [Body<'a>],
    /// The largest distance of a point of a part that was looked at.
    found: f64,
    heap: BinaryHeap<Cell>,
}

/// A box, and a bound on the distance to the solid of any point of a part in it.
#[derive(Clone, Copy, Debug)]
struct Cell {
    bound: f64,
    body: usize,
    bounds: [DVec3; 2],
}

impl Search<'_> {
    fn look_at(&mut self, point: DVec3) {
        if let Place::Outside { distance } = self.solid.place(point) {
            self.found = greater(self.found, distance);
        }
    }

    /// Splits the box with the largest bound in eight.
    fn split(&mut self) {
        let Some(cell) = self.heap.pop() else {
            return;
        };
        let [lo, hi] = cell.bounds;
        let middle = (lo + hi) / 2.0;
        for k in 0..8 {
            let upper = [0, 1, 2].map(|axis| k >> axis & 1 == 1);
            let pick = |above: DVec3, below: DVec3| {
                DVec3::from_array([0, 1, 2].map(|axis| match upper[axis] {
                    true => above[axis],
                    false => below[axis],
                }))
            };
            self.push(cell.body, [pick(middle, lo), pick(hi, middle)]);
        }
    }

    fn push(&mut self, body: usize, bounds: [DVec3; 2]) {
        let [lo, hi] = bounds;
        let (centre, half) = ((lo + hi) / 2.0, (hi - lo) / 2.0);
        let reach = half.length() + self.solid.slack();
        let within = match self.bodies[body].meets(centre, half) {
            Meets::No => return,
            Meets::Centre => true,
            Meets::Perhaps => false,
        };
        let near = match self.solid.place(centre) {
            Place::Inside { depth } => reach - depth,
            Place::Outside { distance } => {
                if within {
                    self.found = greater(self.found, distance);
                }
                distance + reach
            }
        };
        if !(near > self.found) {
            return;
        }
        let under = under::excess(self.solid, &self.bodies[body], centre, half);
        let bound = under.map_or(near, |bound| lesser(bound, near));
        if bound > self.found {
            self.heap.push(Cell {
                bound,
                body,
                bounds,
            });
        }
    }
}

impl Ord for Cell {
    fn cmp(&self, other: &Self) -> Ordering {
        let place = |cell: &Cell| cell.bounds[0].to_array();
        let ties = || {
            let (p, q) = (place(self), place(other));
            let along = |axis: usize| p[axis].total_cmp(&q[axis]);
            along(0)
                .then(along(1))
                .then(along(2))
                .then(self.body.cmp(&other.body))
        };
        self.bound.total_cmp(&other.bound).then_with(ties)
    }
}

impl PartialOrd for Cell {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Cell {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Cell {}
