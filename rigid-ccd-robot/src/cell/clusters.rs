//! Groups the pieces of a body, for a convex hull around each group.

use crate::tuning::{MAX_COMPONENTS, MIN_PIECES_FOR_TWO_HULLS};
use ccd_core::{Body, Piece, Solidity, connected_part_numbers};
use rigid_ccd::glam::DVec3;

/// Groups the pieces of a body, so that each point of the body is in the hull of a group.
///
/// Pieces that are connected are grouped: a scene in one file is many things apart, and the space between them is in no hull.
/// Each group is halved into at most `max_count` clusters, of a solid at most [`MAX_SOLID_CLUSTERS`]. If there are too many
/// groups, whole ones share clusters.
pub(super) fn connected_clusters(body: &Body, max_count: usize) -> Vec<Vec<Piece<'_>>> {
    let pieces: Vec<Piece<'_>> = body.pieces().iter().collect();
    if max_count < 2 || pieces.len() < MIN_PIECES_FOR_TWO_HULLS {
        return vec![pieces];
    }
    let components = components(body);
    if components.len() > MAX_COMPONENTS {
        let shared = halved(components, MAX_COMPONENTS, |component| {
            component.iter().map(middle).sum::<DVec3>() / component.len() as f64
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
        halved(component, count, middle)
    });
    clusters.collect()
}

/// The largest number of hulls around the surface of a solid that surely enclose the solid, too.
///
/// Let a point be in none of two hulls. A plane through it leaves each hull on one side. The line in which both planes meet
/// leaves both hulls, and so the whole surface: the point is not inside. Between four hulls there may be a gap.
const MAX_SOLID_CLUSTERS: usize = 2;

/// Groups the pieces of a body that are connected.
fn components(body: &Body) -> Vec<Vec<Piece<'_>>> {
    let numbers = connected_part_numbers(body.pieces());
    let count = numbers.iter().max().map_or(0, |&last| last as usize + 1);
    let mut components = vec![Vec::new(); count];
    for (piece, number) in body.pieces().iter().zip(numbers) {
        components[number as usize].push(piece);
    }
    components
}

fn middle(piece: &Piece<'_>) -> DVec3 {
    piece.points.iter().sum::<DVec3>() / piece.points.len() as f64
}

/// Groups things into at most `max_count` clusters of nearby ones. It halves them at their median along the longest side of the
/// bounding box of their middles, then halves each half in the same way.
fn halved<T>(
    mut things: Vec<T>,
    max_count: usize,
    middle: impl Fn(&T) -> DVec3 + Copy,
) -> Vec<Vec<T>> {
    if max_count < 2 || things.len() < 2 {
        return vec![things];
    }
    let (mut min, mut max) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    for thing in &things {
        (min, max) = (min.min(middle(thing)), max.max(middle(thing)));
    }
    let axis = (max - min).max_position();
    things.sort_by(|a, b| middle(a)[axis].total_cmp(&middle(b)[axis]));
    let second = things.split_off(things.len() / 2);
    let mut all = halved(things, max_count / 2, middle);
    all.extend(halved(second, max_count / 2, middle));
    all
}

#[cfg(test)]
mod tests;
