//! Tests bounds over boxes of positions against random positions in them.

use super::*;
use crate::pairs::LinkPairs;
use crate::test_robots::{least_distance_of_links, random_robot, with_symmetric_limits};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

/// Tests that no position in a box contradicts either bound, and that the first-order bound is often the better one.
#[test]
fn no_position_in_a_box_is_nearer_than_its_bounds() {
    let mut random = Pcg64::seed_from_u64(5);
    let (mut bounds, mut better, mut tight) = (0, 0, 0);
    for _ in 0..150 {
        let robot = with_symmetric_limits(&random_robot(&mut random), 2.0);
        let unlimited = with_symmetric_limits(&robot, 100.0);
        let pairs = LinkPairs::from_robot(&robot);
        let links: Vec<[usize; 2]> = pairs.all_pairs().collect();
        let cell = Cell::new(robot, pairs);
        let mut measurer = Measurer::new(&cell, None);
        for links in links {
            let pair = LinkPair::new(&cell, &measurer.placement, links).unwrap();
            let size = [0.003, 0.05, 0.3, 1.5][random.random_range(0..4)];
            let ranges = pair.joints.all_positions.ranges.iter().map(|&[low, high]| {
                let middle = random.random_range(low..=high);
                let half = size * random.random_range(0.0..1.0);
                [middle - half, middle + half]
            });
            let joint_box = JointBox::new(ranges.collect());
            let Some([gap, displacement, first_order]) = measurer.bounds(&pair, &joint_box) else {
                continue;
            };
            let samples = (0..40).map(|_| {
                let ranges = joint_box.ranges.iter();
                let positions = ranges.map(|&[low, high]| match random.random_range(0..3) {
                    0 => low,
                    1 => high,
                    _ => random.random_range(low..=high),
                });
                let positions: Vec<f64> = positions.collect();
                least_distance_of_links(&unlimited, links, &pair.joints.configuration(&positions))
            });
            let least = samples.fold(f64::INFINITY, lesser);
            assert!(least >= gap - displacement, "{least} {gap} {displacement}");
            assert!(least >= first_order, "{least} {first_order}");
            bounds += 1;
            better += usize::from(first_order > gap - displacement);
            tight += usize::from(first_order > 0.9 * least);
        }
    }
    let enough = bounds > 500 && 3 * better > bounds && tight > 50;
    assert!(enough, "{bounds} {better} {tight}");
}

impl Measurer<'_> {
    /// Returns, for the first pair of parts, the gap at the center of a box, the displacement bound and the
    /// first-order bound; `None` if the hulls overlap at the center.
    fn bounds(&mut self, pair: &LinkPair, joint_box: &JointBox) -> Option<[f64; 3]> {
        self.place_box(&pair.joints, joint_box);
        let placed = self.placed_parts(&pair.part_pairs[0]);
        let displacement = self.motion.displacement(placed.parts, placed.centers);
        let ([gap, _], axis) = placed.hull_distance([f64::INFINITY, 0.0]);
        let frames = [&placed.frames[0], &placed.frames[1]];
        let direction = axis / axis.length();
        let lower = self
            .motion
            .gap_lower_bound(direction, placed.parts, frames, gap);
        (gap > 0.0).then_some([gap, displacement.bound, lower])
    }
}
