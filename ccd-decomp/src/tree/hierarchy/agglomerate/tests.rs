use super::super::nodes::{AabbF32, Node};
use super::{best_neighbour_indices, spread_bits};
use ccd_core::glam::Vec3A;
use proptest::prelude::*;

/// Generates boxes with corners on a coarse grid, so that many joint boxes have equal areas.
fn boxes_on_grid() -> impl Strategy<Value = Vec<Node>> {
    let number = || (0u8..8).prop_map(f32::from);
    let corner = move || [number(), number(), number()].prop_map(Vec3A::from);
    let node = (corner(), corner()).prop_map(|(p, q)| {
        let cuboid = AabbF32 {
            lo: p.min(q),
            hi: p.max(q),
        };
        Node::leaf(0, cuboid)
    });
    prop::collection::vec(node, 2..40)
}

proptest! {
    #[test]
    fn the_best_neighbour_is_the_last_of_the_cheapest(row in boxes_on_grid(), reach in 1usize..=6) {
        let best = best_neighbour_indices(&row, reach);
        for (index, node) in row.iter().enumerate() {
            let price = |other: usize| node.cuboid.union(row[other].cuboid).half_area();
            let near = (0..row.len()).filter(|&k| k != index && k.abs_diff(index) <= reach);
            let cheapest = near.rev().min_by(|&a, &b| price(a).total_cmp(&price(b)));
            prop_assert_eq!(Some(best[index]), cheapest);
        }
    }

    #[test]
    fn every_bit_goes_to_three_times_its_place(bits in 0u32..1 << 21) {
        let slow: u64 = (0..21).map(|k| (u64::from(bits) >> k & 1) << (3 * k)).sum();
        prop_assert_eq!(spread_bits(bits), slow);
    }
}
