//! The motion of one body as seen from another.

use super::path::Path;
use super::pose::Frame;
use super::trig::sin_cos;
use glam::{DMat3, DVec3};

/// The motion of each body of a pair as seen from the other, where at most one of them turns.
///
/// The rotation that takes one body's frame to the other's is then `cos(ω s) P + sin(ω s) Q + K`, as
/// that of a single path is. So is what turns the way between their centres.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RelativePath {
    /// The angular speed; zero if neither turns.
    rate: f64,
    /// `P`, `Q` and `K` for the rotation that takes B's frame to A's.
    rotation: [DMat3; 3],
    /// As seen from A, and from B.
    ways: [Way; 2],
}

/// One body as seen from another at an instant, along the axes of the latter.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Seen {
    /// Takes the seen body's frame to the seeing one's.
    pub(crate) rotation: DMat3,
    /// From the seeing body's centre of rotation to the seen one's.
    pub(crate) way: DVec3,
    /// The velocity of the seeing body's centre minus that of the seen one's.
    pub(crate) velocity: DVec3,
    /// The angular velocity of the seen body.
    pub(crate) spin: DVec3,
}

/// The way to the other body's centre, and its spin, along the axes of the body that looks.
#[derive(Clone, Copy, Debug)]
struct Way {
    /// The factors of cosine, sine and one, at the start.
    start: [DVec3; 3],
    /// The same for its change per unit of time.
    change: [DVec3; 3],
    spin: DVec3,
}

impl RelativePath {
    /// Returns none when both bodies turn.
    pub(crate) fn new(a: &Path, b: &Path) -> Option<Self> {
        if a.turns() && b.turns() {
            return None;
        }
        let (of_a, of_b) = (a.rotations(), b.rotations());
        let rotation = [0, 1, 2].map(|k| match b.turns() {
            true => of_a[2].transpose() * of_b[k],
            false => of_a[k].transpose() * of_b[2],
        });
        Some(RelativePath {
            rate: if b.turns() { b.rate } else { a.rate },
            rotation,
            ways: [Way::new(a, b), Way::new(b, a)],
        })
    }
}

impl Way {
    fn new(own: &Path, other: &Path) -> Self {
        let (start, change) = (
            other.centre_at(0.0) - own.centre_at(0.0),
            other.velocity - own.velocity,
        );
        let rotations = own.rotations().map(|part| part.transpose());
        Way {
            start: rotations.map(|part| part * start),
            change: rotations.map(|part| part * change),
            // One of the two does not turn.
            spin: rotations[2] * other.spin,
        }
    }
}

impl RelativePath {
    /// Returns B as seen from A.
    #[inline(always)]
    pub(crate) fn seen_by_a(&self, s: f64) -> Seen {
        let (sin, cos) = self.sin_cos(s);
        let [p, q, k] = self.rotation;
        let rotation = p * cos + q * sin + k;
        self.ways[0].seen(rotation, s, (sin, cos))
    }

    /// Returns A as seen from B.
    #[inline(always)]
    pub(crate) fn seen_by_b(&self, s: f64) -> Seen {
        let (sin, cos) = self.sin_cos(s);
        let [p, q, k] = self.rotation;
        let rotation = (p * cos + q * sin + k).transpose();
        self.ways[1].seen(rotation, s, (sin, cos))
    }

    #[inline(always)]
    fn sin_cos(&self, s: f64) -> (f64, f64) {
        sin_cos(self.rate * s)
    }
}

impl Way {
    #[inline(always)]
    fn seen(&self, rotation: DMat3, s: f64, (sin, cos): (f64, f64)) -> Seen {
        let [p, q, k] = self.change;
        let change = p * cos + q * sin + k;
        let [p, q, k] = self.start;
        Seen {
            rotation,
            way: p * cos + q * sin + k + change * s,
            velocity: -change,
            spin: self.spin,
        }
    }
}

impl Seen {
    /// Returns a body as seen from another, for any motions.
    #[inline(always)]
    pub(crate) fn at(own: &Path, other: &Path, s: f64) -> Self {
        let (frame, other_frame) = (own.frame(s), other.frame(s));
        Seen {
            rotation: frame.rotation.transpose() * other_frame.rotation,
            way: frame.inverse_vector(other.centre_at(s) - own.centre_at(s)),
            velocity: frame.inverse_vector(own.velocity - other.velocity),
            spin: frame.inverse_vector(other.spin),
        }
    }

    /// Returns the frame that takes coordinates of the seen body to those of the seeing one.
    #[inline(always)]
    pub(crate) fn frame(&self, own: &Path, other: &Path) -> Frame {
        Frame {
            rotation: self.rotation,
            translation: self.way + own.centre - self.rotation * other.centre,
        }
    }
}

#[cfg(test)]
mod tests;
