use super::{Cluster, MORTON_SEARCH_RADIUS, mutual_count, nearest_neighbours, spread_bits};
use ccd_core::HierarchyNode;
use ccd_core::glam::Vec3A;
use proptest::prelude::*;

/// Generates centres on a coarse grid, so that many distances are equal.
fn centres_on_grid() -> impl Strategy<Value = Vec<Cluster>> {
    let number = || (0u8..8).prop_map(f32::from);
    let cluster = [number(), number(), number()].prop_map(|centre| cluster(Vec3A::from(centre)));
    prop::collection::vec(cluster, 2..300)
}

fn cluster(centre: Vec3A) -> Cluster {
    Cluster {
        centre,
        weight: 1.0,
        node: HierarchyNode::Leaf(0),
    }
}

proptest! {
    #[test]
    fn the_nearest_neighbour_is_the_first_of_the_nearest(row in centres_on_grid()) {
        let nearest = nearest_neighbours(&row);
        for (index, own) in row.iter().enumerate() {
            let near = (0..row.len()).filter(|&k| k != index && k.abs_diff(index) <= MORTON_SEARCH_RADIUS);
            let expected = near.min_by_key(|&k| {
                let distance = own.centre.distance_squared(row[k].centre);
                (distance.to_bits(), k.abs_diff(index), (k > index) != index.is_multiple_of(2))
            });
            prop_assert_eq!(Some(nearest[index]), expected);
        }
    }

    #[test]
    fn every_bit_goes_to_three_times_its_place(bits in 0u32..1 << 21) {
        let slow: u64 = (0..21).map(|k| (u64::from(bits) >> k & 1) << (3 * k)).sum();
        prop_assert_eq!(spread_bits(bits), slow);
    }
}

#[test]
fn clusters_with_one_centre_are_all_partners() {
    for count in [2, 7, 1000] {
        let partners = nearest_neighbours(&vec![cluster(Vec3A::ONE); count]);
        assert!(mutual_count(&partners) >= count as f32 - 1.0, "{count}");
    }
}
