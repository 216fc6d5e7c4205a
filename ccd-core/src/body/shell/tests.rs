//! Parts are connected where they share a point, and only there.

use super::shells;
use crate::tests::meshes::{cube, moved};
use crate::tests::scene::{direction, pieces, rng};
use glam::DVec3;

#[test]
fn parts_are_found_and_their_extremes() {
    let mut parts = Vec::new();
    for x in [0.0, 5.0, -7.0] {
        parts.extend(moved(&cube(1.0, 3), x * DVec3::X));
    }
    let found = shells(&pieces(&parts));
    assert_eq!(found.len(), 3);
    for shell in &found {
        let middle = 0.5 * (shell[0].x + shell[3].x);
        assert!([0.0, 5.0, -7.0].contains(&middle));
        for (side, point) in shell.iter().enumerate() {
            let sign = if side < 3 { 1.0 } else { -1.0 };
            let offset = if side % 3 == 0 { middle } else { 0.0 };
            assert_eq!(point[side % 3], offset + sign);
        }
    }
}

#[test]
fn one_point_in_common_connects_and_negative_zero_is_zero() {
    let corner = [DVec3::ZERO, DVec3::X, DVec3::Y];
    let touching = [-DVec3::ZERO, -DVec3::X, -DVec3::Y];
    assert_eq!(shells(&pieces(&[corner, touching])).len(), 1);
    let beside = touching.map(|p| p - 1e-300 * DVec3::ONE);
    assert_eq!(shells(&pieces(&[corner, beside])).len(), 2);
}

#[test]
fn a_chain_of_many_is_one_part_in_any_order() {
    let mut rng = rng(1);
    let mut chain = Vec::new();
    let mut at = DVec3::ZERO;
    for _ in 0..2_000 {
        let next = at + direction(&mut rng);
        chain.push([at, next, at + direction(&mut rng)]);
        at = next;
    }
    assert_eq!(shells(&pieces(&chain)).len(), 1);
    chain.reverse();
    assert_eq!(shells(&pieces(&chain)).len(), 1);
    let every_other: Vec<_> = chain.iter().step_by(2).copied().collect();
    assert_eq!(shells(&pieces(&every_other)).len(), 1_000);
}
