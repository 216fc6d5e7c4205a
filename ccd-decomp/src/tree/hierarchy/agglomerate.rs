//! Builds a tree by agglomeration: clusters that are each other's nearest neighbours become siblings, pass by pass, until one
//! is left (`[PLOC18]`).

use crate::tolerance::{MIN_MERGED_SHARE, MORTON_SEARCH_RADIUS};
use ccd_core::HierarchyNode;
use ccd_core::glam::{DVec3, Vec3A};
use rayon::prelude::*;

/// The number of clusters in a parallel task. Smaller tasks cost more than they gain.
const CLUSTERS_PER_TASK: usize = 512;

/// A set of pieces: a piece, or the root of a subtree.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cluster {
    /// The mean of the centres of the pieces, in the unit cube.
    pub(super) centre: Vec3A,
    /// The number of pieces.
    pub(super) weight: f32,
    pub(super) node: HierarchyNode,
}

/// Builds a binary tree over clusters. The root comes first, then pairs of siblings, parents before children.
///
/// Siblings are near each other, and not those with the least joint box: boxes of the wide tree are oriented, and a set of pieces
/// that is compact has a small one in any direction.
///
/// # Complexity
/// O(n) for each pass, of which there are O(log n): each merges at least a share of the clusters.
pub(super) fn agglomerate(mut row: Vec<Cluster>) -> Vec<HierarchyNode> {
    row = sorted_along_morton_curve(&row);
    let Some(&first) = row.first() else {
        return Vec::new();
    };
    let mut tree = vec![first.node; 2 * row.len() - 1];
    // The tree is filled from its end.
    let mut free = tree.len();
    while row.len() > 1 {
        let mut partners = nearest_neighbours(&row);
        if mutual_count(&partners) < MIN_MERGED_SHARE * row.len() as f32 {
            // Few are each other's nearest, as along a curve whose spacing shrinks.
            partners = (0..row.len()).map(|index| index ^ 1).collect();
        }
        let mut next = Vec::with_capacity(row.len());
        for (index, &own) in row.iter().enumerate() {
            let partner = partners[index];
            // The last one of an odd number has no partner.
            if partners.get(partner) != Some(&index) {
                next.push(own);
            } else if partner < index {
                let other = row[partner];
                free -= 2;
                (tree[free], tree[free + 1]) = (own.node, other.node);
                next.push(Cluster {
                    node: HierarchyNode::Inner(free as u32, free as u32 + 1),
                    ..merged(own, other)
                });
            }
        }
        row = next;
    }
    tree[0] = row[0].node;
    tree
}

/// Returns the cluster of the pieces of two, without a node of its own.
fn merged(one: Cluster, other: Cluster) -> Cluster {
    let weight = one.weight + other.weight;
    Cluster {
        // Equal centres stay what they are.
        centre: one.centre + (other.centre - one.centre) * (other.weight / weight),
        weight,
        node: one.node,
    }
}

/// Returns the number of clusters in pairs that are each other's partners.
fn mutual_count(partners: &[usize]) -> f32 {
    let mutual = partners.iter().enumerate();
    mutual
        .filter(|(index, partner)| partners[**partner] == *index)
        .count() as f32
}

/// Finds the nearest neighbour of each cluster in a row among those within the search radius. Of several that are as near, the
/// nearest in the row counts, and of two of these the later one for an even place, the earlier one for an odd place: clusters
/// with one centre find their partners in one pass.
fn nearest_neighbours(row: &[Cluster]) -> Vec<usize> {
    let centres: Vec<Vec3A> = row.iter().map(|cluster| cluster.centre).collect();
    let nearest = |index: usize| {
        let distance = |other: usize| centres[other].distance_squared(centres[index]);
        let (mut least, mut best) = (f32::INFINITY, index);
        for step in 1..=MORTON_SEARCH_RADIUS {
            let beside = [index.checked_sub(step), Some(index + step)];
            // The one that counts is compared first.
            let beside = if index.is_multiple_of(2) {
                [beside[1], beside[0]]
            } else {
                beside
            };
            for other in beside
                .into_iter()
                .flatten()
                .filter(|&other| other < row.len())
            {
                let distance = distance(other);
                if distance < least {
                    (least, best) = (distance, other);
                }
            }
        }
        // Without a number, the neighbour is the other one of its pair.
        if best == index {
            (index ^ 1).min(row.len() - 1)
        } else {
            best
        }
    };
    let indices = (0..row.len()).into_par_iter();
    indices
        .with_min_len(CLUSTERS_PER_TASK)
        .map(nearest)
        .collect()
}

/// Returns clusters sorted by the Morton codes of their centres.
fn sorted_along_morton_curve(clusters: &[Cluster]) -> Vec<Cluster> {
    let code = |cluster: &Cluster| morton_code(cluster.centre.as_dvec3());
    let mut order: Vec<(u64, u64)> = clusters.iter().map(code).zip(0..).collect();
    order.par_sort_unstable();
    let clusters = order.iter().map(|&(_, cluster)| clusters[cluster as usize]);
    clusters.collect()
}

/// Returns the Morton code of a point: the interleaved 21 leading bits of its coordinates in the unit interval.
fn morton_code(point: DVec3) -> u64 {
    let cell = point * f64::from(1 << 21);
    spread_bits(cell.x as u32) | spread_bits(cell.y as u32) << 1 | spread_bits(cell.z as u32) << 2
}

/// Moves bit k of 21 bits to position 3 k.
fn spread_bits(bits: u32) -> u64 {
    let mut x = u64::from(bits) & 0x1f_ffff;
    x = (x | x << 32) & 0x001f_0000_0000_ffff;
    x = (x | x << 16) & 0x001f_0000_ff00_00ff;
    x = (x | x << 8) & 0x100f_00f0_0f00_f00f;
    x = (x | x << 4) & 0x10c3_0c30_c30c_30c3;
    (x | x << 2) & 0x1249_2492_4924_9249
}

#[cfg(test)]
mod tests;
