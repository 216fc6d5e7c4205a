//! Bodies made from shapes, with what casts need to know about them.

use crate::ShapeError;
use crate::form::ShapeGeometry;
use ccd_core::Body;
use ccd_core::glam::DVec3;

/// A body made from a shape, for casts and for all other questions of [`rigid_ccd::Solver`].
///
/// # Guarantee
/// Each point of the shape is at most [`slack`](BodyOfShape::slack) from the body, and each point of the body at most
/// [`slack`](BodyOfShape::slack) + [`excess`](BodyOfShape::excess) from the shape. The casts of this crate add the slack to
/// the target distance: they are never late for it. The [body's excess](Body::excess) is slack + excess, rounded up: upper
/// bounds of distances hold for the shapes, lower ones less the slack of both.
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
    pub(crate) fn new(form: &ShapeGeometry) -> Result<Self, ShapeError> {
        let form = form.with_enclosing_polytope()?;
        let (body, numbers) = form.body()?;
        let together = if form.slack > 0.0 {
            (form.slack + form.excess).next_up()
        } else {
            form.excess
        };
        Ok(BodyOfShape {
            body: body.with_excess(together).map_err(ShapeError::Body)?,
            sub_shape_indices: numbers,
            enclosing_ball: form.enclosing_ball(),
            ball_center: form.center_if_ball(),
            slack: form.slack,
            excess: form.excess,
        })
    }

    /// Returns the body, in the shape's frame.
    ///
    /// Features of a triangle mesh have the mesh's numbers. Vertices of other bodies of many parts have the number of
    /// their part.
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
