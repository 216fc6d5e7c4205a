//! Functions with parry's names and signatures.

use super::ask::{self, linear_cast_from_arguments, nonlinear_cast_from_arguments};
use super::library::math::{Pose, Real, Vector};
use super::library::query::{NonlinearRigidMotion, ShapeCastHit, ShapeCastOptions, Unsupported};
use super::library::shape::{Shape, TypedShape};
use super::shapes::{half_space, shape_geometry};
use crate::body_cache::BodyCache;
use crate::cast::{Cast, PreparedShape};
use crate::{CastError, Options, ShapeError};
use rigid_ccd::Solver;
use std::cell::Cell;

/// Finds when two moving shapes first touch: parry's `query::cast_shapes_nonlinear`, but never late.
///
/// # Guarantee
/// Nothing touches before the time of the hit; without a hit nothing touches in the interval. See the [crate's
/// documentation](crate) for what each argument means.
///
/// # Errors
/// `Unsupported`; [`try_cast_shapes_nonlinear`] returns the reason.
///
/// # Complexity
/// Each call compares all numbers of both shapes with the shapes of earlier calls of the thread, to find their bodies in
/// a cache. For large meshes use a [`Caster`](super::Caster).
#[doc = ""]
#[doc = "```"]
#[doc = concat!("use ", parry!(), "::math::{Pose, Vector};")]
#[doc = concat!("use ", parry!(), "::query::NonlinearRigidMotion;")]
#[doc = concat!("use ", parry!(), "::shape::{Ball, Cuboid};")]
#[doc = concat!("use rigid_ccd_parry::", precision!(), "::cast_shapes_nonlinear;")]
/// let (ball, wall) = (Ball::new(0.5), Cuboid::new(Vector::new(0.1, 5.0, 5.0)));
/// let start = Pose::translation(-3.0, 0.0, 0.0);
/// let flies = NonlinearRigidMotion::new(start, Vector::ZERO, 4.0 * Vector::X, 20.0 * Vector::Z);
/// let rests = NonlinearRigidMotion::identity();
/// let hit = cast_shapes_nonlinear(&flies, &ball, &rests, &wall, 0.0, 1.0, true)?;
/// let time = hit.expect("it flies at the wall").time_of_impact;
/// assert!(time <= 0.6 && time > 0.5999);
#[doc = concat!("# Ok::<(), ", parry!(), "::query::Unsupported>(())")]
/// ```
#[allow(clippy::too_many_arguments)] // They are parry's.
pub fn cast_shapes_nonlinear(
    motion1: &NonlinearRigidMotion,
    g1: &dyn Shape,
    motion2: &NonlinearRigidMotion,
    g2: &dyn Shape,
    start_time: Real,
    end_time: Real,
    stop_at_penetration: bool,
) -> Result<Option<ShapeCastHit>, Unsupported> {
    let times = [start_time, end_time];
    try_cast_shapes_nonlinear(motion1, g1, motion2, g2, times, stop_at_penetration)
        .map_err(|_| Unsupported)
}

/// Finds when two moving shapes first touch, like [`cast_shapes_nonlinear`]. The error says why there is no answer.
/// `times` are the start and the end.
///
/// # Errors
/// [`CastError`].
pub fn try_cast_shapes_nonlinear(
    motion1: &NonlinearRigidMotion,
    g1: &dyn Shape,
    motion2: &NonlinearRigidMotion,
    g2: &dyn Shape,
    times: [Real; 2],
    stop_at_penetration: bool,
) -> Result<Option<ShapeCastHit>, CastError> {
    let options = Options::default();
    let cast =
        nonlinear_cast_from_arguments([motion1, motion2], times, stop_at_penetration, &options)?;
    answer(cast, [g1, g2])
}

/// Finds when two shapes in linear motion first touch: parry's `query::cast_shapes`, but never late.
///
/// # Guarantee
/// The same as for [`cast_shapes_nonlinear`].
///
/// # Errors
/// `Unsupported`; [`try_cast_shapes`] returns the reason.
///
/// # Complexity
/// The same as for [`cast_shapes_nonlinear`].
#[doc = ""]
#[doc = "```"]
#[doc = concat!("use ", parry!(), "::math::{Pose, Vector};")]
#[doc = concat!("use ", parry!(), "::query::ShapeCastOptions;")]
#[doc = concat!("use ", parry!(), "::shape::Ball;")]
#[doc = concat!("use rigid_ccd_parry::", precision!(), "::cast_shapes;")]
/// let (ball, options) = (Ball::new(1.0), ShapeCastOptions::default());
/// let (here, there) = (Pose::IDENTITY, Pose::translation(10.0, 0.0, 0.0));
/// let hit = cast_shapes(&here, 2.0 * Vector::X, &ball, &there, Vector::ZERO, &ball, options)?;
/// let time = hit.expect("they meet").time_of_impact;
/// assert!(time <= 4.0 && time > 3.9999);
#[doc = concat!("# Ok::<(), ", parry!(), "::query::Unsupported>(())")]
/// ```
#[allow(clippy::too_many_arguments)] // They are parry's.
pub fn cast_shapes(
    pos1: &Pose,
    vel1: Vector,
    g1: &dyn Shape,
    pos2: &Pose,
    vel2: Vector,
    g2: &dyn Shape,
    options: ShapeCastOptions,
) -> Result<Option<ShapeCastHit>, Unsupported> {
    try_cast_shapes((pos1, vel1, g1), (pos2, vel2, g2), options).map_err(|_| Unsupported)
}

/// Finds when two shapes in linear motion first touch, like [`cast_shapes`]. The error says why there is no answer.
///
/// # Errors
/// [`CastError`].
pub fn try_cast_shapes(
    (pos1, vel1, g1): (&Pose, Vector, &dyn Shape),
    (pos2, vel2, g2): (&Pose, Vector, &dyn Shape),
    options: ShapeCastOptions,
) -> Result<Option<ShapeCastHit>, CastError> {
    let cast =
        linear_cast_from_arguments([(pos1, vel1), (pos2, vel2)], options, &Options::default())?;
    answer(cast, [g1, g2])
}

/// The solver and the bodies that a thread reuses from call to call.
#[derive(Default)]
struct ThreadMemory {
    body_cache: BodyCache,
    solver: Solver,
}

thread_local! {
    /// The solver and the bodies of this thread; a call takes them out while it uses them.
    static THREAD_MEMORY: Cell<Option<Box<ThreadMemory>>> = const { Cell::new(None) };
}

fn answer(cast: Option<Cast>, shapes: [&dyn Shape; 2]) -> Result<Option<ShapeCastHit>, CastError> {
    // The memory is not available while its thread ends.
    let memory = THREAD_MEMORY.try_with(Cell::take).ok().flatten();
    let mut memory = memory.unwrap_or_default();
    let shapes = shapes.map(|shape| memory.prepared_shape(shape));
    let result = ask::run_cast(cast, shapes, &mut memory.solver);
    let _ = THREAD_MEMORY.try_with(|stored| stored.set(Some(memory)));
    result
}

impl ThreadMemory {
    fn prepared_shape(&mut self, shape: &dyn Shape) -> Result<PreparedShape, ShapeError> {
        match shape.as_typed_shape() {
            TypedShape::HalfSpace(plane) => half_space(plane).map(PreparedShape::HalfSpace),
            _ => {
                let geometry = shape_geometry(shape, &Options::default())?;
                self.body_cache.body(geometry).map(PreparedShape::Body)
            }
        }
    }
}

#[cfg(test)]
mod tests;
