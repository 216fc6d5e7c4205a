//! Bodies of a single piece: balls, capsules and boxes.

use super::pieces::Pieces;
use super::polytope::{Facet, FacetOrigin, Polytope};
use super::{Body, Solidity};
use crate::error::{InputError, check_shape_length};
use glam::DVec3;

impl Body {
    /// Creates a solid ball about the origin, as one point with a rounding radius instead of a mesh.
    ///
    /// # Errors
    /// [`InputError::OutOfRange`] for a radius that is not from 0 to
    /// [`MAX_COORDINATE`](crate::limits::MAX_COORDINATE).
    pub fn sphere(radius: f64) -> Result<Self, InputError> {
        check_shape_length("radius", radius)?;
        Body::polytope(Polytope {
            points: vec![DVec3::ZERO],
            radius,
            ..Polytope::default()
        })
    }

    /// Creates a capsule: all points within `radius` of the segment from `−half_height` to `half_height` along z.
    ///
    /// # Errors
    /// [`InputError::OutOfRange`] for a length that is not from 0 to
    /// [`MAX_COORDINATE`](crate::limits::MAX_COORDINATE).
    pub fn capsule(radius: f64, half_height: f64) -> Result<Self, InputError> {
        check_shape_length("radius", radius)?;
        check_shape_length("half height", half_height)?;
        Body::polytope(Polytope {
            points: vec![-half_height * DVec3::Z, half_height * DVec3::Z],
            radius,
            ..Polytope::default()
        })
    }

    /// Creates a solid box with its center at the origin, given by half of each side's length.
    ///
    /// Corner `k` has a positive x, y, z if bit 0, 1, 2 of `k` is set. Faces 0 to 5 have the
    /// outward normals −x, +x, −y, +y, −z, +z.
    ///
    /// # Errors
    /// [`InputError::OutOfRange`] for a half extent that is not from 0 to
    /// [`MAX_COORDINATE`](crate::limits::MAX_COORDINATE).
    pub fn cuboid(half_extents: impl Into<[f64; 3]>) -> Result<Self, InputError> {
        let half_extents = half_extents.into();
        for (what, length) in ["half extent x", "half extent y", "half extent z"]
            .into_iter()
            .zip(half_extents)
        {
            check_shape_length(what, length)?;
        }
        let half_extents = DVec3::from_array(half_extents);
        let sign = |corner: u32, bit: u32| if corner >> bit & 1 == 1 { 1.0 } else { -1.0 };
        let corner = |k| half_extents * DVec3::new(sign(k, 0), sign(k, 1), sign(k, 2));
        let loops = [
            [0, 4, 6, 2],
            [1, 3, 7, 5],
            [0, 1, 5, 4],
            [2, 6, 7, 3],
            [0, 2, 3, 1],
            [4, 5, 7, 6],
        ];
        Body::polytope(Polytope {
            points: (0..8).map(corner).collect(),
            facets: loops
                .iter()
                .enumerate()
                .map(|(id, corners)| Facet {
                    origin: FacetOrigin::Face(id as u32),
                    corners: corners.to_vec(),
                })
                .collect(),
            ..Polytope::default()
        })
    }

    /// Creates a solid body of one convex piece, given as a polytope in the body's frame.
    ///
    /// # Errors
    /// The errors of [`Pieces::from_polytopes`].
    pub fn polytope(polytope: Polytope) -> Result<Self, InputError> {
        Body::new(&Pieces::from_polytopes(&[polytope])?, Solidity::Solid)
    }
}
