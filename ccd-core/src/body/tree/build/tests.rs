use super::*;
use crate::tests::scene::{SoupKind, body, random_triangle_soup, rng};

#[test]
fn layers_grow_evenly_up_to_all_pieces() {
    for pieces in [1, 8, 9, 48, 49, 10_000, 69_664, 1_000_000, 1 << 30] {
        let layer_capacities = layer_capacities(pieces);
        assert_eq!(layer_capacities[..2], [LANES, 48]);
        assert!(layer_capacities[layer_capacities.len() - 1] <= pieces.max(48));
        for pair in layer_capacities.windows(2) {
            assert!(
                pair[0] < pair[1] && pair[1] <= LANES * pair[0],
                "{layer_capacities:?}"
            );
        }
        // A node of all pieces is at most one layer above the last one.
        assert!(
            layer_capacities[layer_capacities.len() - 1] * LANES >= pieces,
            "{layer_capacities:?}"
        );
    }
}

#[test]
fn groups_are_half_full_at_least() {
    let triangles = random_triangle_soup(&mut rng(5), SoupKind::MixedSizes, 20_000, 0.02);
    let body = body(&triangles);
    let tree = body.tree();
    let lanes: usize = tree
        .box_groups
        .iter()
        .map(|group| group.header.count as usize)
        .sum();
    assert!(
        lanes >= 4 * tree.box_groups.len(),
        "{lanes}, {}",
        tree.box_groups.len()
    );
    assert_eq!(lanes + 1, tree.nodes.len());
    assert_eq!(tree.nodes.capacity(), tree.nodes.len());
}
