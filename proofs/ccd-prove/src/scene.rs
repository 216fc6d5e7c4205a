//! The scene of a certificate: links that move on each other, the meshes on them, and the pairs that stay apart.

use crate::body::Body;
use ccd_core::glam::DVec3;
use ccd_core::{Contact, Motion, Pose, Separation};

/// Links, the bodies on them, and the pairs of bodies to prove apart.
#[derive(Clone, Debug, Default)]
pub struct Scene<'a> {
    /// The links, each after its parent.
    pub links: Vec<Link>,
    /// The bodies.
    pub bodies: Vec<SceneBody<'a>>,
    /// The pairs.
    pub pairs: Vec<Pair>,
}

/// Two bodies, and the margin that they keep.
#[derive(Clone, Copy, Debug)]
pub struct Pair {
    /// The indices of both bodies in the scene.
    pub bodies: [usize; 2],
    /// The distance that the bodies stay farther apart than.
    pub margin: f64,
}

/// A link, and its motion on its parent.
#[derive(Clone, Copy, Debug)]
pub struct Link {
    /// The parent: 0 is the world, 1 the first link.
    pub parent: usize,
    /// The joint between the parent and the link.
    pub joint: Joint,
}

/// The motion of a link on its parent.
#[derive(Clone, Copy, Debug)]
pub enum Joint {
    /// A free motion, at a constant velocity and a constant angular velocity.
    Free(Motion),
    /// A motion about an axis or along an axis, at a constant rate.
    Axis {
        /// Whether the link turns about the axis or slides along it.
        kind: AxisKind,
        /// The pose of the link on its parent at position 0. This is the frame of the joint.
        pose: Pose,
        /// The axis in the joint's frame.
        axis: DVec3,
        /// The position at time 0, in radians or as a length.
        start: f64,
        /// The change of the position per time.
        rate: f64,
    },
}

/// The kind of a joint with an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AxisKind {
    /// The link turns about the axis.
    Revolute,
    /// The link slides along the axis.
    Prismatic,
}

/// A mesh on a link.
#[derive(Clone, Copy, Debug)]
pub struct SceneBody<'a> {
    /// The mesh.
    pub body: &'a Body,
    /// The link that carries it: 0 is the world, 1 the first link.
    pub link: usize,
}

/// Two points of a pair that are near each other at a time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Witness {
    /// The index of the pair in the scene.
    pub pair: usize,
    /// The time.
    pub time: f64,
    /// The distance of the points is at most the margin plus this tolerance.
    pub tolerance: f64,
    /// A point of each body, in the world.
    pub points: [DVec3; 2],
}

impl Witness {
    /// Returns the witness of a contact, for a scene of two bodies.
    pub fn of_two(time: f64, tolerance: f64, contact: &Contact) -> Self {
        let Separation {
            witness_a,
            witness_b,
            ..
        } = contact.separation;
        Witness {
            pair: 0,
            time,
            tolerance,
            points: [witness_a, witness_b],
        }
    }
}

impl<'a> Scene<'a> {
    /// Returns the scene of two bodies that move freely.
    pub fn of_two(a: (&'a Body, Motion), b: (&'a Body, Motion), margin: f64) -> Self {
        let link = |motion| Link {
            parent: 0,
            joint: Joint::Free(motion),
        };
        let on_link = |body, link| SceneBody { body, link };
        Scene {
            links: vec![link(a.1), link(b.1)],
            bodies: vec![on_link(a.0, 1), on_link(b.0, 2)],
            pairs: vec![Pair {
                bodies: [0, 1],
                margin,
            }],
        }
    }
}
