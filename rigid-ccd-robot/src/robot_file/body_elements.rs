//! Selects the shapes of a robot's file that become bodies.

/// The kind of shapes that become bodies.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum BodyElements {
    /// Collision shapes: `collision` elements of a URDF, and geoms of an MJCF that can collide.
    #[default]
    Collision,
    /// Visual shapes: `visual` elements of a URDF, and geoms in the groups 0 to 2 of an MJCF.
    Visual,
}
