//! Tests ranges of paths against sampled configurations, and against mechanisms with known answers.

use super::*;
use crate::solver::tests::{
    configuration_between, least_distance, random_cell, random_configuration,
};
use crate::{Cell, Joint, Link, LinkPairs, PositionRule, Robot};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rigid_ccd::glam::DQuat;
use rigid_ccd::{Body, Pose, Settings, trajectory};
use std::f64::consts::PI;
use std::time::Duration;

fn settings_with_margin(margin: f64) -> Settings {
    Settings {
        margin,
        tolerance: 1e-6,
        ..Settings::DEFAULT
    }
}

/// Tests random cells: sampled distances agree with the verdicts, ranges are contiguous, and little is unverified.
#[test]
fn sampled_distances_are_on_the_proven_side() {
    let mut random = Pcg64::seed_from_u64(21);
    let (mut kept, mut violated, mut unverified, mut length) = (0, 0, 0.0, 0.0);
    for number in 0..120 {
        let cell = random_cell(&mut random);
        let margin = [0.0, 0.05, 0.2][number % 3];
        let path: Vec<Vec<f64>> = (0..random.random_range(2..4))
            .map(|_| random_configuration(&mut random, cell.robot()))
            .collect();
        let mut solver = cell.solver().with_settings(settings_with_margin(margin));
        let ranges = solver
            .clearance_ranges(&path, RangeSettings::DEFAULT)
            .unwrap();
        let at = |point: PathPoint| point.segment as f64 + point.fraction;
        assert_eq!(at(ranges[0].from), 0.0);
        assert_eq!(at(ranges[ranges.len() - 1].to), (path.len() - 1) as f64);
        length += (path.len() - 1) as f64;
        for (k, range) in ranges.iter().enumerate() {
            if k > 0 {
                assert_eq!(at(ranges[k - 1].to), at(range.from));
                assert_ne!(ranges[k - 1].verdict, range.verdict);
            }
            if range.verdict == ClearanceVerdict::Unverified {
                unverified += at(range.to) - at(range.from);
            }
            for sample in 0..=8 {
                let there =
                    at(range.from) + f64::from(sample) / 8.0 * (at(range.to) - at(range.from));
                let there = PathPoint::from_path_position(there, path.len() - 1);
                let ends = [&path[there.segment], &path[there.segment + 1]];
                let distance = least_distance(
                    &cell,
                    &configuration_between(ends[0], ends[1], there.fraction),
                );
                match range.verdict {
                    ClearanceVerdict::Kept => {
                        assert!(distance > margin, "{distance} of {margin} in {range:?}");
                    }
                    ClearanceVerdict::Violated if margin > 0.0 => {
                        assert!(distance < margin, "{distance} in {range:?}");
                    }
                    ClearanceVerdict::Violated => {
                        assert!(distance <= 0.0, "{distance} in {range:?}");
                    }
                    ClearanceVerdict::Unverified => {}
                }
                kept += usize::from(range.verdict == ClearanceVerdict::Kept);
                violated += usize::from(range.verdict == ClearanceVerdict::Violated);
            }
        }
    }
    assert!(kept > 500 && violated > 500, "{kept} {violated}");
    // Overlaps of non-convex bodies at a margin of 0 are not proven.
    assert!(unverified < 0.1 * length, "{unverified} of {length}");
}

/// Tests that the path is unverified from the deadline on.
#[test]
fn without_time_nothing_is_verified() {
    let mut random = Pcg64::seed_from_u64(22);
    let cell = random_cell(&mut random);
    let settings = Settings {
        deadline: Some(Duration::ZERO),
        ..Settings::DEFAULT
    };
    let path = [(); 2].map(|()| random_configuration(&mut random, cell.robot()));
    let mut solver = cell.solver().with_settings(settings);
    let ranges = solver
        .clearance_ranges(&path, RangeSettings::DEFAULT)
        .unwrap();
    let [
        ClearanceRange {
            verdict: ClearanceVerdict::Unverified,
            to,
            ..
        },
    ] = ranges[..]
    else {
        panic!("{ranges:?}");
    };
    assert_eq!(to.fraction, 1.0);
}

/// Tests that a budget limits the whole question at any resolution, and that its verdicts hold.
#[test]
fn a_budget_ends_the_question() {
    let cell = lid_with_stop(1.0);
    let finest = RangeSettings {
        resolution: 1e-9,
        ..RangeSettings::DEFAULT
    };
    let mut verified = Vec::new();
    for budget in [1, 100, 10_000] {
        let settings = Settings {
            budget,
            ..settings_with_margin(0.1)
        };
        let mut solver = cell.solver().with_settings(settings);
        let path: Vec<[f64; 1]> = (0..4).map(|k| [0.5 * f64::from(k)]).collect();
        let ranges = solver.clearance_ranges(&path, finest).unwrap();
        let last = ranges[ranges.len() - 1];
        assert_eq!((last.to.segment, last.to.fraction), (2, 1.0));
        let known = ranges
            .iter()
            .filter(|range| range.verdict != ClearanceVerdict::Unverified);
        let length = |range: &ClearanceRange| {
            let at = |point: PathPoint| point.segment as f64 + point.fraction;
            at(range.to) - at(range.from)
        };
        verified.push(known.map(length).sum::<f64>());
        // The balls of radius 0.1 are nearer than 0.1 if the angle between them is below this.
        let near = angle_of_gap(0.1);
        for range in ranges.iter() {
            let angle = |point: PathPoint| 0.5 * (point.segment as f64 + point.fraction);
            let [from, to] = [range.from, range.to].map(|point| angle(point) - 1.0);
            match range.verdict {
                ClearanceVerdict::Kept => assert!(to < -near || from > near, "{range:?}"),
                ClearanceVerdict::Violated => assert!(from > -near && to < near, "{range:?}"),
                ClearanceVerdict::Unverified => {}
            }
        }
    }
    assert!(
        verified[0] < verified[1] && verified[1] <= verified[2],
        "{verified:?}"
    );
    assert!(verified[0] < 2.0 && verified[2] > 2.9, "{verified:?}");
}

fn joint(
    name: &str,
    [parent, child]: [&str; 2],
    joint: trajectory::Joint,
    position: PositionRule,
) -> Joint {
    Joint {
        name: name.into(),
        parent: parent.into(),
        child: child.into(),
        geometry: joint,
        position_rule: position,
    }
}

fn hinge_at(at: [f64; 3]) -> trajectory::Joint {
    trajectory::Joint::revolute(Pose::at(at).unwrap(), [0.0, 0.0, 1.0]).unwrap()
}

/// A hinged lid with a ball at its end, about 1 from the axis, and a stop: a ball at the same distance, at an angle.
fn lid_with_stop(stop_angle: f64) -> Cell {
    let ball = || Body::sphere(0.1).unwrap();
    let lid = Link::named("lid").with_body(ball(), Pose::at([1.0, 0.0, 0.0]).unwrap());
    let hinge = joint(
        "hinge",
        ["frame", "lid"],
        hinge_at([0.0; 3]),
        PositionRule::Independent,
    );
    let robot = Robot::new(vec![Link::named("frame"), lid], vec![hinge]).unwrap();
    let mut cell = Cell::new(robot.clone(), LinkPairs::from_robot(&robot));
    let (sine, cosine) = stop_angle.sin_cos();
    cell.add_obstacle("stop", ball(), Pose::at([cosine, sine, 0.0]).unwrap())
        .unwrap();
    cell
}

/// Returns the angle at which two balls of radius 0.1, both about 1 from a hinge, have the given gap.
fn angle_of_gap(gap: f64) -> f64 {
    2.0 * f64::asin(0.5 * (gap + 0.2))
}

/// Tests the range borders of a hinge with a stop, and that an overlap is proven without a margin.
#[test]
fn a_stop_of_a_hinge_limits_it() {
    let cell = lid_with_stop(2.0);
    for gap in [0.0, 0.003, 0.4] {
        let mut solver = cell.solver().with_settings(settings_with_margin(gap));
        let ranges = solver
            .clearance_ranges(&[[0.0], [PI]], RangeSettings::DEFAULT)
            .unwrap();
        let verdicts: Vec<ClearanceVerdict> = ranges.iter().map(|range| range.verdict).collect();
        use ClearanceVerdict::{Kept, Unverified, Violated};
        assert_eq!(verdicts, [Kept, Unverified, Violated, Unverified, Kept]);
        let borders = [2.0 - angle_of_gap(gap), 2.0 + angle_of_gap(gap)];
        for (border, range) in borders.iter().zip([ranges[1], ranges[3]]) {
            let [from, to] = [range.from, range.to].map(|at| PI * at.fraction);
            assert!(from <= *border && *border <= to, "{border} in {range:?}");
            assert!(to - from <= 2.001 * PI / 4096.0, "{range:?}");
        }
    }
}

/// Tests that overlaps of thin bodies and of concentric bodies are violations without a margin.
#[test]
fn deep_overlaps_are_violated() {
    let turned = DQuat::from_rotation_z(0.3);
    let rod = Body::cuboid([1.0, 0.05, 0.05]).unwrap();
    let slides = trajectory::Joint::prismatic(Pose::IDENTITY, [1.0, 0.0, 0.0]).unwrap();
    let turns = hinge_at([0.0; 3]);
    let post = Body::cuboid([0.05, 1.0, 0.05]).unwrap();
    let (shaft, hub) = (Body::cylinder(0.1, 1.0), Body::cylinder(0.5, 0.3));
    for (moves, shape, pose, obstacle, at) in [
        (
            slides,
            rod,
            Pose::new([0.0; 3], turned),
            post,
            [0.3, -0.2, 0.0],
        ),
        (
            turns,
            shaft.unwrap(),
            Ok(Pose::IDENTITY),
            hub.unwrap(),
            [0.0; 3],
        ),
    ] {
        let link = Link::named("part").with_body(shape, pose.unwrap());
        let moves = joint("joint", ["frame", "part"], moves, PositionRule::Independent);
        let robot = Robot::new(vec![Link::named("frame"), link], vec![moves]).unwrap();
        let mut cell = Cell::new(robot.clone(), LinkPairs::from_robot(&robot));
        cell.add_obstacle("obstacle", obstacle, Pose::at(at).unwrap())
            .unwrap();
        let mut solver = cell.solver();
        let ranges = solver
            .clearance_ranges(&[[-0.5], [0.5]], RangeSettings::DEFAULT)
            .unwrap();
        assert!(
            ranges[0].verdict == ClearanceVerdict::Violated && ranges.len() == 1,
            "{ranges:?}"
        );
    }
}

/// Tests that a pose error moves the borders on both sides.
#[test]
fn an_error_of_poses_is_kept_on_both_sides() {
    let cell = lid_with_stop(2.0);
    let mut solver = cell.solver().with_settings(settings_with_margin(0.1));
    let settings = RangeSettings {
        max_pose_error: 0.01,
        ..RangeSettings::DEFAULT
    };
    let ranges = solver.clearance_ranges(&[[0.0], [2.0]], settings).unwrap();
    let [kept, unverified, violated] = ranges[..] else {
        panic!("{ranges:?}")
    };
    assert_eq!(
        [kept.verdict, violated.verdict],
        [ClearanceVerdict::Kept, ClearanceVerdict::Violated]
    );
    // Both balls may deviate.
    let [from, to] = [unverified.from, unverified.to].map(|at| 2.0 * at.fraction);
    assert!(
        (from - (2.0 - angle_of_gap(0.12))).abs() < 1e-3,
        "{unverified:?}"
    );
    assert!(
        (to - (2.0 - angle_of_gap(0.08))).abs() < 1e-3,
        "{unverified:?}"
    );
    // The following questions assume exact poses.
    assert!(
        solver
            .is_free(&[[0.0], [2.0 - angle_of_gap(0.101)]])
            .unwrap()
    );
}

/// Tests that invalid settings are refused.
#[test]
fn settings_of_ranges_are_checked() {
    let cell = lid_with_stop(2.0);
    let mut solver = cell.solver();
    for (resolution, pose_error) in [
        (0.0, 0.0),
        (f64::NAN, 0.0),
        (0.1, -1.0),
        (0.1, f64::INFINITY),
    ] {
        let settings = RangeSettings {
            resolution,
            max_pose_error: pose_error,
        };
        let error = solver
            .clearance_ranges(&[[0.0], [1.0]], settings)
            .unwrap_err();
        assert!(
            matches!(error, PathError::InvalidRangeSetting { .. }),
            "{error}"
        );
    }
}
