//! Clusters the pieces of a body, so that one convex hull can enclose each cluster.

use crate::tuning::{MAX_COMPONENTS, MIN_PIECES_FOR_TWO_HULLS};
use ccd_core::{Body, Piece, Solidity, connected_part_numbers};
use rigid_ccd::glam::DVec3;

/// Divides the pieces of a body into clusters. The hulls of all clusters together cover the body.
///
/// A cluster contains pieces of one connected component. A scene in one file has many components, and no hull should
/// span the gaps between them. A component is divided into at most `max_count` clusters, a component of a solid into
/// at most [`MAX_SOLID_CLUSTERS`]. If there are more than [`MAX_COMPONENTS`] components, nearby components share a
/// cluster.
pub(super) fn connected_clusters(body: &Body, max_count: usize) -> Vec<Vec<Piece<'_>>> {
    let pieces: Vec<Piece<'_>> = body.pieces().iter().collect();
    if max_count < 2 || pieces.len() < MIN_PIECES_FOR_TWO_HULLS {
        return vec![pieces];
    }
    let components = components(body);
    if components.len() > MAX_COMPONENTS {
        let shared = divided(components, MAX_COMPONENTS, |component| {
            component.iter().map(mean_point).sum::<DVec3>() / component.len() as f64
        });
        return shared.into_iter().map(|cluster| cluster.concat()).collect();
    }
    let max_count = match body.solidity() {
        Solidity::Solid => max_count.min(MAX_SOLID_CLUSTERS),
        Solidity::Surface => max_count,
    };
    let is_small = |component: &Vec<Piece<'_>>| component.len() < MIN_PIECES_FOR_TWO_HULLS;
    let clusters = components.into_iter().flat_map(|component| {
        let count = if is_small(&component) { 1 } else { max_count };
        divided(component, count, mean_point)
    });
    clusters.collect()
}

/// The largest number of hulls that are proven to cover the interior of a solid if they cover its surface.
///
/// Proof for two hulls: let a point be in neither. Through the point, choose for each hull a plane that has the hull
/// strictly on one side. A ray along the intersection line of both planes starts at the point and meets neither hull,
/// so it never meets the surface. Hence the point is outside the solid. Four hulls can leave a gap inside.
const MAX_SOLID_CLUSTERS: usize = 2;

/// Groups the pieces of a body into connected components.
fn components(body: &Body) -> Vec<Vec<Piece<'_>>> {
    let numbers = connected_part_numbers(body.pieces());
    let count = numbers.iter().max().map_or(0, |&last| last as usize + 1);
    let mut components = vec![Vec::new(); count];
    for (piece, number) in body.pieces().iter().zip(numbers) {
        components[number as usize].push(piece);
    }
    components
}

/// Returns the mean of a piece's points.
fn mean_point(piece: &Piece<'_>) -> DVec3 {
    piece.points.iter().sum::<DVec3>() / piece.points.len() as f64
}

/// Divides items into at most `max_count` clusters by position. Splits at the median along the longest side of the
/// bounding box, then splits each half recursively.
fn divided<T>(
    mut items: Vec<T>,
    max_count: usize,
    position: impl Fn(&T) -> DVec3 + Copy,
) -> Vec<Vec<T>> {
    if max_count < 2 || items.len() < 2 {
        return vec![items];
    }
    let (mut min, mut max) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    for item in &items {
        (min, max) = (min.min(position(item)), max.max(position(item)));
    }
    let axis = (max - min).max_position();
    items.sort_by(|a, b| position(a)[axis].total_cmp(&position(b)[axis]));
    let second_half = items.split_off(items.len() / 2);
    let mut clusters = divided(items, max_count / 2, position);
    clusters.extend(divided(second_half, max_count / 2, position));
    clusters
}

#[cfg(test)]
mod tests;
