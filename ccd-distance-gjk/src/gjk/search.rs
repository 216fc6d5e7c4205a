//! The search itself, in either precision.

use super::minkowski::Difference;
use super::simplex::{Simplex, Vertex};
use super::termination::{Stop, meets, touches};
use super::vector::Vector;
use crate::tolerance::{CONVERGED_ULPS, STEP_CAP};
use num_traits::{Float, Zero};

/// The best that is known of a pair.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Found<V: Vector> {
    /// The simplex of the nearest point, and its weights.
    pub(crate) simplex: Simplex<V>,
    pub(crate) weights: [V::Scalar; 4],
    /// The square of that point's distance from the origin.
    pub(crate) square: V::Scalar,
    /// The axis with the largest support gap, of any length.
    pub(crate) axis: V,
    /// That gap, along the unit vector.
    pub(crate) gap: V::Scalar,
}

impl<V: Vector> Found<V> {
    /// Nothing.
    pub(crate) fn nothing() -> Self {
        Found {
            simplex: Simplex::EMPTY,
            weights: [V::Scalar::zero(); 4],
            square: V::Scalar::infinity(),
            axis: V::ZERO,
            gap: V::Scalar::neg_infinity(),
        }
    }

    /// Looks along an axis: the vertex that is least along it, and its support gap.
    pub(crate) fn probe<D>(&mut self, difference: &D, axis: V) -> (Vertex<V>, V::Scalar)
    where
        D: Difference<Vector = V>,
    {
        let vertex = difference.support(axis);
        let gap = axis.dot(vertex.point) / axis.square().sqrt();
        if gap > self.gap {
            (self.axis, self.gap) = (axis, gap);
        }
        (vertex, gap)
    }
}

/// Goes from `simplex` to the point of the difference that is nearest to the origin, step by step
/// nearer `[GJK88]`; `found` keeps the best, whatever stops it.
pub(crate) fn search<D: Difference>(
    difference: &D,
    mut simplex: Simplex<D::Vector>,
    found: &mut Found<D::Vector>,
) -> Stop {
    for _ in 0..STEP_CAP {
        let Some(foot) = simplex.foot() else {
            return Stop::Stalled;
        };
        let square = foot.point.square();
        // Written so that NaN stops it.
        if !(square < found.square) {
            return Stop::Stalled;
        }
        let reduced;
        (reduced, found.weights) = simplex.reduced(&foot);
        (found.simplex, found.square) = (reduced, square);
        let Some(direction) = foot.direction else {
            return Stop::Enclosed;
        };
        if touches(&foot, &simplex) {
            return Stop::Touching;
        }
        let (vertex, gap) = found.probe(difference, direction);
        if meets(gap, square, &simplex, CONVERGED_ULPS) {
            return Stop::Converged;
        }
        simplex = reduced;
        if !simplex.push(vertex) {
            return Stop::Stalled;
        }
    }
    Stop::Capped
}
