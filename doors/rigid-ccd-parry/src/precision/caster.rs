//! Casts that cache the bodies of shapes.

use super::ask::{self, linear_cast_from_arguments, nonlinear_cast_from_arguments};
use super::library::math::{Pose, Real, Vector};
use super::library::query::{NonlinearRigidMotion, ShapeCastHit, ShapeCastOptions};
use super::library::shape::{SharedShape, TypedShape};
use super::shapes::{body, half_space};
#[cfg(feature = "record")]
use crate::Recording;
use crate::cast::{Cast, PreparedShape};
use crate::{BodyOfShape, CastError, Options, ShapeError};
use rigid_ccd::Solver;
use std::collections::HashMap;
use std::sync::Arc;

/// A caster that caches the bodies of shapes, for simulations and games that cast in each frame.
///
/// A body is found by the address of its [`SharedShape`], of which the caster holds a clone. The clone ensures that the
/// address stays in use for this shape, and that `SharedShape::make_mut` makes a copy at another address. Whenever the
/// number of bodies has doubled, the caster drops the shapes that nothing else uses.
#[doc = ""]
#[doc = "```"]
#[doc = concat!("use ", parry!(), "::math::{Pose, Vector};")]
#[doc = concat!("use ", parry!(), "::query::NonlinearRigidMotion;")]
#[doc = concat!("use ", parry!(), "::shape::SharedShape;")]
#[doc = concat!("use rigid_ccd_parry::", precision!(), "::Caster;")]
/// let (ball, wall) = (SharedShape::ball(0.5), SharedShape::cuboid(0.1, 5.0, 5.0));
/// let rests = NonlinearRigidMotion::constant_position(Pose::IDENTITY);
/// let mut caster = Caster::default();
/// for speed in [1.0, 2.0, 4.0] {
///     let start = Pose::translation(-3.0, 0.0, 0.0);
///     let flies = NonlinearRigidMotion::new(start, Vector::ZERO, speed * Vector::X, Vector::Y);
///     let hit = caster.cast_shapes_nonlinear(&flies, &ball, &rests, &wall, 0.0, 1.0, true)?;
///     assert_eq!(hit.is_some(), speed > 2.4);
/// }
/// # Ok::<(), rigid_ccd_parry::CastError>(())
/// ```
#[derive(Default)]
pub struct Caster {
    options: Options,
    solver: Solver,
    shapes: HashMap<usize, (SharedShape, PreparedShape)>,
    /// The number of cached bodies after the last removal of unused ones.
    body_count_after_removal: usize,
}

impl Caster {
    /// Creates a caster with an empty cache.
    pub fn new(options: Options) -> Self {
        Caster {
            options,
            ..Caster::default()
        }
    }

    /// Finds when two moving shapes first touch: `query::cast_shapes_nonlinear`, with the same arguments.
    ///
    /// # Guarantee
    /// Nothing touches before the time of the hit; without a hit nothing touches in the interval. See the [crate's
    /// documentation](crate) for what each argument means.
    ///
    /// # Errors
    /// [`CastError`].
    #[allow(clippy::too_many_arguments)] // They are parry's.
    pub fn cast_shapes_nonlinear(
        &mut self,
        motion1: &NonlinearRigidMotion,
        g1: &SharedShape,
        motion2: &NonlinearRigidMotion,
        g2: &SharedShape,
        start_time: Real,
        end_time: Real,
        stop_at_penetration: bool,
    ) -> Result<Option<ShapeCastHit>, CastError> {
        let (motions, times) = ([motion1, motion2], [start_time, end_time]);
        let cast =
            nonlinear_cast_from_arguments(motions, times, stop_at_penetration, &self.options)?;
        self.answer(cast, [g1, g2])
    }

    /// Finds when two shapes in linear motion first touch: `query::cast_shapes`, with the same arguments.
    ///
    /// # Guarantee
    /// The same as for [`Caster::cast_shapes_nonlinear`].
    ///
    /// # Errors
    /// [`CastError`].
    #[allow(clippy::too_many_arguments)] // They are parry's.
    pub fn cast_shapes(
        &mut self,
        pos1: &Pose,
        vel1: Vector,
        g1: &SharedShape,
        pos2: &Pose,
        vel2: Vector,
        g2: &SharedShape,
        options: ShapeCastOptions,
    ) -> Result<Option<ShapeCastHit>, CastError> {
        let cast =
            linear_cast_from_arguments([(pos1, vel1), (pos2, vel2)], options, &self.options)?;
        self.answer(cast, [g1, g2])
    }

    /// Records a cast for the command `ccd`, which can answer other questions about it and display it. The arguments are
    /// the same as for [`Caster::cast_shapes_nonlinear`].
    ///
    /// # Errors
    /// [`CastError`]; [`CastError::EmptyInterval`] for an end before the start.
    #[doc = ""]
    #[doc = "```"]
    #[doc = concat!("use ", parry!(), "::math::{Pose, Vector};")]
    #[doc = concat!("use ", parry!(), "::query::NonlinearRigidMotion;")]
    #[doc = concat!("use ", parry!(), "::shape::SharedShape;")]
    #[doc = concat!("use rigid_ccd_parry::", precision!(), "::Caster;")]
    /// let (ball, wall) = (SharedShape::ball(0.5), SharedShape::cuboid(0.1, 5.0, 5.0));
    /// let start = Pose::translation(-3.0, 0.0, 0.0);
    /// let flies = NonlinearRigidMotion::new(start, Vector::ZERO, 4.0 * Vector::X, Vector::Y);
    /// let rests = NonlinearRigidMotion::identity();
    /// let recording = Caster::default().record(&flies, &ball, &rests, &wall, 0.0, 1.0, true)?;
    #[doc = concat!("let folder = std::env::temp_dir().join(\"cast-", precision!(), "\");")]
    /// let command = recording.save(&folder)?;
    /// assert!(command.starts_with("ccd query --a "));
    /// # std::fs::remove_dir_all(&folder)?;
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[cfg(feature = "record")]
    #[allow(clippy::too_many_arguments)] // They are parry's.
    pub fn record(
        &mut self,
        motion1: &NonlinearRigidMotion,
        g1: &SharedShape,
        motion2: &NonlinearRigidMotion,
        g2: &SharedShape,
        start_time: Real,
        end_time: Real,
        stop_at_penetration: bool,
    ) -> Result<Recording, CastError> {
        let (motions, times) = ([motion1, motion2], [start_time, end_time]);
        let cast =
            nonlinear_cast_from_arguments(motions, times, stop_at_penetration, &self.options)?;
        let [a, b] = CastError::shapes_or_error([g1, g2].map(|shape| self.prepared_shape(shape)))?;
        let cast = cast.ok_or(CastError::EmptyInterval)?;
        cast.with_scene([&a, &b], |scene| Ok(Recording::new(scene)))
    }

    /// Returns the body of a shape, for other questions, or to prepare it in advance.
    ///
    /// # Errors
    /// [`ShapeError`]; [`ShapeError::HalfSpace`] for half-spaces, which have no body.
    pub fn body(&mut self, shape: &SharedShape) -> Result<Arc<BodyOfShape>, ShapeError> {
        match self.prepared_shape(shape)? {
            PreparedShape::Body(body) => Ok(body),
            PreparedShape::HalfSpace(_) => Err(ShapeError::HalfSpace),
        }
    }

    /// Returns the number of bodies in the cache.
    pub fn cached_body_count(&self) -> usize {
        self.shapes.len()
    }

    /// Removes the bodies of shapes that have no owner besides this cache.
    pub fn remove_unused_bodies(&mut self) {
        self.shapes
            .retain(|_, (shape, _)| Arc::strong_count(&shape.0) > 1);
        self.body_count_after_removal = self.shapes.len();
    }

    fn prepared_shape(&mut self, shape: &SharedShape) -> Result<PreparedShape, ShapeError> {
        if let Some((_, cached)) = self.shapes.get(&shape_address(shape)) {
            return Ok(cached.clone());
        }
        let prepared = match shape.as_typed_shape() {
            TypedShape::HalfSpace(plane) => PreparedShape::HalfSpace(half_space(plane)?),
            _ => PreparedShape::Body(Arc::new(body(&**shape, &self.options)?)),
        };
        if self.shapes.len() >= 2 * self.body_count_after_removal + MIN_BODIES_FOR_REMOVAL {
            self.remove_unused_bodies();
        }
        self.shapes
            .insert(shape_address(shape), (shape.clone(), prepared.clone()));
        Ok(prepared)
    }

    fn answer(
        &mut self,
        cast: Option<Cast>,
        shapes: [&SharedShape; 2],
    ) -> Result<Option<ShapeCastHit>, CastError> {
        let shapes = shapes.map(|shape| self.prepared_shape(shape));
        ask::run_cast(cast, shapes, &mut self.solver)
    }
}

/// Unused bodies are removed only if the cache has at least this number of bodies.
const MIN_BODIES_FOR_REMOVAL: usize = 32;

fn shape_address(shape: &SharedShape) -> usize {
    Arc::as_ptr(&shape.0).cast::<()>() as usize
}

#[cfg(test)]
mod tests;
