use super::{
    Cluster, MORTON_SEARCH_RADIUS, MORTON_SHIFTS, NeighbourSearch, find_nearest_in_row,
    mutual_count, order_along_morton_curve, spread_bits,
};
use ccd_core::HierarchyNode;
use ccd_core::glam::Vec3A;
use proptest::prelude::*;

/// Generates centers on a coarse grid, so that many distances are equal.
fn centers_on_grid() -> impl Strategy<Value = Vec<Vec3A>> {
    let number = || (0u8..8).prop_map(f32::from);
    let center = [number(), number(), number()].prop_map(Vec3A::from);
    prop::collection::vec(center, 2..300)
}

proptest! {
    #[test]
    fn the_nearest_neighbour_is_the_first_of_the_nearest(row in centers_on_grid()) {
        let mut nearest = Vec::new();
        find_nearest_in_row(&row, &mut nearest);
        for (index, own) in row.iter().enumerate() {
            let near = (0..row.len()).filter(|&k| k != index && k.abs_diff(index) <= MORTON_SEARCH_RADIUS);
            let expected = near.min_by_key(|&k| {
                let distance = own.distance_squared(row[k]);
                (distance.to_bits(), k.abs_diff(index), (k > index) != index.is_multiple_of(2))
            });
            let place = nearest[index].place as usize;
            prop_assert_eq!(Some(place), expected);
            prop_assert_eq!(nearest[index].distance, own.distance_squared(row[place]));
        }
    }

    #[test]
    fn every_bit_goes_to_three_times_its_place(bits in 0u32..1 << 21) {
        let slow: u64 = (0..21).map(|k| (u64::from(bits) >> k & 1) << (3 * k)).sum();
        prop_assert_eq!(spread_bits(bits), slow);
    }
}

#[test]
fn clusters_with_one_center_are_all_partners() {
    for count in [2, 7, 1000] {
        let mut partners = Vec::new();
        find_nearest_in_row(&vec![Vec3A::ONE; count], &mut partners);
        assert!(mutual_count(&partners) >= count as f32 - 1.0, "{count}");
    }
}

/// Tests that the curves together find the nearest neighbour of nearly every point of a surface, as a single one does not.
#[test]
fn hardly_any_nearest_neighbour_is_missed() {
    let point = |k: u16| {
        let (x, y) = (f32::from(k % 61) / 61.0, f32::from(k / 61) / 61.0);
        // Moved off the grid, so that each point has one nearest neighbour.
        let shift = Vec3A::new((f32::from(k) * 1.3).sin(), (f32::from(k) * 2.1).sin(), 0.0);
        Vec3A::new(x, y, 0.4 + 0.3 * (3.0 * x).sin() * y) * 0.9 + 0.004 * (shift + 1.0)
    };
    let row: Vec<Cluster> = (0..3600)
        .map(|k| Cluster {
            center: point(k),
            weight: 1.0,
            node: HierarchyNode::Leaf(0),
        })
        .collect();
    let first = order_along_morton_curve(&row, 0.0);
    let row: Vec<Cluster> = first.iter().map(|&k| row[k as usize]).collect();
    let curves = MORTON_SHIFTS.map(|shift| order_along_morton_curve(&row, shift));
    let missed = |curves: &[Vec<u32>]| {
        let mut search = NeighbourSearch::default();
        search.find_nearest(&row, curves);
        let is_missed = |(index, own): (usize, &Cluster)| {
            let others = row.iter().enumerate().filter(|&(k, _)| k != index);
            let squares = others.map(|(_, other)| other.center.distance_squared(own.center));
            squares.min_by(f32::total_cmp) < Some(search.nearest[index].distance)
        };
        row.iter().enumerate().filter(|&at| is_missed(at)).count()
    };
    assert!(missed(&[]) > 200, "{}", missed(&[]));
    assert!(missed(&curves) < 50, "{}", missed(&curves));
}
