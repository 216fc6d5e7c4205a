//! Tests bounds of second derivatives against differences of positions.

use super::*;
use crate::solver::tests::{configuration_between, random_cell, random_configuration};
use ccd_core::order::lesser;
use rand::SeedableRng;
use rand_pcg::Pcg64;

/// The time between the positions of which differences are formed.
const STEP: f64 = 1e-3;

#[test]
fn no_point_accelerates_faster() {
    let mut random = Pcg64::seed_from_u64(5);
    let (mut tightest, mut compared, mut prismatic) = (f64::INFINITY, 0, 0);
    for _ in 0..80 {
        let cell = random_cell(&mut random);
        let kinematics = cell.kinematics();
        let [from, to] = [0, 1].map(|_| random_configuration(&mut random, cell.robot()));
        let position = |configuration: &[f64]| -> Vec<f64> {
            let joints = kinematics.joints().iter();
            joints
                .map(|joint| joint.source.position(configuration))
                .collect()
        };
        let [starts, ends] = [&from, &to].map(|at| position(at));
        let rates: Vec<f64> = starts
            .iter()
            .zip(&ends)
            .map(|(from, to)| to - from)
            .collect();
        let largest = starts.iter().zip(&ends);
        let largest: Vec<f64> = largest.map(|(a, b)| greater(a.abs(), b.abs())).collect();
        prismatic += kinematics
            .joints()
            .iter()
            .filter(|joint| joint.is_prismatic)
            .count();
        for part in &cell.parts()[..cell.robot_part_count()] {
            let mut ancestor = part.frame;
            loop {
                let arms = JointArms::new(kinematics, (part.frame, part.points()), ancestor);
                let bound = arms.motion_bounds(&rates, &largest).acceleration;
                let mut fastest: f64 = 0.0;
                for k in 0..10 {
                    let at = 0.05 + 0.09 * f64::from(k);
                    let places = [at - STEP, at, at + STEP].map(|time| {
                        let mut frames = Vec::new();
                        let configuration = configuration_between(&from, &to, time);
                        kinematics.place(position(&configuration).into_iter(), &mut frames);
                        let seen_from = frames[ancestor];
                        let point = |corner: &DVec3| {
                            let point = frames[part.frame].transform_point(*corner);
                            seen_from.inverse_transform_vector(point - seen_from.translation)
                        };
                        part.points().iter().map(point).collect::<Vec<_>>()
                    });
                    let [before, here, after] = &places;
                    for ((before, &here), &after) in before.iter().zip(here).zip(after) {
                        let second = (after - 2.0 * here + *before) / (STEP * STEP);
                        fastest = greater(fastest, second.length());
                    }
                }
                assert!(fastest <= bound + 1e-7, "{fastest} {bound}");
                if fastest > 1e-3 {
                    compared += 1;
                    tightest = lesser(tightest, bound / fastest);
                }
                if ancestor == 0 {
                    break;
                }
                ancestor = kinematics.joints()[ancestor - 1].parent;
            }
        }
    }
    assert!(compared > 300 && prismatic > 20, "{compared} {prismatic}");
    // A single joint turns its corners at exactly this rate.
    assert!(tightest < 1.0 + 1e-4, "{tightest}");
}
