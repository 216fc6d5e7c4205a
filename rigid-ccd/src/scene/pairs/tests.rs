//! Tests that the search in a tree finds the same pairs as a comparison of every two boxes.

use super::*;
use ccd_core::glam::DVec3;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

fn every_overlapping_pair(boxes: &[SweptBox]) -> Vec<[usize; 2]> {
    let pairs = (0..boxes.len()).flat_map(|a| (a + 1..boxes.len()).map(move |b| [a, b]));
    pairs.filter(|&[a, b]| boxes[a].meets(&boxes[b])).collect()
}

#[test]
fn pairs_are_those_of_the_twin() {
    let mut rng = Pcg64::seed_from_u64(1);
    let (mut meet, mut asked) = (0, 0);
    for round in 0..300 {
        let count: usize = rng.random_range(0..120);
        // Many boxes at one place, boxes of all sizes, and points.
        let spread = [0.0, 1.0, 1e3, 1e12][round % 4];
        let mut boxes: Vec<SweptBox> = (0..count)
            .map(|_| {
                let mut any =
                    || DVec3::from_array(std::array::from_fn(|_| rng.random_range(-1.0..1.0)));
                let (middle, half) = (any() * spread, any().abs());
                let half =
                    half * 10f64.powf(rng.random_range(-9.0..3.0)) * f64::from(round % 3 != 0);
                SweptBox {
                    min: middle - half,
                    max: middle + half,
                }
            })
            .collect();
        if count > 3 && round % 5 == 0 {
            boxes[1] = SweptBox {
                min: DVec3::splat(-1e15),
                max: DVec3::splat(1e15),
            };
            boxes[2] = boxes[0];
        }
        let pairs = overlapping_pairs(&boxes, |_| true);
        assert_eq!(pairs, every_overlapping_pair(&boxes), "{round}");
        meet += pairs.len();
        asked += count * count.saturating_sub(1) / 2;
    }
    assert!(meet > 10_000 && 2 * meet < asked, "{meet} of {asked}");
}

/// Tests that boxes that only touch, in a face or an edge, count as meeting.
#[test]
fn boxes_that_touch_meet() {
    let unit = |x: f64, y: f64| SweptBox {
        min: DVec3::new(x, y, 0.0),
        max: DVec3::new(x + 1.0, y + 1.0, 1.0),
    };
    let boxes = [
        unit(0.0, 0.0),
        unit(1.0, 0.0),
        unit(1.0, 1.0),
        unit(2.0, 2.0),
        unit(3.0_f64.next_up(), 3.0),
    ];
    let asked = |pair: [usize; 2]| pair != [1, 2];
    assert_eq!(overlapping_pairs(&boxes, asked), [[0, 1], [0, 2], [2, 3]]);
}

#[test]
fn a_leaf_outside_its_tree_is_detected() {
    let leaf = |x: f64| Aabb::new(Vector::new(x, 0.0, 0.0), Vector::new(x + 0.5, 1.0, 1.0));
    let leaves: Vec<Aabb> = (0..9).map(|k| leaf(f64::from(k))).collect();
    let tree = Bvh::from_leaves(BvhBuildStrategy::Binned, &leaves);
    assert!((0..9).all(|k| ancestor_boxes_contain(&tree, k, &leaves[k])));
    // This simulates a tree that lost a part.
    assert!(!ancestor_boxes_contain(&tree, 3, &leaf(40.0)));
    assert!(!ancestor_boxes_contain(&tree, 12, &leaves[3]));
}
