//! Scenes with a first contact in closed form, and near misses with a least distance in closed form.

mod linear;
mod rounded;
mod turning;
mod twisted;

pub use linear::{combs, sliding};
pub use twisted::screw_in_nut;

use crate::query::{Actor, Query};

/// A scene with its known outcome.
pub struct Scene {
    /// The name of the scene.
    pub name: String,
    /// The bodies and their motions.
    pub query: Query,
    /// The known outcome.
    pub expect: Expect,
}

/// The known outcome of a scene.
pub enum Expect {
    /// The bodies touch.
    Hit {
        /// A lower bound of the time, as a function of the distance: the first time at which the distance falls to the
        /// argument.
        earliest: Distance,
        /// An upper bound of the time.
        latest: f64,
    },
    /// The bodies stay at least this far apart, and the bound is attained.
    Free {
        /// The least distance.
        gap: f64,
    },
    /// The bodies overlap at the start.
    Overlap,
    /// No closed form is known.
    Unknown,
}

/// The first time at which the distance falls to a value.
pub type Distance = Box<dyn Fn(f64) -> f64 + Send + Sync>;

/// Every scene.
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

/// Returns the scenes whose name begins with the prefix.
pub fn scenes_named(prefix: &str) -> Vec<Scene> {
    scenes()
        .into_iter()
        .filter(|scene| scene.name.starts_with(prefix))
        .collect()
}

impl Scene {
    fn new(name: impl Into<String>, actors: [Actor; 2], expect: Expect) -> Self {
        let [a, b] = actors;
        Scene {
            name: name.into(),
            query: Query::new(a, b),
            expect,
        }
    }
}

impl Expect {
    /// Returns a contact at an exactly known time, with the known distance at all earlier times.
    fn hit(distance: impl Fn(f64) -> f64 + Send + Sync + 'static) -> Self {
        Expect::Hit {
            latest: distance(0.0),
            earliest: Box::new(distance),
        }
    }
}
