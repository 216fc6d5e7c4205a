//! Throws a part at another one: the certified first contact, and tests at equal steps.

use crate::{Part, WebError};
use rigid_ccd::answer::HitKind;
use rigid_ccd::{Hit, Motion, Pose, Settings, Solver};

/// A throw of one second: a part's position at the start, its velocity and its angular velocity. The other part rests
/// at the world's origin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Throw {
    /// The position of the part's origin at the start, in metres.
    pub place: [f64; 3],
    /// The velocity of the part, in metres per second.
    pub velocity: [f64; 3],
    /// The angular velocity of the part, in radians per second.
    pub spin: [f64; 3],
}

/// The certified result of a throw.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Thrown {
    /// The kind of the result.
    pub verdict: Verdict,
    /// The time in seconds before which nothing touches.
    pub time: f64,
    /// The first contact; `None` without one.
    pub hit: Option<Hit>,
}

/// The kind of a throw's result.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// The parts touch after the start.
    Contact,
    /// The parts never touch.
    Free,
    /// The parts touch at the start.
    Touching,
    /// The parts overlap at the start.
    Overlapping,
    /// A limit was reached before there was a result.
    Unresolved,
}

impl Throw {
    /// The duration of every throw, in seconds.
    pub const DURATION: f64 = 1.0;
    /// The distance, in metres, at which parts count as touching.
    pub const TOLERANCE: f64 = 1e-6;

    /// Finds the first contact of the thrown part with the target.
    ///
    /// # Guarantee
    /// Nothing touches before the returned time.
    ///
    /// # Errors
    /// [`WebError`] for numbers out of range.
    pub fn first_contact(&self, part: &Part, target: &Part) -> Result<Thrown, WebError> {
        ask(part, self.motion()?, target, Throw::DURATION)
    }

    /// Tests whether the parts touch at evenly spaced instants, from the start to the end.
    ///
    /// # Errors
    /// [`WebError`] for numbers out of range.
    pub fn steps(&self, part: &Part, target: &Part, count: u32) -> Result<Vec<bool>, WebError> {
        let motion = self.motion()?;
        let touches = (0..=count).map(|step| {
            let time = Throw::DURATION * f64::from(step) / f64::from(count.max(1));
            let found = ask(part, Motion::still(motion.pose(time)), target, 0.0)?;
            Ok(found.verdict != Verdict::Free)
        });
        touches.collect()
    }

    fn motion(&self) -> Result<Motion, WebError> {
        Ok(Motion::new(
            Pose::at(self.place)?,
            self.velocity,
            self.spin,
        )?)
    }
}

fn ask(part: &Part, motion: Motion, target: &Part, duration: f64) -> Result<Thrown, WebError> {
    let mut solver = Solver::new().with_settings(Settings {
        tolerance: Throw::TOLERANCE,
        ..Settings::DEFAULT
    });
    let answer = solver.first_contact(
        (&part.body, motion),
        (&target.body, Motion::STILL),
        duration,
    );
    Ok(match answer?.hit() {
        Ok(None) => Thrown {
            verdict: Verdict::Free,
            time: duration,
            hit: None,
        },
        Ok(Some(hit)) => Thrown {
            verdict: match hit.kind {
                HitKind::Contact(_) => Verdict::Contact,
                HitKind::Touching(_) => Verdict::Touching,
                HitKind::Overlapping(_) => Verdict::Overlapping,
            },
            time: hit.time,
            hit: Some(hit),
        },
        Err(known) => Thrown {
            verdict: Verdict::Unresolved,
            time: known.safe_until,
            hit: None,
        },
    })
}

impl Verdict {
    /// Returns the name of the result's kind on the page.
    pub fn name(self) -> &'static str {
        match self {
            Verdict::Contact => "contact",
            Verdict::Free => "free",
            Verdict::Touching => "touching",
            Verdict::Overlapping => "overlapping",
            Verdict::Unresolved => "unresolved",
        }
    }
}

#[cfg(test)]
mod tests;
