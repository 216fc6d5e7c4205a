//! The scene of a certificate: links that move relative to their parents, the meshes on the links, and the pairs that stay apart.

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

/// Two bodies, and their margin.
#[derive(Clone, Copy, Debug)]
pub struct Pair {
    /// The indices of both bodies in the scene.
    pub bodies: [usize; 2],
    /// The bodies stay farther apart than this distance.
    pub margin: f64,
}

/// A link, and its motion relative to its parent.
#[derive(Clone, Copy, Debug)]
pub struct Link {
    /// The parent: 0 is the world, 1 the first link.
    pub parent: usize,
    /// The joint between the parent and the link.
    pub joint: Joint,
}

/// The motion of a link relative to its parent.
#[derive(Clone, Copy, Debug)]
pub enum Joint {
    /// A free motion, at a constant velocity and a constant angular velocity.
    Free(Motion),
    /// A revolute or prismatic joint that moves at a constant rate.
    Axis {
        /// Whether the joint is revolute or prismatic.
        kind: AxisKind,
        /// The pose of the link relative to its parent at joint position 0. It is the frame of the joint.
        pose: Pose,
        /// The axis in the joint's frame.
        axis: DVec3,
        /// The joint position at time 0: an angle in radians or a length.
        start: f64,
        /// The change of the joint position per time.
        rate: f64,
    },
}

/// The kind of a joint with an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AxisKind {
    /// The link rotates about the axis.
    Revolute,
    /// The link moves along the axis.
    Prismatic,
}

/// A mesh on a link.
#[derive(Clone, Copy, Debug)]
pub struct SceneBody<'a> {
    /// The mesh.
    pub body: &'a Body,
    /// The link to which it is attached: 0 is the world, 1 the first link.
    pub link: usize,
}

/// A point of each body of a pair, and a time at which the points are near each other.
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
