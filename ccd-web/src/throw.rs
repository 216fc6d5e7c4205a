//! A throw: what is proven of it, and what steps see.

use crate::{Part, WebError};
use rigid_ccd::{Config, Error, Hit, HitKind, Motion, Pose, Solver};

/// A part at a place, with its velocity and its spin about its origin, for one second. The other part rests at the
/// world's origin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Throw {
    /// The place at the start.
    pub place: [f64; 3],
    /// The velocity, per second.
    pub velocity: [f64; 3],
    /// The angular velocity, in radians per second.
    pub spin: [f64; 3],
}

/// What is proven of a throw.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Found {
    /// What happens.
    pub verdict: Verdict,
    /// Nothing touches before this time.
    pub time: f64,
    /// The contact.
    pub hit: Option<Hit>,
}

/// What happens to a part that is thrown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// It touches the other one.
    Contact,
    /// It touches nothing.
    Free,
    /// It touches the other one at the start.
    Touching,
    /// It is in the other one at the start.
    Overlapping,
    /// A limit was reached.
    Unresolved,
}

impl Throw {
    /// How long it lasts, in seconds.
    pub const DURATION: f64 = 1.0;
    /// What is no farther apart than this, in metres, touches.
    pub const TOLERANCE: f64 = 1e-6;

    /// Finds the first contact.
    ///
    /// # Guarantee
    /// Nothing touches before the time that is found, in floating point.
    ///
    /// # Errors
    /// [`WebError`] for numbers out of range.
    pub fn first_contact(&self, part: &Part, target: &Part) -> Result<Found, WebError> {
        ask(part, self.motion()?, target, Throw::DURATION)
    }

    /// Looks at evenly spaced instants, from the start to the end: whether the parts touch at each.
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

fn ask(part: &Part, motion: Motion, target: &Part, duration: f64) -> Result<Found, WebError> {
    let mut solver = Solver::new().with_config(Config {
        tolerance: Throw::TOLERANCE,
        ..Config::default()
    });
    let answer = solver.first_contact(
        (&part.body, motion),
        (&target.body, Motion::STILL),
        duration,
    );
    Ok(match answer {
        Ok(None) => Found {
            verdict: Verdict::Free,
            time: duration,
            hit: None,
        },
        Ok(Some(hit)) => Found {
            verdict: match hit.kind {
                HitKind::Contact => Verdict::Contact,
                HitKind::Touching => Verdict::Touching,
                HitKind::Overlapping(_) => Verdict::Overlapping,
            },
            time: hit.time,
            hit: Some(hit),
        },
        Err(Error::Unresolved { safe_until, .. }) => Found {
            verdict: Verdict::Unresolved,
            time: safe_until,
            hit: None,
        },
        Err(error) => return Err(error.into()),
    })
}

impl Verdict {
    /// The name.
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
