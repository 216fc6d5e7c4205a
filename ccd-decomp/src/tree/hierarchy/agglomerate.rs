//! Builds a tree by agglomeration: clusters that are each other's nearest neighbours become siblings, pass by pass, until one
//! is left (`[PLOC18]`).

use crate::tolerance::{MIN_MERGED_SHARE, MORTON_SEARCH_RADIUS, MORTON_SHIFTS};
use ccd_core::HierarchyNode;
use ccd_core::glam::{DVec3, Vec3A};
use rayon::prelude::*;

/// The number of clusters in a parallel task. Smaller tasks cost more than they gain.
const CLUSTERS_PER_TASK: usize = 512;

/// A set of pieces: a piece, or the root of a subtree.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cluster {
    /// The mean of the centers of the pieces, in the unit cube.
    pub(super) center: Vec3A,
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
    row = order_along_morton_curve(&row, 0.0)
        .into_iter()
        .map(|cluster| row[cluster as usize])
        .collect();
    let mut curves = MORTON_SHIFTS.map(|shift| order_along_morton_curve(&row, shift));
    let Some(&first) = row.first() else {
        return Vec::new();
    };
    let mut tree = vec![first.node; 2 * row.len() - 1];
    // The tree is filled from its end.
    let mut free = tree.len();
    let mut search = NeighbourSearch::default();
    // The place of each cluster in the next row. The second of two that merge has none.
    let mut next_places = Vec::new();
    while row.len() > 1 {
        search.find_nearest(&row, &curves);
        let partners = &mut search.nearest;
        if mutual_count(partners) < MIN_MERGED_SHARE * row.len() as f32 {
            // Few are each other's nearest, as along a curve whose spacing shrinks.
            for (index, partner) in (0..).zip(&mut *partners) {
                partner.place = index ^ 1;
            }
        }
        next_places.clear();
        let mut count = 0;
        for index in 0..row.len() {
            let mut cluster = row[index];
            let partner = partners[index].place as usize;
            // The last one of an odd number has no partner.
            if partners.get(partner).map(|of| of.place) == Some(index as u32) {
                if partner < index {
                    next_places.push(u32::MAX);
                    continue;
                }
                free -= 2;
                (tree[free], tree[free + 1]) = (cluster.node, row[partner].node);
                cluster = merged(cluster, row[partner]);
                cluster.node = HierarchyNode::Inner(free as u32, free as u32 + 1);
            }
            next_places.push(count as u32);
            row[count] = cluster;
            count += 1;
        }
        row.truncate(count);
        curves.par_iter_mut().for_each(|curve| {
            curve.retain_mut(|cluster| {
                *cluster = next_places[*cluster as usize];
                *cluster != u32::MAX
            });
        });
    }
    tree[0] = row[0].node;
    tree
}

/// Returns the cluster of the pieces of two, without a node of its own.
fn merged(one: Cluster, other: Cluster) -> Cluster {
    let weight = one.weight + other.weight;
    Cluster {
        // Equal centers stay what they are.
        center: one.center + (other.center - one.center) * (other.weight / weight),
        weight,
        node: one.node,
    }
}

/// Returns the number of clusters in pairs that are each other's partners.
fn mutual_count(partners: &[Neighbour]) -> f32 {
    let mutual = partners.iter().zip(0..);
    mutual
        .filter(|&(partner, index)| partners[partner.place as usize].place == index)
        .count() as f32
}

/// The neighbour of a cluster: its place in a row, and its squared distance.
#[derive(Clone, Copy, Debug)]
struct Neighbour {
    distance: f32,
    place: u32,
}

/// A search for nearest neighbours, whose memory is reused by one pass after the other.
#[derive(Default)]
struct NeighbourSearch {
    /// The nearest neighbour of each cluster of the row.
    nearest: Vec<Neighbour>,
    /// The centers along one of the other curves, and the nearest neighbours among them.
    centers: Vec<Vec3A>,
    nearest_along_curve: Vec<Neighbour>,
}

impl NeighbourSearch {
    /// Finds the nearest neighbour of each cluster in a row among those near it in the row or along one of the other curves.
    /// Of several that are as near, one near it in the row counts, then one along the first of the curves.
    fn find_nearest(&mut self, row: &[Cluster], curves: &[Vec<u32>]) {
        row.par_iter()
            .with_min_len(CLUSTERS_PER_TASK)
            .map(|cluster| cluster.center)
            .collect_into_vec(&mut self.centers);
        find_nearest_in_row(&self.centers, &mut self.nearest);
        for curve in curves {
            curve
                .par_iter()
                .with_min_len(CLUSTERS_PER_TASK)
                .map(|&place| row[place as usize].center)
                .collect_into_vec(&mut self.centers);
            find_nearest_in_row(&self.centers, &mut self.nearest_along_curve);
            for (&place, found) in curve.iter().zip(&self.nearest_along_curve) {
                let known = &mut self.nearest[place as usize];
                if found.distance < known.distance {
                    *known = Neighbour {
                        place: curve[found.place as usize],
                        ..*found
                    };
                }
            }
        }
    }
}

/// Finds the nearest neighbour of each center among those within the search radius. Of several that are as near, the nearest in
/// the row counts, and of two of these the later one for an even place, the earlier one for an odd place: clusters with one
/// center find their partners in one pass.
fn find_nearest_in_row(centers: &[Vec3A], nearest: &mut Vec<Neighbour>) {
    let find = |index: usize| {
        let (mut distance, mut best) = (f32::INFINITY, index);
        for step in 1..=MORTON_SEARCH_RADIUS {
            // A place before the first one is out of range, too.
            let beside = [index.wrapping_sub(step), index + step];
            // The one that counts is compared first.
            let first = usize::from(index.is_multiple_of(2));
            for other in [beside[first], beside[1 - first]] {
                if let Some(center) = centers.get(other) {
                    let square = center.distance_squared(centers[index]);
                    if square < distance {
                        (distance, best) = (square, other);
                    }
                }
            }
        }
        // Without a number, the neighbour is the other one of its pair.
        if best == index {
            best = (index ^ 1).min(centers.len() - 1);
        }
        Neighbour {
            distance,
            place: best as u32,
        }
    };
    let indices = (0..centers.len()).into_par_iter();
    indices
        .with_min_len(CLUSTERS_PER_TASK)
        .map(find)
        .collect_into_vec(nearest);
}

/// Returns the indices of clusters, sorted by the Morton codes of their centers. The centers are moved by `shift` along each
/// coordinate, in a cube of twice the size.
fn order_along_morton_curve(clusters: &[Cluster], shift: f64) -> Vec<u32> {
    let code = |cluster: &Cluster| morton_code(0.5 * (cluster.center.as_dvec3() + shift));
    let mut order: Vec<(u64, u32)> = clusters.iter().map(code).zip(0..).collect();
    order.par_sort_unstable();
    order.into_iter().map(|(_, cluster)| cluster).collect()
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
