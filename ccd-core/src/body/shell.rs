//! The connected parts of a body.

use super::pieces::Pieces;
use glam::DVec3;

/// The points of a connected part that are farthest along x, y, z, −x, −y, −z.
pub(crate) type Shell = [DVec3; 6];

/// Returns the extreme points of every connected part; pieces that share a point are connected.
pub(crate) fn shells(pieces: &Pieces) -> Vec<Shell> {
    let points = pieces.points();
    let mut parts = Parts((0..points.len() as u32).collect());
    for piece in 0..pieces.len() {
        let range = pieces.point_range(piece);
        for k in range.start + 1..range.end {
            parts.join(k - 1, k);
        }
    }
    // Equal points are adjacent after sorting by a hash of their coordinates.
    let place = |k: u32| points[k as usize].to_array().map(|x| (x + 0.0).to_bits());
    let mut by_place: Vec<(u64, u32)> = (0..points.len() as u32)
        .map(|k| (scatter(place(k)), k))
        .collect();
    by_place.sort_unstable();
    for pair in by_place.windows(2) {
        if place(pair[0].1) == place(pair[1].1) {
            parts.join(pair[0].1 as usize, pair[1].1 as usize);
        }
    }
    let mut shell_of = vec![None; points.len()];
    let mut shells: Vec<Shell> = Vec::new();
    for (k, &point) in points.iter().enumerate() {
        let shell = *shell_of[parts.root(k)].get_or_insert_with(|| {
            shells.push([point; 6]);
            shells.len() - 1
        });
        for (side, extreme) in shells[shell].iter_mut().enumerate() {
            let sign = if side < 3 { 1.0 } else { -1.0 };
            if sign * (point[side % 3] - extreme[side % 3]) > 0.0 {
                *extreme = point;
            }
        }
    }
    shells
}

/// Returns a hash of coordinates.
fn scatter(place: [u64; 3]) -> u64 {
    place.into_iter().fold(0, |mixed: u64, bits| {
        (mixed.rotate_left(23) ^ bits).wrapping_mul(0x9e37_79b9_7f4a_7c15)
    })
}

/// Disjoint sets: every element names another one of its set, a root itself.
struct Parts(Vec<u32>);

impl Parts {
    fn root(&mut self, mut k: usize) -> usize {
        while self.0[k] as usize != k {
            // Path halving shortens later searches.
            self.0[k] = self.0[self.0[k] as usize];
            k = self.0[k] as usize;
        }
        k
    }

    fn join(&mut self, a: usize, b: usize) {
        let (a, b) = (self.root(a), self.root(b));
        self.0[a.max(b)] = a.min(b) as u32;
    }
}

#[cfg(test)]
mod tests;
