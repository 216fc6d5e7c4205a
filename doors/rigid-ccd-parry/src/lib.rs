//! Certified shape casts for parry and rapier: parry's signatures, and answers that are never late.
//!
//! Changing one `use` switches from parry to this crate:
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
//! | ask other questions of [`rigid_ccd::Solver`] | [`body`] and [`motion`] |
//! | repeat a cast with the command `ccd` | [`Caster::record`], with the feature `record` |
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
//! Nothing touches between the start and the time of a hit. Without a hit nothing touches in the whole interval. This
//! holds for all shapes and motions, and includes all rounding errors: all numbers are converted to double precision
//! exactly, and the engine proves its answers in double precision. At the time of a hit the distance of the shapes is at
//! most the target distance plus the bounds that the table lists under `time_of_impact`. No input causes a panic or an
//! endless search.
//!
//! # What parry's arguments mean
//! | argument | here |
//! |---|---|
//! | `motion1`, `motion2` | the same poses at all times. Quaternions are normalised in double precision. parry's own arithmetic scales a shape by the square of the quaternion's length, which differs from 1 by about 1e-7 because of rounding |
//! | `pos1`, `vel1`, `pos2`, `vel2` | a motion without rotation |
//! | `start_time`, `end_time` | both belong to the interval. Times count from time 0 of the motions. The start may be negative. If the end is before the start, there is no hit. The end may be infinite or the largest number: the cast then ends after the bodies have passed each other, or have repeated all their poses. If neither happens, it ends as `OutOfIterations` after a rotation by a million radians, or when the budget is spent, after some seconds |
//! | `max_time_of_impact` | the end of an interval that starts at 0 |
//! | `target_distance` | bodies at this distance or nearer are in contact. At least 0. It may be larger than the bodies |
//! | `stop_at_penetration: true` | a contact at the start is a hit |
//! | `stop_at_penetration: false` | bodies that touch at the start are ignored as long as they do not approach. A pair of overlapping convex parts is ignored in the whole cast if neither part rotates and they begin to separate along the direction of least overlap. All other pairs of parts are examined. Overlapping parts that rotate or do not separate are a hit. parry's nonlinear cast also ignores overlapping parts that rotate, and parts that would not pass through each other before the end |
//! | `compute_impact_geometry_on_penetration` | has no effect: witnesses and normals are always computed |
//!
//! # Fields of a hit
//! | field | here |
//! |---|---|
//! | `time_of_impact` | rounded down. At this time the distance of the shapes is at most the target distance + the tolerance ([`Options::tolerance`], or the least tolerance that is possible for large coordinates) + the excess of polytopes ([`BodyOfShape::excess`]) + rounding errors (twice [`BodyOfShape::slack`]) |
//! | `witness1`, `witness2` | the nearest points, each in its shape's frame. For shapes that overlap at the start, a common point |
//! | `normal1`, `normal2` | the unit directions to the other shape, each in its shape's frame. For shapes that overlap at the start, an arbitrary direction |
//! | `status: Converged` | a contact after the start, or shapes that touch at the start without overlapping |
//! | `status: PenetratingOrWithinTargetDist` | at the start the shapes overlap, or are nearer than the target distance |
//! | `status: OutOfIterations` | the budget is spent, or rounding errors allow no proof. Nothing touches before `time_of_impact`; later times are unknown. Witnesses are the nearest points at this time |
//! | `status: Failed` | never |
//! | `subshape1`, `subshape2` | the triangle of a mesh or height field, the segment of a polyline, the part of a compound; 0 for all others, as in parry |
//! | `Unsupported` | the cast has a [`CastError`] |
//!
//! # Shapes
//! | shape | body |
//! |---|---|
//! | `Ball`, `Capsule`, `Cuboid`, `Segment`, `Triangle`, `ConvexPolyhedron`, `RoundCuboid`, `RoundTriangle`, `RoundConvexPolyhedron` | exact: a hull of points, grown by a radius |
//! | `TriMesh` | its triangles, exact. The mesh is a surface, even with the flag `ORIENTED`, as in all of parry's queries between two shapes; [`Meshes`] makes it a solid. Other flags have no effect |
//! | `HeightField` | its triangles as parry computes their corners, without those that are removed |
//! | `Polyline` | its segments, exact |
//! | `Voxels` | boxes on the grid, up to rounding ([`BodyOfShape::slack`]), for all motions. parry's nonlinear cast supports only translations |
//! | `Compound` | its parts, placed in double precision, up to rounding ([`BodyOfShape::slack`]) |
//! | `Cylinder`, `Cone`, `RoundCylinder`, `RoundCone` | an enclosing polytope, whose excess has a limit ([`Excess`]) and a known bound ([`BodyOfShape::excess`]). Contacts may be early by the excess, but never late |
//! | `HalfSpace` | only alone, not as a part of a compound: a box that has the same contacts in the cast. parry's nonlinear cast refuses half-spaces |
//! | all others | refused: their points are not known |
//!
//! # Caches
//! Making a body takes longer than most casts: 60 to 160 ms for 80,000 triangles, and 0.02 to 0.3 ms for a cast with
//! them. The functions with parry's signatures get only a reference to a shape, so they cache bodies by geometry: each
//! thread caches the [64](limits::MAX_CACHED_BODIES) most recently used bodies, in at most
//! [256 MiB](limits::MAX_CACHED_BYTES). A call compares all numbers of both shapes with the cached geometries, which takes
//! 0.3 ms for 80,000 triangles. A `Caster` caches bodies by the address of a `SharedShape`, of which it holds a clone, so
//! it compares no numbers. The example `switch` measures all these times.
//!
//! # Features
//! `f32` (default) is for `parry3d`, `f64` for `parry3d-f64`. Both may be on at once. `record` adds `Caster::record`.

// The links are to single precision.
#![cfg_attr(not(feature = "f32"), allow(rustdoc::broken_intra_doc_links))]
// Without a precision there are no casts.
#![cfg_attr(not(any(feature = "f32", feature = "f64")), allow(dead_code))]

mod body_cache;
mod cast;
mod closed;
mod error;
mod geometry;
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
