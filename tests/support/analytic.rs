//! Scenes whose first contact is known in closed form, and near misses whose least distance is.

mod linear;
mod rounded;
mod turning;
mod twisted;

pub use linear::{combs, sliding};
pub use twisted::screw_in_nut;

use crate::query::{Actor, Query};

/// A scene with its known outcome.
pub struct Scene {
    /// Its name.
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
        /// No earlier than when this says the distance first comes down to its argument.
        earliest: Distance,
        /// No later than this.
        latest: f64,
    },
    /// They stay this far apart, and no farther.
    Free {
        /// The least distance.
        gap: f64,
    },
    /// They overlap at the start.
    Overlap,
    /// No closed form is known.
    Unknown,
}

/// The time at which the distance first comes down to a value.
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

/// The scenes whose name begins so.
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
            query: Query {
                a,
                b,
                duration: 1.0,
            },
            expect,
        }
    }
}

impl Expect {
    /// A contact at a time known exactly, as the distance is at all times before it.
    fn hit(distance: impl Fn(f64) -> f64 + Send + Sync + 'static) -> Self {
        Expect::Hit {
            latest: distance(0.0),
            earliest: Box::new(distance),
        }
    }
}
