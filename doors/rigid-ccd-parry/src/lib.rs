//! Certified shape casts for parry and rapier: parry's signatures, and answers that are never late.
//!
//! One line switches:
//!
#![cfg_attr(feature = "f32", doc = "```")]
#![cfg_attr(not(feature = "f32"), doc = "```ignore")]
//! // use parry3d::query::cast_shapes_nonlinear;
//! use rigid_ccd_parry::f32::cast_shapes_nonlinear;
//! # use parry3d::math::{Pose, Vector};
//! # use parry3d::query::NonlinearRigidMotion;
//! # use parry3d::shape::{Ball, Cuboid};
//!
//! let (ball, wall) = (Ball::new(0.5), Cuboid::new(Vector::new(0.1, 5.0, 5.0)));
//! let start = Pose::translation(-3.0, 0.0, 0.0);
//! let flies = NonlinearRigidMotion::new(start, Vector::ZERO, 4.0 * Vector::X, 20.0 * Vector::Z);
//! let rests = NonlinearRigidMotion::identity();
//! let hit = cast_shapes_nonlinear(&flies, &ball, &rests, &wall, 0.0, 1.0, true)?;
//! assert!(hit.is_some_and(|hit| hit.time_of_impact <= 0.6));
//! # Ok::<(), parry3d::query::Unsupported>(())
//! ```
//!
//! | to … | use, in the module `f32` or `f64` |
//! |---|---|
//! | replace parry's functions | [`cast_shapes_nonlinear`], [`cast_shapes`] |
//! | learn why there is no answer | [`try_cast_shapes_nonlinear`], [`try_cast_shapes`], which return a [`CastError`] |
//! | cast large shapes each frame | [`Caster`], which keeps the bodies of shared shapes |
//! | set a tolerance or a budget, or fill meshes | [`Caster::new`] with [`Options`] |
//! | ask all else that [`rigid_ccd::Solver`] answers | [`body`] and [`motion`] |
//! | hand a cast to the command `ccd` | [`Caster::record`], with the feature `record` |
//!
//! [`cast_shapes`]: crate::f32::cast_shapes
//! [`cast_shapes_nonlinear`]: crate::f32::cast_shapes_nonlinear
//! [`try_cast_shapes`]: crate::f32::try_cast_shapes
//! [`try_cast_shapes_nonlinear`]: crate::f32::try_cast_shapes_nonlinear
//! [`Caster`]: crate::f32::Caster
//! [`Caster::new`]: crate::f32::Caster::new
//! [`body`]: crate::f32::body
//! [`motion`]: crate::f32::motion
//! [`Caster::record`]: crate::f32::Caster
//!
//! # Guarantee
//! Nothing touches between the start and the time of a hit. Without a hit nothing touches in the whole interval. Both hold
//! for the shapes and motions as given, whatever they are, in floating point too: all numbers are taken over exactly into
//! double precision, in which the engine proves its answers. At the time of a hit the shapes are within the target
//! distance, and what the table says under `time_of_impact`. No input panics or takes for ever.
//!
//! # What parry's arguments mean
//! | argument | here |
//! |---|---|
//! | `motion1`, `motion2` | the same poses at all times. Orientations are those of the quaternions made units in double precision; parry's own arithmetic scales a shape by the square of the quaternion's length, which rounding takes 1e-7 from 1 |
//! | `pos1`, `vel1`, `pos2`, `vel2` | a motion without turning |
//! | `start_time`, `end_time` | both belong to the interval. Times count from time 0 of the motions. The start may be negative. An end before the start leaves no time, and no hit. The end may be the largest number, or infinite: the cast looks until the bodies have passed each other, or have repeated all poses; if they never do, until one has turned by a million radians, or the budget is spent after some seconds, where it ends as `OutOfIterations` |
//! | `max_time_of_impact` | the end, of an interval that starts at 0 |
//! | `target_distance` | bodies are in contact within it, from 0 on. It may be larger than the bodies |
//! | `stop_at_penetration: true` | a contact at the start is a hit |
//! | `stop_at_penetration: false` | bodies that touch at the start are let go for as long as they do not approach. Two convex parts that overlap are let go, for ever, if neither turns and they begin to part along the direction in which they overlap least; all other pairs of parts are asked about. Parts that overlap and do not part, or that turn, are a hit. parry's nonlinear cast also lets go what turns, and what would not go through by the end |
//! | `compute_impact_geometry_on_penetration` | plays no role: witnesses and normals are always computed |
//!
//! # What comes out
//! | field | here |
//! |---|---|
//! | `time_of_impact` | rounded down. At it the shapes are within the target distance + the tolerance ([`Options::tolerance`], or the least that can be proven at such coordinates) + what polytopes exceed their shapes by ([`BodyOfShape::excess`]) + rounding ([`BodyOfShape::slack`], twice) |
//! | `witness1`, `witness2` | the nearest points, each in its shape's frame. Of shapes that overlap at the start they are one common point |
//! | `normal1`, `normal2` | the directions to the other shape, each in its shape's frame. Of shapes that overlap at the start they are some direction |
//! | `status: Converged` | a contact. Also at the start, of shapes that touch and do not overlap |
//! | `status: PenetratingOrWithinTargetDist` | at the start, of shapes that overlap, or are nearer than the target distance |
//! | `status: OutOfIterations` | the budget is spent, or rounding allows no proof: nothing touches before that time, after it nothing is known. Witnesses are those of that time |
//! | `status: Failed` | never |
//! | `subshape1`, `subshape2` | the triangle of a mesh or height field, the segment of a polyline, the part of a compound; 0 for all others, as in parry |
//! | `Unsupported` | whatever a [`CastError`] tells |
//!
//! # Shapes
//! | shape | body |
//! |---|---|
//! | `Ball`, `Capsule`, `Cuboid`, `Segment`, `Triangle`, `ConvexPolyhedron`, `RoundCuboid`, `RoundTriangle`, `RoundConvexPolyhedron` | exact: a hull of points, grown by a radius |
//! | `TriMesh` | its triangles, exact. It is a surface, with the flag `ORIENTED` too, as in all of parry's queries between two shapes; [`Meshes`] fills it. Other flags play no role |
//! | `HeightField` | its triangles as parry computes their corners, without those that are removed |
//! | `Polyline` | its segments, exact |
//! | `Voxels` | boxes on the grid, up to rounding ([`BodyOfShape::slack`]), for a motion of any kind. parry's nonlinear cast lets them slide only |
//! | `Compound` | its parts, placed in double precision, up to rounding ([`BodyOfShape::slack`]) |
//! | `Cylinder`, `Cone`, `RoundCylinder`, `RoundCone` | a polytope about it, which exceeds it by a length that is asked for ([`Excess`]) and told ([`BodyOfShape::excess`]): contacts may be early by that, never late |
//! | `HalfSpace` | alone, not as a part: for each cast a box that has the same contacts. parry's nonlinear cast refuses it |
//! | all others | refused: their points are not known |
//!
//! # What is kept
//! A body takes longer to make than most casts: 80,000 triangles take 60 to 160 ms, and a cast at them 0.02 to 0.3 ms. The functions with
//! parry's signatures get no more than a reference to a shape, so that they keep bodies by their numbers: in each thread the
//! [64](limits::MAX_CACHED_BODIES) asked for last, in at most [256 MiB](limits::MAX_CACHED_BYTES). A call compares all numbers of both
//! shapes with those, which takes 0.3 ms for 80,000 triangles. A `Caster` keeps bodies by the address of a `SharedShape`,
//! which it holds, and compares nothing. The example `switch` measures all of it.
//!
//! # Features
//! `f32` (default) is for `parry3d`, `f64` for `parry3d-f64`. Both may be on at once. `record` adds `Caster::record`.

// The links are those of single precision.
#![cfg_attr(not(feature = "f32"), allow(rustdoc::broken_intra_doc_links))]
// Without a precision nothing is asked.
#![cfg_attr(not(any(feature = "f32", feature = "f64")), allow(dead_code))]

mod body_cache;
mod cast;
mod closed;
mod error;
mod form;
mod half_space;
mod horizon;
mod interval;
mod leaving;
pub mod limits;
mod options;
mod order;
mod prepared;
#[cfg(feature = "record")]
mod recording;
mod scene;
mod tolerance;

pub use error::{CastError, ShapeError};
pub use options::{Excess, Meshes, Options};
pub use prepared::BodyOfShape;
#[cfg(feature = "record")]
pub use recording::{RecordError, Recording};

/// Casts for `parry3d`, in single precision.
#[cfg(feature = "f32")]
#[allow(clippy::duplicate_mod)] // Both precisions are one source.
#[path = "precision"]
pub mod f32 {
    macro_rules! parry {
        () => {
            "parry3d"
        };
    }
    macro_rules! precision {
        () => {
            "f32"
        };
    }
    pub(crate) use crate::tolerance::DEFAULT_TOLERANCE_F32 as CONTACT;
    pub(crate) use parry3d as library;

    #[path = "api.rs"]
    mod api;
    pub use api::*;
}

/// Casts for `parry3d-f64`, in double precision.
#[cfg(feature = "f64")]
// Both precisions share one source, and some conversions are needed only in the other precision.
#[allow(
    clippy::duplicate_mod,
    clippy::unnecessary_cast,
    clippy::useless_conversion
)]
#[path = "precision"]
pub mod f64 {
    macro_rules! parry {
        () => {
            "parry3d_f64"
        };
    }
    macro_rules! precision {
        () => {
            "f64"
        };
    }
    pub(crate) use crate::tolerance::DEFAULT_TOLERANCE_F64 as CONTACT;
    pub(crate) use parry3d_f64 as library;

    #[path = "api.rs"]
    mod api;
    pub use api::*;
}

/// The examples in the README, run as doctests.
#[cfg(all(doctest, feature = "f32"))]
#[doc = include_str!("../README.md")]
struct ReadmeDoctests;
