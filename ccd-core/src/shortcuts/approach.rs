//! Bounds of the rate at which two nodes approach along a fixed direction, in f64.

use super::placed::Placed;
use crate::math::order::{greater, lesser};
use crate::math::vector::length;
use crate::motion::gap::Gap;
use crate::motion::path::Path;
use crate::problem::Problem;
use crate::rounding::RATE_F64;
use glam::DVec3;

/// Upper bounds of the rate at which a node of A and a node of B approach.
pub(crate) struct Approach {
    /// The rate at which the nodes' centres approach each other.
    pub(crate) straight: f64,
    /// An upper bound of the rate at which any two points of the nodes approach.
    rate: f64,
    /// An upper bound of the second derivative of the approach; negative if the nodes accelerate away from each other.
    second_derivative: f64,
}

impl Approach {
    /// Computes the bounds along a unit vector from A to B, from clock `s` on.
    pub(crate) fn along(problem: &Problem<'_>, [a, b]: [&Placed; 2], n: DVec3, s: f64) -> Self {
        let straight = straight(problem, [a, b], n, s);
        let (mut turning, mut second_derivative, mut speed) = (0.0, 0.0, 0.0);
        for (side, node, n) in [(&problem.a, a, n), (&problem.b, b, -n)] {
            let (path, radius) = (&side.path, node.radius);
            let arm = node.centre - path.centre_at(s);
            let across = n.cross(path.spin);
            // n·(ω×w) = w·(n×ω) of points at w from the centre.
            turning += greater(0.0, node.extent_along(across)) + RATE_F64 * path.rate * radius;
            let from_axis = length(path.axis.cross(arm)) + radius + RATE_F64 * length(arm);
            let across = length(across) + RATE_F64 * path.rate;
            second_derivative += across * path.rate * from_axis * (1.0 + RATE_F64);
            second_derivative += n.dot(path.acceleration) + RATE_F64 * length(path.acceleration);
            speed += path.speed() + path.rate * (length(arm) + radius);
        }
        Approach {
            straight,
            rate: straight + turning + 2.0 * RATE_F64 * speed,
            second_derivative,
        }
    }

    /// Returns a time in which the nodes certainly do not use up a gap.
    pub(crate) fn free_time(&self, gap: f64) -> f64 {
        let gap = Gap {
            gap,
            rate: self.rate,
            second_derivative: self.second_derivative,
        };
        lesser(f64::MAX, gap.free_time())
    }
}

/// Returns the rate at which the nodes' centres approach each other along `n`.
pub(crate) fn straight(problem: &Problem<'_>, [a, b]: [&Placed; 2], n: DVec3, s: f64) -> f64 {
    let rate = |path: &Path, centre: DVec3, n: DVec3| n.dot(path.velocity_at(centre, s));
    rate(&problem.a.path, a.centre, n) + rate(&problem.b.path, b.centre, -n)
}

#[cfg(test)]
mod tests;
