//! Tests the error bounds of frames and the displacement bounds of parts.

use super::*;
use crate::cell::rounding::{CoordinateBounds, pose_rounding};
use crate::kinematics::Kinematics;
use crate::kinematics::magnitude::Magnitude;
use crate::solver::displacement::DisplacementBounds;
use rigid_ccd::oracle::Frame;

/// Tests that frames agree with link poses within the rounding bound, and that the bound is less than a million times
/// the error.
#[test]
fn frames_are_within_the_bound_on_rounding() {
    let mut random = Pcg64::seed_from_u64(5);
    let mut largest_fraction = 0.0;
    for _ in 0..300 {
        let cell = random_cell(&mut random);
        let (robot, kinematics) = (cell.robot(), cell.kinematics());
        let configuration = random_configuration(&mut random, robot);
        let positions = kinematics
            .joints()
            .iter()
            .map(|joint| joint.source.position(&configuration));
        let positions: Vec<f64> = positions.collect();
        let mut frames = Vec::new();
        kinematics.place(positions.iter().copied(), &mut frames);
        let largest = positions.iter().map(|position| Magnitude {
            position: position.abs(),
            rounding: position.abs(),
        });
        let bound = pose_rounding(
            kinematics,
            CoordinateBounds::of_parts(cell.parts()),
            largest,
        )
        .of_points;
        for part in &cell.parts()[..cell.robot_part_count()] {
            let link = cell.link_of(part.owner);
            let pose = robot
                .pose(&robot.links()[link].name, &configuration)
                .unwrap();
            let pose = pose.compose(&cell.pose_in_link(part.owner));
            let body = &cell.bodies()[part.owner].body;
            for &point in body.pieces().points() {
                let in_frame = cell.bodies()[part.owner].pose.transform_point(point);
                let found = frames[part.frame].transform_point(in_frame);
                let fraction = found.distance(pose.transform_point(point)) / bound;
                largest_fraction = greater(largest_fraction, fraction);
            }
        }
    }
    assert!(
        largest_fraction < 1.0 && largest_fraction > 1e-4,
        "{largest_fraction}"
    );
}

/// Tests that no point of a part moves farther than the bounds, relative to the base and to each frame in between.
#[test]
fn displacements_are_within_their_bounds() {
    let mut random = Pcg64::seed_from_u64(6);
    let mut largest_fraction = 0.0;
    for _ in 0..200 {
        let cell = random_cell(&mut random);
        let kinematics = cell.kinematics();
        let parts = &cell.parts()[..cell.robot_part_count()];
        let ends = [(); 2].map(|()| random_configuration(&mut random, cell.robot()));
        let half = random.random_range(0.01..0.5);
        let fraction = FramesAndRates::new(kinematics, &ends, 0.5);
        let mut displacements = DisplacementBounds::new(kinematics, parts);
        displacements.update(
            kinematics,
            parts,
            &fraction.frames,
            &fraction
                .rates
                .iter()
                .map(|rate| half * rate)
                .collect::<Vec<_>>(),
            1e-12,
        );
        for _ in 0..10 {
            let later =
                FramesAndRates::new(kinematics, &ends, 0.5 + random.random_range(-half..half));
            for (number, part) in parts.iter().enumerate() {
                for seen_from in 0..part.frame {
                    let Some(index) =
                        displacements.bound_index_seen_from(kinematics, number, seen_from)
                    else {
                        continue;
                    };
                    let bound = displacements.bound(Some(index));
                    for &point in part.points() {
                        let place = |frames: &[Frame]| {
                            frames[seen_from]
                                .inverse_transform_point(frames[part.frame].transform_point(point))
                        };
                        let moved = place(&fraction.frames).distance(place(&later.frames));
                        assert!(moved <= bound + 1e-12, "{moved} beyond {bound}");
                        if bound > 1e-6 {
                            largest_fraction = greater(largest_fraction, moved / bound);
                        }
                    }
                }
            }
        }
    }
    assert!(largest_fraction > 0.7, "{largest_fraction}");
}

/// The frames at a point of an edge, and the rates of its joints.
struct FramesAndRates {
    frames: Vec<Frame>,
    rates: Vec<f64>,
}

impl FramesAndRates {
    fn new(kinematics: &Kinematics, [from, to]: &[Vec<f64>; 2], fraction: f64) -> Self {
        let sources = kinematics.joints().iter().map(|joint| joint.source);
        let ends: Vec<[f64; 2]> = sources
            .map(|source| [source.position(from), source.position(to)])
            .collect();
        let mut frames = Vec::new();
        kinematics.place(
            ends.iter().map(|[from, to]| from + fraction * (to - from)),
            &mut frames,
        );
        let rates = ends.iter().map(|[from, to]| (to - from).abs()).collect();
        FramesAndRates { frames, rates }
    }
}
