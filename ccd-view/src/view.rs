//! The content of a page.

use crate::ShownMotion;
use ccd_core::glam::DVec3;
use serde::Serialize;

/// A named group of views.
#[derive(Clone, Debug, Serialize)]
pub struct Group {
    /// The name in the list of groups.
    pub name: String,
    /// The views, shown one at a time.
    pub views: Vec<View>,
}

/// One query, or one scene.
#[derive(Clone, Debug, Serialize)]
pub struct View {
    /// The name in the list of views.
    pub name: String,
    /// The result, in words.
    pub verdict: String,
    /// The duration of the motions, from time 0.
    pub duration: f64,
    /// The displayed value of time 0.
    pub start: f64,
    /// The initially displayed time.
    pub time: f64,
    /// The world point at the centre of the drawing.
    pub origin: [f64; 3],
    /// The bodies.
    pub bodies: Vec<ShownBody>,
    /// The times at which moving bodies are drawn as ghosts.
    pub ghosts: Vec<f64>,
    /// The gap between two bodies, if it is known.
    pub gap: Option<Gap>,
    /// The contacts, by time.
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
    /// The motion.
    pub motion: ShownMotion,
    moves: bool,
}

/// The gap between two bodies over time.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Gap {
    /// The gap at some times, in their order.
    pub points: Vec<GapPoint>,
    /// A proven lower bound of the gap over time: pairs of time and gap, by time.
    pub proven: Vec<[f64; 2]>,
}

/// The gap at one time.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct GapPoint {
    /// The time.
    pub time: f64,
    /// The lower bound.
    pub lower: f64,
    /// The upper bound.
    pub upper: f64,
}

/// A contact, in world coordinates at its time.
#[derive(Clone, Debug, Serialize)]
pub struct ShownContact {
    /// The time.
    pub time: f64,
    /// The touching features, in words.
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
    pub fn new(name: &str, verdict: &str, duration: f64) -> Self {
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
    pub fn new(name: &str, mesh: usize, color: &str, motion: impl Into<ShownMotion>) -> Self {
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
