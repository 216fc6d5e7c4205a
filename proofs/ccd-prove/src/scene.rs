//! What a certificate is about: links that move on each other, the meshes on them, and the pairs that stay apart.

use crate::body::Body;
use ccd_core::glam::DVec3;
use ccd_core::{Contact, Motion, Pose, Separation};

/// Links, the bodies on them, and the pairs of bodies that are to be proven apart.
#[derive(Clone, Debug, Default)]
pub struct Scene<'a> {
    /// The links, each after the one that carries it.
    pub links: Vec<Link>,
    /// The bodies.
    pub bodies: Vec<Carried<'a>>,
    /// The pairs.
    pub pairs: Vec<Pair>,
}

/// Two bodies, and what they have to be farther apart than.
#[derive(Clone, Copy, Debug)]
pub struct Pair {
    /// The numbers of both bodies.
    pub bodies: [usize; 2],
    /// The margin.
    pub margin: f64,
}

/// A link, and how it moves on the one that carries it.
#[derive(Clone, Copy, Debug)]
pub struct Link {
    /// The number of the link that carries it, counted from 1; 0 is the world.
    pub parent: usize,
    /// How it moves.
    pub joint: Joint,
}

/// How a link moves on the one that carries it.
#[derive(Clone, Copy, Debug)]
pub enum Joint {
    /// Freely, at constant rates.
    Free(Motion),
    /// About an axis, or along one.
    Axis {
        /// Whether it turns or slides.
        kind: AxisKind,
        /// The pose of the joint's frame, in which the link is when its position is 0.
        pose: Pose,
        /// The axis in the joint's frame.
        axis: DVec3,
        /// The position at time 0, in radians or as a length.
        start: f64,
        /// How the position changes in a unit of time.
        rate: f64,
    },
}

/// What a joint with an axis does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AxisKind {
    /// It turns the link about the axis.
    Turns,
    /// It moves the link along the axis.
    Slides,
}

/// A mesh on a link.
#[derive(Clone, Copy, Debug)]
pub struct Carried<'a> {
    /// The mesh.
    pub body: &'a Body,
    /// The number of the link, counted from 1; 0 is the world.
    pub link: usize,
}

/// Two points of a pair that are near each other at a time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Witness {
    /// The number of the pair.
    pub pair: usize,
    /// The time.
    pub time: f64,
    /// What the points may be farther apart than the margin.
    pub tolerance: f64,
    /// A point of each body, in the world.
    pub points: [DVec3; 2],
}

impl Witness {
    /// Returns a contact of two bodies as a witness of the only pair of their scene.
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
        let carried = |body, link| Carried { body, link };
        Scene {
            links: vec![link(a.1), link(b.1)],
            bodies: vec![carried(a.0, 1), carried(b.0, 2)],
            pairs: vec![Pair {
                bodies: [0, 1],
                margin,
            }],
        }
    }
}
