//! Compares box tests with exact fractions, in the worst cases that a search finds.

use super::{Extent, OrientedBox};
use crate::rational::{Exact3, exact};
use crate::search::element::Element;
use crate::tolerance::box_rounding;
use crate::worst::{RandomCase, Worst, share};
use ccd_core::glam::DVec3;
use ccd_core::order::greater;
use ccd_core::vector::unit;
use dashu_ratio::Relaxed;

/// Draws a box around a triangle, and three points; all may be far from the origin.
fn setting(tape: &mut RandomCase) -> (OrientedBox, [DVec3; 3]) {
    let scale = tape.size(-300..=39);
    let middle = DVec3::from(tape.vector(-8..=0));
    let small = tape.size(-50..=0);
    let mut point = || (middle + DVec3::from(tape.vector(-8..=0)) * small) * scale;
    let element = Element {
        corners: [point(), point(), point()],
        face: 0,
    };
    let points = [point(), point(), point()];
    (OrientedBox::around(&[element]), points)
}

/// Returns the exact extent of a box along a direction, from its centre.
fn reach(of: &OrientedBox, direction: DVec3) -> Relaxed {
    let along = Exact3::of(direction);
    let absolute = |x: Relaxed| if x < Relaxed::ZERO { -x } else { x };
    let halves = of.halves.to_array();
    let axes = (0..3).map(|k| absolute(along.dot(&Exact3::of(of.axes[k]))) * exact(halves[k]));
    let slack = along.0.clone().into_iter().map(absolute);
    let slack = slack.fold(exact(0.0), |sum, x| sum + x) * exact(of.slack);
    axes.fold(slack, |sum, x| sum + x)
}

/// Searches for the largest error of the interval test between a shape and a box.
#[test]
fn worst_extent() {
    let found = Worst::of("box_rounding, an extent", 10_000).search(|tape| {
        let (of, points) = setting(tape);
        let direction = unit(tape.vector(-40..=0).into())?;
        let extent = Extent::along(&points, direction);
        // The same as `Extent::misses`.
        let along = extent.direction.dot(of.centre - extent.base);
        let apart = along - of.support(extent.direction) - extent.hi;
        let exactly = Exact3::of(direction);
        let ahead = |p: &DVec3| exactly.dot(&Exact3::of(of.centre).minus(&Exact3::of(*p)));
        let least = points
            .iter()
            .map(ahead)
            .reduce(|a, b| if b < a { b } else { a })?;
        let truth = least - reach(&of, direction);
        let error = (exact(apart) - truth).to_f64().value();
        let allowed = box_rounding(direction, greater(extent.reach, of.reach));
        Some(share(error, allowed))
    });
    found.is_within(200.0);
}

/// Searches for the largest error of the test that separates a point from a box along an axis of the box.
#[test]
fn worst_beside() {
    let found = Worst::of("box_rounding, beside a box", 10_000).search(|tape| {
        let (of, [point, ..]) = setting(tape);
        let k = tape.pick(3);
        let axis = of.axes[k];
        let way = axis.dot(point - of.centre);
        let truth = Exact3::of(axis).dot(&Exact3::of(point).minus(&Exact3::of(of.centre)));
        let error = (exact(way) - truth).to_f64().value();
        let reach = greater(of.reach, point.abs().max_element());
        Some(share(error.abs(), box_rounding(axis, reach)))
    });
    found.is_within(120.0);
}
