//! Tests what the ball test proves against distances at sampled configurations.

use super::*;
use crate::cell::rounding::largest_arm;
use crate::solver::measure::minkowski_support_vertex;
use crate::solver::placement::Placement;
use crate::solver::tests::{
    configuration_between, random_cell, random_configuration, random_segment,
};
use ccd_core::order::lesser;
use ccd_distance_gjk::bound_distance;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rigid_ccd::glam::DVec3;
use rigid_ccd::oracle::Frame;

/// Returns an upper bound of the distance of two parts.
fn distance(cell: &Cell, frames: &[Frame], [a, b]: [usize; 2]) -> f64 {
    let parts = [a, b].map(|part| &cell.parts()[part]);
    let frames = parts.map(|part| frames[part.frame]);
    if let Some(plane) = &parts[1].plane {
        return plane.lowest_corner_height(parts[0], &frames[0]) - parts[0].radius;
    }
    let vertex = |direction: DVec3| minkowski_support_vertex(parts, &frames, direction);
    bound_distance(vertex, DVec3::X, |_| false).upper - parts[0].radius - parts[1].radius
}

/// Returns a path of up to 30 segments, of unequal lengths, that strays from the straight way.
fn random_walk(random: &mut Pcg64, cell: &Cell, from: Vec<f64>, to: &[f64]) -> JointPath {
    let mut all = vec![from];
    let count = random.random_range(2..30);
    let stray = [0.0, 1e-3, 0.02][random.random_range(0..3)];
    for k in 1..=count {
        let fraction = (f64::from(k) + random.random_range(0.0..0.5)) / f64::from(count);
        let mut next = configuration_between(&all[0], to, fraction);
        for position in &mut next {
            *position += stray * random.random_range(-1.0..1.0);
        }
        all.push(next);
    }
    let mut path = JointPath::default();
    path.set_configurations(cell.kinematics(), &all);
    path
}

/// For each pair of parts that is checked, the intervals in which the test leaves it open.
fn open_intervals(
    cell: &Cell,
    test: &BallTest<'_>,
    pairs: &PartPairs<'_>,
) -> Vec<([usize; 2], u8)> {
    let of_robot = pairs
        .self_pairs()
        .iter()
        .map(|pair| [pair.a as usize, pair.b as usize]);
    let obstacles = cell.robot_part_count()..cell.parts().len();
    let moving = (0..cell.robot_part_count()).filter(|&part| cell.parts()[part].frame > 0);
    let with_obstacles = moving.flat_map(|part| obstacles.clone().map(move |other| [part, other]));
    let open = |parts: [usize; 2]| {
        let same = test.open_pairs().filter(|tested| {
            let pair = test.part_pair(pairs, tested.pair);
            [pair.a as usize, pair.b as usize] == parts
        });
        same.fold(0, |lanes, tested| lanes | tested.open)
    };
    of_robot
        .chain(with_obstacles)
        .map(|parts| (parts, open(parts)))
        .collect()
}

#[test]
fn a_pair_that_is_not_open_stays_apart_and_a_touching_pair_touches() {
    let mut random = Pcg64::seed_from_u64(31);
    let (mut free, mut long, mut open, mut touching, mut least) = (0, 0, 0, 0, f64::INFINITY);
    for round in 0..200 {
        let mut cell = random_cell(&mut random);
        if round % 5 == 0 {
            let pose = crate::test_robots::random_pose(&mut random, 2.0);
            cell.add_plane("plane", pose).unwrap();
        }
        let mut placement = Placement::new(&cell);
        let mut pairs = PartPairs::new(&cell, &placement.displacement_bounds);
        let margin = [0.0, 0.1][round % 2];
        pairs.set_margin(margin);
        let mut test = BallTest::new(&cell, &pairs);
        let from = random_configuration(&mut random, cell.robot());
        let to = random_configuration(&mut random, cell.robot());
        let to = configuration_between(&from, &to, [0.02, 0.2, 1.0, 4.0][round % 4]);
        let path = match round % 3 {
            0 => random_walk(&mut random, &cell, from, &to),
            _ => random_segment(&mut random, &cell, [&from, &to]),
        };
        placement.begin(&cell, &path);
        let arm = largest_arm(cell.kinematics(), placement.coordinates, path.magnitudes());
        test.set_path(arm, placement.rounding);
        let length = path.segment_count() as f64;
        let start = length * random.random_range(0.0..0.5);
        let end = start + length * random.random_range(1e-4..0.5);
        let lanes = Lanes::dividing(start, end);
        assert!(test.test((&path, &lanes), (&pairs, Margins::OfPairs), None));
        if let Some(pair) = test.touching() {
            touching += 1;
            let at = lanes.middle(pair.lane);
            let both = test.part_pair(&pairs, pair.pair);
            placement.place_frames(&cell, &path, at);
            let parts = [both.a as usize, both.b as usize];
            let found = distance(&cell, &placement.frames, parts);
            assert!(found <= 1e-9, "{found}");
            continue;
        }
        for (parts, left_open) in open_intervals(&cell, &test, &pairs) {
            for lane in 0..LANES {
                if left_open >> lane & 1 == 1 {
                    open += 1;
                    continue;
                }
                free += 1;
                long += usize::from(lanes.segment(lane).is_none());
                let [from, to] = lanes.ends(lane);
                for k in 0..=8 {
                    let at = from + (to - from) * f64::from(k) / 8.0;
                    placement.place_frames(&cell, &path, at);
                    let found = distance(&cell, &placement.frames, parts);
                    assert!(found > margin, "{found} {parts:?}");
                    least = lesser(least, found - margin);
                }
            }
        }
    }
    assert!(
        free > 2000 && long > 300 && open > 300 && touching > 20,
        "{free} {long} {open} {touching}"
    );
    // The bounds are not so loose that they would hold by chance.
    assert!(least < 0.02, "{least}");
}

/// Long links and fast joints have errors that are too large for f32.
#[test]
fn what_f32_cannot_resolve_is_refused() {
    let mut random = Pcg64::seed_from_u64(4);
    let cell = random_cell(&mut random);
    let placement = Placement::new(&cell);
    let pairs = PartPairs::new(&cell, &placement.displacement_bounds);
    let mut test = BallTest::new(&cell, &pairs);
    let mut path = JointPath::default();
    let ends = [0.0, 1.0].map(|x| vec![x; cell.robot().independent_joint_names().count()]);
    path.set_configurations(cell.kinematics(), &ends);
    for (longest_arm, rounding, is_usable) in [
        (10.0, 1e-12, true),
        (1e6, 1e-12, false),
        (10.0, f64::NAN, false),
    ] {
        test.set_path(longest_arm, rounding);
        let lanes = Lanes::dividing(0.0, 1.0);
        let pairs = (&pairs, Margins::OfPairs);
        assert_eq!(test.test((&path, &lanes), pairs, None), is_usable);
    }
}
