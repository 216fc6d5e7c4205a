//! Tests that links on curves deviate from their approximations by at most the bounds.

use super::*;
use crate::joint_curve::JointCurve;
use crate::path::PathSource;
use crate::solver::pair_chain::pair_chain;
use crate::solver::tests::{random_cell, random_configuration};
use ccd_core::order::greater;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rigid_ccd::trajectory::worst_deviation;

#[test]
fn links_on_curves_are_within_their_bounds() {
    let mut random = Pcg64::seed_from_u64(41);
    let mut worst_ratio = 0.0;
    for number in 0..60 {
        let cell = random_cell(&mut random);
        let mut rows = || [(); 2].map(|()| random_configuration(&mut random, cell.robot()));
        let (positions, velocities, accelerations) = (rows(), rows(), rows());
        let curve =
            JointCurve::quintic_hermite(&[0.0, 1.0], &positions, &velocities, &accelerations);
        let mut path = JointPath::default();
        curve.unwrap().write_to(&cell, &mut path).unwrap();
        let section = PathSection {
            path: &path,
            segment: 0,
            from: random.random_range(0.0..0.5),
            to: random.random_range(0.5..1.0),
        };
        let bodies = cell.robot_body_count();
        let [a, b] = [(); 2].map(|()| random.random_range(0..bodies));
        if a == b {
            continue;
        }
        let own = pair_chain(&cell, a, Some(b).filter(|_| number % 2 == 0));
        let link = CurvedLink {
            pair_chain: &own,
            section,
        };
        let worst = worst_deviation(&link, 1.0, 2.0, 3_000, number).unwrap();
        assert!(worst.ratio <= 1.0, "{worst:?}");
        worst_ratio = greater(worst_ratio, worst.ratio);
    }
    assert!(worst_ratio > 0.3, "{worst_ratio}");
}
