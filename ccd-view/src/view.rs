//! What a page shows.

use crate::Course;
use ccd_core::glam::DVec3;
use serde::Serialize;

/// Views under one name.
#[derive(Clone, Debug, Serialize)]
pub struct Group {
    /// The name in the list of groups.
    pub name: String,
    /// The views, of which one is shown at a time.
    pub views: Vec<View>,
}

/// One query, or one scene.
#[derive(Clone, Debug, Serialize)]
pub struct View {
    /// The name in the list of views.
    pub name: String,
    /// What was found, in words.
    pub verdict: String,
    /// The end of the motions, from time 0 on.
    pub duration: f64,
    /// What time 0 is called.
    pub start: f64,
    /// The time that is shown first.
    pub time: f64,
    /// The point of the world about which pictures are drawn.
    pub origin: [f64; 3],
    /// The bodies.
    pub bodies: Vec<ShownBody>,
    /// The times at which bodies that move leave a ghost.
    pub ghosts: Vec<f64>,
    /// The gap between two bodies, if it is known.
    pub gap: Option<Gap>,
    /// What touches, by time.
    pub contacts: Vec<ShownContact>,
}

/// A body of a view.
#[derive(Clone, Debug, Serialize)]
pub struct ShownBody {
    /// The name in the legend.
    pub name: String,
    /// The number of its mesh in [`Meshes`](crate::Meshes).
    pub mesh: usize,
    /// The colour, in CSS.
    pub color: String,
    /// How it moves.
    pub motion: Course,
    moves: bool,
}

/// The gap between two bodies over time.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Gap {
    /// The gap at some times, in their order.
    pub points: Vec<GapPoint>,
    /// The line under it: at every time the gap is at least that. Times and gaps, by time.
    pub proven: Vec<[f64; 2]>,
}

/// The gap at one time.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct GapPoint {
    /// The time.
    pub time: f64,
    /// A bound from below.
    pub lower: f64,
    /// A bound from above.
    pub upper: f64,
}

/// A contact, in the world at its time.
#[derive(Clone, Debug, Serialize)]
pub struct ShownContact {
    /// The time.
    pub time: f64,
    /// What touches, in words.
    pub words: String,
    /// The nearest points of both bodies.
    pub witnesses: Option<[DVec3; 2]>,
    /// The direction from the first body to the second.
    pub normal: Option<DVec3>,
    /// The corners of the first body's feature: one of a vertex, two of an edge, three of each triangle of a face.
    pub lit_a: Vec<DVec3>,
    /// The corners of the second body's feature.
    pub lit_b: Vec<DVec3>,
}

impl View {
    /// Creates a view without bodies.
    pub fn of(name: &str, verdict: &str, duration: f64) -> Self {
        View {
            name: name.to_owned(),
            verdict: verdict.to_owned(),
            duration,
            start: 0.0,
            time: 0.0,
            origin: [0.0; 3],
            bodies: Vec::new(),
            ghosts: Vec::new(),
            gap: None,
            contacts: Vec::new(),
        }
    }
}

impl ShownBody {
    /// Creates a body.
    pub fn new(name: &str, mesh: usize, color: &str, motion: impl Into<Course>) -> Self {
        let motion = motion.into();
        ShownBody {
            name: name.to_owned(),
            mesh,
            color: color.to_owned(),
            moves: motion.moves(),
            motion,
        }
    }
}
