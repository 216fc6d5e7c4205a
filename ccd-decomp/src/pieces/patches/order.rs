//! The order in which patches start and grow.

use crate::solid::flats::ConvexPolygons;
use crate::solid::manifold::{Dihedral, Manifold};
use std::collections::VecDeque;

/// The order in which patches start at polygons, and grow to adjacent ones.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum PatchOrder {
    /// Patches start at the polygons farthest from reflex edges, and grow breadth first.
    #[default]
    Cresting,
    /// Patches start in the mesh's order, and grow breadth first.
    BreadthFirst,
    /// Patches start in the mesh's order, and grow depth first.
    DepthFirst,
}

/// Returns all polygons in the order in which they may start a patch.
pub(super) fn seed_order(
    manifold: &Manifold<'_>,
    flats: &ConvexPolygons,
    order: PatchOrder,
) -> Vec<u32> {
    let mut seeds: Vec<u32> = (0..flats.len() as u32).collect();
    if order == PatchOrder::Cresting {
        let height = reflex_distance_by_polygon(manifold, flats);
        seeds.sort_by_key(|&flat| std::cmp::Reverse(height[flat as usize]));
    }
    seeds
}

/// Returns for each polygon the number of steps over adjacent polygons to the nearest polygon with a reflex edge;
/// `u32::MAX` without reflex edges.
fn reflex_distance_by_polygon(manifold: &Manifold<'_>, flats: &ConvexPolygons) -> Vec<u32> {
    let mut height = vec![u32::MAX; flats.len()];
    let mut queue = VecDeque::new();
    for flat in 0..flats.len() as u32 {
        let rim = &flats.get(flat).rim;
        if rim
            .iter()
            .any(|&h| manifold.classify_dihedral(h) == Dihedral::Reflex)
        {
            height[flat as usize] = 0;
            queue.push_back(flat);
        }
    }
    while let Some(flat) = queue.pop_front() {
        for &edge in &flats.get(flat).rim {
            let next = flats.polygon_of_face(manifold.twin(edge) / 3);
            if height[next as usize] == u32::MAX {
                height[next as usize] = height[flat as usize] + 1;
                queue.push_back(next);
            }
        }
    }
    height
}

impl PatchOrder {
    /// Removes and returns the waiting polygon that a growing patch tries next.
    pub(super) fn pop(self, waiting: &mut VecDeque<u32>) -> Option<u32> {
        match self {
            PatchOrder::Cresting | PatchOrder::BreadthFirst => waiting.pop_front(),
            PatchOrder::DepthFirst => waiting.pop_back(),
        }
    }
}
