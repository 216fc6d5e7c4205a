//! Scenes with a known outcome: a first contact or a least distance, in closed form.

mod linear;
mod rounded;
mod turning;
mod twisted;

pub use linear::{combs_closing, sliding_cube};
pub use twisted::screw_in_nut;

use crate::query::{MovingShape, Query};

/// A query with its known outcome.
pub struct Scene {
    /// The name of the scene, which begins with the number of its group.
    pub name: String,
    /// The bodies and their motions.
    pub query: Query,
    /// The known outcome of the query.
    pub expected: ExpectedOutcome,
}

/// The known outcome of a scene.
pub enum ExpectedOutcome {
    /// The bodies touch, at a known time or within known bounds.
    Hit {
        /// The first time at which the distance falls to a given value. It bounds the time of contact from below.
        first_time_within_distance: TimeOfDistance,
        /// An upper bound of the time of contact.
        latest_time: f64,
    },
    /// The bodies stay apart, and their least distance is known.
    Free {
        /// The least distance of the bodies, in units of length.
        gap: f64,
    },
    /// The bodies overlap at the start.
    Overlap,
    /// No closed form of the outcome is known.
    Unknown,
}

/// A function that returns the first time at which the bodies are within a given distance.
pub type TimeOfDistance = Box<dyn Fn(f64) -> f64 + Send + Sync>;

/// Returns the scenes of all groups.
pub fn scenes() -> Vec<Scene> {
    [
        linear::scenes(),
        turning::scenes(),
        twisted::scenes(),
        rounded::scenes(),
    ]
    .into_iter()
    .flatten()
    .collect()
}

/// Returns the scenes whose name begins with `prefix`.
pub fn scenes_with_name_prefix(prefix: &str) -> Vec<Scene> {
    scenes()
        .into_iter()
        .filter(|scene| scene.name.starts_with(prefix))
        .collect()
}

impl Scene {
    fn new(name: impl Into<String>, actors: [MovingShape; 2], expect: ExpectedOutcome) -> Self {
        let [a, b] = actors;
        Scene {
            name: name.into(),
            query: Query::new(a, b),
            expected: expect,
        }
    }
}

impl ExpectedOutcome {
    /// Returns the outcome of a contact at an exactly known time. `distance` returns the first time at which the bodies
    /// are within a given distance.
    fn exact_hit(distance: impl Fn(f64) -> f64 + Send + Sync + 'static) -> Self {
        ExpectedOutcome::Hit {
            latest_time: distance(0.0),
            first_time_within_distance: Box::new(distance),
        }
    }
}
