//! The bounding box of a whole body, in f64.

use super::fit::{NodePoints, Sample, best_frame};
use crate::math::order::greater;
use crate::math::vector::length;
use crate::rounding::UNIT_ROUNDOFF_F64;
use glam::{DMat3, DVec3};

/// The oriented bounding box of a body, as tight as f64 allows. The root's own box is rounded to f32: with it, bodies
/// that slide along each other closer than that would count as near each other everywhere.
///
/// # Guarantee
/// For a unit vector n, no point of the body is farther along n from the centre than the sum of `half` times the
/// components of n along the axes, and `slack`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BodyBox {
    pub(crate) centre: DVec3,
    /// The axes of the box as columns; `slack` covers their error.
    pub(crate) axes: DMat3,
    pub(crate) half: DVec3,
    /// An upper bound of the distances of the pieces' points from the centre.
    pub(crate) radius: f64,
    /// The pieces' rounding radius, plus the error of the axes and half extents.
    pub(crate) slack: f64,
}

impl BodyBox {
    /// Fits the box to all points of a body.
    pub(super) fn fit_to(node_points: &NodePoints<'_>, sample: &mut Sample) -> Self {
        sample.fill_from(node_points);
        let axes = best_frame(sample, node_points.triangles);
        let turned = axes.transpose();
        let (low, high) =
            crate::body::hierarchy::bounding_box(node_points.points.iter().map(|&p| turned * p));
        let centre = axes * (0.5 * (low + high));
        let (mut half, mut radius) = (DVec3::ZERO, 0.0);
        for &point in node_points.points {
            let way = point - centre;
            let along = (turned * way).abs();
            half = DVec3::new(
                greater(half.x, along.x),
                greater(half.y, along.y),
                greater(half.z, along.z),
            );
            radius = greater(radius, length(way));
        }
        // A point's components along the axes add up to the point, except for the deviation of the axes from an
        // orthonormal frame: three times the largest entry. Differences, products and sums of components are off by
        // 8u of the radius each.
        let off = turned * axes - DMat3::IDENTITY;
        let largest = off
            .to_cols_array()
            .into_iter()
            .fold(0.0, |sum, entry| greater(sum, entry.abs()));
        BodyBox {
            centre,
            axes,
            half,
            radius: (radius + node_points.radius) * (1.0 + 8.0 * UNIT_ROUNDOFF_F64),
            slack: node_points.radius + (3.0 * largest + 32.0 * UNIT_ROUNDOFF_F64) * radius,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tests::double::{Double, Double3};
    use crate::tests::scene::{RngExt, direction, magnitude, rng, rotation};
    use crate::tests::worst::{Worst, share};

    /// Compares the slack of a body without rounding radius with the exact heights of all points along a direction.
    #[test]
    fn worst_slack() {
        let mut sample = Sample::EMPTY;
        let found = Worst::of("Whole::slack", 20_000).search(|tape| {
            let [u, v, w, middle] = [(); 4].map(|()| DVec3::from(tape.vector(-20..=0)));
            let points = [(); 6].map(|()| {
                let at = u * tape.any(-8..=0) + v * tape.any(-8..=0) + w * tape.any(-8..=0);
                middle + at
            });
            let node_points = NodePoints {
                points: &points,
                radius: 0.0,
                triangles: tape.pick(2) == 0,
            };
            let whole = BodyBox::fit_to(&node_points, &mut sample);
            // An axis of the box, or nearly, or any direction.
            let axis = whole.axes.col(tape.pick(3));
            let n = match tape.pick(3) {
                0 => axis,
                1 => axis.map(|x| tape.near(x)),
                _ => DVec3::from(tape.vector(-20..=0)),
            };
            let n = Double3::from(n);
            let length = n.dot(n).sqrt().get();
            let along = |axis: DVec3| {
                let part = n.dot(Double3::from(axis));
                part.max(-part)
            };
            let half = whole.half.to_array();
            let reach = (0..3)
                .map(|k| along(whole.axes.col(k)) * Double::from(half[k]))
                .fold(Double::ZERO, |sum, part| sum + part);
            let over = |&point: &DVec3| {
                let way = Double3::from(point) - Double3::from(whole.centre);
                (n.dot(way) - reach).get()
            };
            let over = points.iter().map(over).fold(f64::NEG_INFINITY, greater);
            (length > 0.0 && whole.radius > 0.0).then(|| share(over, whole.slack * length))
        });
        found.is_within(30.0);
    }

    #[test]
    fn no_point_reaches_out_of_the_box_and_flat_faces_are_known_to_rounding() {
        let mut rng = rng(5);
        let mut sample = Sample::EMPTY;
        for _ in 0..300 {
            let size = magnitude(&mut rng, -9.0, 9.0);
            let turn = rotation(&mut rng);
            let count = rng.random_range(1..200);
            // The points are on the faces of a box, which is rotated and away from the origin.
            let middle = 10.0 * size * direction(&mut rng);
            let points: Vec<DVec3> = (0..3 * count)
                .map(|k| {
                    let mut at = direction(&mut rng);
                    at[k % 3] = at[k % 3].signum();
                    middle + turn * (size * at)
                })
                .collect();
            let node_points = NodePoints {
                points: &points,
                radius: 0.0,
                triangles: rng.random_bool(0.5),
            };
            let whole = BodyBox::fit_to(&node_points, &mut sample);
            assert!(
                whole.slack <= 1e-13 * size * 2.0,
                "{} of {size}",
                whole.slack
            );
            for _ in 0..20 {
                let n = direction(&mut rng);
                let along = (whole.axes.transpose() * n).abs();
                let reach = along.dot(whole.half) + whole.slack;
                for &point in &points {
                    let height = n.dot(point - whole.centre);
                    assert!(height <= reach, "{height} {reach}");
                }
            }
        }
    }
}
