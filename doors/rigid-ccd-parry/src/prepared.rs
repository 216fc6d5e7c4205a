//! Bodies made from shapes, with the bounds that casts need.

use crate::ShapeError;
use crate::geometry::ShapeGeometry;
use ccd_core::Body;
use ccd_core::glam::DVec3;

/// A body made from a shape, for casts and for all other questions of [`rigid_ccd::Solver`].
///
/// # Guarantee
/// Each point of the shape is at most [`slack`](BodyOfShape::slack) from the body, and each point of the body at most
/// [`slack`](BodyOfShape::slack) + [`excess`](BodyOfShape::excess) from the shape. The casts of this crate add the slack to
/// the target distance, so the slack makes no contact late. The [body's excess](Body::excess) is slack + excess, rounded
/// up. So upper bounds of distances hold for the shapes. Subtract the slack of both bodies from lower bounds.
#[derive(Clone, Debug)]
pub struct BodyOfShape {
    body: Body,
    sub_shape_indices: Vec<u32>,
    /// An enclosing ball: its center, in the shape's frame, and its radius.
    pub(crate) enclosing_ball: (DVec3, f64),
    /// The center in the shape's frame if the body is a ball; `None` for other shapes.
    pub(crate) ball_center: Option<DVec3>,
    slack: f64,
    excess: f64,
}

impl BodyOfShape {
    /// Makes the body from the geometry of a shape.
    pub(crate) fn new(geometry: &ShapeGeometry) -> Result<Self, ShapeError> {
        let geometry = geometry.with_enclosing_polytope()?;
        let (body, sub_shape_indices) = geometry.body()?;
        let total_excess = if geometry.slack > 0.0 {
            (geometry.slack + geometry.excess).next_up()
        } else {
            geometry.excess
        };
        Ok(BodyOfShape {
            body: body.with_excess(total_excess).map_err(ShapeError::Body)?,
            sub_shape_indices,
            enclosing_ball: geometry.enclosing_ball(),
            ball_center: geometry.center_if_ball(),
            slack: geometry.slack,
            excess: geometry.excess,
        })
    }

    /// Returns the body, in the shape's frame.
    ///
    /// Features of a triangle mesh have the indices of the mesh. In other bodies of many parts, a vertex has the index of
    /// its part.
    pub fn body(&self) -> &Body {
        &self.body
    }

    /// Returns a bound on the distance of the shape's points from the body, due to rounding: 0 except for compounds and
    /// voxels.
    pub fn slack(&self) -> f64 {
        self.slack
    }

    /// Returns a bound on the body's excess over the shape: 0 without cylinders and cones.
    pub fn excess(&self) -> f64 {
        self.excess
    }

    /// Returns the sub-shape index of a piece of the body, as in `parry3d::query::ShapeCastHit::subshape1`; 0 for a
    /// piece that does not exist.
    pub fn sub_shape_index(&self, piece: u32) -> u32 {
        self.sub_shape_indices
            .get(piece as usize)
            .copied()
            .unwrap_or(0)
    }

    /// Returns the approximate memory use in bytes.
    pub fn memory_usage(&self) -> usize {
        self.body.memory_usage()
            + size_of_val(self.sub_shape_indices.as_slice())
            + size_of::<Self>()
    }
}
