//! Which shapes of a robot's file become bodies.

/// The kind of XML elements of a robot's links that become bodies.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum BodyElements {
    /// The shapes for collision checks: the elements `collision` of a URDF, the geoms of an MJCF that can collide.
    #[default]
    Collision,
    /// The shapes for drawing: the elements `visual` of a URDF, the geoms of the groups 0 to 2 of an MJCF.
    Visual,
}
