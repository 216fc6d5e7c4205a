//! Where a march begins: at the last pair of features, or at corners that face each other
//! `[SWIFT01]`.

use crate::feature::{Feature, Pair};
use crate::place::{Placed, Places};
use crate::polytope::Polytope;
use ccd_core::glam::DVec3;

/// Which features were nearest, and along which axis, for the next call to start from.
///
/// Features serve the polytope that they are of; for any other one, such as a part of that, the axis
/// says where to start. Whatever a cache holds, it only decides where a march begins.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Cache(Option<Last>);

/// How the last march ended.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Last {
    pair: Pair,
    /// Of A's polytope and B's.
    names: [u64; 2],
    axis: DVec3,
}

impl Cache {
    /// Keeps a pair, with the axis from A to B.
    #[inline]
    pub(crate) fn keep(&mut self, places: &Places<'_>, pair: Pair, axis: DVec3) {
        self.0 = Some(Last {
            pair,
            names: names(places),
            axis,
        });
    }

    /// The pair to start from: the last one; or corners that are extremal along the last axis, or along
    /// the way from one middle to the other where there is none.
    #[inline]
    pub(crate) fn start(self, places: &Places<'_>) -> Pair {
        let Some(last) = self.0 else {
            return extremal(places, places.b.origin());
        };
        let names = names(places);
        if names == last.names && is_state(places, last.pair) {
            return last.pair;
        }
        let corners = extremal(places, last.axis);
        // What one polytope has kept is nearer than a corner.
        let kept = Pair {
            a: if names[0] == last.names[0] {
                last.pair.a
            } else {
                corners.a
            },
            b: if names[1] == last.names[1] {
                last.pair.b
            } else {
                corners.b
            },
        };
        if is_state(places, kept) {
            kept
        } else {
            corners
        }
    }
}

/// Numbers that hardly any two polytopes have in common.
#[inline]
fn names(places: &Places<'_>) -> [u64; 2] {
    let name = |polytope: &Polytope| {
        let DVec3 { x, y, z } = polytope.origin;
        let coordinates = [polytope.reach, x, y, z].map(f64::to_bits);
        coordinates
            .into_iter()
            .fold(0, |name: u64, bits| name.rotate_left(16) ^ bits)
    };
    [name(places.a.shape()), name(places.b.shape())]
}

/// Whether a march can begin there: never at two faces.
#[inline]
fn is_state(places: &Places<'_>, pair: Pair) -> bool {
    let two_faces = matches!((pair.a, pair.b), (Feature::Face(_), Feature::Face(_)));
    !two_faces && places.a.shape().has(pair.a) && places.b.shape().has(pair.b)
}

/// The corners that face each other along an axis from A to B.
pub(crate) fn extremal(places: &Places<'_>, axis: DVec3) -> Pair {
    let a = places.a.shape().extremal(axis);
    let b = places.b.shape().extremal(-places.b.own_vector(axis));
    Pair {
        a: Feature::Vertex(a),
        b: Feature::Vertex(b),
    }
}

/// For directions all around the corner that is farthest along each.
///
/// A direction belongs to one of sixteen squares on one of six sides of a cube: it is found by
/// comparing, and the corner is one or two edges away from the extremal one in most polytopes.
#[derive(Clone, Debug)]
pub(crate) struct Starts([u32; 6 * SQUARES * SQUARES]);

/// How many squares there are along the side of the cube.
const SQUARES: usize = 4;

impl Starts {
    /// Fills the table, going from square to square, with a climb for each.
    pub(crate) fn new(polytope: &Polytope) -> Self {
        let mut starts = [0; 6 * SQUARES * SQUARES];
        let mut at = 0;
        for (square, start) in starts.iter_mut().enumerate() {
            at = polytope.climbed(at, middle_of(square));
            *start = at;
        }
        Starts(starts)
    }

    /// The corner for a direction of any length; some corner for one that is not finite.
    fn of(&self, direction: DVec3) -> u32 {
        self.0[square_of(direction)]
    }
}

/// The square that a direction belongs to.
fn square_of(direction: DVec3) -> usize {
    let size = direction.abs();
    let axis = match (size.x >= size.y, size.x >= size.z, size.y >= size.z) {
        (true, true, _) => 0,
        (_, _, true) => 1,
        _ => 2,
    };
    let side = 2 * axis + usize::from(direction[axis] < 0.0);
    let step = |across: f64| {
        let part = 0.5 * SQUARES as f64 * (1.0 + across / size[axis]);
        // What is no number is cast to 0.
        (part as usize).min(SQUARES - 1)
    };
    let (u, v) = (direction[(axis + 1) % 3], direction[(axis + 2) % 3]);
    (side * SQUARES + step(u)) * SQUARES + step(v)
}

/// The direction in the middle of a square.
fn middle_of(square: usize) -> DVec3 {
    let (side, u, v) = (
        square / (SQUARES * SQUARES),
        square / SQUARES % SQUARES,
        square % SQUARES,
    );
    let across = |step: usize| (step as f64 + 0.5) / (0.5 * SQUARES as f64) - 1.0;
    let axis = side / 2;
    let mut out = DVec3::ZERO;
    out[axis] = if side % 2 == 1 { -1.0 } else { 1.0 };
    out[(axis + 1) % 3] = across(u);
    out[(axis + 2) % 3] = across(v);
    out
}

impl Polytope {
    /// A corner that is farthest along a direction, but for rounding.
    pub(crate) fn extremal(&self, direction: DVec3) -> u32 {
        if let Some(starts) = &self.starts {
            return self.climbed(starts.of(direction), direction);
        }
        let heights = self
            .vertices
            .iter()
            .map(|v| v.point.dot(direction))
            .zip(0..);
        let none = (f64::NEG_INFINITY, 0);
        heights
            .fold(none, |best, here| if here.0 > best.0 { here } else { best })
            .1
    }

    /// Goes to the highest neighbour until none is higher. It may stop short of corners that are level
    /// but for rounding: a march goes on from there.
    fn climbed(&self, start: u32, direction: DVec3) -> u32 {
        let height = |v: u32| self.vertex(v).point.dot(direction);
        let (mut at, mut highest) = (start, height(start));
        // Every round is higher than the last one.
        for _ in 0..self.vertices.len() {
            let before = at;
            for spoke in self.spokes_of(before) {
                let here = height(spoke.to);
                if here > highest {
                    (at, highest) = (spoke.to, here);
                }
            }
            if at == before {
                break;
            }
        }
        at
    }
}

#[cfg(test)]
mod tests;
