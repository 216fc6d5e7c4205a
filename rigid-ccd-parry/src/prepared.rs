//! Bodies of shapes, ready for casts.

use crate::ShapeError;
use crate::form::Form;
use ccd_core::Body;
use ccd_core::glam::DVec3;

/// A body made of a shape: for casts, and for all other questions of [`rigid_ccd::Solver`].
///
/// # Guarantee
/// Each point of the shape is at most [`slack`](Prepared::slack) from the body, and each point of the body at most
/// [`slack`](Prepared::slack) + [`excess`](Prepared::excess) from the shape. The casts of this crate add the slack to
/// the target distance: they are never late for it. The [body's excess](Body::excess) is slack + excess, rounded up: upper
/// bounds of distances hold for the shapes, lower ones less the slack of both.
#[derive(Clone, Debug)]
pub struct Prepared {
    body: Body,
    numbers: Vec<u32>,
    middle: DVec3,
    radius: f64,
    /// The middle, for a ball.
    point: Option<DVec3>,
    slack: f64,
    excess: f64,
}

impl Prepared {
    /// Makes the body of a form.
    pub(crate) fn new(form: &Form) -> Result<Self, ShapeError> {
        let form = form.expanded()?;
        let (body, numbers) = form.body()?;
        let (middle, radius) = form.ball();
        Ok(Prepared {
            body: exceeding(body, form.slack(), form.excess())?,
            numbers,
            middle,
            radius,
            point: form.point(),
            slack: form.slack(),
            excess: form.excess(),
        })
    }

    /// The body, in the shape's frame.
    ///
    /// Features of a triangle mesh have the mesh's numbers. Vertices of other bodies of many parts have the number of
    /// their part.
    pub fn body(&self) -> &Body {
        &self.body
    }

    /// How far points of the shape may be outside of the body, for rounding: 0 for all shapes but compounds and
    /// voxels.
    pub fn slack(&self) -> f64 {
        self.slack
    }

    /// How far the body may exceed the shape: 0 without cylinders and cones.
    pub fn excess(&self) -> f64 {
        self.excess
    }

    /// Returns the number of the sub-shape that a piece of the body is, as in
    /// `parry3d::query::ShapeCastHit::subshape1`; 0 for a piece that does not exist.
    pub fn sub_shape(&self, piece: u32) -> u32 {
        self.numbers.get(piece as usize).copied().unwrap_or(0)
    }

    /// Returns it as one that exceeds its shape by this.
    ///
    /// # Errors
    /// [`ShapeError::Body`] for what is no length.
    pub(crate) fn exceeding(self, excess: f64) -> Result<Self, ShapeError> {
        let body = exceeding(self.body, self.slack, excess)?;
        Ok(Prepared {
            body,
            excess,
            ..self
        })
    }

    /// The approximate number of bytes held.
    pub fn bytes(&self) -> usize {
        self.body.bytes() + size_of_val(self.numbers.as_slice()) + size_of::<Self>()
    }

    /// The middle of a ball, in the shape's frame; none for other shapes.
    pub(crate) fn point(&self) -> Option<DVec3> {
        self.point
    }

    /// A ball about all points: its middle, in the shape's frame, and its radius.
    pub(crate) fn ball(&self) -> (DVec3, f64) {
        (self.middle, self.radius)
    }
}

/// Returns a body that may exceed its shape by two lengths together.
fn exceeding(body: Body, slack: f64, excess: f64) -> Result<Body, ShapeError> {
    let together = if slack > 0.0 {
        (slack + excess).next_up()
    } else {
        excess
    };
    body.with_excess(together).map_err(ShapeError::Body)
}
