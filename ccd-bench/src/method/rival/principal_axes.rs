//! Computes the axes along which a set of triangles is thinnest and longest.

use ccd_core::glam::{DMat3, DVec3};
use ccd_core::order::greater;
use nalgebra::{Matrix3, SymmetricEigen};

/// Returns the mean of points and the principal axes of their spread as columns, the longest first,
/// right-handed \[OBBTREE96 §4\].
pub(super) fn mean_and_principal_axes(
    points: impl Iterator<Item = DVec3> + Clone,
) -> (DVec3, DMat3) {
    let (sum, count) = points
        .clone()
        .fold((DVec3::ZERO, 0.0), |(sum, count), p| (sum + p, count + 1.0));
    let mean = sum / greater(1.0, count);
    let mut spread = Matrix3::zeros();
    for point in points {
        let d = nalgebra::Vector3::from((point - mean).to_array());
        spread += d * d.transpose();
    }
    let eigen = SymmetricEigen::new(spread);
    let mut order = [0, 1, 2];
    order.sort_by(|&i, &j| eigen.eigenvalues[j].total_cmp(&eigen.eigenvalues[i]));
    let axis = |k: usize| {
        let column = eigen.eigenvectors.column(order[k]);
        DVec3::new(column[0], column[1], column[2])
    };
    let (x, y) = (axis(0), axis(1));
    (mean, DMat3::from_cols(x, y, x.cross(y)))
}
