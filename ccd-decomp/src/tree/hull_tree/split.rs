//! Divides the pieces of a hull tree node into two sets.

use crate::hull::exact_hull::ExactHull;
use crate::tolerance::{MAX_EIGEN_ITERATIONS, MAX_SPREAD_SAMPLES, MIN_CHILD_SHARE};
use ccd_core::Pieces;
use ccd_core::glam::DVec3;
use ccd_core::order::greater;
use ccd_core::vector::unit;
use nalgebra::{Matrix3, SymmetricEigen, Vector3};

/// Splits sets of pieces in two, across the direction in which their centers spread most.
pub(super) struct Splitter {
    centers: Vec<DVec3>,
}

impl Splitter {
    pub(super) fn new(pieces: &Pieces) -> Self {
        let mean = |points: &[DVec3]| points.iter().sum::<DVec3>() / points.len() as f64;
        Splitter {
            centers: pieces.iter().map(|piece| mean(piece.points)).collect(),
        }
    }

    /// Partitions at least two pieces into two sets, and returns the size of the first.
    pub(super) fn split(&self, pieces: &mut [u32]) -> usize {
        if pieces.len() == 2 {
            return 1;
        }
        let axis = self.direction_of_largest_spread(pieces);
        let height = |&piece: &u32| (axis.dot(self.centers[piece as usize]), piece);
        let mut heights: Vec<(f64, u32)> = pieces.iter().map(height).collect();
        heights.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        for (piece, sorted) in pieces.iter_mut().zip(&heights) {
            *piece = sorted.1;
        }
        let middle = 0.5 * (heights[0].0 + heights[heights.len() - 1].0);
        let below = heights.partition_point(|&(height, _)| height < middle);
        let least = greater(1.0, MIN_CHILD_SHARE * pieces.len() as f64);
        if (below.min(pieces.len() - below) as f64) < least {
            pieces.len() / 2
        } else {
            below
        }
    }

    /// Returns the unit vector along which the surface of the hull of the piece centers spreads most.
    fn direction_of_largest_spread(&self, pieces: &[u32]) -> DVec3 {
        // A sample is enough.
        let stride = pieces.len().div_ceil(MAX_SPREAD_SAMPLES);
        let some = pieces.iter().step_by(stride);
        let centers: Vec<DVec3> = some.map(|&k| self.centers[k as usize]).collect();
        let mean = centers.iter().sum::<DVec3>() / centers.len() as f64;
        let reach = |p: &DVec3| (*p - mean).abs().max_element();
        let size = centers.iter().map(reach).fold(0.0, greater);
        if !(size > 0.0) {
            return DVec3::X;
        }
        // Scaled to avoid underflow.
        let unit: Vec<DVec3> = centers.iter().map(|&p| (p - mean) / size).collect();
        let spread = match ExactHull::facets_of(&unit) {
            Some(triangles) => second_moments_of_surface(&unit, &triangles),
            None => second_moments_of_points(&unit),
        };
        principal_axis(spread).unwrap_or(DVec3::X)
    }
}

/// Returns the second moments of a surface of triangles about its centroid.
fn second_moments_of_surface(points: &[DVec3], triangles: &[[u32; 3]]) -> Matrix3<f64> {
    let (mut area, mut first, mut second) = (0.0, DVec3::ZERO, Matrix3::zeros());
    for corners in triangles {
        let [p, q, r] = corners.map(|v| points[v as usize]);
        let weight = (q - p).cross(r - p).length();
        let middle = (p + q + r) / 3.0;
        area += weight;
        first += weight * middle;
        // The second moments of a triangle: those of its corners plus 9 times that of its middle, over 12.
        let corners =
            outer_product(p) + outer_product(q) + outer_product(r) + 9.0 * outer_product(middle);
        second += weight / 12.0 * corners;
    }
    second - outer_product(first / area) * area
}

fn second_moments_of_points(points: &[DVec3]) -> Matrix3<f64> {
    points.iter().map(|&p| outer_product(p)).sum()
}

/// Returns the outer product `p pᵀ` of a vector with itself.
fn outer_product(p: DVec3) -> Matrix3<f64> {
    let p = Vector3::from(p.to_array());
    p * p.transpose()
}

/// Returns the unit eigenvector of a symmetric matrix for the largest eigenvalue.
fn principal_axis(matrix: Matrix3<f64>) -> Option<DVec3> {
    let eigen = SymmetricEigen::try_new(matrix, f64::EPSILON, MAX_EIGEN_ITERATIONS)?;
    let axis = eigen.eigenvectors.column(eigen.eigenvalues.imax());
    unit(DVec3::new(axis[0], axis[1], axis[2]))
}
