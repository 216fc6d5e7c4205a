//! The content of a page: groups of views, with their bodies and contacts.

use crate::ShownMotion;
use ccd_core::glam::DVec3;
use serde::Serialize;

/// A named group of views, which the page lists together.
#[derive(Clone, Debug, Serialize)]
pub struct AnimationGroup {
    /// The name of the group in the page's list of groups.
    pub name: String,
    /// The views of the group, shown one at a time.
    pub views: Vec<Animation>,
}

/// The content that the page shows at once: one query, or one scene.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Animation {
    /// The name of the view in its group's list.
    pub name: String,
    /// The result of the query or the scene, as text.
    pub verdict: String,
    /// The duration of the motions, from time 0.
    pub duration: f64,
    /// The time that the page displays when the motions are at time 0.
    pub start: f64,
    /// The time that the animation shows when the view is opened.
    pub time: f64,
    /// The point of the world that is the center of the drawing.
    pub origin: [f64; 3],
    /// The bodies of the query or the scene.
    pub bodies: Vec<ShownBody>,
    /// The times at which moving bodies are also drawn, translucent.
    pub ghost_times: Vec<f64>,
    /// The distance between two bodies over time, if it is known.
    pub gap: Option<GapCurve>,
    /// The contacts, in order of time.
    pub contacts: Vec<ShownContact>,
}

/// A body that the page draws.
#[derive(Clone, Debug, Serialize)]
pub struct ShownBody {
    /// The name of the body in the legend.
    pub name: String,
    /// The number of the body's mesh in [`Meshes`](crate::Meshes).
    pub mesh: usize,
    /// The colour of the body, in CSS.
    pub color: String,
    /// The motion by which the page moves the body.
    pub motion: ShownMotion,
}

/// The distance between two bodies over time.
#[derive(Clone, Debug, Default, Serialize)]
pub struct GapCurve {
    /// The measured distances, in order of time.
    pub points: Vec<GapSample>,
    /// A proven lower bound of the distance, as pairs of time and bound, in order of time.
    pub proven: Vec<[f64; 2]>,
    /// The unit of the distances; `None` if it is not known.
    pub unit: Option<String>,
    /// The distance that is required, if any.
    pub required: Option<f64>,
    /// The ranges of time in which the required distance is violated or unverified, in order of time.
    pub failing_ranges: Vec<FailingRange>,
}

/// A range of time in which a required distance is violated or unverified.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct FailingRange {
    /// The start of the range.
    pub from: f64,
    /// The end of the range.
    pub to: f64,
    /// Whether the distance is proven to be less than the required one everywhere in the range.
    pub is_violated: bool,
}

/// The distance between two bodies, measured at one time.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct GapSample {
    /// The time of the measurement.
    pub time: f64,
    /// The lower bound of the distance at the time of the measurement.
    pub lower: f64,
    /// The upper bound of the distance at the time of the measurement.
    pub upper: f64,
}

/// A contact, in world coordinates at its time.
#[derive(Clone, Debug, Serialize)]
pub struct ShownContact {
    /// The time of the contact.
    pub time: f64,
    /// The touching features, as text.
    pub words: String,
    /// The nearest points of both bodies, in the world frame.
    pub witnesses: Option<[DVec3; 2]>,
    /// The unit vector from the first body to the second, in the world frame.
    pub normal: Option<DVec3>,
    /// The corners of the first body's highlighted feature: one for a vertex, two for an edge, three for each triangle of
    /// a face.
    pub highlight_a: Vec<DVec3>,
    /// The corners of the second body's highlighted feature, as in `highlight_a`.
    pub highlight_b: Vec<DVec3>,
}

impl Animation {
    /// Creates a view of motions from time 0 to `duration`, without bodies.
    pub fn new(name: &str, verdict: &str, duration: f64) -> Self {
        Animation {
            name: name.to_owned(),
            verdict: verdict.to_owned(),
            duration,
            ..Animation::default()
        }
    }
}

impl ShownBody {
    /// Creates a body that is drawn with the mesh of the given number.
    pub fn new(name: &str, mesh: usize, color: &str, motion: impl Into<ShownMotion>) -> Self {
        ShownBody {
            name: name.to_owned(),
            mesh,
            color: color.to_owned(),
            motion: motion.into(),
        }
    }
}
