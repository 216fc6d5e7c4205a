//! Groups the pieces of a body, for a convex hull around each group.

use crate::tuning::{MAX_COMPONENTS, MIN_PIECES_FOR_TWO_HULLS};
use ccd_core::Piece;
use rigid_ccd::glam::DVec3;
use std::collections::HashMap;
use std::collections::hash_map::Entry;

/// Groups pieces that are connected, and each group into at most `max_count` clusters of nearby pieces. If there are too many
/// groups, all pieces are clustered together.
///
/// A scene in one file is many things apart, and the space between them is in no hull.
pub(super) fn connected_clusters(pieces: Vec<Piece<'_>>, max_count: usize) -> Vec<Vec<Piece<'_>>> {
    if max_count < 2 || pieces.len() < MIN_PIECES_FOR_TWO_HULLS {
        return vec![pieces];
    }
    let components = components(&pieces);
    if components.len() > MAX_COMPONENTS {
        return clusters(pieces, MAX_COMPONENTS);
    }
    let groups = components.into_iter();
    groups
        .flat_map(|component| clusters(component, max_count))
        .collect()
}

/// Groups pieces that share points, directly or through others.
fn components<'a>(pieces: &[Piece<'a>]) -> Vec<Vec<Piece<'a>>> {
    let mut first_at_point = HashMap::new();
    let mut sets = DisjointSets((0..pieces.len()).collect());
    for (number, piece) in pieces.iter().enumerate() {
        for point in piece.points {
            // The bits of both zeros differ; their sum with 0 is the same one.
            let key = point
                .to_array()
                .map(|coordinate| (coordinate + 0.0).to_bits());
            match first_at_point.entry(key) {
                Entry::Occupied(first) => sets.join(*first.get(), number),
                Entry::Vacant(place) => {
                    place.insert(number);
                }
            }
        }
    }
    let mut numbers = HashMap::new();
    let mut components: Vec<Vec<Piece<'a>>> = Vec::new();
    for (number, piece) in pieces.iter().enumerate() {
        let component = *numbers
            .entry(sets.representative(number))
            .or_insert_with(|| {
                components.push(Vec::new());
                components.len() - 1
            });
        components[component].push(*piece);
    }
    components
}

/// Groups pieces into at most `max_count` clusters of nearby pieces. It halves the pieces at their median along the
/// longest side of the bounding box of their middles, then halves each half in the same way.
fn clusters(mut pieces: Vec<Piece<'_>>, max_count: usize) -> Vec<Vec<Piece<'_>>> {
    if max_count < 2 || pieces.len() < MIN_PIECES_FOR_TWO_HULLS {
        return vec![pieces];
    }
    let middle = |piece: &Piece<'_>| piece.points.iter().sum::<DVec3>() / piece.points.len() as f64;
    let (mut min, mut max) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    for piece in &pieces {
        (min, max) = (min.min(middle(piece)), max.max(middle(piece)));
    }
    let axis = (max - min).max_position();
    pieces.sort_by(|a, b| middle(a)[axis].total_cmp(&middle(b)[axis]));
    let second = pieces.split_off(pieces.len() / 2);
    let mut all = clusters(pieces, max_count / 2);
    all.extend(clusters(second, max_count / 2));
    all
}

/// Disjoint sets of numbers: for each number one of the same set, up to the set's representative.
struct DisjointSets(Vec<usize>);

impl DisjointSets {
    fn representative(&mut self, mut number: usize) -> usize {
        while self.0[number] != number {
            self.0[number] = self.0[self.0[number]];
            number = self.0[number];
        }
        number
    }

    fn join(&mut self, a: usize, b: usize) {
        let (a, b) = (self.representative(a), self.representative(b));
        self.0[b] = a;
    }
}

#[cfg(test)]
mod tests;
