//! Reads the transforms of 3MF components and build items.

use crate::mesh::affine::AffineMap;
use crate::mesh::error::{MeshFault, Quote};
use ccd_core::glam::{DAffine3, DMat3, DVec3};

/// Parses a transform: the rows of a matrix that is applied from the right, `x ↦ x · M`. The last row is the
/// translation.
pub(super) fn parse(text: &str) -> Result<AffineMap, MeshFault> {
    let mut numbers = [0.0; 12];
    let mut words = text.split_whitespace();
    let mut filled = numbers.iter_mut().all(|number| {
        let word = words.next().and_then(|word| word.parse::<f64>().ok());
        word.is_some_and(|word| {
            *number = word;
            word.is_finite()
        })
    });
    filled &= words.next().is_none();
    if !filled {
        let problem = format!("has the transform {:?} instead of 12 numbers", Quote(text));
        return Err(MeshFault::malformed_content(problem));
    }
    let [x, y, z, translation] = [0, 3, 6, 9].map(|at| DVec3::from_slice(&numbers[at..]));
    // The rows of a matrix from the right are the columns of one from the left.
    let map = DAffine3::from_mat3_translation(DMat3::from_cols(x, y, z), translation);
    Ok(map.into())
}
