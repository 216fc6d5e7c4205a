//! Tests that the rounding bounds cover their derivations, which are repeated here.

use super::*;
use ccd_core::glam::DVec3;

/// Half a unit in the last place of 1.
const U: f64 = 1.0 / 9_007_199_254_740_992.0;

#[test]
fn allowances_are_those_of_their_derivations() {
    assert_eq!(excess_rounding_bound(0.0, 3.0), 768.0 * U);
    let direction = DVec3::new(1.0, -2.0, 3.0);
    assert_eq!(box_rounding_bound(direction, 5.0), 3_840.0 * U);
    assert_eq!(box_rounding_bound(direction, 0.0), f64::MIN_POSITIVE);
    assert_eq!(volume_rounding_bound(7.0, 0.0), 224.0 * U);
    // So many terms that their squares count.
    let terms = 67_108_864.0;
    assert_eq!(volume_rounding_bound(7.0, terms), 7.0 * (32.0 + 2.0) * U);
}

/// Tests that `MIN_CHILD_SHARE` limits a hull tree of a million pieces to 104 levels.
#[test]
fn a_tree_of_a_million_pieces_has_few_levels() {
    let levels = 1e6_f64.ln() / -(1.0 - MIN_CHILD_SHARE).ln();
    assert!((103.0..104.0).contains(&levels), "{levels}");
}
