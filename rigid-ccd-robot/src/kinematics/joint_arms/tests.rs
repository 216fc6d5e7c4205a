//! Tests bounds of second derivatives against differences of positions.

use super::*;
use crate::solver::tests::{random_cell, random_configuration, random_segment};
use ccd_core::order::lesser;
use rand::SeedableRng;
use rand_pcg::Pcg64;

/// The time between the positions of which differences are formed.
const STEP: f64 = 1e-3;

#[test]
fn no_point_accelerates_faster() {
    let mut random = Pcg64::seed_from_u64(5);
    let (mut tightest, mut compared) = (f64::INFINITY, 0);
    let (mut prismatic, mut curved) = (0, 0);
    for _ in 0..80 {
        let cell = random_cell(&mut random);
        let kinematics = cell.kinematics();
        let ends = [(); 2].map(|()| random_configuration(&mut random, cell.robot()));
        let path = random_segment(&mut random, &cell, [&ends[0], &ends[1]]);
        let joints = 0..kinematics.joints().len();
        let motions: Vec<_> = joints.map(|joint| path.joint_motion(0, joint)).collect();
        curved += usize::from(!path.has_constant_rates());
        prismatic += kinematics
            .joints()
            .iter()
            .filter(|joint| joint.is_prismatic)
            .count();
        for part in &cell.parts()[..cell.robot_part_count()] {
            let mut ancestor = part.frame;
            loop {
                let arms = JointArms::new(kinematics, (part.frame, part.points()), ancestor);
                let bound = arms.acceleration_bound(|joint| motions[joint]);
                let mut fastest: f64 = 0.0;
                for k in 0..10 {
                    let at = 0.05 + 0.09 * f64::from(k);
                    let places = [at - STEP, at, at + STEP].map(|time| {
                        let (mut positions, mut frames) = (Vec::new(), Vec::new());
                        path.interpolate_in_segment(0, time, &mut positions);
                        kinematics.place(positions.into_iter(), &mut frames);
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
    let counts = [compared, prismatic, curved];
    assert!(
        compared > 300 && prismatic > 20 && curved > 20,
        "{counts:?}"
    );
    // A single joint turns its corners at exactly this rate.
    assert!(tightest < 1.0 + 1e-4, "{tightest}");
}
