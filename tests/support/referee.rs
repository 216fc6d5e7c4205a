//! An independent judge of the first contact of two moving meshes, by a slow and simple method.
//!
//! It shares no code with the engine. Poses come from the formula of the motion, distances from all
//! pairs of vertices, edges and faces, times from undirected conservative advancement.
//! The judge of `ccd-fuzz` takes each distance in double-double, which is too slow for a million answers.

mod placement;
mod triangles;

use ccd_core::order::{greater, lesser};
pub use placement::RelativeMotion;
pub(crate) use triangles::{Face, distance_squared};
pub use triangles::{contains, nearest_on_segment, nearest_on_triangle};

use crate::query::Query;
use crate::tolerance::{NEAR_CONTACT_DISTANCE_FRACTION, STEP_FRACTION};
use ccd_core::glam::DVec3;
use triangles::PosedMesh;

/// The referee's finding about the first contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Finding {
    /// The surfaces are in contact or within the margin at the start.
    ContactAtStart,
    /// The surfaces are apart until `lo`, and in contact at `hi`.
    Hit {
        /// The time until which the bodies are proven apart.
        lo: f64,
        /// A time at which the bodies are in contact.
        hi: f64,
    },
    /// The surfaces are apart until `lo`, and later too near for a decision.
    Graze {
        /// The time until which the bodies are proven apart.
        lo: f64,
    },
    /// The surfaces are apart over the whole duration.
    Free {
        /// The least distance that was found, over the whole duration.
        gap: f64,
    },
    /// The step limit was reached before the search ended.
    Undecided {
        /// The time until which the bodies are proven apart.
        lo: f64,
    },
}

/// The judge of the first contact in one query.
pub struct Referee<'a> {
    query: &'a Query,
    motions_about_center_of_a: [RelativeMotion; 2],
    margin: f64,
}

/// The maximum number of advancement steps of a search.
const MAX_STEPS: u32 = 20_000;

impl<'a> Referee<'a> {
    /// Creates a judge that counts intersecting surfaces as a contact, with no margin.
    pub fn new(query: &'a Query) -> Self {
        Referee::with_margin(query, 0.0)
    }

    /// Creates a judge that counts surfaces nearer than `margin` as a contact.
    pub fn with_margin(query: &'a Query, margin: f64) -> Self {
        Referee {
            query,
            motions_about_center_of_a: RelativeMotion::pair(query),
            margin,
        }
    }

    /// Returns the distance of the two surfaces at a time; 0 if they intersect.
    pub fn gap(&self, time: f64) -> f64 {
        let [a, b] = self.posed_meshes(time);
        a.distance(&b)
    }

    /// Returns true if one solid contains the first vertex of the other body at a time.
    pub fn are_nested(&self, time: f64) -> bool {
        let [a, b] = self.posed_meshes(time);
        let solid = |k: usize| [&self.query.a, &self.query.b][k].shape.is_solid();
        let inside = |outer: &PosedMesh<'_>, inner: &PosedMesh<'_>| {
            inner
                .first_vertex()
                .is_some_and(|p| contains(outer.mesh(), outer.points(), p))
        };
        (solid(1) && inside(&b, &a)) || (solid(0) && inside(&a, &b))
    }

    /// Returns true if a point in world coordinates lies inside body A (0) or B (1) at the start.
    pub fn contains_at_start(&self, body: usize, point: DVec3) -> bool {
        let posed = &self.posed_meshes(0.0)[body];
        contains(
            posed.mesh(),
            posed.points(),
            point - self.motions_about_center_of_a[0].origin(),
        )
    }

    /// Searches for the first contact of the bodies.
    pub fn finding(&self) -> Finding {
        let speed = self.distance_rate_bound();
        let close = NEAR_CONTACT_DISTANCE_FRACTION * self.size();
        let (mut time, mut least) = (0.0, f64::INFINITY);
        for _ in 0..MAX_STEPS {
            let gap = self.gap(time) - self.margin;
            least = lesser(least, gap);
            if gap <= close {
                return self.find_contact(time, close / speed);
            }
            // The distance falls no faster than `speed`.
            time += STEP_FRACTION * gap / speed;
            if time >= self.query.duration {
                return Finding::Free {
                    gap: least + self.margin,
                };
            }
        }
        Finding::Undecided { lo: time }
    }

    /// Returns an upper bound on the rate of change of the distance.
    pub fn distance_rate_bound(&self) -> f64 {
        let [a, b] = &self.motions_about_center_of_a;
        (b.velocity() - a.velocity()).length() + a.max_rotational_speed() + b.max_rotational_speed()
    }

    /// Searches for a contact soon after `lo`, a time at which the bodies nearly touch.
    fn find_contact(&self, lo: f64, first_step: f64) -> Finding {
        if lo == 0.0 && self.is_in_contact(0.0) {
            return Finding::ContactAtStart;
        }
        let mut step = first_step;
        while step <= 1e-2 * self.query.duration {
            let hi = lesser(lo + step, self.query.duration);
            if self.is_in_contact(hi) {
                return Finding::Hit { lo, hi };
            }
            step *= 1.5;
        }
        Finding::Graze { lo }
    }

    fn is_in_contact(&self, time: f64) -> bool {
        let gap = self.gap(time);
        if self.margin > 0.0 {
            gap < self.margin
        } else {
            gap == 0.0
        }
    }

    fn size(&self) -> f64 {
        self.motions_about_center_of_a
            .iter()
            .map(RelativeMotion::radius)
            .fold(0.0, greater)
    }

    fn posed_meshes(&self, time: f64) -> [PosedMesh<'a>; 2] {
        let posed = |k: usize, actor: &'a crate::query::MovingShape| {
            let mesh = &actor.shape.mesh;
            PosedMesh::new(
                mesh,
                mesh.vertices
                    .iter()
                    .map(|&p| self.motions_about_center_of_a[k].point_position_at(time, p))
                    .collect(),
            )
        };
        [posed(0, &self.query.a), posed(1, &self.query.b)]
    }
}

impl Finding {
    /// Returns a time at which the bodies are certainly in contact; `None` if no contact is proven.
    pub fn proven_contact_time(self) -> Option<f64> {
        match self {
            Finding::ContactAtStart => Some(0.0),
            Finding::Hit { hi, .. } => Some(hi),
            _ => None,
        }
    }
}
