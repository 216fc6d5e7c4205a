//! Digests of bodies and of the pairs that are checked.

use crate::cell::Cell;
use rigid_ccd::Body;
use rigid_ccd::body::Solidity;
use sha2::{Digest, Sha256};

/// Returns the SHA-256 digest of a body. It covers whether the body is solid, its excess, and of each piece the
/// radius, the number of points and the points. Each number is 64 bits, little-endian.
pub(super) fn body_digest(body: &Body) -> String {
    let mut hash = Sha256::new();
    hash.update([u8::from(body.solidity() == Solidity::Solid)]);
    hash.update(body.excess().to_le_bytes());
    for piece in body.pieces().iter() {
        hash.update(piece.radius.to_le_bytes());
        hash.update((piece.points.len() as u64).to_le_bytes());
        for point in piece.points {
            for coordinate in point.to_array() {
                hash.update(coordinate.to_le_bytes());
            }
        }
    }
    hexadecimal(hash)
}

/// Returns the SHA-256 digest of the checked pairs: their body indices, and the distance at which each counts as
/// touching.
pub(super) fn pairs_digest(cell: &Cell, margin: f64) -> String {
    let mut hash = Sha256::new();
    for (pair, distance) in cell.compared_pairs(margin) {
        for number in pair {
            hash.update((number as u64).to_le_bytes());
        }
        hash.update(distance.to_le_bytes());
    }
    hexadecimal(hash)
}

fn hexadecimal(hash: Sha256) -> String {
    let digits = hash.finalize();
    digits.iter().map(|byte| format!("{byte:02x}")).collect()
}
