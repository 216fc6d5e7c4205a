//! Options beyond parry's arguments.

use crate::limits::DEFAULT_BUDGET;
use std::time::Duration;

/// The options of a cast that parry's arguments do not have.
///
/// ```
/// use rigid_ccd_parry::{Excess, Options};
/// let options = Options { excess: Excess::Length(1e-3), ..Options::default() };
/// # assert_eq!(options.tolerance, None);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// The distance above the target distance up to which a contact may be reported, in the scene's unit of length.
    ///
    /// `None` means 1e-6 in single and 1e-9 in double precision, but at most a millionth of the smaller body's radius.
    pub tolerance: Option<f64>,
    /// The allowed excess of polytopes around cylinders and cones.
    pub excess: Excess,
    /// Whether a triangle mesh is a surface or a solid.
    pub meshes: Meshes,
    /// The maximum work before a cast ends as `OutOfIterations`: [`Settings::budget`](ccd_core::Settings::budget). The
    /// default is a quarter of the engine's default. It takes about a second, or some seconds if both bodies make many
    /// turns. Set a deadline to limit the time.
    pub budget: u64,
    /// The maximum duration before a cast ends as `OutOfIterations`:
    /// [`Settings::deadline`](ccd_core::Settings::deadline).
    pub deadline: Option<Duration>,
}

impl Default for Options {
    fn default() -> Self {
        Options {
            tolerance: None,
            excess: Excess::default(),
            meshes: Meshes::default(),
            budget: DEFAULT_BUDGET,
            deadline: None,
        }
    }
}

/// The distance by which the polytope around a cylinder or a cone may exceed it. Because of the excess, contacts may be
/// early, by at most the time in which the bodies approach by the excess. They are never late.
///
/// The polytope touches its shape along the axes, so that a cylinder that stands, or lies along an axis, is exact.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Excess {
    /// The polytope may exceed the shape by 1/4000 of the radius.
    #[default]
    DefaultRadiusFraction,
    /// The polytope may exceed the shape by this length.
    Length(f64),
    /// Cylinders and cones are refused.
    NotAllowed,
}

/// Whether the interior of a triangle mesh belongs to the body.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Meshes {
    /// The interior is empty: only the triangles can be touched, as in all of parry's queries on two shapes. For example,
    /// bodies can move inside a mesh of a room.
    #[default]
    Surfaces,
    /// The interior is solid if the mesh has the flag `ORIENTED`, as in parry's point queries: a body inside is in
    /// contact. Such a mesh is refused unless it is closed. Meshes in compounds stay surfaces.
    SolidIfOriented,
}
